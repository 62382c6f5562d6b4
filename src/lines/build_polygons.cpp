#include "lines/build_polygons.hpp"

#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "lines/cut_domain.hpp"
#include "lines/given_blocks.hpp"
#include "lines/held.hpp"
#include "lines/overlaps.hpp"
#include "lines/place.hpp"
#include "lines/quality.hpp"

namespace edda {
namespace {

void append(std::vector<BlockPolygon>& to, std::vector<BlockPolygon> from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// A ring needs three corners to have an inside; all later stages rely on it.
Faults too_few_corners(const Model& model) {
  Faults faults;
  for (const BlockInput& block : model.blocks) {
    if (block.polygon.size() >= 3) continue;
    faults.push_back({member_of(block.where, "polygon"), "has fewer than three corners",
                      "list the corners of the block in order"});
  }
  return faults;
}

/// Work on a block grows with the square of its corners, and one strain for so many says nothing.
constexpr std::size_t most_corners = 10000;

Faults too_many_corners(const std::vector<BlockPolygon>& blocks, std::size_t first_cut) {
  Faults faults;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::size_t corners = 0;
    for (const Ring& ring : blocks[i].rings) corners += ring.size();
    if (corners <= most_corners) continue;
    const bool cut = i >= first_cut;
    faults.push_back(
        {member_of(blocks[i].where, cut ? "outline" : "polygon"),
         (cut ? "a block cut from it has " : "has ") + std::to_string(corners) +
             " corners, more than " + std::to_string(most_corners),
         cut ? "give outline, traces and openings fewer points, or cut into more blocks"
             : "give fewer corners, or several blocks"});
    if (cut) break;
  }
  return faults;
}

/// Beyond this no machine that runs the model could hold them.
constexpr double most_bricks = 1e7;

Faults too_many_bricks(const Model& model) {
  Faults faults;
  double bricks = 0.0;
  for (const BrickWall& wall : model.walls) {
    bricks += (wall.columns + 0.5) * static_cast<double>(wall.rows);
    if (bricks <= most_bricks) continue;
    faults.push_back({member_of(wall.where, "columns"), "the walls have more than 1e7 bricks",
                      "give fewer columns or rows"});
    break;
  }
  return faults;
}

}  // namespace

Result<PolygonSet> build_polygons(const Model& model) {
  if (Faults faults = too_few_corners(model); !faults.empty()) return faults;
  if (Faults faults = too_many_bricks(model); !faults.empty()) return faults;
  PolygonSet set;
  set.origin = model_centre(model);
  set.blocks = given_blocks(model, set.origin);
  const std::size_t given = set.blocks.size();
  Faults faults = too_many_corners(set.blocks, given);
  if (!faults.empty()) return faults;
  append(set.blocks, wall_bricks(model, set.origin));
  const std::size_t first_cut = set.blocks.size();
  if (model.domain) {
    Result<DomainCut> cut = cut_domain(model, set.origin);
    if (!cut.ok()) return cut.faults();
    append(set.blocks, std::move(cut.value().blocks));
    set.removed = std::move(cut.value().removed);
    set.report = cut.value().report;
    faults = too_many_corners(set.blocks, first_cut);
    if (!faults.empty()) return faults;
  }
  faults = hold_blocks(model, model.domain ? snap_of(model) : 0.0, first_cut, set);
  if (!faults.empty()) return faults;
  faults = find_overlaps(set.blocks, first_cut);
  if (!faults.empty()) return faults;
  measure_quality(set.blocks, set.origin, set.report);
  return set;
}

}  // namespace edda
