#include "step/contact_pairs.hpp"

#include <cmath>

#include "contacts/face_reading.hpp"
#include "step/faces_now.hpp"
#include "step/simulation.hpp"

namespace edda {

std::vector<std::pair<Id, Id>> blocks_in_contact(const Simulation& sim, Nearness nearness) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  std::vector<std::pair<Id, Id>> pairs;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (is_closed_now(sim, k) || (nearness == Nearness::touching && meets(face_row(sim, k))) ||
        (nearness == Nearness::near &&
         meets_within(face_row(sim, k), drawn_gap * smaller_size(f, b, k))))
      pairs.emplace_back(block_of_edge(b, f, k), block_of_facing(b, f, k));
  }
  const PointSet& p = sim.point_contacts;
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (p.closed[k] > 0.0 || nearness == Nearness::near ||
        (nearness == Nearness::touching && meets(p, b, sim.motion.pose, k, f.noise)))
      pairs.emplace_back(b.vertex_block[p.vertex[k]], b.vertex_block[p.edge[k]]);
  }
  return pairs;
}

NormalForces normal_forces(const Simulation& sim, const std::vector<double>& of_faces) {
  NormalForces all;
  const auto add = [&](double force, std::size_t ends) {
    all.size += std::abs(force);
    if (!(force > 0.0)) return;
    all.pressed += force;
    all.ends += ends;
  };
  for (const double force : of_faces) add(force, 2);
  for (const double force : sim.point_contacts.normal) add(force, 1);
  for (const std::array<Vec2, 3>& on_corners : sim.motion.zones.force) {
    for (const Vec2 force : on_corners) add(norm(force), 1);
  }
  return all;
}

}  // namespace edda
