#include "contacts/face_preload.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/joint_strength.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

/// Closures whose pressure has these normal forces at the ends: N = k L d/2 where the integral is
/// taken at the ends, N_a = k L (2 d_a + d_b)/6 where it is exact.
FaceEnds closures_of(FaceEnds normal, double stiffness, bool at_ends) {
  if (at_ends) return {2.0 * normal.a / stiffness, 2.0 * normal.b / stiffness};
  return {(4.0 * normal.a - 2.0 * normal.b) / stiffness,
          (4.0 * normal.b - 2.0 * normal.a) / stiffness};
}

/// Normal and shear forces that the initial stress requires at the ends of a face, N.
struct RequiredForces {
  Id face;
  double length;
  FaceEnds normal, shear;
};

void add_to_joint(JointStress& joint, const FaceSet& c, const RequiredForces& required) {
  const Id k = required.face;
  const double length = required.length;
  joint.length += length;
  if (c.glued(k)) return;
  const double tension = c.carries_tension(k) ? c.tension[k] * length : 0.0;
  const double normal = required.normal.a + required.normal.b;
  const double shear = std::abs(required.shear.a + required.shear.b);
  if (normal < -tension) joint.torn += length;
  constexpr double rounding = 1e-9;
  const double strength = coulomb_limit(c.cohesion[k] * length, c.friction[k], normal);
  const double size = shear > rounding * std::abs(normal) ? shear : 0.0;
  if (normal > 0.0) {
    joint.ratio = std::max(joint.ratio, size / normal);
    if (size > 0.0) joint.mobilised = std::max(joint.mobilised, size / strength);
  }
  if (normal >= -tension && size > (1.0 + rounding) * strength) joint.over += length;
}

/// Of an edge whose faces are without force where they touch, whatever was on the other side.
constexpr double never_pressed = -1e100;

void lock_pressures(FaceSet& c, const BlockSet& b, const FaceTraction& traction) {
  const std::size_t nv = b.vertex_count();
  c.locked_start.resize(nv);
  c.locked_end.resize(nv);
  for (std::size_t e = 0; e < nv; ++e) {
    if (b.is_added(b.vertex_block[e])) {
      c.locked_start[e] = c.locked_end[e] = never_pressed;
      continue;
    }
    const EndForces on = traction(static_cast<Id>(e), 0.0, 1.0);
    const Vec2 n = outward_normal(unit(b.vertex(b.next[e]) - b.vertex(e)));
    const double from = -dot(on.at_from, n), to = -dot(on.at_to, n);
    c.locked_start[e] = (4.0 * from - 2.0 * to) / b.edge_length[e];
    c.locked_end[e] = (4.0 * to - 2.0 * from) / b.edge_length[e];
  }
}

}  // namespace

FaceEnds locked_closure(const FaceSet& c, const Face& face, std::size_t k) {
  if (c.locked_start.empty()) return {};
  const Id e = c.edge[k], f = c.facing[k];
  const auto pressure = [&](double xi, double eta) {
    return 0.5 * ((1.0 - xi) * c.locked_start[e] + xi * c.locked_end[e] + eta * c.locked_start[f] +
                  (1.0 - eta) * c.locked_end[f]);
  };
  const auto closure = [&](double xi, double eta) {
    return std::max(pressure(xi, eta), 0.0) / c.stiffness[k];
  };
  return {closure(face.xi.a, face.eta.a), closure(face.xi.b, face.eta.b)};
}

std::vector<JointStress> preload_faces(FaceSet& c, FaceStates& states, const BlockSet& b,
                                       const Pose& pose, const LawTable& laws,
                                       const FaceTraction& traction) {
  std::vector<JointStress> joints(laws.rows.size());
  std::vector<RequiredForces> required;
  lock_pressures(c, b, traction);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (b.is_added(b.vertex_block[c.edge[k]]) || b.is_added(b.vertex_block[c.facing[k]])) continue;
    const Face drawn = face_at(c, b, pose.x, pose.y, k);
    // Edges that meet at a corner only, as at a crossing of two joints at a few degrees, have a
    // void between them.
    if (!touch_as_drawn(c, b, pose, drawn, k) || !lies_flush_as_drawn(drawn.closure, drawn.length))
      continue;
    const Vec2 n = outward_normal(drawn.t);
    // `traction` runs along the facing edge from its first corner, so end b comes first.
    const EndForces on = traction(c.facing[k], 1.0 - drawn.eta.b, 1.0 - drawn.eta.a);
    const FaceEnds normal{dot(on.at_to, n), dot(on.at_from, n)};
    const FaceEnds shear{dot(on.at_to, drawn.t), dot(on.at_from, drawn.t)};
    c.set(FaceFlag::acts, k);
    c.set(FaceFlag::leans, k);
    required.push_back({static_cast<Id>(k), drawn.length, normal, shear});
    const bool bears = normal.a + normal.b > 0.0 || c.carries_tension(k);
    if (!bears) continue;
    // A locked closure moves the ends of the overlap inward (face.hpp): a little more closure makes
    // up for the lost length.
    Face face = drawn;
    double more = 1.0;
    constexpr int passes = 4;
    for (int pass = 0; pass < passes; ++pass) {
      const FaceEnds closure =
          closures_of(normal, c.stiffness[k] * drawn.length * drawn.gate, c.of_law(k).at_ends);
      c.locked_closure_a[k] = more * closure.a - drawn.drawn.a;
      c.locked_closure_b[k] = more * closure.b - drawn.drawn.b;
      face = face_at(c, b, pose.x, pose.y, k);
      const double pressing = dot(face.force.q1 + face.force.q2, n);
      if (pressing != 0.0) more *= std::clamp((normal.a + normal.b) / pressing, 0.5, 2.0);
    }
    FaceFields& m = states.before[k];
    take_element(m, face);
    m.overlap = face.length;
    m.spring = 0.5 * c.shear_stiffness[k] * face.length * face.gate;
    m.shear_a = shear.a;
    m.shear_b = shear.b;
    m.slip_a = -shear.a / m.spring;
    m.slip_b = -shear.b / m.spring;
  }
  put_in_force(c, states, laws);
  for (const RequiredForces& a : required) add_to_joint(joints[c.law[a.face]], c, a);
  states.now = states.before;
  return joints;
}

}  // namespace edda
