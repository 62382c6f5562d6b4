#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/completion/complete.hpp"

namespace edda {
namespace {

struct Box {
  Vec2 low, high;

  double width() const { return std::max(0.0, high.x - low.x); }
  double height() const { return std::max(0.0, high.y - low.y); }
};

Box box_of(const Ring& ring) {
  Box box{ring[0], ring[0]};
  for (const Vec2 p : ring) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

double shared_area(const Box& a, const Box& b) {
  const Box both{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
                 {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
  return both.width() * both.height();
}

/// The data of a joint set needed to count blocks.
struct Lines {
  double angle = 0.0;    ///< radians
  double spacing = 0.0;  ///< m
  double count = 0.0;    ///< joints through the ring
  double part = 1.0;     ///< persistence: fraction of their length that is joint
  double area = 0.0;     ///< m2, that they run through
  Box box;
};

/// The joints of `set` inside `ring`, which must not be empty.
Lines lines_of(const JointSet& set, const Ring& ring) {
  Lines lines{set.angle * std::numbers::pi / 180.0, set.spacing, 0.0, 1.0,
              std::abs(signed_area(ring)),          box_of(ring)};
  const Vec2 across{-std::sin(lines.angle), std::cos(lines.angle)};
  double low = dot(ring[0] - set.origin, across), high = low;
  for (const Vec2 p : ring) {
    low = std::min(low, dot(p - set.origin, across));
    high = std::max(high, dot(p - set.origin, across));
  }
  lines.part = set.trace_length ? *set.trace_length / (*set.trace_length + set.gap) : 1.0;
  lines.count = (high - low) / set.spacing;
  return lines;
}

/// Number of crossings of two sets: the area that both run through, times the crossings per area.
double crossings(const Lines& a, const Lines& b) {
  const double sine = std::abs(std::sin(a.angle - b.angle));
  const double area = std::min({a.area, b.area, shared_area(a.box, b.box)});
  constexpr double parallel = 1e-9;
  return sine < parallel || area <= 0.0 ? 0.0
                                        : area * sine / a.spacing / b.spacing * a.part * b.part;
}

std::string counted(double n) {
  constexpr double written_out = 1e7;
  return n < written_out ? fmt::format("{:.0f}", n) : fmt::format("{:.2e}", n);
}

double polygons_of(const Domain& domain, const Voronoi& voronoi) {
  const Ring& ring = voronoi.region.empty() ? domain.outline : voronoi.region;
  return std::abs(signed_area(ring)) / voronoi.size / voronoi.size;
}

void check_block_estimate(const Value& root, Reading& reading) {
  const Domain& domain = *reading.model.domain;
  const auto& sets = reading.model.joint_sets;
  const double blocks = estimated_blocks(reading.model);
  if (blocks <= static_cast<double>(domain.max_blocks)) return;
  const std::optional<Voronoi>& voronoi = reading.model.voronoi;
  if (sets.empty() || (voronoi && polygons_of(domain, *voronoi) > 0.5 * blocks)) {
    add_fault(reading, find(find(&root, "voronoi"), "size")->place, "voronoi.size",
              fmt::format("about {} blocks would be cut, more than domain.max_blocks = {}",
                          counted(blocks), domain.max_blocks),
              "give a larger size, or raise domain.max_blocks");
    return;
  }
  std::size_t densest = 0;
  const auto density = [&](std::size_t i) {
    const Ring& ring = sets[i].region.empty() ? domain.outline : sets[i].region;
    return lines_of(sets[i], ring).count;
  };
  for (std::size_t i = 1; i < sets.size(); ++i) {
    if (density(i) > density(densest)) densest = i;
  }
  const Value* spacing = find(child(find(&root, "joint_set"), densest), "spacing");
  add_fault(reading, spacing->place, sets[densest].where.key + ".spacing",
            fmt::format("about {} blocks would be cut, more than domain.max_blocks = {}",
                        counted(blocks), domain.max_blocks),
            "give a larger spacing, or raise domain.max_blocks");
}

void check_walls(const Value& root, Reading& reading) {
  constexpr double most_bricks = 5e6;
  double bricks = 0.0;
  for (std::size_t i = 0; i < reading.model.walls.size(); ++i) {
    const BrickWall& wall = reading.model.walls[i];
    bricks += static_cast<double>(wall.columns) * wall.rows;
    if (bricks <= most_bricks) continue;
    const Value* node = child(find(&root, "brick_wall"), i);
    add_fault(reading, find(node, "columns")->place, wall.where.key + ".columns",
              fmt::format("the walls have {} bricks, more than {}", counted(bricks),
                          counted(most_bricks)),
              "give fewer columns or rows");
    return;
  }
}

void complete_snap(const Value& root, Reading& reading) {
  Domain& domain = *reading.model.domain;
  const Box box = box_of(domain.outline);
  const double side = std::max(box.width(), box.height());
  constexpr double parts_of_default = 1e9, largest_part = 1e-2;
  const Value* snap = find(find(&root, "domain"), "snap");
  if (snap == nullptr) {
    domain.snap = std::max(side / parts_of_default, smallest_positive);
  } else if (domain.snap > largest_part * side) {
    add_fault(reading, snap->place, "domain.snap",
              fmt::format("{} is too coarse for an outline of {:.3g} m", shown(*snap), side),
              fmt::format("give at most {:.3g}", largest_part * side));
  }
}

/// The smallest joint spacing of the model, m; infinite where it gives none.
double smallest_spacing(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const JointSet& set : model.joint_sets) {
    if (set.spacing > 0.0) least = std::min(least, set.spacing);
  }
  if (model.voronoi && model.voronoi->size > 0.0) least = std::min(least, model.voronoi->size);
  // Fracture network: area over length, the spacing of parallel joints of that density.
  for (const FractureNetwork& network : model.networks) {
    if (network.p21 && *network.p21 > 0.0) least = std::min(least, 1.0 / *network.p21);
    if (!network.count || !network.length.mean || !model.domain) continue;
    const Ring& ring = network.region.empty() ? model.domain->outline : network.region;
    const double length = static_cast<double>(*network.count) * *network.length.mean;
    if (!ring.empty() && length > 0.0) {
      least = std::min(least, std::abs(signed_area(ring)) / length);
    }
  }
  return least;
}

/// Polygons keep their shapes up to half of their size (theory, section 15.1).
void complete_voronoi(const Value& root, Reading& reading) {
  std::optional<Voronoi>& voronoi = reading.model.voronoi;
  if (!voronoi || !(voronoi->size > 0.0)) return;
  constexpr double part_of_size = 0.2, largest_part = 0.5;
  const Value* min_edge = find(find(&root, "voronoi"), "min_edge");
  if (min_edge == nullptr) {
    voronoi->min_edge = part_of_size * voronoi->size;
  } else if (voronoi->min_edge > largest_part * voronoi->size) {
    add_fault(
        reading, min_edge->place, "voronoi.min_edge",
        fmt::format("{} is too long for polygons of {:.3g} m", shown(*min_edge), voronoi->size),
        fmt::format("give at most {:.3g}", largest_part * voronoi->size));
  }
}

/// Two hundredths of the spacing, since a strip so thin is an accident of the positions of joints,
/// far below the spacing of a set; and the area of a square with sides twice as long.
void complete_quality(const Value& root, Reading& reading) {
  Quality& quality = reading.model.quality;
  const Value* node = find(&root, "quality");
  constexpr double part_of_spacing = 0.02;
  const double spacing = smallest_spacing(reading.model);
  if (find(node, "min_edge") == nullptr && std::isfinite(spacing)) {
    quality.min_edge = std::min(part_of_spacing * spacing, largest_length);
  }
  if (find(node, "min_area") == nullptr) {
    quality.min_area = 4.0 * quality.min_edge * quality.min_edge;
  }
}

}  // namespace

double estimated_blocks(const Model& model) {
  const double blocks = estimated_blocks(*model.domain, model.joint_sets);
  return model.voronoi ? blocks + polygons_of(*model.domain, *model.voronoi) : blocks;
}

double estimated_blocks(const Domain& domain, const std::vector<JointSet>& sets) {
  std::vector<Lines> all;
  for (const JointSet& set : sets) {
    const Ring& ring = set.region.empty() ? domain.outline : set.region;
    all.push_back(lines_of(set, ring));
    const Box outline = box_of(domain.outline);
    all.back().area = std::min(all.back().area, shared_area(outline, all.back().box));
  }
  double blocks = 1.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    blocks += all[i].count * all[i].part;
    for (std::size_t j = 0; j < i; ++j) blocks += crossings(all[i], all[j]);
  }
  return blocks;
}

void complete_geometry(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  check_walls(root, reading);
  complete_quality(root, reading);
  complete_voronoi(root, reading);
  if (!model.domain || model.domain->outline.empty()) return;
  complete_snap(root, reading);
  const bool sized = !model.voronoi || model.voronoi->size > 0.0;
  const bool all_sets_read =
      sized && std::all_of(model.joint_sets.begin(), model.joint_sets.end(),
                           [](const JointSet& set) { return set.spacing > 0.0; });
  if (all_sets_read) check_block_estimate(root, reading);
}

}  // namespace edda
