// Joints that a stage holds together.
#pragma once

#include "contacts/contact_set.hpp"

namespace edda {

/// Every contact that is closed, or closes, neither opens nor slides from now on. Its springs stay
/// as they are.
void glue(ContactSet& contacts);

/// All of them go back to their own laws: what is pulled apart, and neither was bonded nor may
/// pull, opens, its energy booked as fracture; shear beyond the strength slips at the next step.
void unglue(ContactSet& contacts);

}  // namespace edda
