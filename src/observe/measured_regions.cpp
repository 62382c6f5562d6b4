#include "observe/measured_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "blocks/locate.hpp"
#include "cutting/rock_area.hpp"

namespace edda {
namespace {

struct Box {
  Vec2 low, high;
  explicit Box(std::span<const Vec2> points) : low(points.front()), high(points.front()) {
    for (const Vec2 p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  bool apart_from(const Box& o, double by) const {
    return o.low.x > high.x + by || low.x > o.high.x + by || o.low.y > high.y + by ||
           low.y > o.high.y + by;
  }
};

/// Within one of these (a zone, or a block that is not meshed) u has no kink.
struct Cell {
  std::size_t block = 0;
  std::optional<std::size_t> zone;
  std::vector<Ring> rings;  ///< m, at the start
};

std::vector<Cell> cells_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_meshed(i)) {
      cells.push_back({i, {}, sim.scene->polygons.blocks[i].rings});
      continue;
    }
    const Vec2 centre{b.centroid_x[i], b.centroid_y[i]};
    const auto node = [&](std::uint32_t j) {
      return centre + Vec2{b.meshes.arm_x[j], b.meshes.arm_y[j]};
    };
    for (std::size_t z = b.meshes.zone_begin[i]; z < b.meshes.zone_begin[i + 1]; ++z) {
      const auto& [p, q, r] = b.meshes.zone[z];
      cells.push_back({i, z, {{node(p), node(q), node(r)}}});
    }
  }
  return cells;
}

/// Area of the cell inside the ring, m2.
double area_inside(const Cell& cell, const Ring& ring) {
  double area = 0.0;
  for (std::size_t r = 0; r < cell.rings.size(); ++r) {
    const double part = common_area(cell.rings[r], ring).value_or(0.0);
    area += r == 0 ? part : -part;  // the others are holes
  }
  return area;
}

/// Where a side p-q of the outline meets the edge a-b, and where ends of that edge lie on it: parts
/// of its length.
void add_meetings(Vec2 p, Vec2 q, Vec2 a, Vec2 b, double snap, std::vector<double>& at) {
  const Vec2 side = q - p, edge = b - a;
  const double length = norm(side);
  for (const Vec2 end : {a, b}) {
    if (distance_to_segment(end, p, q) <= snap)
      at.push_back(dot(end - p, side) / (length * length));
  }
  const double turn = cross(side, edge);
  if (turn == 0.0) return;
  const double t = cross(a - p, edge) / turn, s = cross(a - p, side) / turn;
  if (t >= 0.0 && t <= 1.0 && s >= 0.0 && s <= 1.0) at.push_back(t);
}

/// The pieces of the side p-q of an outline, each in one cell or in none.
void add_pieces(const Simulation& sim, const std::vector<Cell>& cells, Vec2 p, Vec2 q,
                std::vector<OutlinePiece>& pieces) {
  const Scene& scene = *sim.scene;
  const double snap = snap_distance(scene.model, scene.blocks), length = norm(q - p);
  const Box box(std::array{p, q});
  std::vector<double> at{0.0, 1.0};
  for (const Cell& cell : cells) {
    if (Box(cell.rings.front()).apart_from(box, snap)) continue;
    for (const Ring& ring : cell.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k)
        add_meetings(p, q, ring[k], ring[(k + 1) % ring.size()], snap, at);
    }
  }
  for (double& t : at) t = std::clamp(t, 0.0, 1.0);
  std::sort(at.begin(), at.end());
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    if ((at[k + 1] - at[k]) * length <= snap && k + 2 < at.size()) {
      at[k + 1] = at[k];
      continue;
    }
    if (at[k + 1] == at[k]) continue;
    const auto point = [&](double t) { return p + t * (q - p); };
    const double middle = 0.5 * (at[k] + at[k + 1]);
    OutlinePiece piece{point(at[k]), point(at[k + 1]), {}};
    const auto block = block_at(scene.model, scene.polygons, scene.blocks, point(middle));
    if (block) {
      const auto of_block = [&](double t) { return block_point(scene.blocks, *block, point(t)); };
      piece.in = {of_block(at[k]), of_block(middle), of_block(at[k + 1])};
    }
    pieces.push_back(piece);
  }
}

MeasuredRegion placed(const Simulation& sim, const std::vector<Cell>& cells, const Measurement& m,
                      Ring ring) {
  MeasuredRegion region{m.name, std::abs(signed_area(ring)), {}, {}, {}};
  if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  const Box box(ring);
  for (const Cell& cell : cells) {
    if (Box(cell.rings.front()).apart_from(box, 0.0)) continue;
    const double area = area_inside(cell, ring);
    if (area <= 0.0) continue;
    if (cell.zone) {
      region.zones.push_back({cell.block, *cell.zone, area});
    } else {
      region.blocks.emplace_back(cell.block, area);
    }
  }
  for (std::size_t k = 0; k < ring.size(); ++k)
    add_pieces(sim, cells, ring[k], ring[(k + 1) % ring.size()], region.outline);
  return region;
}

BlockStress mean_stress_in(const Simulation& sim, const State& state,
                           const MeasuredRegion& region) {
  BlockStress sum;
  const auto add = [&](const BlockStress& s, double area) {
    const double part = area / region.area;
    sum.xx += part * s.xx;
    sum.yy += part * s.yy;
    sum.zz += part * s.zz;
    sum.xy += part * s.xy;
  };
  for (const auto& [block, area] : region.blocks) {
    if (state.alive[block]) add(block_stress(sim, state, block), area);
  }
  for (const auto& [block, zone, area] : region.zones) {
    const auto& [xx, yy, zz, xy] = sim.motion.zones.stress[zone];
    if (state.alive[block]) add({xx, yy, zz, xy}, area);
  }
  return sum;
}

/// Displacement at the ends of a piece and its mean along it (Simpson's rule), m; nothing where its
/// block is excavated, or where there is none.
struct PieceMotion {
  Vec2 from, mean, to;
};
std::optional<PieceMotion> motion_of(const BlockSet& b, const State& s, const OutlinePiece& piece) {
  if (!piece.in || !s.alive[piece.in->from.block]) return {};
  const auto moved = [&](const BlockPoint& p) {
    return at_point(vector_of(b, s.position, p.block) - vector_of(b, s.reference, p.block), p);
  };
  const Vec2 from = moved(piece.in->from), to = moved(piece.in->to);
  return PieceMotion{from, (from + 4.0 * moved(piece.in->middle) + to) / 6.0, to};
}

}  // namespace

Result<std::vector<MeasuredRegion>> place_measurements(const Simulation& sim) {
  const Scene& scene = *sim.scene;
  std::vector<MeasuredRegion> regions;
  if (scene.model.measurements.empty()) return regions;
  const std::vector<Cell> cells = cells_of(sim);
  Faults faults;
  for (const Measurement& m : scene.model.measurements) {
    Ring ring = m.polygon;
    bool outside = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      ring[k] = ring[k] - scene.blocks.origin;
      if (block_at(scene.model, scene.polygons, scene.blocks, ring[k])) continue;
      Fault fault{m.where, "lies in no block",
                  "move it into the rock; only between its corners may the outline cross openings"};
      fault.where.key += ".polygon[" + std::to_string(k) + "]";
      faults.push_back(fault);
      outside = true;
    }
    if (!outside) regions.push_back(placed(sim, cells, m, ring));
  }
  if (!faults.empty()) return faults;
  return regions;
}

MeanState mean_state(const Simulation& sim, const Instant& at, const MeasuredRegion& region) {
  struct Moved {
    const OutlinePiece* piece;
    PieceMotion u;
  };
  std::vector<Moved> rock;
  for (const OutlinePiece& piece : region.outline) {
    if (const auto u = motion_of(sim.scene->blocks, at.state, piece)) rock.push_back({&piece, *u});
  }
  MeanState mean{mean_stress_in(sim, at.state, region), {}};
  double area = 0.0;
  const auto add = [&](Vec2 from, Vec2 to, Vec2 u) {
    const Vec2 n = -1.0 * perp(to - from);
    mean.strain.xx += u.x * n.x;
    mean.strain.yy += u.y * n.y;
    mean.strain.xy += 0.5 * (u.x * n.y + u.y * n.x);
    area += 0.5 * cross(from, to);
  };
  for (std::size_t k = 0; k < rock.size(); ++k) {
    const auto& [piece, u] = rock[k];
    const auto& [next, next_u] = rock[(k + 1) % rock.size()];
    add(piece->from, piece->to, u.mean);
    add(piece->to, next->from, 0.5 * (u.to + next_u.from));  // of no length but across voids
  }
  for (double* part : {&mean.strain.xx, &mean.strain.yy, &mean.strain.xy})
    *part = area > 0.0 ? *part / area : 0.0;
  return mean;
}

}  // namespace edda
