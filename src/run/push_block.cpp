#include "run/push_block.hpp"

#include "integrate/leapfrog.hpp"

namespace edda {

double kick_of(const StepTaken& taken) {
  const double h_mean = 0.5 * (taken.h_old + taken.h_new);
  return h_mean / (1.0 + 0.5 * taken.mass_damping * h_mean);
}

void push_block(const BlockSet& b, State& s, Pose& pose, Id i, const std::array<Vec2, 3>& force,
                double kick, double h_new, StrainDamping* strain) {
  if (b.fixed[i]) return;
  std::array<Vec2, 3> dv = accelerations(b, i, force);
  for (Vec2& v : dv) v = kick * v;
  if (strain != nullptr) dv = damped_change(*strain, b, s, h_new, i, dv);
  for (std::size_t k = 0; k < 3; ++k) {
    s.vx[k][i] += dv[k].x;
    s.vy[k][i] += dv[k].y;
    s.x[k][i] += h_new * dv[k].x;
    s.y[k][i] += h_new * dv[k].y;
  }
  place_vertices(b, s.x, s.y, i, pose.x, pose.y);
}

}  // namespace edda
