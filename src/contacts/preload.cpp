#include "contacts/preload.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/shares.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

/// Gap, of the smaller block's size, within which blocks touch (as bonds do).
constexpr double touch = 1e-6;

bool touches(const ContactSet& c, const BlockSet& b, std::size_t k) {
  const double size = smaller_size(c, b, k);
  return c.length[k] > 0.0 && c.share[k] > 0.0 && c.on_edge(k) && c.depth[k] >= -touch * size &&
         !c.is(k, cs::blocked);
}

/// Force on the vertex of k: of each face of its that lies against the edge, what the end of their
/// overlap stands for, N.
Vec2 end_force(const ContactSet& c, const BlockSet& b, const Pose& pose,
               const FaceTraction& traction, std::size_t k) {
  const Id vertex = c.vertex[k];
  const Vec2 start = at(pose.x, pose.y, c.edge[k]), end = at(pose.x, pose.y, c.edge_end[k]);
  Vec2 sum;
  for (const Id f : {b.previous[vertex], vertex}) {
    const Vec2 a = at(pose.x, pose.y, f), u = at(pose.x, pose.y, b.next[f]) - a;
    if (dot(unit(u), c.tangent(k)) > -opposite) continue;
    const double from = std::clamp(dot(end - a, u) / dot(u, u), 0.0, 1.0),
                 to = std::clamp(dot(start - a, u) / dot(u, u), 0.0, 1.0);
    if (!(to > from)) continue;
    const EndForces on = traction(f, from, to);
    sum += f == vertex ? on.at_from : on.at_to;
  }
  return sum;
}

/// Part of its end of the overlap that each contact carries: those of a spring that two corners
/// divide count together.
std::vector<double> shares_of_ends(const ContactSet& c) {
  std::vector<double> sum = c.share;
  for (std::size_t p = 0; p < c.pairs.size(); ++p) {
    if (!divides(c, p)) continue;
    const Id first = c.pairs[p].first, second = c.pairs[p].second;
    if (c.is(second, cs::closed)) sum[first] += c.share[second];
    if (c.is(first, cs::closed)) sum[second] += c.share[first];
  }
  return sum;
}

void load(ContactSet& c, std::size_t k, double normal, double shear) {
  c.normal[k] = normal;
  c.rest[k] = c.depth[k] - normal / c.kn[k];
  c.shear[k] = c.shear_1[k] = shear;
  c.slip_trial[k] = -shear / c.ks[k];
  c.anchor[k] = (c.foot[k] + shear / c.ks[k]) / c.span[k];
}

/// `length`: of the joint that the contact stands for, m.
void judge(JointStress& joint, const ContactSet& c, std::size_t k, double length, double normal,
           double shear) {
  joint.length += length;
  if (c.is(k, cs::glued)) return;
  const double tension = c.is(k, cs::pulls) ? c.tension[k] : 0.0;
  if (normal < -tension) joint.torn += length;
  constexpr double rounding = 1e-9;
  const double strength = c.shear_limit(k, normal);
  const double size = std::abs(shear) > rounding * std::abs(normal) ? std::abs(shear) : 0.0;
  if (normal > 0.0) {
    joint.ratio = std::max(joint.ratio, size / normal);
    if (size > 0.0) joint.mobilised = std::max(joint.mobilised, size / strength);
  }
  if (normal >= -tension && size > (1.0 + rounding) * strength) joint.over += length;
}

}  // namespace

std::vector<JointStress> preload_contacts(ContactSet& c, const BlockSet& b, const Pose& pose,
                                          const LawTable& laws, const FaceTraction& traction,
                                          TransitionScratch& scratch) {
  std::vector<Vec2> forces(c.size());
  std::vector<std::uint8_t> is_end(c.size(), 0);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!touches(c, b, k)) continue;
    is_end[k] = 1;
    forces[k] = end_force(c, b, pose, traction, k);
    const double normal = dot(forces[k], normal_of(c, k));
    if (!c.is(k, cs::closed) && normal > 0.0) c.rest[k] = c.depth[k] - normal / c.kn[k];
  }
  settle_contacts(c, b, pose, laws, 0, true, scratch);
  const std::vector<double> whole = shares_of_ends(c);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (is_end[k] == 0) continue;
    forces[k] = 1.0 / whole[k] * forces[k];
    if (!c.is(k, cs::closed)) continue;
    const double normal = dot(forces[k], normal_of(c, k));
    const bool bears = normal > 0.0 || c.is(k, cs::pulls);
    load(c, k, bears ? normal : 0.0, bears ? dot(forces[k], c.tangent(k)) : 0.0);
  }
  put_strengths_in_force(c, b, laws);
  std::vector<JointStress> joints(laws.rows.size());
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (is_end[k] == 0) continue;
    const double normal = dot(forces[k], normal_of(c, k)), shear = dot(forces[k], c.tangent(k));
    if (c.is(k, cs::closed) || normal <= 0.0)
      judge(joints[c.law[k]], c, k, c.length[k] * c.share[k] / whole[k], normal, shear);
  }
  return joints;
}

void cut_preload(ContactSet& c) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::closed)) {
      c.normal[k] = c.shear[k] = c.shear_1[k] = c.slip_trial[k] = 0.0;
      if (!c.is(k, cs::blocked)) c.rest[k] = std::max(0.0, std::min(c.rest[k], c.depth[k]));
      continue;
    }
    const double limit = c.shear_limit(k, c.normal[k]);
    if (c.is(k, cs::bonded) || std::abs(c.shear[k]) <= limit) continue;
    load(c, k, c.normal[k], std::copysign(limit, c.shear[k]));
    c.set(k, cs::slipped);
  }
}

}  // namespace edda
