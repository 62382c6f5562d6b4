#include "limit/joint_strength.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contacts/strength.hpp"

namespace edda {
namespace {

double barton_friction(const Law& law, const RigidBlocks& rigid, const RigidJoint& joint,
                       double normal, double thickness) {
  const double area = std::max(joint.length(), 1e-3 * rigid.size) * thickness;
  const double least = 1e-6 * rigid.force / area;
  const double angle = barton_angle(law, 1.0, std::max(normal / area, least));
  return std::tan(angle * std::numbers::pi / 180.0);
}

}  // namespace

std::vector<RigidStrength> joint_strengths(const RigidBlocks& rigid, const LawTable& laws,
                                           const std::vector<double>& divided_by, StrengthOf which,
                                           bool crushing,
                                           const std::vector<RigidJointForce>& last) {
  std::vector<RigidStrength> all;
  all.reserve(rigid.joints.size());
  for (std::size_t k = 0; k < rigid.joints.size(); ++k) {
    const RigidJoint& joint = rigid.joints[k];
    const Law& law = laws.rows[joint.law];
    const bool peak = which == StrengthOf::peak && joint.has_peak;
    const double by = divided_by[joint.law], length = joint.length() * laws.thickness;
    RigidStrength s;
    s.friction = (peak ? law.peak_friction : law.residual_friction) / by;
    if (law.type == LawType::barton_bandis) {
      const double normal = last.empty() ? rigid.force : last[k].whole();
      s.friction = barton_friction(law, rigid, joint, normal, laws.thickness) / by;
    }
    s.shear = (peak ? law.peak_cohesion : law.residual_cohesion) / by * length;
    s.tension = 0.5 * (peak ? law.peak_tension : law.residual_tension) / by * length;
    if (s.friction > 0.0) s.tension = std::min(s.tension, 0.5 * s.shear / s.friction);
    if (crushing && !joint.is_corner()) s.compression = joint.compression * joint.length();
    all.push_back(s);
  }
  return all;
}

bool depends_on_stress(const RigidBlocks& rigid, const LawTable& laws) {
  return std::any_of(rigid.joints.begin(), rigid.joints.end(), [&](const RigidJoint& joint) {
    return laws.rows[joint.law].type == LawType::barton_bandis;
  });
}

}  // namespace edda
