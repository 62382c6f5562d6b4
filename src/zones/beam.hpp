// A piece of a lining between two sections: a beam that may turn by any angle (corotational;
// Crisfield 1991, chapter 7).
//
// Its corners are those of a strip: outer 1, outer 2, inner 2, inner 1, counter-clockwise. Of the
// chord c between the middles of both sections and the directors d_k = inner - outer there are
//   l = |c|,  theta_k: angle of d_k from perp(c),  h_k = |d_k|,
// which no motion of the whole changes. With what they differ by from the form without stress,
//   U = EA dl^2/(2 l) + EI b^2/(2 l) + S l ((dtheta_1 + dtheta_2)/2)^2/2
//       + T (dh_1^2 + dh_2^2)/2,
//   b = dtheta_2 - dtheta_1 - c dl,   1/S = 1/(k G A) + l^2/(12 E I):
// the curvature is constant, c = (theta_2 - theta_1)/l without stress, so that a ring that only
// grows loses curvature (Winkler), and S, with the residual bending flexibility (MacNeal 1978),
// makes the piece exact for forces at its ends. T holds the sections together.
//
// Where N and M of a section reach what it can carry, it becomes a plastic hinge: l and theta_k of
// the form without stress follow the flow that belongs to the strength. From the step after that it
// has its residual strength, if there is one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

inline constexpr std::size_t corners_of_beam = 4;
using BeamCorners = std::array<Vec2, corners_of_beam>;

struct BeamForm {
  double length = 0.0;             ///< l, m
  std::array<double, 2> turn{};    ///< theta_k, rad
  std::array<double, 2> height{};  ///< h_k, m
};
BeamForm form_of(const BeamCorners& x);

/// What does not change during a run: EA (N), EI (N m2), S (N), T (N/m).
struct BeamShape {
  double axial = 0.0, bending = 0.0, shear = 0.0, across = 0.0;
};
/// Of the section of a beam of plane stress modulus E (Pa) and shear modulus G (Pa), of width out
/// of plane as its area and second moment have it.
struct BeamSection {
  double young = 0.0, shear_modulus = 0.0;  ///< Pa
  double area = 0.0, inertia = 0.0;         ///< m2, m4
};
/// `across` is that of two nodes of `mass` (kg) each whose frequency is not above the highest that
/// the piece has without it, and not above that of a solid strip.
BeamShape beam_shape(const BeamSection& section, const BeamCorners& x, double mass);

/// Square of the highest frequency of a piece by itself, with `mass` at each corner, 1/s2.
double highest_square(const BeamShape& shape, const BeamCorners& x, double mass);

/// a N + b M <= d, of either sign of M.
struct SectionLimit {
  double axial = 0.0, moment = 0.0;  ///< a and b > 0
  double limit = 0.0;                ///< d
};
/// What a section can carry; empty: anything. Of a rectangle of strengths f_c and f_t (rigid and
/// plastic), of which the part x is in tension:
///   N = f_t x A - f_c (1 - x) A,  M = (f_c + f_t) A t x (1 - x)/2,
/// by its tangents.
using SectionStrength = std::vector<SectionLimit>;
/// compressive, tensile: f_c and f_t, Pa; area in m2, thickness t in m.
SectionStrength rectangle_strength(double compressive, double tensile, double area,
                                   double thickness);
/// Corners of what it allows with M >= 0, from pure compression to pure tension: N in x, M in y;
/// empty where it allows anything.
std::vector<Vec2> outline_of(const SectionStrength& strength);
/// By what N and M would have to be divided to be on the surface; 1 on it.
double utilisation(const SectionStrength& strength, double axial, double moment);

/// Forces of its sections: N, positive in tension, and M, positive where the outer side is in
/// tension.
struct BeamForces {
  double axial = 0.0;              ///< N
  std::array<double, 2> moment{};  ///< M_1, M_2, N m
  double shear(double length) const { return (moment[1] - moment[0]) / length; }
};

/// What is remembered of a piece: the form without stress.
struct BeamState {
  BeamForm free;
  double length = 0.0, curvature = 0.0;  ///< l and c at first, m and 1/m
  std::array<double, 2> hinge{};         ///< plastic rotations of the ends, rad
  std::array<double, 2> yielded{};       ///< 1: that end has yielded; 0: not yet
  BeamForces forces;                     ///< of the last evaluation
};

/// Without stress at these places.
BeamState beam_at_start(const BeamCorners& x);

/// Gives a piece that is there another shape: its form without stress becomes that in which it
/// carries what it carries. Returns by how much more is stored, J.
double change_shape(const BeamShape& from, const BeamShape& to, const BeamCorners& x,
                    BeamState& state);

/// Forces on its corners, N, what is stored, and what its hinges have dissipated since its state
/// before, by the mean of the forces then and now, J.
struct BeamResult {
  std::array<Vec2, corners_of_beam> force{};
  double stored = 0.0, dissipated = 0.0;
  bool yields = false;
};
/// The state becomes that at x. An end that has yielded before this has the residual strength, if
/// there is one.
BeamResult evaluate_beam(const BeamShape& shape, const SectionStrength& strength,
                         const BeamCorners& x, BeamState& state,
                         const SectionStrength& residual = {});
/// Of an end.
inline const SectionStrength& strength_at(const BeamState& state, std::size_t end,
                                          const SectionStrength& strength,
                                          const SectionStrength& residual) {
  return state.yielded[end] != 0.0 && !residual.empty() ? residual : strength;
}

/// Forces on its corners, N, of a viscosity eta, s, where they move by v: -eta times the rate at
/// which the elastic ones would grow.
BeamCorners viscous_forces(const BeamShape& shape, const BeamState& state, const BeamCorners& x,
                           const BeamCorners& v, double eta);

}  // namespace edda
