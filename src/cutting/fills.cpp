#include "cutting/fills.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/rings.hpp"
#include "cutting/cut_domain.hpp"
#include "cutting/overlaps.hpp"
#include "model/stage_names.hpp"

namespace edda {
namespace {

const Ring& outline_of(const Model& model, const Fill& fill) {
  if (fill.opening.empty()) return fill.polygon;
  return std::find_if(model.openings.begin(), model.openings.end(),
                      [&](const Opening& o) { return o.name == fill.opening; })
      ->polygon;
}

/// What the model has that fill cannot be with. Still water acts on faces and in pores as it did
/// before there was fill: it may be in rock, but not in fill.
std::optional<Fault> at_odds(const Model& model, const Fill& fill) {
  if (model.plane == Plane::stress) {
    return Fault{fill.where, "consists of zones, which are in plane strain",
                 "leave out plane = \"stress\""};
  }
  for (const Water& water : model.waters) {
    const bool flooded =
        std::find(water.flooded.begin(), water.flooded.end(), fill.opening) != water.flooded.end();
    if (!fill.opening.empty() && !flooded) continue;
    return Fault{fill.where, "would lie in " + water.where.key + ", and no water acts on fill",
                 "give it an opening that is not flooded, or loads in place of the water"};
  }
  return {};
}

/// A model of the fill alone, which joints at right angles to gravity cut into lifts.
Model lifts_of(const Model& model, const Fill& fill) {
  const Vec2 up = model.gravity == Vec2{} ? Vec2{0.0, 1.0} : -unit(model.gravity);
  Model alone;
  Domain& domain = alone.domain.emplace();
  domain.outline = outline_of(model, fill);
  domain.material = fill.material;
  domain.where = fill.where;
  JointSet& set = alone.joint_sets.emplace_back();
  set.angle = std::atan2(-up.x, up.y) * 180.0 / std::numbers::pi;
  set.spacing = *fill.lift;
  set.origin = *std::min_element(domain.outline.begin(), domain.outline.end(),
                                 [&](Vec2 a, Vec2 b) { return dot(a, up) < dot(b, up); });
  set.where = fill.where;
  return alone;
}

Result<std::vector<BlockPolygon>> parts_of(const Model& model, const Fill& fill, Vec2 origin) {
  if (!fill.lift) {
    BlockPolygon block;
    block.rings = {local_ring(outline_of(model, fill), origin)};
    return std::vector<BlockPolygon>{std::move(block)};
  }
  Result<DomainCut> cut = cut_domain(lifts_of(model, fill), origin, {}, false);
  if (!cut.ok()) {
    Faults faults = cut.faults();
    for (Fault& fault : faults) fault.where = fill.where;
    return faults;
  }
  return std::move(cut.value().blocks);
}

/// Whether what block `other` is has left, or has not come, when fill is placed in a stage.
bool makes_room(const Model& model, const BlockPolygon& other, std::size_t stage) {
  const auto by_then = [&](const std::string& name) {
    const auto out = excavated_in(model, name);
    return out && *out <= stage;
  };
  if (other.fill != none) {
    const std::string& name = model.fills[static_cast<std::size_t>(other.fill)].name;
    return *placed_in(model, name) > stage || by_then(name);
  }
  return other.opening != none &&
         by_then(model.openings[static_cast<std::size_t>(other.opening)].name);
}

std::string label_of(const Model& model, const BlockPolygon& block) {
  if (block.fill != none || block.lining != none)
    return fmt::format("\"{}\"", block.name.empty() ? block.where.key : block.name);
  if (block.opening == none) return "a block that is there";
  return fmt::format("\"{}\", which has not been excavated by then",
                     model.openings[static_cast<std::size_t>(block.opening)].name);
}

bool boxes_meet(const BlockPolygon& a, const BlockPolygon& b, double within) {
  for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
    const auto [low, high] = extent_along(a.rings[0], axis);
    const auto [least, most] = extent_along(b.rings[0], axis);
    if (least > high + within || most < low - within) return false;
  }
  return true;
}

/// Whether a corner of one lies on an edge of the other.
bool touch(const BlockPolygon& a, const BlockPolygon& b, double within) {
  const auto corner_of = [&](const BlockPolygon& one, const BlockPolygon& on) {
    return std::any_of(one.rings[0].begin(), one.rings[0].end(),
                       [&](Vec2 p) { return side_of(on.rings, p, within) == 0; });
  };
  return corner_of(a, b) || corner_of(b, a);
}

}  // namespace

Faults add_fills(const Model& model, PolygonSet& polygons) {
  Faults faults;
  for (std::size_t q = 0; q < model.fills.size(); ++q) {
    const Fill& fill = model.fills[q];
    if (auto fault = at_odds(model, fill)) {
      faults.push_back(*fault);
      continue;
    }
    Result<std::vector<BlockPolygon>> parts = parts_of(model, fill, polygons.origin);
    if (!parts.ok()) {
      faults.insert(faults.end(), parts.faults().begin(), parts.faults().end());
      continue;
    }
    const std::size_t count = parts.value().size();
    for (std::size_t k = 0; k < count; ++k) {
      BlockPolygon& block = parts.value()[k];
      block.joint.clear();
      block.table.clear();
      for (const Ring& ring : block.rings) block.joint.emplace_back(ring.size(), fill.joint);
      block.material = fill.material;
      block.name = count == 1 ? fill.name : fmt::format("{}.{}", fill.name, k);
      block.where = fill.where;
      block.fill = static_cast<Index>(q);
      block.opening = excavated_in(model, fill.name) ? Owners(model).of_fill(block.fill) : none;
      polygons.blocks.push_back(std::move(block));
    }
  }
  return faults;
}

Faults misplaced_fills(const Model& model, const PolygonSet& polygons) {
  Faults faults;
  Index faulty = none;
  for (const BlockPolygon& part : polygons.blocks) {
    if (part.fill == none || part.fill == faulty) continue;
    const std::size_t stage =
        *placed_in(model, model.fills[static_cast<std::size_t>(part.fill)].name);
    constexpr double rounding = 1e-3;  // of half the width
    const double within = rounding * 0.5 * least_width(part.rings[0]);
    bool touches = false;
    for (const BlockPolygon& other : polygons.blocks) {
      if (&other == &part || !boxes_meet(part, other, within)) continue;
      touches = touches || touch(part, other, within);
      if (other.fill == part.fill || makes_room(model, other, stage)) continue;
      if (overlap_depth(part, other) <= allowed_overlap(part, other)) continue;
      faults.push_back({part.where, "overlaps " + label_of(model, other),
                        "place it later, or draw it where there is room"});
      faulty = part.fill;
      break;
    }
    if (touches || faulty == part.fill) continue;
    faults.push_back(
        {part.where, "touches no block", "move it to a wall (edda cut draws the blocks)"});
    faulty = part.fill;
  }
  return faults;
}

}  // namespace edda
