// Answers of rigid limit analysis that take several programs: factors of strength, tilts, and the
// loads of joints that do not dilate as they slide.
#pragma once

#include <functional>

#include "limit/limit_program.hpp"

namespace edda {

/// The factor of strength F by which all of the strength may be divided that `divided` marks.
struct StrengthFactor {
  LimitEnd end = LimitEnd::not_solved;  ///< no_limit: any factor; no_equilibrium: none
  double holds = 0.0, fails = 0.0;  ///< factors with and without an equilibrium, as near to each
                                    ///< other as asked for
  LimitState state;                 ///< forces at `holds`, mechanism at `fails`
};
/// strength_at(F): [joints] with their strength divided by F. tolerance: relative width between
/// holds and fails; first: the factor to begin with. Newton's method on the tension that joints
/// need (Shortfall) as a function of F, of which the derivative is D/F with the dissipation D of
/// its mechanism: for friction alone it is straight as long as the mechanism stays the same.
StrengthFactor strength_factor(LimitProblem problem, const std::vector<char>& divided,
                               const std::function<std::vector<RigidStrength>(double)>& strength_at,
                               double tolerance, double first = 1.0);

/// The largest angle, rad, by which gravity may be tilted towards +x (or the smallest). dead_at:
/// the loads at an angle; turning_at: their derivative by it. Newton's method on the tangent of the
/// arc that gravity describes.
LimitState tilt_limit(LimitProblem problem, bool largest,
                      const std::function<RigidForces(double)>& dead_at,
                      const std::function<RigidForces(double)>& turning_at);

/// Strength of joints that slide without dilating, for successive programs (Gilbert, Casapulla and
/// Ahmed 2006): nearly all of their friction is replaced by the shear strength that it has at the
/// normal forces of the program before. kept: the part of it that still makes a joint dilate.
std::vector<RigidStrength> without_dilation(const RigidBlocks& rigid,
                                            std::vector<RigidStrength> given,
                                            const std::vector<RigidJointForce>& before,
                                            double kept);

}  // namespace edda
