// What a step of a face follows from (contacts/face_step.hpp).
#pragma once

#include "blocks/masses.hpp"
#include "contacts/face.hpp"

namespace edda {

/// Shear strength and damping of a face.
struct FaceStrength {
  double shear_stiffness;   ///< ks times the thickness, N/m per m of overlap
  double friction;          ///< tan(phi)
  double cohesion;          ///< c times the thickness, N per m of overlap
  bool bonded;              ///< has its peak strength; its shear is not cut end by end
  double zeta, shear_zeta;  ///< dashpots, as fractions of critical
  double rebound;           ///< of dashpots in proportion to the pressure; 0: they are linear
};

/// A face at n - 1.
struct FaceBefore {
  double slip_a, slip_b;    ///< elastic slip u, m: T = -spring u
  double overlap, spring;   ///< of the shear springs: length of both, m; stiffness of each, N/m
  bool stored, on;          ///< it stored energy; its gate was open
  bool closed_a, closed_b;  ///< its ends were closed
  bool switched;            ///< one of them had just opened or closed
  EdgeCoordinates corners;  ///< in the frame of n - 1; without z1
  FaceEnds damping, shear_damping;  ///< forces of the dashpots, N
  FaceEnds strike;                  ///< strike_speed() of the ends, m/s
};

/// All that a step of a face follows from.
struct FaceInputs {
  FacePair pair;
  FaceStrength strength;
  FacePoints at, then;  ///< the corners at n and n - 1; `then` counts only with a locked closure
  FaceBefore before;
  EdgeInverseMass mass_e, mass_f;  ///< for dashpots
  double per_step;                 ///< 1/s, of the step from n - 1 to n
  double noise;                    ///< m: closures up to this size are rounding of the coordinates
  FaceEnds limits;                 ///< of the shear forces, N, where they are given
};

/// One end of a face: its normal force, its elastic slip before Coulomb's limit, and the motion of
/// its points in the last step (EndMotion); of the closing only what came after they touched.
struct EndOfFace {
  double normal, trial, closing, slipping, xi, eta;
  double strike;  ///< strike_speed(), m/s
};
}  // namespace edda
