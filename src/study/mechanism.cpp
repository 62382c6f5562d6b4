#include "study/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "base/text.hpp"
#include "blocks/shape_change.hpp"
#include "results/columns.hpp"
#include "run/stages.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"
#include "step/touching.hpp"
#include "study/moving_faces.hpp"

namespace edda {
namespace {

constexpr double mostly_rotation = 0.5;  // lower limit of rotation_part

double turned(const Simulation& before, const Simulation& after, std::size_t i) {
  const Rotation a = rotation(deformation(before.scene->blocks, before.motion.state.position, i));
  const Rotation b = rotation(deformation(after.scene->blocks, after.motion.state.position, i));
  return std::atan2(a.c * b.s - a.s * b.c, a.c * b.c + a.s * b.s);
}

/// Whether the block rotates about a point below its centroid, towards its displacement, as a
/// toppling block does. A block that slides along a floor that bends upwards rotates the other way.
bool overturns(const MovingBlock& m, Vec2 gravity) {
  // From the centre of rotation to the centroid: the displacement rotated back by a right angle,
  // over the rotation. Times the rotation here, which preserves the direction.
  const Vec2 arm = m.rotation * Vec2{m.displacement.y, -m.displacement.x};
  return dot(arm, gravity) <= 0.0;
}

/// Whether a meshed block has moved less as a whole than its shape has changed, or not much more.
bool deforms(const Simulation& before, const Simulation& after, const MovingBlock& m) {
  const BlockSet& b = before.scene->blocks;
  if (!b.is_meshed(m.id)) return false;
  constexpr double part = 0.25;
  const std::vector<double> change =
      shape_change(b, before.motion.state.position, after.motion.state.position, m.id);
  return *std::max_element(change.begin(), change.end()) > part * m.largest;
}

/// [nb] 1: the block is in contact, or within `gap` of another one.
std::vector<std::uint8_t> next_to_something(const Simulation& s, double gap) {
  std::vector<std::uint8_t> near = touching(s);
  const FaceSet& f = s.motion.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const FaceRow row = face_row(s, k);
    if (row.state.gate == 0.0 || closure_of(row) <= -gap) continue;
    near[block_of_edge(s.scene->blocks, f, k)] = near[block_of_facing(s.scene->blocks, f, k)] = 1;
  }
  return near;
}

MovingBlock motion_of(const Simulation& before, const Simulation& after, std::size_t i) {
  MovingBlock m;
  m.id = static_cast<Id>(i);
  const Vec2 at = centroid(before.motion.state.position, i);
  const Vec2 ground = after.attached.ground.shift - before.attached.ground.shift;
  m.place = at + before.scene->blocks.origin;
  m.displacement = centroid(after.motion.state.position, i) - at - ground;
  for (Id v = before.scene->blocks.vertex_begin[i]; v < before.scene->blocks.vertex_begin[i + 1];
       ++v) {
    const Vec2 u = Vec2{after.motion.pose.x[v], after.motion.pose.y[v]} -
                   Vec2{before.motion.pose.x[v], before.motion.pose.y[v]} - ground;
    m.largest = std::max(m.largest, norm(u));
  }
  m.rotation = turned(before, after, i);
  const double way = norm(m.displacement);
  m.rotation_part = way > 0.0 ? std::abs(m.rotation) * before.scene->blocks.radius[i] / way : 0.0;
  return m;
}

JointMotion motion_of(const MovingJoint& joint, double least_opening) {
  constexpr double twice = 2.0, closed = 0.5;  // of `turning`
  if (joint.turning >= twice * joint.slip && least_opening < closed * joint.turning)
    return JointMotion::hinges;
  return joint.slip >= joint.opening ? JointMotion::slips : JointMotion::opens;
}

/// The relative motion of the joints that carried load before. `rotation`: [nb] of the blocks, rad.
std::vector<MovingJoint> joints_of(const Simulation& before, const Simulation& after,
                                   const std::vector<double>& rotation, double least) {
  SeenJoints joints;
  collect_joints(joints, before, after, rotation, least);
  std::vector<MovingJoint> list;
  list.reserve(joints.size());
  for (auto& entry : joints) {
    MovingJoint& joint = entry.second.joint;
    joint.motion = motion_of(joint, entry.second.least_opening);
    if (joint.motion == JointMotion::hinges) joint.place = entry.second.hinge;
    list.push_back(std::move(joint));
  }
  return list;
}

/// Groups of blocks that move as one piece: [nb] the first block of its group. Only blocks of which
/// `moves` is set.
std::vector<Id> pieces(const Simulation& sim, const std::vector<std::uint8_t>& moves,
                       const std::vector<MovingJoint>& joints) {
  std::vector<Id> first(sim.scene->blocks.size());
  std::iota(first.begin(), first.end(), Id{0});
  const auto root = [&](Id i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  std::set<std::pair<Id, Id>> apart;
  for (const MovingJoint& joint : joints) apart.insert({joint.block_i, joint.block_j});
  const FaceSet& f = sim.motion.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const auto [i, j] = blocks_of_face(sim.scene->blocks, f, k);
    if (!is_closed_now(sim, k) || !moves[i] || !moves[j] || apart.contains({i, j})) continue;
    const auto [low, high] = std::minmax({root(i), root(j)});
    first[high] = low;
  }
  for (Id i = 0; i < first.size(); ++i) first[i] = root(i);
  return first;
}

/// [nb] 1: the block's piece lies between two or more hinges and no joint slips along it.
std::vector<std::uint8_t> between_hinges(const std::vector<Id>& piece,
                                         const std::vector<MovingJoint>& joints) {
  std::vector<int> hinges(piece.size(), 0), slips(piece.size(), 0);
  for (const MovingJoint& joint : joints) {
    const Id i = piece[joint.block_i], j = piece[joint.block_j];
    if (i == j || joint.motion == JointMotion::opens) continue;
    auto& count = joint.motion == JointMotion::hinges ? hinges : slips;
    ++count[i];
    ++count[j];
  }
  std::vector<std::uint8_t> between(piece.size(), 0);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    between[i] = hinges[piece[i]] >= 2 && slips[piece[i]] == 0 ? 1 : 0;
  }
  return between;
}

/// "bedding", "bedding and cross": the joints with most of the slip.
std::string slipping_joints(const Mechanism& m) {
  std::map<std::string, double> slip;  // slip times length
  double all = 0.0;
  for (const MovingJoint& joint : m.joints) {
    if (joint.motion != JointMotion::slips) continue;
    for (const Stretch& s : joint.stretches) {
      slip[joint.joint] += joint.slip * norm(s.to - s.from);
      all += joint.slip * norm(s.to - s.from);
    }
  }
  constexpr double counts = 0.2;
  std::string names;
  for (const auto& [name, part] : slip) {
    if (part >= counts * all) names += (names.empty() ? "" : " and ") + name;
  }
  return names;
}

/// "4 hinges at (1, 2), (3, 4), ..."
std::string hinges_of(const Mechanism& m) {
  constexpr std::size_t named = 6;
  std::vector<Vec2> places;
  for (const MovingJoint& joint : m.joints) {
    if (joint.motion == JointMotion::hinges) places.push_back(joint.place);
  }
  std::sort(places.begin(), places.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  std::string text = counted(places.size(), "hinge") + " at ";
  for (std::size_t q = 0; q < std::min(named, places.size()); ++q)
    text += (q == 0 ? "" : ", ") + place_label(places[q]);
  if (places.size() > named) text += fmt::format(" and {} more", places.size() - named);
  return text;
}

std::string sentence(const Mechanism& m) {
  std::size_t count[5] = {0, 0, 0, 0, 0};
  for (const MovingBlock& b : m.blocks) ++count[static_cast<int>(b.motion)];
  const double parts[] = {m.sliding, m.toppling, m.falling, m.hinging, m.yielding};
  constexpr double most = 0.75;
  const auto largest = std::max_element(std::begin(parts), std::end(parts));
  const bool mixed = *largest < most;
  const auto kind = static_cast<FailureMode>(largest - std::begin(parts));
  const std::string along = slipping_joints(m);
  constexpr const char* kinds[] = {"sliding", "toppling", "falling", "hinging", "yielding"};
  std::string text = mixed ? "mixed" : kinds[static_cast<int>(kind)];
  if (!mixed && kind == FailureMode::slides && !along.empty()) text += " along " + along;
  text += ": ";
  if (!mixed && kind == FailureMode::hinges) text += hinges_of(m) + ", ";
  if (!mixed) text += counted(count[static_cast<int>(kind)], "block");
  bool first = mixed;
  constexpr const char* verbs[][2] = {{"slides", "slide"},
                                      {"topples", "topple"},
                                      {"falls", "fall"},
                                      {"hinges", "hinge"},
                                      {"yields", "yield"}};
  for (const FailureMode other : {FailureMode::slides, FailureMode::topples, FailureMode::falls,
                                  FailureMode::hinges, FailureMode::yields}) {
    const std::size_t n = count[static_cast<int>(other)];
    if (n == 0 || (!mixed && other == kind)) continue;
    text += first ? counted(n, "block") : fmt::format(", {}", n);
    text += fmt::format(" {}", verbs[static_cast<int>(other)][n == 1 ? 0 : 1]);
    if (other == FailureMode::slides && !along.empty()) text += " along " + along;
    first = false;
  }
  return text;
}

/// "all 50.6 m", or "7.8 m of the 9.72 m".
std::string brittle_part(const Mechanism& m) {
  const std::string all = fmt::format("{:.3g} m", m.brittle_length),
                    lost = fmt::format("{:.3g} m", m.cohesion_lost_length);
  return lost == all ? "all " + all : lost + " of the " + all;
}

}  // namespace

Mechanism mechanism_of(const Simulation& before, const Simulation& after, double moving) {
  return mechanism_of(before, after, moving, after);
}

Mechanism mechanism_of(const Simulation& before, const Simulation& after, double moving,
                       const Simulation& apart) {
  Mechanism m;
  double largest = 0.0, weight = 0.0;
  std::vector<double> rotation(before.scene->blocks.size(), 0.0);
  for (std::size_t i = 0; i < before.scene->blocks.size(); ++i) {
    if (!is_free(before.scene->blocks, before.motion.state, i)) continue;
    m.blocks.push_back(motion_of(before, after, i));
    rotation[i] = m.blocks.back().rotation;
    largest = std::max(largest, m.blocks.back().largest);
  }
  std::erase_if(m.blocks, [&](const MovingBlock& b) { return b.largest < moving * largest; });
  m.joints = joints_of(before, after, rotation, moving * largest);
  const std::vector<std::uint8_t> near = next_to_something(apart, moving * largest);
  std::vector<std::uint8_t> moves(before.scene->blocks.size(), 0);
  for (const MovingBlock& b : m.blocks) moves[b.id] = 1;
  const std::vector<std::uint8_t> hinged =
      between_hinges(pieces(before, moves, m.joints), m.joints);
  double* const parts[] = {&m.sliding, &m.toppling, &m.falling, &m.hinging, &m.yielding};
  for (MovingBlock& b : m.blocks) {
    const bool topples =
        b.rotation_part >= mostly_rotation && overturns(b, before.scene->model.gravity);
    b.motion = deforms(before, after, b) ? FailureMode::yields
               : !near[b.id]             ? FailureMode::falls
               : hinged[b.id]            ? FailureMode::hinges
               : topples                 ? FailureMode::topples
                                         : FailureMode::slides;
    const double mass = before.scene->blocks.mass[b.id];
    weight += mass;
    *parts[static_cast<int>(b.motion)] += mass;
  }
  for (double* part : parts) *part /= weight > 0.0 ? weight : 1.0;
  m.text = sentence(m);
  return m;
}

std::vector<Id> blocks_of(const Mechanism& mechanism) {
  std::vector<Id> blocks;
  for (const MovingBlock& m : mechanism.blocks) blocks.push_back(m.id);
  return blocks;
}

double area_of(const Mechanism& mechanism, const BlockSet& b) {
  double area = 0.0;
  for (const MovingBlock& m : mechanism.blocks) area += b.area[m.id];
  return area;
}

static bool has_lost_cohesion(const Mechanism& m) {
  constexpr double little = 0.01;
  return m.cohesion_lost_length > little * m.brittle_length;
}

void find_lost_cohesion(Mechanism& m, const Simulation& stable) {
  const FaceSet& f = stable.motion.contacts;
  std::set<std::tuple<Id, Id, std::uint16_t>> brittle;
  for (const MovingJoint& j : m.joints) {
    const Law& law = stable.motion.laws.rows[j.law];
    if (!law.glued && !law.changes && law.residual_cohesion < law.peak_cohesion)
      brittle.insert({j.block_i, j.block_j, j.law});
  }
  for (std::size_t k = 0; k < f.size(); ++k) {
    const auto [i, j] = blocks_of_face(stable.scene->blocks, f, k);
    if (!brittle.contains({i, j, f.law[k]})) continue;
    const bool lost = !f.holds(k);
    const FaceRow row = face_row(stable, k);
    if (lost && !is_closed(row) && !row.opened) continue;  // was never bonded
    m.brittle_length += row.state.length;
    if (lost) m.cohesion_lost_length += row.state.length;
  }
  if (has_lost_cohesion(m))
    m.text +=
        "; " + brittle_part(m) + " of its joints had already lost their cohesion before failure";
}

std::string lost_cohesion_text(const Mechanism& m) {
  if (!has_lost_cohesion(m)) return {};
  return fmt::format(
      "{} of joints in the mechanism had already lost their cohesion before failure. If cohesion "
      "should survive, set residual.cohesion (joints with fracture energies keep none)",
      brittle_part(m));
}

std::string mechanism_csv(const Simulation& sim, const Mechanism& mechanism) {
  Csv csv = begin_table(ResultFile::mechanism);
  for (const MovingBlock& b : mechanism.blocks) {
    csv.add(b.id).add(sim.scene->blocks.name(b.id)).add(b.place.x).add(b.place.y);
    csv.add(b.displacement.x).add(b.displacement.y).add(b.largest).add(b.rotation);
    csv.add(b.rotation_part).add(motion_name(b.motion)).end();
  }
  return csv.text();
}

std::string mechanism_joints_csv(const Mechanism& mechanism) {
  Csv csv = begin_table(ResultFile::mechanism_joints);
  for (const MovingJoint& j : mechanism.joints) {
    csv.add(j.block_i).add(j.block_j).add(j.joint).add(j.place.x).add(j.place.y);
    csv.add(j.slip).add(j.opening).add(j.turning).add(motion_name(j.motion)).add(j.table).end();
  }
  return csv.text();
}

}  // namespace edda
