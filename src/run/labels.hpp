// What things are called in messages.
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

}  // namespace edda
