// Forces on the free blocks among several, completed in loops over all of them.
#pragma once

#include <array>
#include <cassert>

#include "base/parallel.hpp"
#include "blocks/kinematics.hpp"

namespace edda {

/// Which of the blocks [begin, end), not more than blocks_at_once, are free: 1, or else 0.
class FreeMarks {
 public:
  FreeMarks(const BlockSet& b, const State& s, std::size_t begin, std::size_t end) : begin_(begin) {
    assert(end - begin <= blocks_at_once);
    const std::uint8_t *const fixed = b.fixed.data() + begin, *const alive = s.alive.data() + begin;
    for (std::size_t n = 0; n < end - begin; ++n) {
      marks_[n] = ((fixed[n] == 0) & (alive[n] != 0)) ? 1.0 : 0.0;
    }
  }
  const double* data() const { return marks_.data(); }
  std::size_t begin() const { return begin_; }

 private:
  std::size_t begin_;
  std::array<double, blocks_at_once> marks_;
};

/// Forces, and those `on` the same blocks that are yet to be added to them, N.
struct ForcesToAdd {
  const BodyVectors& on;
  BodyVectors& forces;
};

/// The same, for the loops over the blocks of some marks.
struct FreeForces {
  ConstNodeValues on_x, on_y;
  NodeValues x, y;
  const double* free;
  std::size_t begin;

  /// Adds what is to be added on node k of block i, or sets its force to 0 if it is not free.
  EDDA_INLINE Vec2 complete(std::size_t k, std::size_t i) const {
    const bool is_free = free[i - begin] > 0.0;
    const double fx = x[k][i] + on_x[k][i], fy = y[k][i] + on_y[k][i];
    const Vec2 f{is_free ? fx : 0.0, is_free ? fy : 0.0};
    x[k][i] = f.x;
    y[k][i] = f.y;
    return f;
  }
};
inline FreeForces free_forces(const ForcesToAdd& f, const FreeMarks& marks) {
  return {values_of(f.on.x),     values_of(f.on.y), values_of(f.forces.x),
          values_of(f.forces.y), marks.data(),      marks.begin()};
}

/// Adds them on the nodes of the blocks [begin, end), not more than blocks_at_once; those that are
/// not free have no force.
void add_to_free(const BlockSet& blocks, const State& state, const ForcesToAdd& forces,
                 std::size_t begin, std::size_t end);

/// The same on their modes, also of blocks that are not free: advance_modes() does not move these.
void add_to_modes(const BlockSet& blocks, const ForcesToAdd& forces, std::size_t begin,
                  std::size_t end);

}  // namespace edda
