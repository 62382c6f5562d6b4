// Slips of units in [[import]], told from what its drawing says and from its size.
#pragma once

#include <optional>
#include <string>

#include "lines/imports.hpp"

namespace edda {

/// m
double metres(LengthUnit unit);

/// What is doubtful about the units of the i-th import, with what to write: its drawing says
/// another unit than it is read in, or it spans far more than the domain. Nothing otherwise, or
/// where there is no domain to compare with and the drawing says nothing.
std::optional<std::string> unit_doubt(const Model& model, const Imports& imports, std::size_t i);

}  // namespace edda
