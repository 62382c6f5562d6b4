#include "attachments/loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "attachments/boundary_lines.hpp"
#include "attachments/edges_on_line.hpp"
#include "base/polygon.hpp"
#include "blocks/locate.hpp"
#include "model/stage_names.hpp"

namespace edda {
namespace {

void attach_line(const Load& load, Index row, const BlockSet& b, double snap, Loads& loads,
                 Faults& faults) {
  std::vector<Line> lines;
  for (std::size_t k = 0; k + 1 < load.along.size(); ++k) {
    lines.push_back({load.along[k] - b.origin, load.along[k + 1] - b.origin});
  }
  bool in_joints = false;
  const std::vector<Piece> pieces =
      pieces_on(b, lines, load.force ? WhichFaces::open : WhichFaces::all, snap, in_joints);
  const double t = b.thickness;
  for (const Piece& p : pieces) {
    loads.edges.push_back({p.edge, p.part.from, p.part.to, load.force ? t * *load.force : Vec2{},
                           load.pressure ? t * *load.pressure : 0.0, row});
  }
  if (!pieces.empty()) return;
  Fault fault{load.where, "no face of a free block lies on this line",
              "give a line that faces of blocks lie on (edda cut draws them)"};
  if (in_joints) {
    fault.problem = "lies along a joint, where a traction would act on both faces";
    fault.remedy = "give pressure in place of force, or a line along a free face";
  }
  fault.where.key += ".along";
  faults.push_back(fault);
}

/// A boundary of type stress: a traction on the faces along it. Without a traction of its own it
/// gets that of the initial stress (load_initial_stress()).
void attach_stress(const Model& model, std::size_t row, const BlockSet& b, double snap,
                   Loads& loads, Faults& faults) {
  const Boundary& boundary = model.boundaries[row];
  bool in_joints = false;
  const std::vector<Piece> pieces =
      pieces_on(b, boundary_lines(model, b, boundary), WhichFaces::open, snap, in_joints);
  for (const Piece& p : pieces) {
    if (!boundary.traction) break;
    loads.edges.push_back({p.edge, p.part.from, p.part.to, b.thickness * *boundary.traction, 0.0,
                           static_cast<Index>(model.loads.size() + row)});
  }
  if (!pieces.empty()) return;
  faults.push_back({boundary.where, "no open face of a free block lies on this boundary",
                    "give a line that faces of blocks lie on, or sides of the outline"});
}

/// A body force: one at the centroid of each free block in the polygon. It is the same all over the
/// block, and leaves the modes alone.
void attach_region(const Load& load, Index row, const BlockSet& b, Loads& loads, Faults& faults) {
  const std::size_t before = loads.points.size();
  Ring ring;
  for (const Vec2 p : load.within) ring.push_back(p - b.origin);
  if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  for (Id i = 0; i < b.size(); ++i) {
    if (b.fixed[i] || side_of({&ring, 1}, centroid(b.node_x, b.node_y, i), 0.0) < 0) continue;
    loads.points.push_back(
        {{i, centroid_weights}, b.area[i] * b.thickness * *load.body_force, row});
  }
  if (loads.points.size() > before) return;
  Fault fault{load.where, "no free block has its centroid in this polygon",
              "give a polygon that contains blocks (edda cut draws them)"};
  fault.where.key += ".within";
  faults.push_back(fault);
}

void attach_point(const Model& model, const PolygonSet& polygons, const Load& load, Index row,
                  const BlockSet& b, Loads& loads, Faults& faults) {
  const Vec2 p = *load.point - b.origin;
  if (const auto block = block_at(model, polygons, b, p, Among::free_blocks)) {
    // A block that bends has no modes for what acts within it (theory, section 3.4).
    const BlockPoint at = b.is_meshed(*block) ? block_point(b, *block, p)
                                              : BlockPoint{*block, weights_at(b, *block, p)};
    loads.points.push_back({at, *load.force, row});
    return;
  }
  Fault fault{load.where, "lies in no block", "move it into one (edda cut draws them)"};
  if (block_at(model, polygons, b, p)) {
    fault.problem = "lies in a block that is fixed";
    fault.remedy = "move it to a free block, or leave the load out";
  }
  fault.where.key += ".point";
  faults.push_back(fault);
}

/// Level of a table, from left to right, at x.
double level_at(const std::vector<Vec2>& table, double x) {
  if (x <= table.front().x) return table.front().y;
  std::size_t k = 1;
  while (k + 1 < table.size() && table[k].x < x) ++k;
  const Vec2 a = table[k - 1], b = table[k];
  return a.y + std::min((x - a.x) / (b.x - a.x), 1.0) * (b.y - a.y);
}

/// The water table from left to right, local coordinates.
struct Table {
  std::vector<Vec2> points;

  double low() const { return points.front().x; }
  double high() const { return points.back().x; }
  double at(double x) const { return level_at(points, x); }
};

/// The parts of edge v that each lie under one straight piece of the table, without those that are
/// dry.
void wet_edge(const BlockSet& b, Id v, const Table& table, const std::vector<Part>& dry,
              double snap, Index row, std::vector<WetEdge>& wet) {
  const Vec2 a = b.vertex(v), u = b.vertex(b.next[v]) - a;
  const auto add = [&](Part piece) {
    for (const Part p : without(piece, dry)) {
      if ((p.to - p.from) * norm(u) <= snap) continue;
      wet.push_back(
          {v, p.from, p.to, table.at(a.x + p.from * u.x), table.at(a.x + p.to * u.x), row});
    }
  };
  if (std::abs(u.x) <= snap) {  // vertical
    const double x = a.x + 0.5 * u.x;
    if (x >= table.low() - snap && x <= table.high() + snap) add({0.0, 1.0});
    return;
  }
  std::vector<double> ends;
  for (const Vec2 p : table.points) ends.push_back(std::clamp((p.x - a.x) / u.x, 0.0, 1.0));
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) add({ends[k - 1], ends[k]});
}

bool is_flooded(const Water& water, const std::string& opening) {
  return std::find(water.flooded.begin(), water.flooded.end(), opening) != water.flooded.end();
}

/// Outlines of the openings that are not flooded, local coordinates.
std::vector<std::array<Vec2, 2>> dry_outlines(const Model& model, const Water& water, Vec2 origin) {
  std::vector<std::array<Vec2, 2>> lines;
  for (const Opening& opening : model.openings) {
    if (is_flooded(water, opening.name)) continue;
    for (std::size_t k = 0; k < opening.polygon.size(); ++k) {
      const Vec2 end = opening.polygon[(k + 1) % opening.polygon.size()];
      lines.push_back({opening.polygon[k] - origin, end - origin});
    }
  }
  return lines;
}

/// Whether a lining lies in an opening that is not flooded, on its wall or on another lining there.
bool is_drained(const Model& model, const Water& water, Index row) {
  const Lining* lining = &model.linings[static_cast<std::size_t>(row)];
  for (auto below = model.linings.rbegin(); below != model.linings.rend(); ++below) {
    if (!lining->on.empty() && below->name == lining->on) lining = &*below;
  }
  return !lining->opening.empty() && !is_flooded(water, lining->opening);
}

/// The zones between the ends of the table, whose rock has pores.
void wet_pores(const Model& model, const BlockSet& b, const Table& table, double snap, Index row,
               std::vector<WetZone>& wet) {
  const Meshes& m = b.meshes;
  for (std::size_t i = 0; m.any() && i < b.size(); ++i) {
    if (b.material[i] == none || b.is_added(i)) continue;
    if (b.fixed[i] || !model.materials[static_cast<std::size_t>(b.material[i])].pore_pressure)
      continue;
    for (std::uint32_t z = m.zone_begin[i]; z < m.zone_begin[i + 1]; ++z) {
      const double x = b.centroid_x[i] + centre_of_zone(m, z).x;
      if (x < table.low() - snap || x > table.high() + snap) continue;
      wet.push_back(
          {z, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(row), table.at(x)});
    }
  }
}

void attach_water(const Model& model, const Water& water, Index row, const BlockSet& b, double snap,
                  Loads& loads, Faults& faults) {
  if (water.table.empty()) return;
  Table table;
  for (const Vec2 p : water.table) table.points.push_back(p - b.origin);
  const std::vector<std::array<Vec2, 2>> outlines = dry_outlines(model, water, b.origin);
  const std::size_t before = loads.wet.size();
  std::vector<Part> dry;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    const Id i = b.vertex_block[v];
    if (b.fixed[i] || b.is_fill(i) || (b.is_lining(i) && is_drained(model, water, b.lining[i])))
      continue;
    dry.clear();
    for (const auto& line : outlines) {
      const Part part = on_segment(b, v, line[0], line[1], snap);
      if (part.to > part.from) dry.push_back(part);
    }
    wet_edge(b, v, table, dry, snap, row, loads.wet);
  }
  wet_pores(model, b, table, snap, row, loads.wet_zones);
  if (loads.wet.size() > before) return;
  Fault fault{water.where, "no face of a free block lies between the ends of the table",
              "give a table that lies above the blocks it is to act on"};
  fault.where.key += ".table";
  faults.push_back(fault);
}

/// The weights of fills are carried until these are placed.
void attach_weights(const Model& model, const BlockSet& b, Loads& loads) {
  const Owners owners(model);
  loads.remaining.assign(static_cast<std::size_t>(owners.all()), {});
  for (Index row = 0; row < owners.fills; ++row)
    loads.remaining[static_cast<std::size_t>(owners.of_weight(row))] = {1.0, 1.0};
  const auto before = static_cast<Index>(model.loads.size() + model.boundaries.size());
  for (Id i = 0; i < b.size(); ++i) {
    if (!b.is_fill(i)) continue;
    loads.points.push_back(
        {{i, centroid_weights}, -b.mass[i] * model.gravity, before + owners.of_weight(b.fill[i])});
  }
}

/// Active intervals at the start: active, or not yet.
template <class Item>
std::vector<ActiveInterval> first_intervals(const Model& model, const std::vector<Item>& items) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<ActiveInterval> intervals;
  intervals.reserve(items.size());
  for (const Item& item : items)
    intervals.push_back({acts_at_first(model, item.name) ? 0.0 : never});
  return intervals;
}

/// Sorts each list by block, and fills the ranges of the blocks.
void sort_by_block(const BlockSet& b, Loads& l) {
  auto by_edge = [](const auto& x, const auto& y) { return x.edge < y.edge; };
  std::stable_sort(l.points.begin(), l.points.end(),
                   [](const PointLoad& x, const PointLoad& y) { return x.at.block < y.at.block; });
  std::stable_sort(l.edges.begin(), l.edges.end(), by_edge);
  std::stable_sort(l.wet.begin(), l.wet.end(), by_edge);
  std::vector<std::uint8_t> any(b.size(), 0);
  for (const PointLoad& p : l.points) any[p.at.block] = 1;
  for (const EdgeLoad& e : l.edges) any[b.vertex_block[e.edge]] = 1;
  for (const WetEdge& e : l.wet) any[b.vertex_block[e.edge]] = 1;
  l.place.assign(b.size(), no_id);
  l.blocks.clear();
  l.range.clear();
  Id point = 0, edge = 0, wet = 0;
  for (Id i = 0; i < b.size(); ++i) {
    if (!any[i]) continue;
    l.place[i] = static_cast<Id>(l.blocks.size());
    l.blocks.push_back(i);
    Loads::Range r{point, 0, edge, 0, wet, 0};
    while (point < l.points.size() && l.points[point].at.block == i) ++point;
    while (edge < l.edges.size() && b.vertex_block[l.edges[edge].edge] == i) ++edge;
    while (wet < l.wet.size() && b.vertex_block[l.wet[wet].edge] == i) ++wet;
    r.point_end = point;
    r.edge_end = edge;
    r.wet_end = wet;
    l.range.push_back(r);
  }
}

}  // namespace

Result<Loads> attach_loads(const Model& model, const PolygonSet& polygons, const BlockSet& b) {
  Loads loads;
  Faults faults;
  loads.intervals = {first_intervals(model, model.loads), first_intervals(model, model.waters),
                     first_intervals(model, model.boundaries),
                     first_intervals(model, model.shakings)};
  attach_weights(model, b, loads);
  constexpr SteppedValue as_given{1.0, 1.0};
  loads.slow.loads.assign(model.loads.size(), as_given);
  loads.slow.waters.assign(model.waters.size(), as_given);
  loads.slow.boundaries.assign(model.boundaries.size(), as_given);
  // Before its first ramp a load has the multiplier with which that begins.
  for (auto stage = model.stages.rbegin(); stage != model.stages.rend(); ++stage) {
    if (!stage->ramp || stage->ramp->target == none) continue;
    const double from = stage->ramp->what.range->x;
    *slow_value(loads.slow, stage->ramp->varied, stage->ramp->target) = {from, from};
  }
  // A displacement begins with the run.
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    if (model.boundaries[q].type != BoundaryType::displacement) continue;
    SteppedValue& multiplier = loads.slow.boundaries[q];
    multiplier = {multiplier.value, 0.0, 0.0};
  }
  const auto is_stress = [](const Boundary& q) { return q.type == BoundaryType::stress; };
  const bool stressed = std::any_of(model.boundaries.begin(), model.boundaries.end(), is_stress);
  if (model.loads.empty() && model.waters.empty() && model.fills.empty() && !stressed) return loads;
  const double snap = 4.0 * snap_distance(model, b);
  for (std::size_t q = 0; q < model.loads.size(); ++q) {
    const Load& load = model.loads[q];
    const auto row = static_cast<Index>(q);
    if (load.point) {
      attach_point(model, polygons, load, row, b, loads, faults);
    } else if (load.body_force) {
      attach_region(load, row, b, loads, faults);
    } else {
      attach_line(load, row, b, snap, loads, faults);
    }
  }
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    if (is_stress(model.boundaries[q])) attach_stress(model, q, b, snap, loads, faults);
  }
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    attach_water(model, model.waters[q], static_cast<Index>(q), b, snap, loads, faults);
  }
  if (!faults.empty()) return faults;
  std::stable_sort(loads.wet_zones.begin(), loads.wet_zones.end(),
                   [](const WetZone& x, const WetZone& y) { return x.zone < y.zone; });
  sort_by_block(b, loads);
  return loads;
}

double level_of(const Water& water, Vec2 origin, double x) {
  return (water.level ? *water.level : level_at(water.table, x + origin.x)) - origin.y;
}

void put_water(const BlockSet& b, std::vector<WetEdge> wet, Loads& loads) {
  loads.wet = std::move(wet);
  sort_by_block(b, loads);
}

void add_edge_loads(const BlockSet& b, const std::vector<EdgeLoad>& more, Loads& loads) {
  loads.edges.insert(loads.edges.end(), more.begin(), more.end());
  sort_by_block(b, loads);
}

void keep_wall_forces(const Model& model, const BlockSet& b, const std::vector<WallForce>& forces,
                      Loads& loads) {
  const std::size_t before = model.loads.size() + model.boundaries.size();
  for (const WallForce& f : forces) {
    loads.points.push_back(
        {corner_point(b, f.vertex), f.force, static_cast<Index>(before) + f.owner});
  }
  sort_by_block(b, loads);
}

void remove_wall_forces(const Model& model, const BlockSet& b, Index owner, Loads& loads) {
  const auto row = static_cast<Index>(model.loads.size() + model.boundaries.size()) + owner;
  std::erase_if(loads.points, [&](const PointLoad& p) { return p.load == row; });
  sort_by_block(b, loads);
}

}  // namespace edda
