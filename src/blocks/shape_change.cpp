#include "blocks/shape_change.hpp"

#include "blocks/kinematics.hpp"

namespace edda {

std::vector<double> shape_change(const BlockSet& b, const BodyVectors& then, const BodyVectors& now,
                                 std::size_t i) {
  const Meshes& m = b.meshes;
  const std::size_t mode = b.bending.modes();
  struct Seen {
    AffineMotion affine;
    Vec2 centre;
    Rotation r;
  };
  const auto seen = [&](const BodyVectors& x) {
    return Seen{affine_motion(b, vectors_of(x, i), i), centroid(x, i),
                rotation(deformation(b, x, i))};
  };
  const auto from_block = [&](const Seen& s, const BodyVectors& x, std::size_t j) {
    const Vec2 arm = s.affine.of(m.arm_x[j], m.arm_y[j]) + x.modes[mode + j] - s.centre;
    return Vec2{s.r.c * arm.x + s.r.s * arm.y, s.r.c * arm.y - s.r.s * arm.x};
  };
  const Seen before = seen(then), after = seen(now);
  std::vector<double> change;
  for (std::size_t j = m.begin[i]; j < m.begin[i + 1]; ++j)
    change.push_back(norm(from_block(after, now, j) - from_block(before, then, j)));
  return change;
}

}  // namespace edda
