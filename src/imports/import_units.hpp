// Wrong units in [[import]], recognised by the unit given in the drawing and by its size.
#pragma once

#include <optional>
#include <string>

#include "imports/imports.hpp"

namespace edda {

/// m
double metres(LengthUnit unit);

/// A warning about the units of the i-th import, with the remedy, where its drawing gives another
/// unit than it is read in, or where it is far larger than the domain. Nothing otherwise, or where
/// there is no domain to compare with and the drawing gives no unit.
std::optional<std::string> unit_doubt(const Model& model, const Imports& imports, std::size_t i);

}  // namespace edda
