#include "observe/observe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/face_softening.hpp"
#include "forces/elastic.hpp"
#include "observe/overstress.hpp"
#include "step/contact_pairs.hpp"
#include "step/faces_now.hpp"
#include "step/ground_motion.hpp"

namespace edda {
namespace {

bool moves(const Simulation& sim, std::size_t i) {
  return is_free(sim.scene->blocks, sim.motion.state, i);
}

/// F = I + sum u_k G_k^T: exactly the identity where nothing has moved.
Deformation deformation_of(const BlockSet& b, const State& s, std::size_t i) {
  const Deformation by =
      gradient_of(b, vectors_of(s.position, i) - vectors_of(b.node_x, b.node_y, i), i);
  return {1.0 + by.xx, by.xy, by.yx, 1.0 + by.yy};
}

/// Angular velocity: the rate of the polar angle in the affine motion of the block.
double spin(const BlockSet& b, const State& s, std::size_t i) {
  // theta = atan2(beta, alpha) with alpha = F11 + F22, beta = F21 - F12.
  const Deformation f = deformation_of(b, s, i), rate = deformation(b, s.velocity, i);
  const double alpha = f.xx + f.yy, beta = f.yx - f.xy;
  const double alpha_rate = rate.xx + rate.yy, beta_rate = rate.yx - rate.xy;
  return (alpha * beta_rate - beta * alpha_rate) / (alpha * alpha + beta * beta);
}

double polar_angle(const BlockSet& b, const State& s, std::size_t i) {
  const Deformation f = deformation_of(b, s, i);
  return std::atan2(f.yx - f.xy, f.xx + f.yy);
}

/// Displacement of the middle of the overlap along the edge since the start: relative to each
/// other, of the two material points that lie there now.
double slip_since_start(const BlockSet& b, const FaceRow& row) {
  const FaceSet& f = row.of;
  const double xi = 0.5 * (row.state.xi_a + row.state.xi_b);
  const double eta = 0.5 * (row.state.eta_a + row.state.eta_b);
  const FacePoints drawn = face_points(f, b.vertex_x, b.vertex_y, row.k);
  return -dot(from_point_of_e(drawn, xi, eta),
              frame_of(drawn, f.inverse_e[row.k], f.inverse_f[row.k]));
}

/// Closed length of the overlap, and the stresses on it: k d at the ends.
void add_stresses(ContactRecord& r, const Simulation& sim, const FaceRow& row) {
  const FaceSet& f = row.of;
  const std::size_t k = row.k;
  const FaceFields& m = row.state;
  const bool carries_tension = f.carries_tension(k);
  const double a = carries_tension ? m.closure_a : std::max(m.closure_a, 0.0);
  const double b = carries_tension ? m.closure_b : std::max(m.closure_b, 0.0);
  const double apart = std::abs(m.closure_a - m.closure_b);
  const bool whole = carries_tension || std::min(m.closure_a, m.closure_b) >= 0.0;
  r.closed_length = whole ? r.length : r.length * (a + b) / apart;
  const double area = r.length * sim.motion.laws.thickness;
  const double stiffness = m.gate * f.stiffness[k] / sim.motion.laws.thickness;
  r.normal_stress_a = stiffness * a;
  r.normal_stress_b = stiffness * b;
  r.normal_stress = area > 0.0 ? r.normal_force / area : 0.0;
  r.shear_stress = area > 0.0 ? r.shear_force / area : 0.0;
}

/// Displacement of vertex v, m.
Vec2 displacement_of_corner(const BlockSet& b, const State& s, std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  const Vec2 affine = displacement_of(s, i, weights_of(b.weight, v));
  if (b.mode_places() == 0) return affine;
  return affine + deviation_at(b, s.position, v) - deviation_at(b, s.reference, v);
}

/// What a joint with fracture energy has lost of its strength.
void add_crack(ContactRecord& r, const Simulation& sim, std::size_t k) {
  const FaceSet& f = sim.motion.contacts;
  if (f.is(FaceFlag::softens, k)) {
    const FaceEnds damage = damage_of(f, sim.motion.laws, k);
    r.damage = 0.5 * (damage.a + damage.b);
  } else if (f.is_broken(k)) {
    r.damage = 1.0;
    r.crack = f.is(FaceFlag::broken_in_shear, k) ? CrackMode::shear : CrackMode::tension;
  }
}

void add_water(ContactRecord& r, const Simulation& sim, const FaceRow& row) {
  const FlowRow* flow = row_of(sim.attached.joint_water, row.of.edge[row.k], row.of.facing[row.k]);
  if (flow == nullptr) return;
  r.aperture = flow->aperture;
  r.discharge = flow->discharge;
  r.water_pressure_a = flow->pressure_a;
  r.water_pressure_b = flow->pressure_b;
  const double sum = flow->pressure_a + flow->pressure_b;
  r.head = sum > 0.0 ? r.position.y + 0.5 * sum / sim.scene->model.waters.front().unit_weight
                     : std::numeric_limits<double>::quiet_NaN();
}

ContactRecord face_record(const Simulation& sim, const FaceRow& row) {
  const FaceSet& f = row.of;
  const std::size_t k = row.k;
  const BlockSet& b = sim.scene->blocks;
  ContactRecord r;
  r.block_i = block_of_facing(b, f, k);
  r.block_j = block_of_edge(b, f, k);
  const std::size_t law = f.law[k];
  r.joint = "glued";
  if (law < sim.scene->model.joints.size()) r.joint = sim.scene->model.joints[law].name;
  r.table = b.table_of(f.edge[k], f.facing[k]);
  const bool apart = f.is_broken(k) && !(row.state.length > 0.0);
  const FaceSpan span = apart ? edge_of(row, sim.motion.pose) : span_of(row, sim.motion.pose);
  r.position = 0.5 * (span.a + span.b) + b.origin;
  r.a = span.a + b.origin;
  r.b = span.b + b.origin;
  r.length = row.state.length;
  const double eta = apart ? 0.5 : 0.5 * (row.state.eta_a + row.state.eta_b);
  const State& s = sim.motion.state;
  r.displacement = (1.0 - eta) * displacement_of_corner(b, s, f.facing_end[k]) +
                   eta * displacement_of_corner(b, s, f.facing[k]);
  r.opening = apart ? distance_apart(row, sim.motion.pose) : -closure_of(row);
  r.slip = apart ? 0.0 : slip_since_start(b, row);
  r.ever_slipped = row.slipped;
  r.ever_opened = row.opened;
  add_crack(r, sim, k);
  add_water(r, sim, row);
  if (!is_closed(row)) return r;
  r.state = f.bonded(k)   ? ContactState::bonded
            : slides(row) ? ContactState::slide
                          : ContactState::stick;
  r.force = force_on_facing(row);
  r.normal_force = normal_force(row);
  r.shear_force = shear_force(row);
  add_stresses(r, sim, row);
  const double strength = shear_strength(row);
  r.mobilised = f.glued(k) || r.shear_force == 0.0 ? 0.0 : std::abs(r.shear_force) / strength;
  return r;
}

/// A point contact is recorded as a face without length.
ContactRecord point_record(const Simulation& sim, std::size_t k) {
  const BlockSet& b = sim.scene->blocks;
  const PointSet& c = sim.point_contacts;
  const PointGap g = gap_of(c, b, sim.motion.pose, k);
  const Id v = c.vertex[k];
  ContactRecord r;
  r.block_i = b.vertex_block[v];
  r.block_j = b.vertex_block[c.edge[k]];
  r.joint = sim.scene->model.joints[c.law[k]].name;
  r.table = b.table_of(c.edge[k], c.edge[k]);
  r.position = r.a = r.b = at(sim.motion.pose.x, sim.motion.pose.y, v) + b.origin;
  r.displacement = displacement_of(sim.motion.state, r.block_i, weights_of(b.weight, v));
  r.opening = -g.depth;
  r.slip = g.along - c.entered[k] * g.length;
  r.ever_slipped = c.slipped[k] > 0.0;
  r.ever_opened = c.opened[k] > 0.0;
  if (c.closed[k] == 0.0) return r;
  r.state = c.slides[k] > 0.0 ? ContactState::slide : ContactState::stick;
  r.force = force_on_vertex(c, b, sim.motion.pose, k);
  r.normal_force = c.normal[k];
  r.shear_force = c.shear[k];
  const double strength = sim.motion.laws.rows[c.law[k]].peak_friction * c.normal[k];
  r.mobilised = r.shear_force == 0.0 ? 0.0 : std::abs(r.shear_force) / strength;
  return r;
}

void place_points(const BlockSet& b, const State& s, Picture& p) {
  const std::size_t nv = b.vertex_count();
  for (auto* values : {&p.x, &p.y, &p.ux, &p.uy, &p.vx, &p.vy})
    values->resize(nv + b.meshes.nodes());
  parallel_for(nv, [&](std::size_t v) {
    const Vec2 now = corner_at(b, s.position, v), speed = corner_at(b, s.velocity, v);
    p.x[v] = now.x + b.origin.x;
    p.y[v] = now.y + b.origin.y;
    const Vec2 u = displacement_of_corner(b, s, v);
    p.ux[v] = u.x;
    p.uy[v] = u.y;
    p.vx[v] = speed.x;
    p.vy[v] = speed.y;
  });
}

void place_mesh_nodes(const BlockSet& b, const State& s, Picture& p) {
  for (std::size_t i = 0; b.meshes.any() && i < b.size(); ++i) {
    for (std::size_t j = b.meshes.begin[i]; j < b.meshes.begin[i + 1]; ++j) {
      const Vec2 now = mesh_node_at(b, s.position, i, j), speed = mesh_node_at(b, s.velocity, i, j);
      const Vec2 u = now - mesh_node_at(b, s.reference, i, j);
      const std::size_t at = b.vertex_count() + j;
      p.x[at] = now.x + b.origin.x;
      p.y[at] = now.y + b.origin.y;
      p.ux[at] = u.x;
      p.uy[at] = u.y;
      p.vx[at] = speed.x;
      p.vy[at] = speed.y;
    }
  }
}

void record_zones(const Simulation& sim, Picture& p) {
  const Zones& zones = sim.motion.zones;
  const BlockSet& b = sim.scene->blocks;
  p.zones.reserve(zones.stress.size());
  for (std::size_t i = 0; b.meshes.any() && i < b.size(); ++i) {
    const ZoneMaterial& rock = zones.material[static_cast<std::size_t>(b.material[i])];
    for (std::uint32_t z = b.meshes.zone_begin[i]; z < b.meshes.zone_begin[i + 1]; ++z) {
      const auto& [xx, yy, zz, xy] = zones.stress[z];
      const ZoneState& state = zones.state[z];
      const double slip = sim.scene->zones.shape[z].width * state.plastic_shear;
      ZoneRecord r{xx, yy, zz, xy, state.plastic_shear + state.slipped, zones.yielding[z]};
      if (has_strength(rock) && !b.is_lining(i))
        r.strength_factor =
            std::min(strength_factor(rock, slip, state.stress), largest_strength_factor);
      if (!zones.pore.empty()) r.pore_pressure = zones.pore[z];
      p.zones.push_back(r);
    }
  }
}

}  // namespace

Picture picture_of(const Simulation& sim, const Instant& at) {
  Picture p;
  p.time = sim.motion.state.time;
  p.blocks.reserve(sim.scene->blocks.size());
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (at.state.alive[i]) p.blocks.push_back(block_record(sim, at.state, i));
  }
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
    const FaceSet& faces = sim.motion.contacts;
    const bool there = is_closed_now(sim, k) || has_opened(sim, k) || faces.is_broken(k) ||
                       row_of(sim.attached.joint_water, faces.edge[k], faces.facing[k]) != nullptr;
    if (!there) continue;
    p.contacts.push_back(face_record(sim, face_row(sim, k)));
  }
  for (std::size_t k = 0; k < sim.point_contacts.size(); ++k) {
    if (sim.point_contacts.closed[k] > 0.0 || sim.point_contacts.opened[k] > 0.0)
      p.contacts.push_back(point_record(sim, k));
  }
  place_points(sim.scene->blocks, at.state, p);
  place_mesh_nodes(sim.scene->blocks, at.state, p);
  record_zones(sim, p);
  return p;
}

BlockRecord block_record(const Simulation& sim, const State& s, std::size_t i) {
  const BlockSet& b = sim.scene->blocks;
  BlockRecord r;
  r.id = static_cast<std::uint32_t>(i);
  r.name = b.name(i);
  r.material_index = b.material[i];
  if (b.material[i] != none) {
    r.material = sim.scene->model.materials[static_cast<std::size_t>(b.material[i])].name;
  }
  r.fixed = b.fixed[i] != 0;
  r.position = centroid(s.position, i) + b.origin;
  r.displacement = displacement_of(s, i, centroid_weights);
  const Deformation f = deformation_of(b, s, i);
  r.area = b.area[i] * (f.xx * f.yy - f.xy * f.yx);
  r.rotation = polar_angle(b, s, i) + 2.0 * std::numbers::pi * s.turns[i];
  r.velocity = centroid(s.velocity, i);
  r.omega = spin(b, s, i);
  const BlockStress stress = block_stress(sim, s, i);
  r.sxx = stress.xx;
  r.syy = stress.yy;
  r.szz = stress.zz;
  r.sxy = stress.xy;
  r.overstress = overstress(sim, s, i);
  return r;
}

Vec2 displacement_of(const State& s, std::size_t i, const NodeWeights& w) {
  return weighted(w, vectors_of(s.position, i) - vectors_of(s.reference, i));
}

BlockStress block_stress(const Simulation& sim, const State& s, std::size_t i) {
  const BlockSet& b = sim.scene->blocks;
  if (b.is_meshed(i)) {
    const auto [xx, yy, zz, xy] = mean_stress(b, sim.scene->zones, sim.motion.zones, i);
    return {xx, yy, zz, xy};
  }
  const Deformation f = deformation_of(b, s, i);
  const Tensor t = cauchy(stress_in(b, i, f), f);
  BlockStress stress{t.xx, t.yy, 0.0, t.xy};
  if (sim.scene->model.plane == Plane::strain && b.material[i] != none) {
    const double poisson =
        sim.scene->model.materials[static_cast<std::size_t>(b.material[i])].poisson;
    const Tensor start = initial_stress(b, i);
    const double out = b.initial_zz.empty() ? 0.0 : b.initial_zz[i];
    stress.zz = out + poisson * (t.xx - start.xx + t.yy - start.yy);
  }
  return stress;
}

double force_scale(const Simulation& sim, const std::vector<Id>& blocks) {
  return force_scale(sim, blocks, normal_forces(sim, normal_forces_now(sim)));
}

double force_scale(const Simulation& sim, const std::vector<Id>& blocks,
                   const NormalForces& contacts) {
  std::size_t bodies = 0;
  const LoadsNow acting = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  double loads = 0.0;
  for (const Id i : blocks) {
    bodies += std::max<std::size_t>(1, sim.scene->blocks.meshes.nodes_of(i));
    loads += sim.scene->blocks.mass[i] * norm(sim.scene->model.gravity) +
             norm(load_on(sim.scene->blocks, acting, sim.motion.pose, i));
  }
  // Contacts that barely touch, as at the start, carry forces of the order of rounding, which are
  // no reference.
  const double mean_load = bodies == 0 ? 0.0 : loads / static_cast<double>(bodies);
  const double mean_normal =
      contacts.ends > 0 ? contacts.pressed / static_cast<double>(contacts.ends) : 0.0;
  return mean_normal > 1e-3 * mean_load ? mean_normal : mean_load;
}

double unbalanced_ratio(const Simulation& sim, const Instant& at) {
  return unbalanced_ratio(sim, at, normal_forces(sim, normal_forces_now(sim)));
}

double unbalanced_ratio(const Simulation& sim, const Instant& at, const NormalForces& contacts) {
  std::vector<Id> free_blocks;
  double force = 0.0;
  std::size_t bodies = 0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!moves(sim, i)) continue;
    const Unbalanced on = unbalanced_forces(sim.motion.masses, sim.scene->blocks, at.forces, i);
    force += on.sum;
    bodies += on.count;
    free_blocks.push_back(static_cast<Id>(i));
  }
  if (force == 0.0) return 0.0;
  const double scale = force_scale(sim, free_blocks, contacts);
  return scale > 0.0 ? force / static_cast<double>(bodies) / scale : 1.0;
}

void count_revolutions(Simulation& sim, std::vector<double>& angle) {
  const std::size_t nb = sim.scene->blocks.size();
  const bool first = angle.empty();
  angle.resize(nb, 0.0);
  parallel_for(nb, [&](std::size_t i) {
    if (!moves(sim, i)) return;
    const double now = polar_angle(sim.scene->blocks, sim.motion.state, i);
    if (!first && now - angle[i] > std::numbers::pi) --sim.motion.state.turns[i];
    if (!first && now - angle[i] < -std::numbers::pi) ++sim.motion.state.turns[i];
    angle[i] = now;
  });
}

}  // namespace edda
