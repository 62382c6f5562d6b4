// A zone: a triangle of constant strain whose rock may yield (multiplicative plasticity with
// logarithmic strains; de Souza Neto, Peric and Owen 2008, chapter 14).
//
//   F = sum x_k g_k^T,  F_e = F F_p^-1,  e = ln V_e in its principal directions n_a,
//   tau = C e (Kirchhoff, isotropic; tau = det(F) sigma),  P = tau F^-T,  f_k = -V P g_k.
// Rock with a foliation that deforms has S = C (F_e^T F_e - 1)/2, tau = F_e S F_e^T instead: there
// the principal directions of strain and stress differ. Its slip g and opening n along t, of normal
// q, make F_p <- exp(g t q^T + n q q^T) F_p: t stays where it is in the rock.
// An initial stress s0 is an elastic strain from the start: F_p^-1 = exp(C^-1 s0). Out of plane the
// total strain is 0. Since e follows from F alone, nothing is summed up over steps, a rotation of
// any size changes nothing, and evaluating a state twice changes nothing, but where pairs share
// plastic volume (below), which leaves stresses beside the strength until the next evaluations.
//
// Zones come in pairs (mixed discretisation; Marti and Cundall 1982), against locking: both have
// the mean of their volume strains ln det(F), and the mean of their stresses in the plane:
//   e_a -> e_a + (mean theta - theta)/2,  theta = ln det F;  the forces remain the gradient of the
//   energy. What a zone's initial stress differs by from that mean stays: the energy has the term
//   V p theta, p = p0 - mean p0, so that ground whose stress grows with depth is in equilibrium.
//   Plastic volume strains are shared likewise: each zone dilates as the mean of both. Otherwise
//   the shared volume would bind the shear strains of two zones that dilate to each other.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec2.hpp"
#include "zones/rock.hpp"

namespace edda {

/// A 2 x 2 matrix.
struct Matrix2 {
  double xx = 1.0, xy = 0.0, yx = 0.0, yy = 1.0;
};

/// What does not change during a run.
struct ZoneShape {
  std::array<Vec2, 3> gradient;  ///< g_k, 1/m
  double volume = 0.0;           ///< area times thickness, m3
  double width = 0.0;            ///< w of a band of shear through it, m: that of two pairs of such
                                 ///< triangles
};
ZoneShape zone_shape(Vec2 a, Vec2 b, Vec2 c, double thickness);
/// theta of a zone, its nodes at x.
double swelling_of(const ZoneShape& shape, const std::array<Vec2, 3>& x);

/// What is remembered of a zone.
struct ZoneState {
  Matrix2 plastic_inverse;         ///< F_p^-1
  double elastic_zz = 0.0;         ///< logarithmic elastic strain out of plane
  double locked = 0.0;             ///< p, Pa
  double plastic_shear = 0.0;      ///< accumulated e1 - e3, also of cracks
  double slipped = 0.0;            ///< accumulated slip on the foliation, strain
  std::array<double, 4> stress{};  ///< Kirchhoff, before the mean of a pair, as seen from the zone,
                                   ///< which rotates, xx, yy, zz, xy, Pa
};
/// Locks what the initial stresses of a pair differ by from their mean.
void lock_pressures(const std::array<ZoneShape, 2>& shape, std::array<ZoneState, 2>& state);
/// Of a zone under an initial stress (xx, yy, zz, xy, Pa).
ZoneState zone_at_start(const ZoneMaterial& material, const std::array<double, 4>& stress);

/// Of both zones of a pair, or one by itself, that are to have no stress where their nodes are.
void begin_without_stress(const std::array<ZoneShape, 2>& shape,
                          const std::array<std::array<Vec2, 3>, 2>& x,
                          std::array<ZoneState, 2>& state);

/// How a zone yields.
enum class Yielding : std::uint8_t { nowhere, in_shear, in_tension, along_foliation };

/// A zone at its nodes' positions: forces on them, N, and the energies of its rock, J.
struct ZoneResult {
  std::array<Vec2, 3> force;
  double stored = 0.0;
  double dissipated = 0.0;  ///< since its state before, by the mean of the stresses then and now:
                            ///< what a leapfrog's work over the step lacks
  std::array<double, 4> stress{};  ///< Cauchy, xx, yy, zz, xy, Pa
  Yielding yielding{};
};

/// Both zones of a pair, or one by itself (shape[1].volume = 0). The states become those at x.
std::array<ZoneResult, 2> evaluate_zones(const std::array<ZoneShape, 2>& shape,
                                         const ZoneMaterial& material,
                                         const std::array<std::array<Vec2, 3>, 2>& x,
                                         std::array<ZoneState, 2>& state);

/// Forces on their nodes, N, of a viscous stress eta C : dE/dt of the elastic rock, E = (F^T F -
/// 1)/2, where the nodes move by v; a pair has the mean of its volume strain rates, and of its
/// pressures.
std::array<std::array<Vec2, 3>, 2> viscous_forces(const std::array<ZoneShape, 2>& shape,
                                                  const ZoneMaterial& material,
                                                  const std::array<std::array<Vec2, 3>, 2>& x,
                                                  const std::array<std::array<Vec2, 3>, 2>& v,
                                                  double eta);

}  // namespace edda
