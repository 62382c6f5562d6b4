// States of faces as values: what a start prescribes, a checkpoint keeps, and a correction of the
// last step changes. A step keeps them in tiles (contacts/face_tiles.hpp).
#pragma once

#include <iterator>
#include <vector>

#include "contacts/face.hpp"

namespace edda {

/// State of a face at a step. All of it follows from the positions, except the slip.
struct FaceFields {
  double closure_a, closure_b;      ///< d at the ends, m
  double energy;                    ///< U of the normal pressure, J
  double normal_a, normal_b;        ///< normal force at the ends, N
  double shear_a, shear_b;          ///< T at the ends, N
  double slip_a, slip_b;            ///< elastic slip u, m: T = -spring u
  double trial_a, trial_b;          ///< elastic slip before Coulomb's limit, m
  double spring;                    ///< stiffness of the shear spring of each end, N/m
  double length;                    ///< L, m; 0: none (overlaps())
  double overlap;                   ///< length that the two shear springs represent, m
  double cohesive;                  ///< length along which cohesion acts, m
  double gate;                      ///< w W
  double xi_a, xi_b, eta_a, eta_b;  ///< positions of the ends along the edges
  double switched;                  ///< 1: another set of ends is closed than at the step before
  double friction_work;             ///< dissipated by friction in the last step, J
  double transfer;  ///< lost in the last step by changes of the overlap, no physical process, J
  double damping_a, damping_b;              ///< forces of the normal dashpots, N
  double shear_damping_a, shear_damping_b;  ///< forces of the shear dashpots, N
  double strike_a, strike_b;  ///< speed at which the ends closed (strike_speed()), m/s
  double damping_work;  ///< work of the dashpot forces at n in the last step, from n - 1 to n, J
  double damping_due;   ///< the other half, of the dashpot forces at n - 1, J
};

/// Fills what follows from the corners of a face, which is this element there.
inline void take_element(FaceFields& m, const Face& face) {
  m.closure_a = face.closure.a;
  m.closure_b = face.closure.b;
  m.energy = face.energy;
  m.normal_a = face.normal.a;
  m.normal_b = face.normal.b;
  m.length = larger(face.length, 0.0);
  m.cohesive = face.cohesive;
  m.gate = face.gate;
  m.xi_a = face.xi.a;
  m.xi_b = face.xi.b;
  m.eta_a = face.eta.a;
  m.eta_b = face.eta.b;
}

/// A member of FaceFields: name, unit.
struct FaceField {
  const char* name;
  const char* unit;
  double FaceFields::*value;
};
inline constexpr FaceField face_fields[] = {{"closure_a", "m", &FaceFields::closure_a},
                                            {"closure_b", "m", &FaceFields::closure_b},
                                            {"energy", "J", &FaceFields::energy},
                                            {"normal_a", "N", &FaceFields::normal_a},
                                            {"normal_b", "N", &FaceFields::normal_b},
                                            {"shear_a", "N", &FaceFields::shear_a},
                                            {"shear_b", "N", &FaceFields::shear_b},
                                            {"slip_a", "m", &FaceFields::slip_a},
                                            {"slip_b", "m", &FaceFields::slip_b},
                                            {"trial_a", "m", &FaceFields::trial_a},
                                            {"trial_b", "m", &FaceFields::trial_b},
                                            {"spring", "N/m", &FaceFields::spring},
                                            {"length", "m", &FaceFields::length},
                                            {"overlap", "m", &FaceFields::overlap},
                                            {"cohesive", "m", &FaceFields::cohesive},
                                            {"gate", "1", &FaceFields::gate},
                                            {"xi_a", "1", &FaceFields::xi_a},
                                            {"xi_b", "1", &FaceFields::xi_b},
                                            {"eta_a", "1", &FaceFields::eta_a},
                                            {"eta_b", "1", &FaceFields::eta_b},
                                            {"switched", "1", &FaceFields::switched},
                                            {"friction_work", "J", &FaceFields::friction_work},
                                            {"transfer", "J", &FaceFields::transfer},
                                            {"damping_a", "N", &FaceFields::damping_a},
                                            {"damping_b", "N", &FaceFields::damping_b},
                                            {"shear_damping_a", "N", &FaceFields::shear_damping_a},
                                            {"shear_damping_b", "N", &FaceFields::shear_damping_b},
                                            {"strike_a", "m/s", &FaceFields::strike_a},
                                            {"strike_b", "m/s", &FaceFields::strike_b},
                                            {"damping_work", "J", &FaceFields::damping_work},
                                            {"damping_due", "J", &FaceFields::damping_due}};
static_assert(sizeof(FaceFields) == std::size(face_fields) * sizeof(double), "a field is missing");

/// The states of all faces of a list, [nf]: at step n, and at n - 1 what a step reads of them.
struct FaceStates {
  std::vector<FaceFields> now, before;

  FaceStates() = default;
  /// Of faces that have never carried load.
  explicit FaceStates(std::size_t faces) : now(faces, FaceFields{}), before(now) {}
};

}  // namespace edda
