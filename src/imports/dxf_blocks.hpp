// The blocks of a drawing, and their insertions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "imports/dxf_entities.hpp"
#include "imports/dxf_tables.hpp"

namespace edda {

struct DxfBlock {
  Vec2 base;
  bool elsewhere = false;  ///< an external reference: another drawing
  DxfContent content;
  std::size_t parts = 0;       ///< points of its lines and entities left out
  std::optional<Fault> fault;  ///< fault in its head; reported where it is inserted
};

/// By name, in capitals, since names of blocks are case-insensitive.
using DxfBlocks = std::map<std::string, DxfBlock>;

/// Reads a section of blocks. `digits`: counts those of their coordinates.
void read_blocks(DxfSection& section, Digits& digits, DxfBlocks& blocks);

/// Fills the drawing with the lines of `content` and of the blocks that it inserts, and counts what
/// is left out: hidden layers, clipped blocks, blocks that contain themselves or are nested too
/// deeply. Fault: so many insertions that a small file would fill the memory.
void place_content(DxfContent content, const DxfBlocks& blocks, const DxfTables& tables,
                   Drawing& drawing, DxfFault& fault);

}  // namespace edda
