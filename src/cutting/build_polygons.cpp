#include "cutting/build_polygons.hpp"

#include <cstddef>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/place.hpp"
#include "base/text.hpp"
#include "cutting/close_gaps.hpp"
#include "cutting/cut_domain.hpp"
#include "cutting/fixed.hpp"
#include "cutting/given_blocks.hpp"
#include "cutting/overlaps.hpp"
#include "cutting/quality.hpp"
#include "imports/imports.hpp"

namespace edda {
namespace {

void append(std::vector<BlockPolygon>& to, std::vector<BlockPolygon> from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// A ring needs three corners to have an interior; all later steps rely on it.
Faults too_few_corners(const Model& model) {
  Faults faults;
  for (const BlockInput& block : model.blocks) {
    if (block.polygon.size() >= 3) continue;
    faults.push_back({member_of(block.where, "polygon"), "has fewer than three corners",
                      "list the corners of the block in order"});
  }
  return faults;
}

/// The work on a block grows with the square of its corners, and one strain, which blocks of many
/// corners have, is too coarse for so many.
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

/// The largest number of blocks for which memory would suffice.
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

std::string place_text(Vec2 p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", p.x, p.y);
  return text;
}

/// [quality] action = "error": the worst case found, as one fault.
Faults poor_blocks(const Model& model, const CutReport& r) {
  if (model.quality.action != QualityAction::error) return {};
  const Quality& q = model.quality;
  const auto fault = [&](const char* key, std::string problem) {
    Where where = q.where;
    if (where.file.empty()) where = {"quality", model.file, 0, 0};
    return Faults{{member_of(where, key), std::move(problem),
                   "change what cuts there, give a smaller limit, or action = \"merge\""}};
  };
  if (r.slivers > 0) {
    return fault("min_area", counted(static_cast<std::size_t>(r.slivers), "block") +
                                 (r.slivers == 1 ? " is" : " are") +
                                 " smaller than it, or thinner than min_edge; the smallest lies "
                                 "at " +
                                 place_text(r.smallest_area_at));
  }
  if (r.short_edges > 0) {
    return fault("min_edge", counted(static_cast<std::size_t>(r.short_edges), "edge") +
                                 (r.short_edges == 1 ? " is" : " are") +
                                 " shorter; the shortest lies at " +
                                 place_text(r.smallest_edge_at));
  }
  if (r.sharp_corners > 0) {
    return fault("min_angle", counted(static_cast<std::size_t>(r.sharp_corners), "corner") +
                                  (r.sharp_corners == 1 ? " is" : " are") +
                                  " sharper; the sharpest lies at " +
                                  place_text(r.smallest_angle_at));
  }
  return {};
}

/// The blocks of the domain, or of the lines of imports where there is none.
Result<PolygonSet> add_cut_blocks(const Model& model, const Imports& imports, bool framed,
                                  PolygonSet set) {
  const std::size_t first_cut = set.blocks.size();
  Result<DomainCut> cut = cut_domain(model, set.origin, imports, framed);
  if (!cut.ok()) return cut.faults();
  append(set.blocks, std::move(cut.value().blocks));
  set.removed = std::move(cut.value().removed);
  set.tables = std::move(cut.value().tables);
  set.report = cut.value().report;
  Faults faults = too_many_corners(set.blocks, first_cut);
  if (faults.empty()) faults = fix_blocks(model, snap_of(model), first_cut, set);
  if (faults.empty()) faults = fix_along(model, imports, snap_of(model), first_cut, set);
  if (!faults.empty()) return faults;
  return set;
}

Result<PolygonSet> all_blocks(const Model& model, const Imports& imports, bool framed) {
  if (Faults faults = too_few_corners(model); !faults.empty()) return faults;
  if (Faults faults = too_many_bricks(model); !faults.empty()) return faults;
  PolygonSet set;
  set.origin = model_centre(model, imports);
  set.blocks = given_blocks(model, set.origin);
  const std::size_t given = set.blocks.size();
  Faults faults = too_many_corners(set.blocks, given);
  if (!faults.empty()) return faults;
  append(set.blocks, wall_bricks(model, set.origin));
  append(set.blocks, voussoirs(model, set.origin));
  const std::size_t first_imported = set.blocks.size();
  append(set.blocks, imported_blocks(model, imports, set.origin));
  const std::size_t first_cut = set.blocks.size();
  const std::string closed = close_gaps(set.blocks, model.contact.close_gaps);
  if (model.domain) {
    Result<PolygonSet> cut = add_cut_blocks(model, imports, framed, std::move(set));
    if (!cut.ok()) return cut.faults();
    set = std::move(cut.value());
  } else {
    set.report.notes = imports.notes;
    set.report.left_out = imports.left_out;
    faults = fix_blocks(model, 0.0, first_imported, set);
    if (!faults.empty()) return faults;
  }
  if (!closed.empty()) set.report.notes.push_back(closed);
  set.report.rounding = overlap_by_rounding(model, imports);
  faults = find_overlaps(set.blocks, first_cut, set.report.rounding);
  if (!faults.empty()) return faults;
  measure_quality(set.blocks, set.origin, set.report);
  judge_blocks(std::span(set.blocks).subspan(first_cut), model.quality, set.origin, set.report);
  faults = poor_blocks(model, set.report);
  if (!faults.empty()) return faults;
  return set;
}

Result<PolygonSet> cut_or_given(const Model& model) {
  if (model.imports.empty()) return all_blocks(model, {}, false);
  const Result<Imports> imports = read_imports(model);
  if (!imports.ok()) return imports.faults();
  if (model.domain || imports.value().lines.empty())
    return all_blocks(model, imports.value(), false);
  Result<Domain> frame = frame_of(model, imports.value());
  if (!frame.ok()) return frame.faults();
  Model framed = model;
  framed.domain = std::move(frame.value());
  return all_blocks(framed, imports.value(), true);
}

}  // namespace

Result<PolygonSet> build_polygons(const Model& model) {
  Result<PolygonSet> made = cut_or_given(model);
  if (!made.ok()) return at_their_keys(model.key_places, made.faults());
  return made;
}

}  // namespace edda
