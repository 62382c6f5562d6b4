// Values that are allowed and yet look like slips of units or of signs.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace edda {

/// A warning per quantity that looks wrong, at the first place where it does, with its key and what
/// to write.
std::vector<std::string> implausible(const Model& model);

}  // namespace edda
