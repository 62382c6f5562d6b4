// The strength of joints in rigid limit analysis, from their laws.
#pragma once

#include "contacts/laws.hpp"
#include "limit/limit_program.hpp"

namespace edda {

enum class StrengthOf { peak, residual };

/// Strength of all joints, that of row r of the table divided by divided_by[r] (rows of the
/// LawTable). Corners that lean on an edge have friction alone. Tension counts up to the apex of
/// Coulomb's limit, t <= c/tan(phi). crushing: joints have the compressive strength of their rock.
/// Barton-Bandis: with the friction angle at each joint's normal stress in `last`, or, where that
/// is empty, at the stress that its blocks' weight gives.
std::vector<RigidStrength> joint_strengths(const RigidBlocks& rigid, const LawTable& laws,
                                           const std::vector<double>& divided_by, StrengthOf which,
                                           bool crushing,
                                           const std::vector<RigidJointForce>& last = {});

/// Whether the strength of a joint depends on its normal stress in other ways than Coulomb's.
bool depends_on_stress(const RigidBlocks& rigid, const LawTable& laws);

}  // namespace edda
