#include "run/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/face_energy.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

/// Strain energy between steps n - 1 and n; x_{n-1} = x_n - h v_{n-1/2}.
double block_strain_energy(const BlockSet& b, const State& s, double h, std::size_t i) {
  const Deformation now = deformation(b, s.x, s.y, i);
  const Deformation rate = deformation(b, s.vx, s.vy, i);
  const Deformation before{now.xx - h * rate.xx, now.xy - h * rate.xy, now.yx - h * rate.yx,
                           now.yy - h * rate.yy};
  const double strain = strain_energy(corotated_strain(before, rotation(before)),
                                      corotated_strain(now, rotation(now)), b.volume[i],
                                      b.lame_lambda[i], b.lame_mu[i]);
  if (b.initial_xx.empty()) return strain;
  return strain + initial_energy(before, now, initial_stress(b, i), b.volume[i], b.lame_lambda[i],
                                 b.lame_mu[i]);
}

double block_gravity_energy(const BlockSet& b, const State& s, double h, Vec2 gravity,
                            std::size_t i) {
  const Vec2 half_back = 0.5 * h * centroid(s.vx, s.vy, i);
  const Vec2 moved = centroid(s.x, s.y, i) - half_back - Vec2{b.centroid_x[i], b.centroid_y[i]};
  return -b.mass[i] * dot(gravity, moved);
}

}  // namespace

double rounding_energy(const BlockSet& b, const FaceSet& c) {
  double size = 0.0, stiffness = 0.0;
  for (const double x : b.vertex_x) size = std::max(size, std::abs(x));
  for (const double y : b.vertex_y) size = std::max(size, std::abs(y));
  for (std::size_t i = 0; i < b.size(); ++i) {
    stiffness =
        std::max(stiffness, (b.lame_lambda[i] + 2.0 * b.lame_mu[i]) * b.volume[i] / b.area[i]);
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double shorter = std::min(b.edge_length[c.edge[k]], b.edge_length[c.facing[k]]);
    stiffness = std::max(stiffness, 0.5 * c.stiffness[k] * shorter);
  }
  const double stretch = 1e4 * std::numeric_limits<double>::epsilon() * size;
  return 0.5 * static_cast<double>(b.size()) * stiffness * stretch * stretch;
}

Ledger sum_ledger(const BlockSet& b, const State& s, double h, const Pose& pose, const FaceSet& c,
                  const BoundarySprings& springs, const DampingWork& work, Vec2 gravity) {
  auto over_free = [&](auto&& term) {
    return ordered_sum(b.size(),
                       [&](std::size_t i) { return b.fixed[i] || !s.alive[i] ? 0.0 : term(i); });
  };
  Ledger l;
  l.kinetic = over_free([&](std::size_t i) { return kinetic_energy(b, s.vx, s.vy, i); });
  l.strain = over_free([&](std::size_t i) { return block_strain_energy(b, s, h, i); });
  l.gravity = over_free([&](std::size_t i) { return block_gravity_energy(b, s, h, gravity, i); });
  const auto over_faces = [&](const ChunkColumn& taken) {
    return ordered_sum(c.size(), [&](std::size_t k) { return taken[k]; });
  };
  l.contact = ordered_sum(c.size(), [&](std::size_t k) { return face_energy(c, b, pose, k); }) +
              boundary_energy(springs, pose);
  l.friction = c.retired_friction + over_faces(c.friction_work);
  l.fracture = c.retired_fracture + over_faces(c.fracture_work);
  l.damping = c.retired_damping + over_faces(c.damping_work) + over_faces(c.now.damping_due) +
              ordered_sum(work.joules.size(), [&](std::size_t i) { return work.joules[i]; });
  l.transfer = c.retired_transfer + over_faces(c.transfer);
  return l;
}

}  // namespace edda
