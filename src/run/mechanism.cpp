#include "run/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "contacts/gap.hpp"
#include "results/csv.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

namespace cs = contact_state;
constexpr double moving = 0.1;   // of the largest displacement
constexpr double topples = 0.5;  // of turning_part

double turned(const Simulation& before, const Simulation& after, std::size_t i) {
  const Rotation a = rotation(deformation(before.blocks, before.state.x, before.state.y, i));
  const Rotation b = rotation(deformation(after.blocks, after.state.x, after.state.y, i));
  return std::atan2(a.c * b.s - a.s * b.c, a.c * b.c + a.s * b.s);
}

/// [nb] 1: a corner of it is at an edge, or one of another block at its own, but for `gap`.
std::vector<std::uint8_t> next_to_something(const Simulation& s, double gap) {
  std::vector<std::uint8_t> near = touching(s);
  const ContactSet& c = s.contacts;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.depth[k] > -gap && c.on_edge(k)) near[c.block_i[k]] = near[c.block_j[k]] = 1;
  }
  return near;
}

MovingBlock motion_of(const Simulation& before, const Simulation& after, std::size_t i) {
  MovingBlock m;
  m.id = static_cast<Id>(i);
  const Vec2 at = centroid(before.state.x, before.state.y, i);
  const Vec2 ground = after.ground.shift - before.ground.shift;
  m.place = at + before.blocks.origin;
  m.displacement = centroid(after.state.x, after.state.y, i) - at - ground;
  for (Id v = before.blocks.vertex_begin[i]; v < before.blocks.vertex_begin[i + 1]; ++v) {
    const Vec2 u =
        Vec2{after.pose.x[v], after.pose.y[v]} - Vec2{before.pose.x[v], before.pose.y[v]} - ground;
    m.largest = std::max(m.largest, norm(u));
  }
  m.rotation = turned(before, after, i);
  const double way = norm(m.displacement);
  m.turning_part = way > 0.0 ? std::abs(m.rotation) * before.blocks.radius[i] / way : 0.0;
  return m;
}

/// The stretch of edge e that the edges of the vertex's block lie along, and where its block has
/// carried it.
Stretch stretch_of(const Simulation& before, const Simulation& after, std::size_t k, Id f) {
  const ContactSet& c = before.contacts;
  const Pose &was = before.pose, &is = after.pose;
  const Id e = c.edge[k], end = c.edge_end[k];
  const EdgeFrame frame = edge_frame(at(was.x, was.y, e), at(was.x, was.y, end));
  const double l = frame.length;
  const double z0 = gap_to(frame, at(was.x, was.y, f)).foot;
  const double z1 = gap_to(frame, at(was.x, was.y, before.blocks.next[f])).foot;
  const auto place = [&](double z, Vec2& point, Vec2& moved) {
    const double xi = std::clamp(z / l, 0.0, 1.0);
    point = frame.start + xi * l * frame.t;
    const Vec2 start = at(is.x, is.y, e);
    moved = start + xi * (at(is.x, is.y, end) - start) - point;
    point += before.blocks.origin;
  };
  Stretch s;
  place(std::min(z0, z1), s.from, s.from_moved);
  place(std::max(z0, z1), s.to, s.to_moved);
  return s;
}

/// The edge of the vertex's block that lies against the contact's edge.
Id facing(const Simulation& sim, std::size_t k) {
  const ContactSet& c = sim.contacts;
  const Pose& p = sim.pose;
  const EdgeFrame frame = edge_frame(at(p.x, p.y, c.edge[k]), at(p.x, p.y, c.edge_end[k]));
  return facing_edge(sim.blocks, p.x, p.y, c.vertex[k], frame.normal());
}

/// What has become of the joints that carried before.
std::vector<MovingJoint> joints_of(const Simulation& before, const Simulation& after,
                                   double least) {
  const ContactSet& c = before.contacts;
  std::map<std::tuple<Id, Id, std::uint16_t>, MovingJoint> joints;
  std::set<std::pair<Id, Id>> drawn;  // edges, once for the contacts at either end
  for (std::size_t k = 0; k < c.size(); ++k) {
    const bool touches = c.is(k, cs::closed) || (c.depth[k] > -least && c.on_edge(k));
    if (!touches || c.share[k] <= 0.0 || c.why[k] != Blocked::no) continue;
    const auto gap = [&](const Pose& pose) {
      const EdgeFrame e =
          edge_frame(at(pose.x, pose.y, c.edge[k]), at(pose.x, pose.y, c.edge_end[k]));
      return gap_to(e, at(pose.x, pose.y, c.vertex[k]));
    };
    const Gap was = gap(before.pose), is = gap(after.pose);
    const double slip = std::abs(is.foot - was.foot), opening = was.depth - is.depth;
    if (std::max(slip, opening) < least) continue;
    const Id i = std::min(c.block_i[k], c.block_j[k]), j = std::max(c.block_i[k], c.block_j[k]);
    MovingJoint& joint = joints[{i, j, c.law[k]}];
    if (std::max(slip, opening) > std::max(joint.slip, joint.opening)) {
      joint.place = at(before.pose.x, before.pose.y, c.vertex[k]) + before.blocks.origin;
    }
    // Where the corner that moves most touches an edge at its end, as at the toe of a slope,
    // nothing of the joint lies along it; but along those of others.
    const Id f = facing(before, k);
    const Stretch stretch = stretch_of(before, after, k, f);
    const double shortest =
        1e-3 * std::min(before.blocks.edge_length[c.edge[k]], before.blocks.edge_length[f]);
    if (norm(stretch.to - stretch.from) > shortest &&
        drawn.insert(std::minmax(c.edge[k], f)).second)
      joint.stretches.push_back(stretch);
    joint.block_i = i;
    joint.block_j = j;
    joint.law = c.law[k];
    joint.joint = c.law[k] < before.model.joints.size()
                      ? std::string_view(before.model.joints[c.law[k]].name)
                      : std::string_view("glued");
    joint.slip = std::max(joint.slip, slip);
    joint.opening = std::max(joint.opening, opening);
  }
  std::vector<MovingJoint> list;
  list.reserve(joints.size());
  for (const auto& entry : joints) list.push_back(entry.second);
  return list;
}

std::string sentence(const Mechanism& m) {
  std::size_t count[3] = {0, 0, 0};
  for (const MovingBlock& b : m.blocks) ++count[static_cast<int>(b.motion)];
  const double largest = std::max({m.sliding, m.toppling, m.falling});
  constexpr double most = 0.75;
  const char* kind = largest < most          ? "mixed"
                     : largest == m.sliding  ? "sliding"
                     : largest == m.toppling ? "toppling"
                                             : "falling";
  const auto some = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  return fmt::format("{}: {}, {}, {}", kind, some(count[0], "block slides", "blocks slide"),
                     some(count[1], "topples", "topple"), some(count[2], "falls", "fall"));
}

}  // namespace

Mechanism mechanism_of(const Simulation& before, const Simulation& after) {
  Mechanism m;
  double largest = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < before.blocks.size(); ++i) {
    if (!is_free(before.blocks, before.state, i)) continue;
    m.blocks.push_back(motion_of(before, after, i));
    largest = std::max(largest, m.blocks.back().largest);
  }
  const std::vector<std::uint8_t> near = next_to_something(after, moving * largest);
  for (MovingBlock& b : m.blocks) {
    b.motion = !near[b.id]                 ? Motion::falls
               : b.turning_part >= topples ? Motion::topples
                                           : Motion::slides;
  }
  std::erase_if(m.blocks, [&](const MovingBlock& b) { return b.largest < moving * largest; });
  for (const MovingBlock& b : m.blocks) {
    const double mass = before.blocks.mass[b.id];
    weight += mass;
    (b.motion == Motion::slides    ? m.sliding
     : b.motion == Motion::topples ? m.toppling
                                   : m.falling) += mass;
  }
  for (double* part : {&m.sliding, &m.toppling, &m.falling}) *part /= weight > 0.0 ? weight : 1.0;
  m.joints = joints_of(before, after, moving * largest);
  m.text = sentence(m);
  return m;
}

void find_lost_cohesion(Mechanism& m, const Simulation& held) {
  const ContactSet& c = held.contacts;
  std::set<std::tuple<Id, Id, std::uint16_t>> brittle;
  for (const MovingJoint& j : m.joints) {
    const Law& law = held.laws.rows[j.law];
    if (!law.glued && !law.changes && law.residual_cohesion < law.peak_cohesion)
      brittle.insert({j.block_i, j.block_j, j.law});
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const auto [i, j] = std::minmax(c.block_i[k], c.block_j[k]);
    if (c.why[k] != Blocked::no || !brittle.contains({i, j, c.law[k]})) continue;
    const bool lost = !c.is(k, cs::bonded);
    if (lost && !c.is(k, cs::closed | cs::opened)) continue;  // was never bonded
    const double length = c.share[k] * c.length[k];
    m.brittle_length += length;
    if (lost) m.cohesion_lost_length += length;
  }
  if (!lost_cohesion_text(m).empty())
    m.text += fmt::format("; without cohesion before on {:.3g} of {:.3g} m", m.cohesion_lost_length,
                          m.brittle_length);
}

std::string lost_cohesion_text(const Mechanism& m) {
  constexpr double little = 0.01;
  if (!(m.cohesion_lost_length > little * m.brittle_length)) return {};
  return fmt::format(
      "{:.3g} m of {:.3g} m of the mechanism's joints had no cohesion before it moved (it was "
      "lost, "
      "or they have closed since; residual.cohesion is lower): with residual.cohesion = cohesion "
      "the factor may be higher",
      m.cohesion_lost_length, m.brittle_length);
}

std::string mechanism_csv(const Simulation& sim, const Mechanism& mechanism) {
  Csv csv;
  csv.header(
      {"id", "name", "x", "y", "ux", "uy", "displacement", "rotation", "turning_part", "motion"});
  for (const MovingBlock& b : mechanism.blocks) {
    csv.add(b.id).add(sim.blocks.name(b.id)).add(b.place.x).add(b.place.y);
    csv.add(b.displacement.x).add(b.displacement.y).add(b.largest).add(b.rotation);
    csv.add(b.turning_part).add(motion_name(b.motion)).end();
  }
  return csv.text();
}

std::string mechanism_joints_csv(const Mechanism& mechanism) {
  Csv csv;
  csv.header({"block_i", "block_j", "joint", "x", "y", "slip", "opening"});
  for (const MovingJoint& j : mechanism.joints) {
    csv.add(j.block_i).add(j.block_j).add(j.joint).add(j.place.x).add(j.place.y);
    csv.add(j.slip).add(j.opening).end();
  }
  return csv.text();
}

}  // namespace edda
