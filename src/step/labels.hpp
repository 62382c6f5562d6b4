// Names of things in messages.
#pragma once

#include <cstddef>
#include <string>

#include "base/vec2.hpp"
#include "blocks/block_set.hpp"

namespace edda {

/// "block 12", with its name where it has one: "block 12 (slider)".
std::string block_label(const BlockSet& blocks, std::size_t i);

/// "(1.25, -3)", model coordinates.
std::string place_label(Vec2 place);

/// "load 2", a row of a list of the model counted from 0, or its name where it has one.
std::string row_label(const char* what, const std::string& name, std::size_t row);

}  // namespace edda
