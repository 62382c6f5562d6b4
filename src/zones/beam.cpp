#include "zones/beam.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "zones/koiter.hpp"

namespace edda {
namespace {

// l, theta_1, theta_2, h_1, h_2.
constexpr std::size_t measures = 5;
using Gradients = std::array<BeamCorners, measures>;
enum Corner : std::size_t { outer_1, outer_2, inner_2, inner_1 };

struct Geometry {
  Vec2 chord;
  std::array<Vec2, 2> director;
};
Geometry geometry_of(const BeamCorners& x) {
  return {0.5 * (x[outer_2] + x[inner_2] - x[outer_1] - x[inner_1]),
          {x[inner_1] - x[outer_1], x[inner_2] - x[outer_2]}};
}

/// Derivatives of the measures by the places of the corners.
Gradients gradients_of(const BeamCorners& x) {
  const auto [chord, director] = geometry_of(x);
  const double square = dot(chord, chord), l = std::sqrt(square);
  Gradients g{};
  const auto add_chord = [&](BeamCorners& to, Vec2 by) {
    to[outer_1] -= 0.5 * by;
    to[inner_1] -= 0.5 * by;
    to[outer_2] += 0.5 * by;
    to[inner_2] += 0.5 * by;
  };
  add_chord(g[0], chord / l);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t outer = k == 0 ? outer_1 : outer_2, inner = k == 0 ? inner_1 : inner_2;
    const Vec2 d = director[k];
    const double of_d = dot(d, d);
    g[1 + k][inner] += perp(d) / of_d;
    g[1 + k][outer] -= perp(d) / of_d;
    add_chord(g[1 + k], -perp(chord) / square);
    g[3 + k][inner] += d / std::sqrt(of_d);
    g[3 + k][outer] -= d / std::sqrt(of_d);
  }
  return g;
}

double curvature_of(const BeamForm& form) {
  return (form.turn[1] - form.turn[0]) / form.length;
}

/// Second derivatives of U by the measures.
using Stiffness = Eigen::Matrix<double, measures, measures>;
Stiffness stiffness_of(const BeamShape& s, const BeamForm& form) {
  const double l = form.length;
  Eigen::Matrix<double, measures, 1> bend = Eigen::Matrix<double, measures, 1>::Zero(),
                                     shear = bend;
  bend.head(3) << -curvature_of(form), -1.0, 1.0;
  shear.head(3) << 0.0, 0.5, 0.5;
  Stiffness k = s.bending / l * bend * bend.transpose() + s.shear * l * shear * shear.transpose();
  k(0, 0) += s.axial / l;
  k(3, 3) = k(4, 4) = s.across;
  return k;
}

/// dl, dtheta_1 and dtheta_2.
using Stretch = std::array<double, 3>;
Stretch stretch_from(const BeamForm& free, const BeamForm& now) {
  return {now.length - free.length, now.turn[0] - free.turn[0], now.turn[1] - free.turn[1]};
}

BeamForces forces_of(const BeamShape& shape, const BeamState& state, const Stretch& e) {
  const double l = state.length, c = state.curvature;
  const double mean = shape.bending / l * (e[2] - e[1] - c * e[0]),
               of_shear = 0.25 * shape.shear * l * (e[1] + e[2]);
  return {shape.axial / l * e[0] - c * mean, {mean - of_shear, mean + of_shear}};
}

/// The same the other way round.
Stretch stretch_of(const BeamShape& shape, const BeamState& state, const BeamForces& f) {
  const double l = state.length, mean = 0.5 * (f.moment[0] + f.moment[1]),
               longer = (f.axial + state.curvature * mean) * l / shape.axial,
               bent = mean * l / shape.bending + state.curvature * longer,
               sheared = 2.0 * (f.moment[1] - f.moment[0]) / (shape.shear * l);
  return {longer, 0.5 * (sheared - bent), 0.5 * (sheared + bent)};
}

double stored_by(const BeamForces& f, const Stretch& e) {
  return 0.5 * (f.axial * e[0] - f.moment[0] * e[1] + f.moment[1] * e[2]);
}

constexpr double tolerated = 1e-10;  // of a strength

bool exceeds(const SectionStrength& strength, double axial, double moment) {
  return std::any_of(strength.begin(), strength.end(), [&](const SectionLimit& s) {
    return s.axial * axial + s.moment * std::abs(moment) > s.limit;
  });
}

/// Strengths of the two ends.
using EndStrengths = std::array<const SectionStrength*, 2>;

/// Roots of the stiffnesses of dl, of b and of dtheta_1 + dtheta_2, the last two over 2^(1/2); c.
/// With forces divided, and strains multiplied by them elasticity is the identity, and Koiter's
/// return finds the nearest point.
struct Scales {
  double axial, bend, shear, curvature;
};
Scales scales_of(const BeamShape& shape, const BeamState& state) {
  return {std::sqrt(shape.axial / state.length), std::sqrt(2.0 * shape.bending / state.length),
          std::sqrt(0.5 * shape.shear * state.length), state.curvature};
}

/// The limit of the moment of section k of this sign, of normal length 1.
YieldPlane scaled(const SectionLimit& s, const Scales& by, std::size_t k, double sign) {
  const double root = std::sqrt(0.5), half = root * sign * s.moment;
  const Principal n{s.axial * by.axial, (half - root * by.curvature * s.axial) * by.bend,
                    (k == 0 ? -half : half) * by.shear};
  const double size = std::sqrt(dot(n, n));
  YieldPlane plane;
  for (std::size_t c = 0; c < n.size(); ++c) plane.normal[c] = plane.flow[c] = n[c] / size;
  plane.limit = s.limit / size;
  return plane;
}

/// Returns a trial stress by those of the planes that it, or the return so far, exceeds most.
ReturnedStress return_to_nearest(const Principal& trial, const std::vector<YieldPlane>& planes) {
  constexpr IsotropicElasticity identity{0.0, 0.5};
  double size = 0.0;
  for (const YieldPlane& p : planes) size = std::max(size, std::abs(p.limit));
  std::vector<YieldPlane> active;
  ReturnedStress r;
  r.stress = trial;
  constexpr std::size_t most = 24;
  while (active.size() < most) {
    const auto beyond = [&](const YieldPlane& p) { return dot(p.normal, r.stress) - p.limit; };
    const auto worst = std::max_element(
        planes.begin(), planes.end(),
        [&](const YieldPlane& a, const YieldPlane& b) { return beyond(a) < beyond(b); });
    if (!(beyond(*worst) > tolerated * size)) break;
    active.push_back(*worst);
    r = return_to_planes(trial, identity, active, tolerated * size);
  }
  return r;
}

/// Brings the forces of a piece that is stretched by `trial` back to the strength.
void flow(const BeamShape& shape, const EndStrengths& strength, const Stretch& trial,
          const BeamForces& before, BeamState& state, BeamResult& result) {
  const Scales by = scales_of(shape, state);
  std::vector<YieldPlane> planes;
  for (const std::size_t k : {0u, 1u}) {
    for (const SectionLimit& s : *strength[k])
      for (const double sign : {-1.0, 1.0}) planes.push_back(scaled(s, by, k, sign));
  }
  const double root = std::sqrt(0.5);
  const ReturnedStress r = return_to_nearest(
      {by.axial * trial[0], by.bend * root * (trial[2] - trial[1] - by.curvature * trial[0]),
       by.shear * root * (trial[1] + trial[2])},
      planes);
  const double longer = r.plastic[0] / by.axial,
               bent = root * r.plastic[1] / by.bend + 0.5 * by.curvature * longer,
               sheared = root * r.plastic[2] / by.shear;
  const Stretch plastic{longer, sheared - bent, sheared + bent};
  state.free.length += plastic[0];
  Stretch elastic = trial;
  for (std::size_t k = 0; k < elastic.size(); ++k) elastic[k] -= plastic[k];
  state.forces = forces_of(shape, state, elastic);
  result.dissipated = 0.5 * (before.axial + state.forces.axial) * plastic[0];
  for (std::size_t k = 0; k < 2; ++k) {
    state.free.turn[k] += plastic[1 + k];
    // A rotation of the section that opens the outer side.
    const double turn = k == 0 ? -plastic[1] : plastic[2];
    state.hinge[k] += turn;
    result.dissipated += 0.5 * (before.moment[k] + state.forces.moment[k]) * turn;
  }
  result.yields = true;
}

}  // namespace

BeamForm form_of(const BeamCorners& x) {
  const auto [chord, director] = geometry_of(x);
  BeamForm form{norm(chord), {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    form.turn[k] = std::atan2(-dot(chord, director[k]), cross(chord, director[k]));
    form.height[k] = norm(director[k]);
  }
  return form;
}

double highest_square(const BeamShape& shape, const BeamCorners& x, double mass) {
  const Gradients g = gradients_of(x);
  Eigen::Matrix<double, measures, 2 * corners_of_beam> b;
  for (std::size_t m = 0; m < measures; ++m) {
    for (std::size_t c = 0; c < corners_of_beam; ++c) {
      const auto row = static_cast<Eigen::Index>(m), at = static_cast<Eigen::Index>(2 * c);
      b(row, at) = g[m][c].x;
      b(row, at + 1) = g[m][c].y;
    }
  }
  const Eigen::Matrix<double, 2 * corners_of_beam, 2 * corners_of_beam> k =
      b.transpose() * stiffness_of(shape, form_of(x)) * b;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff() / mass;
}

BeamShape beam_shape(const BeamSection& section, const BeamCorners& x, double mass) {
  const double l = form_of(x).length, of_rectangle = 5.0 / 6.0;
  BeamShape shape;
  shape.axial = section.young * section.area;
  shape.bending = section.young * section.inertia;
  shape.shear = 1.0 / (1.0 / (of_rectangle * section.shear_modulus * section.area) +
                       l * l / (12.0 * shape.bending));
  const double solid = 0.5 * shape.axial * l * section.area / (12.0 * section.inertia);
  shape.across = std::min(solid, 0.5 * mass * highest_square(shape, x, mass));
  return shape;
}

SectionStrength rectangle_strength(double compressive, double tensile, double area,
                                   double thickness) {
  constexpr int parts = 16;
  SectionStrength strength;
  for (int k = 0; k <= parts; ++k) {
    const double x = k / double(parts), slope = 0.5 * thickness * (1.0 - 2.0 * x);
    const double axial = area * (tensile * x - compressive * (1.0 - x)),
                 moment = 0.5 * (compressive + tensile) * area * thickness * x * (1.0 - x);
    strength.push_back({-slope, 1.0, moment - slope * axial});
  }
  return strength;
}

std::vector<Vec2> outline_of(const SectionStrength& strength) {
  std::vector<Vec2> corners;
  if (strength.empty()) return corners;
  const auto without_moment = [](const SectionLimit& s) { return Vec2{s.limit / s.axial, 0.0}; };
  corners.push_back(without_moment(strength.front()));
  for (std::size_t k = 1; k < strength.size(); ++k) {
    const SectionLimit &a = strength[k - 1], &b = strength[k];
    const double det = a.axial * b.moment - b.axial * a.moment;
    corners.push_back({(a.limit * b.moment - b.limit * a.moment) / det,
                       (a.axial * b.limit - b.axial * a.limit) / det});
  }
  corners.push_back(without_moment(strength.back()));
  return corners;
}

double utilisation(const SectionStrength& strength, double axial, double moment) {
  double most = 0.0, largest = 0.0;
  for (const SectionLimit& s : strength) largest = std::max(largest, s.limit);
  for (const SectionLimit& s : strength) {
    const double value = s.axial * axial + s.moment * std::abs(moment);
    // Through the origin: whatever is on it is at the limit.
    if (s.limit > tolerated * largest) {
      most = std::max(most, value / s.limit);
    } else if (value > tolerated * largest || (value >= -tolerated * largest && moment != 0.0)) {
      most = std::max(most, 1.0);
    }
  }
  return most;
}

BeamState beam_at_start(const BeamCorners& x) {
  BeamState state;
  state.free = form_of(x);
  state.length = state.free.length;
  state.curvature = curvature_of(state.free);
  return state;
}

double change_shape(const BeamShape& from, const BeamShape& to, const BeamCorners& x,
                    BeamState& state) {
  const Stretch before = stretch_of(from, state, state.forces),
                after = stretch_of(to, state, state.forces);
  double more = stored_by(state.forces, after) - stored_by(state.forces, before);
  state.free.length += before[0] - after[0];
  const BeamForm now = form_of(x);
  for (std::size_t k = 0; k < 2; ++k) {
    state.free.turn[k] += before[1 + k] - after[1 + k];
    const double opened = now.height[k] - state.free.height[k],
                 opens = from.across / to.across * opened;
    state.free.height[k] = now.height[k] - opens;
    more += 0.5 * from.across * opened * (opens - opened);
  }
  return more;
}

BeamResult evaluate_beam(const BeamShape& shape, const SectionStrength& strength,
                         const BeamCorners& x, BeamState& state, const SectionStrength& residual) {
  const BeamForm now = form_of(x);
  const Stretch stretch = stretch_from(state.free, now);
  BeamResult r;
  const BeamForces before = state.forces;
  state.forces = forces_of(shape, state, stretch);
  const EndStrengths ends{&strength_at(state, 0, strength, residual),
                          &strength_at(state, 1, strength, residual)};
  std::array<bool, 2> beyond{};
  for (std::size_t k = 0; k < 2; ++k)
    beyond[k] = exceeds(*ends[k], state.forces.axial, state.forces.moment[k]);
  if (beyond[0] || beyond[1]) flow(shape, ends, stretch, before, state, r);
  for (std::size_t k = 0; k < 2; ++k)
    if (beyond[k]) state.yielded[k] = 1.0;
  const Stretch elastic = stretch_from(state.free, now);
  std::array<double, measures> slope{state.forces.axial, -state.forces.moment[0],
                                     state.forces.moment[1], 0.0, 0.0};
  for (std::size_t k = 0; k < elastic.size(); ++k) r.stored += 0.5 * slope[k] * elastic[k];
  for (std::size_t k = 0; k < 2; ++k) {
    const double opened = now.height[k] - state.free.height[k];
    slope[3 + k] = shape.across * opened;
    r.stored += 0.5 * slope[3 + k] * opened;
  }
  const Gradients g = gradients_of(x);
  for (std::size_t m = 0; m < measures; ++m) {
    for (std::size_t c = 0; c < corners_of_beam; ++c) r.force[c] -= slope[m] * g[m][c];
  }
  return r;
}

BeamCorners viscous_forces(const BeamShape& shape, const BeamState& state, const BeamCorners& x,
                           const BeamCorners& v, double eta) {
  const Gradients g = gradients_of(x);
  std::array<double, measures> rate{};
  for (std::size_t m = 0; m < measures; ++m) {
    for (std::size_t c = 0; c < corners_of_beam; ++c) rate[m] += dot(g[m][c], v[c]);
  }
  const BeamForces f = forces_of(shape, state, {rate[0], rate[1], rate[2]});
  const std::array<double, measures> slope{f.axial, -f.moment[0], f.moment[1],
                                           shape.across * rate[3], shape.across * rate[4]};
  BeamCorners force{};
  for (std::size_t m = 0; m < measures; ++m) {
    for (std::size_t c = 0; c < corners_of_beam; ++c) force[c] -= eta * slope[m] * g[m][c];
  }
  return force;
}

}  // namespace edda
