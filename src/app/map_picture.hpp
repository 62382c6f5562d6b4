// Picture of how often each place belongs to a key block, of a study with [map].
#pragma once

#include <string>

#include "results/files.hpp"
#include "sampling/place_map.hpp"

namespace edda {

/// key_block_map.png and .svg in the folder: a square for each place where any sample has rock.
Trouble draw_map(const std::string& title, const StudyMap& where, const KeyBlockMap& map,
                 const std::string& folder);

}  // namespace edda
