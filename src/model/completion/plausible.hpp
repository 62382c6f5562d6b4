// Values that are allowed but look like mistakes of units or signs.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace edda {

/// A warning per quantity that looks wrong, at the first place where it does, with its key and the
/// value to write.
std::vector<std::string> implausible(const Model& model);

}  // namespace edda
