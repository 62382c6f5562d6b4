// Blocks that belong together, such as those that touch each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

/// Disjoint sets of blocks that are joined pairwise; a set is identified by its lowest member.
class Sets {
 public:
  explicit Sets(std::size_t n) : of_(n) { std::iota(of_.begin(), of_.end(), Id{0}); }
  Id find(Id i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(Id i, Id j) {
    const Id a = find(i), b = find(j);
    of_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Id> of_;
};

}  // namespace edda
