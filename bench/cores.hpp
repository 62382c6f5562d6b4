// How a step would be shared by more cores than this machine has: what is not shared at all, and
// what the busiest of so many threads has to do of each loop.
#pragma once

#include <cstddef>

#include "base/parallel.hpp"

namespace edda {

/// Makes the loops of base/parallel.hpp run on one thread, and counts as if there were more.
class CountedCores : public LoopListener {
 public:
  explicit CountedCores(int cores) : cores_(static_cast<std::size_t>(cores)) {
    loop_listener = this;
  }
  ~CountedCores() override { loop_listener = nullptr; }
  CountedCores(const CountedCores&) = delete;
  CountedCores& operator=(const CountedCores&) = delete;

  double now() override;  ///< of this thread alone, whatever else runs on the machine
  void shared(std::span<const double> seconds_of_tasks,
              std::span<const std::size_t> weights) override;

  std::size_t loops() const { return loops_; }
  double on_one() const { return on_one_; }    ///< s: all tasks of all loops
  double busiest() const { return busiest_; }  ///< s: of each loop what its busiest thread does

 private:
  std::size_t cores_, loops_ = 0;
  double on_one_ = 0.0, busiest_ = 0.0;
};

}  // namespace edda
