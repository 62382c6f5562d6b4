#include "limit/rigid_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "attachments/loads.hpp"
#include "base/gravity.hpp"
#include "blocks/kinematics.hpp"
#include "limit/rigid_bolts.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// Compressive strength of the weaker rock of two blocks, N per m of joint; 0: not given.
double compressive_strength(const Model& model, const BlockSet& b, Id i, Id j) {
  double least = std::numeric_limits<double>::infinity();
  for (const Id block : {i, j}) {
    const Material& rock = model.materials[static_cast<std::size_t>(b.material[block])];
    if (rock.strength && rock.strength->ucs > 0.0) least = std::min(least, rock.strength->ucs);
  }
  return std::isfinite(least) ? least * b.thickness : 0.0;
}

/// The corners of two edges in the frame of the first, of which they may touch.
struct Opposed {
  double from, to;             ///< m along t from p1: where both edges are
  double gap_from, gap_to;     ///< m, there
  bool corner_from_e = false;  ///< which edge's corner bounds it there
  bool corner_to_e = false;
};

/// The common part of two opposed edges, along t from p1; from > to: they have none.
Opposed common_part(const FacePoints& at, Vec2 t) {
  const Vec2 n = outward_normal(t);
  const double s2 = dot(at.p2 - at.p1, t), r1 = dot(at.q1 - at.p1, t), r2 = dot(at.q2 - at.p1, t);
  const double y2 = dot(at.p2 - at.p1, n), z1 = dot(at.q1 - at.p1, n), z2 = dot(at.q2 - at.p1, n);
  if (!(s2 > 0.0) || !(r1 > r2)) return {1.0, 0.0, 0.0, 0.0};
  Opposed o{std::max(0.0, r2), std::min(s2, r1), 0.0, 0.0, r2 <= 0.0, s2 <= r1};
  const auto gap = [&](double s) { return z2 + (z1 - z2) * (s - r2) / (r1 - r2) - y2 * s / s2; };
  o.gap_from = gap(o.from);
  o.gap_to = gap(o.to);
  return o;
}

/// The joint of a corner that leans on the inside of an edge. e_leans: it is one of the first edge.
RigidJoint leaning(RigidJoint joint, const FacePoints& at, Vec2 place, bool e_leans) {
  joint.t = e_leans ? unit(at.q1 - at.q2) : unit(at.p2 - at.p1);
  joint.n = outward_normal(joint.t);
  joint.ends[0] = joint.ends[1] = place;
  return joint;
}

/// Whether a point lies on the inside of the edge from a to b.
bool lies_inside(Vec2 place, Vec2 a, Vec2 b, double margin) {
  const Vec2 t = unit(b - a);
  const double s = dot(place - a, t);
  return s > margin && s < norm(b - a) - margin;
}

void add_joint(RigidBlocks& rigid, const Simulation& sim, std::size_t k, double gap) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& faces = sim.motion.contacts;
  const Id i = block_of_edge(b, faces, k), j = block_of_facing(b, faces, k);
  if (sim.motion.state.alive[i] == 0 || sim.motion.state.alive[j] == 0) return;
  const FacePoints at = face_points(faces, sim.motion.pose.x, sim.motion.pose.y, k);
  const Vec2 t = frame_of(at, faces.inverse_e[k], faces.inverse_f[k]);
  const Opposed o = common_part(at, t);
  const double size = smaller_size(faces, b, k), close = rigid_gap * size;
  const bool pressed = face_row(sim, k).state.energy > 0.0;  // however deep it is closed
  const auto touches = [&](double there) {
    return there <= gap * size && (pressed || there >= -gap * size);
  };
  const bool touches_from = touches(o.gap_from), touches_to = touches(o.gap_to);
  if (o.to - o.from <= close || (!touches_from && !touches_to)) return;
  RigidJoint joint;
  joint.block_a = i;
  joint.block_b = j;
  joint.law = faces.law[k];
  joint.face = k;
  if (touches_from && touches_to) {
    joint.t = t;
    joint.n = outward_normal(t);
    const double y = 0.5 * (o.gap_from + o.gap_to);
    joint.ends[0] = at.p1 + o.from * t + 0.5 * y * joint.n;
    joint.ends[1] = at.p1 + o.to * t + 0.5 * y * joint.n;
    joint.compression = compressive_strength(sim.scene->model, b, i, j);
    joint.has_peak = true;
    return rigid.joints.push_back(joint);
  }
  const bool e_leans = touches_from ? o.corner_from_e : o.corner_to_e;
  const Vec2 place = touches_from ? (e_leans ? at.p1 : at.q2) : (e_leans ? at.p2 : at.q1);
  const double margin = gap > rigid_gap ? -close : close;  // corners may come to bear at the ends
  const bool inside =
      e_leans ? lies_inside(place, at.q1, at.q2, margin) : lies_inside(place, at.p1, at.p2, margin);
  if (inside) rigid.joints.push_back(leaning(joint, at, place, e_leans));
}

/// A corner between two edges leans once, not once for each of them, and not where a joint of the
/// same two blocks ends.
void leave_out_twins(std::vector<RigidJoint>& joints, double close) {
  using Places = std::vector<std::pair<Vec2, Vec2>>;  // with t; 0 for an end of a joint
  std::map<std::pair<Id, Id>, Places> seen;           // by blocks
  for (const RigidJoint& joint : joints) {
    if (joint.is_corner()) continue;
    for (const Vec2 end : joint.ends)
      seen[std::minmax(joint.block_a, joint.block_b)].emplace_back(end, Vec2{});
  }
  std::erase_if(joints, [&](const RigidJoint& joint) {
    if (!joint.is_corner()) return false;
    Places& others = seen[std::minmax(joint.block_a, joint.block_b)];
    const bool again = std::any_of(others.begin(), others.end(), [&](const auto& other) {
      return norm(other.first - joint.ends[0]) <= close &&
             std::abs(cross(other.second, joint.t)) < 1e-12;
    });
    if (!again) others.emplace_back(joint.ends[0], joint.t);
    return again;
  });
}

/// What boundaries hold. All with springs do: those that absorb waves carry the forces that were
/// there before them, which are loads.
std::vector<RigidSupport> supports_of(const Simulation& sim) {
  const BoundarySprings& springs = sim.attached.springs;
  std::vector<RigidSupport> all;
  for (std::size_t q = 0; q < springs.size(); ++q) {
    const Id v = springs.vertex[q], i = sim.scene->blocks.vertex_block[v];
    if (springs.kxx[q] == 0.0 && springs.kyy[q] == 0.0) continue;
    const Vec2 place{sim.motion.pose.x[v], sim.motion.pose.y[v]};
    // The principal directions of the spring's symmetric matrix, of which a roller has but one.
    const double half = 0.5 * (springs.kxx[q] - springs.kyy[q]);
    const double mean = 0.5 * (springs.kxx[q] + springs.kyy[q]);
    const double angle = 0.5 * std::atan2(springs.kxy[q], half);
    const Vec2 first{std::cos(angle), std::sin(angle)};
    all.push_back({i, place, first});
    if (mean - std::hypot(half, springs.kxy[q]) > 1e-9 * mean)
      all.push_back({i, place, perp(first)});
  }
  return all;
}

/// Of the weights that forces are compared with, m/s2.
double acceleration_of(const Simulation& sim) {
  const double g = norm(sim.scene->model.gravity);
  return g > 0.0 ? g : usual_acceleration;
}

/// Keeps those supports of a body that do not follow from others. Returns how many are kept.
std::size_t keep_independent(std::vector<RigidSupport>& supports, Vec2 centroid, double size) {
  constexpr double independent = 1e-6;
  std::vector<RigidSupport> kept;
  std::vector<std::array<double, 3>> basis;
  for (const RigidSupport& s : supports) {
    std::array<double, 3> v{s.direction.x, s.direction.y,
                            cross(s.place - centroid, s.direction) / size};
    for (const auto& e : basis) {
      const double along = v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
      for (std::size_t q = 0; q < v.size(); ++q) v[q] -= along * e[q];
    }
    const double rest = std::hypot(v[0], v[1], v[2]);
    if (rest < independent) continue;
    for (double& component : v) component /= rest;
    basis.push_back(v);
    kept.push_back(s);
  }
  supports = std::move(kept);
  return supports.size();
}

/// Blocks in groups that are glued together: [nb] the first block of each group.
class Groups {
 public:
  explicit Groups(std::size_t size) : first_(size) { std::iota(first_.begin(), first_.end(), 0u); }
  Id of(Id i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  void join(Id i, Id j) {
    const auto [low, high] = std::minmax({of(i), of(j)});
    first_[high] = low;
  }

 private:
  std::vector<Id> first_;
};

/// Sorts the blocks into bodies, of which those with a fixed block, or which boundaries hold, are
/// fixed.
void make_bodies(RigidBlocks& rigid, const Simulation& sim, std::vector<RigidSupport> supports) {
  const BlockSet& b = sim.scene->blocks;
  const State& state = sim.motion.state;
  Groups groups(b.size());
  std::vector<char> touched(b.size(), 0);
  for (const RigidJoint& joint : rigid.joints) {
    touched[joint.block_a] = touched[joint.block_b] = 1;
    if (sim.motion.laws.rows[joint.law].glued && joint.has_peak)
      groups.join(joint.block_a, joint.block_b);
  }
  for (const RigidTie& tie : rigid.ties) touched[tie.block_a] = touched[tie.block_b] = 1;
  for (const RigidSupport& s : supports) touched[s.block] = 1;
  std::vector<std::vector<Id>> group(b.size());
  std::vector<char> fixed(b.size(), 0);
  for (Id i = 0; i < b.size(); ++i) {
    if (state.alive[i] == 0) continue;
    if (b.fixed[i] != 0) fixed[groups.of(i)] = 1;
    if (b.fixed[i] == 0 && touched[i] == 0) {
      rigid.loose.push_back(i);
    } else {
      group[groups.of(i)].push_back(i);
    }
  }
  std::vector<std::vector<RigidSupport>> held(b.size());
  for (const RigidSupport& s : supports) held[groups.of(s.block)].push_back(s);
  rigid.body.assign(b.size(), no_id);
  for (Id first = 0; first < b.size(); ++first) {
    if (group[first].empty() || fixed[first] != 0) continue;
    Vec2 sum;
    double mass = 0.0, area = 0.0;
    for (const Id i : group[first]) {
      sum += b.mass[i] * centroid(state.position, i);
      mass += b.mass[i];
      area += b.area[i];
    }
    if (keep_independent(held[first], sum / mass, rigid.size) == 3) continue;
    rigid.supports.insert(rigid.supports.end(), held[first].begin(), held[first].end());
    for (const Id i : group[first]) rigid.body[i] = static_cast<Id>(rigid.blocks.size());
    rigid.centroid.push_back(sum / mass);
    rigid.weight.push_back(mass * acceleration_of(sim));
    rigid.extent.push_back(std::sqrt(area));
    rigid.blocks.push_back(std::move(group[first]));
  }
  std::erase_if(rigid.joints, [&](const RigidJoint& joint) {
    return rigid.body[joint.block_a] == rigid.body[joint.block_b];
  });
}

constexpr double at_last = 1e30;  // s

/// All loads with the last values of their histories, nothing of them gradual any more.
LoadsNow last_loads(const Simulation& sim) {
  Loads loads = sim.attached.loads;
  loads.gradual = {};
  LoadsNow now = loads_at(sim.scene->model, loads, at_last);
  if (now.loads != nullptr) now.loads = &sim.attached.loads;  // the places are the same
  return now;
}

/// Of a row of LoadsNow::weight, N/m2.
double unit_weight(const Simulation& sim, std::size_t water) {
  const Model& model = sim.scene->model;
  return water < model.waters.size() ? model.waters[water].unit_weight * model.thickness
                                     : sim.attached.loads.in_joints;
}

}  // namespace

RigidBlocks rigid_blocks(const Simulation& sim, BoltForces bolts, double gap) {
  const BlockSet& b = sim.scene->blocks;
  RigidBlocks rigid;
  double sizes = 0.0, masses = 0.0, count = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    sizes += std::sqrt(b.area[i]);
    masses += b.mass[i];
    count += 1.0;
  }
  if (count > 0.0) {
    rigid.size = sizes / count;
    rigid.force = masses / count * acceleration_of(sim);
  }
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) add_joint(rigid, sim, k, gap);
  if (gap <= rigid_gap) leave_out_twins(rigid.joints, rigid_gap * rigid.size);
  add_bolts(rigid, sim, bolts);
  make_bodies(rigid, sim, supports_of(sim));
  return rigid;
}

RigidBlocks carrying(const RigidBlocks& rigid, const std::vector<Id>& blocks) {
  RigidBlocks left = rigid;
  for (const Id i : blocks) {
    if (left.body[i] == no_id) continue;
    for (const Id other : rigid.blocks[rigid.body[i]]) left.body[other] = no_id;
  }
  left.blocks.clear();
  left.centroid.clear();
  left.weight.clear();
  left.extent.clear();
  for (std::size_t r = 0; r < rigid.bodies(); ++r) {
    if (left.body[rigid.blocks[r].front()] == no_id) continue;
    for (const Id i : rigid.blocks[r]) left.body[i] = static_cast<Id>(left.blocks.size());
    left.blocks.push_back(rigid.blocks[r]);
    left.centroid.push_back(rigid.centroid[r]);
    left.weight.push_back(rigid.weight[r]);
    left.extent.push_back(rigid.extent[r]);
  }
  const auto fixed = [&](Id i) { return left.body[i] == no_id; };
  std::erase_if(left.joints, [&](const RigidJoint& joint) {
    return fixed(joint.block_a) && fixed(joint.block_b);
  });
  std::erase_if(left.supports, [&](const RigidSupport& s) { return fixed(s.block); });
  return left;
}

RigidForces weights_under(const RigidBlocks& rigid, const Simulation& sim, Vec2 gravity) {
  RigidForces all(rigid.bodies());
  for (std::size_t r = 0; r < all.size(); ++r) {
    for (const Id i : rigid.blocks[r]) all[r].force += sim.scene->blocks.mass[i] * gravity;
  }
  return all;
}

Vec2 last_gravity(const Simulation& sim) {
  return last_gravity(sim, sim.attached.loads.slow);
}

Vec2 last_gravity(const Simulation& sim, const SlowLoading& slow) {
  return gravity_at(sim.scene->model.gravity, slow, at_last, {});
}

LoadFactors last_factors(const Simulation& sim) {
  const LoadsNow now = last_loads(sim);
  LoadFactors factors{now.factor, now.weight};
  for (std::size_t q = 0; q < factors.waters.size(); ++q) factors.waters[q] /= unit_weight(sim, q);
  return factors;
}

RigidForces loads_with(const RigidBlocks& rigid, const Simulation& sim,
                       const LoadFactors& factors) {
  const BlockSet& b = sim.scene->blocks;
  RigidForces all(rigid.bodies());
  LoadsNow now = last_loads(sim);
  if (now.loads == nullptr) return all;
  now.factor = factors.loads;
  for (std::size_t q = 0; q < now.weight.size(); ++q)
    now.weight[q] = factors.waters[q] * unit_weight(sim, q);
  for (std::size_t r = 0; r < all.size(); ++r) {
    for (const Id i : rigid.blocks[r]) {
      BlockForces on{b, i};
      add_loads(on, now, sim.motion.pose.x, sim.motion.pose.y);
      const NodeVectors x = vectors_of(sim.motion.state.position, i);
      const NodeVectors& f = on.sum.nodes;
      all[r].force += resultant(f);
      for (std::size_t k = 0; k < nodes_per_block; ++k)
        all[r].moment += cross(x[k] - rigid.centroid[r], f[k]);
    }
  }
  return all;
}

RigidForces operator+(RigidForces a, const RigidForces& b) {
  for (std::size_t r = 0; r < a.size(); ++r) {
    a[r].force += b[r].force;
    a[r].moment += b[r].moment;
  }
  return a;
}

RigidForces operator*(double s, RigidForces a) {
  for (RigidForce& f : a) f = {s * f.force, s * f.moment};
  return a;
}

}  // namespace edda
