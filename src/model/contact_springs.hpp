// The penalty springs of contacts whose joint gives no kn (theory, section 4.2).
#pragma once

#include <algorithm>

#include "model/model.hpp"

namespace edda {

struct ContactSprings {
  double normal,
      shear;  ///< at each end of a face, Pa (N/m per metre of thickness); of a face
              ///< between squares of the stiffest rock, where they follow from the blocks
  double normal_over_young, shear_over_young;  ///< those over its Young's modulus, where they do;
                                               ///< 0: they are given
};
inline ContactSprings contact_springs(const Model& model) {
  const ContactDefaults& contact = model.contact;
  const double over_young = 10.0 * contact.stiffer;
  double young = 0.0;
  for (const Material& material : model.materials) young = std::max(young, material.young);
  ContactSprings s{over_young * young, over_young * young, over_young, over_young};
  if (contact.normal_stiffness) {
    s.normal = s.shear = *contact.normal_stiffness;
    s.normal_over_young = s.shear_over_young = 0.0;
  }
  if (contact.shear_stiffness) {
    s.shear = *contact.shear_stiffness;
    s.shear_over_young = 0.0;
  }
  return s;
}

}  // namespace edda
