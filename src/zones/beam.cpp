#include "zones/beam.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

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

/// Second derivatives of U by the measures.
using Stiffness = Eigen::Matrix<double, measures, measures>;
Stiffness stiffness_of(const BeamShape& s, double l) {
  Stiffness k = Stiffness::Zero();
  k(0, 0) = s.axial / l;
  const double bend = s.bending / l, shear = 0.25 * s.shear * l;
  k(1, 1) = k(2, 2) = bend + shear;
  k(1, 2) = k(2, 1) = shear - bend;
  k(3, 3) = k(4, 4) = s.across;
  return k;
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
      b.transpose() * stiffness_of(shape, form_of(x).length) * b;
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

BeamResult evaluate_beam(const BeamShape& shape, const BeamState& state, const BeamCorners& x) {
  const BeamForm now = form_of(x), &free = state.free;
  const double l = free.length, stretched = now.length - l;
  const std::array<double, 2> turned{now.turn[0] - free.turn[0], now.turn[1] - free.turn[1]};
  const double mean = shape.bending / l * (turned[1] - turned[0]),
               of_shear = 0.25 * shape.shear * l * (turned[0] + turned[1]);
  BeamResult r;
  r.forces = {shape.axial / l * stretched, {mean - of_shear, mean + of_shear}};
  std::array<double, measures> slope{r.forces.axial, -r.forces.moment[0], r.forces.moment[1], 0.0,
                                     0.0};
  r.stored = 0.5 * (r.forces.axial * stretched - r.forces.moment[0] * turned[0] +
                    r.forces.moment[1] * turned[1]);
  for (std::size_t k = 0; k < 2; ++k) {
    const double opened = now.height[k] - free.height[k];
    slope[3 + k] = shape.across * opened;
    r.stored += 0.5 * slope[3 + k] * opened;
  }
  const Gradients g = gradients_of(x);
  for (std::size_t m = 0; m < measures; ++m) {
    for (std::size_t c = 0; c < corners_of_beam; ++c) r.force[c] -= slope[m] * g[m][c];
  }
  return r;
}

}  // namespace edda
