// The blocks of a drawing, and their insertions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "imports/dxf_entities.hpp"

namespace edda {

struct DxfBlock {
  Vec2 base;
  bool elsewhere = false;  ///< an external reference: another drawing
  DxfContent content;
  std::size_t parts = 0;       ///< points of its lines and entities left out
  std::optional<Fault> fault;  ///< fault within it; reported where it is inserted
};

/// By name, in capitals, since names of blocks are case-insensitive.
using DxfBlocks = std::map<std::string, DxfBlock>;

/// Reads a section of blocks.
void read_blocks(DxfSection& section, DxfBlocks& blocks);

/// Adds the lines of inserted blocks, and counts what is left out of them. Faults: a block that
/// contains itself, blocks nested too deeply, or so many insertions that a small file would fill
/// the memory.
void place_blocks(const DxfBlocks& blocks, const std::vector<DxfInsert>& inserts, Drawing& drawing,
                  DxfFault& fault);

}  // namespace edda
