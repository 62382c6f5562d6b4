#include "attachments/dashpots.hpp"

#include <algorithm>
#include <cmath>

#include "attachments/edges_on_line.hpp"

namespace edda {
namespace {

/// Adds those of a piece of an edge of a meshed block, which has the dashpot `at` per length along
/// all of it: each corner has the part that the mean of its weight gives it.
void add_at_corners(const BlockSet& b, const Piece& piece, Dashpot at,
                    std::vector<Dashpot>& points) {
  const Id v = piece.edge, end = b.next[v];
  const Vec2 a = b.vertex(v), u = b.vertex(end) - a;
  const Part part = piece.part;
  const double mean = 0.5 * (part.from + part.to),
               border = part.from + (1.0 - mean) * (part.to - part.from);
  for (const auto& [corner, of] :
       {std::pair{v, Part{part.from, border}}, {end, Part{border, part.to}}}) {
    const double length = (of.to - of.from) * norm(u);
    Dashpot own = at;
    own.weight = weights_of(b.weight, corner);
    own.cxx *= length;
    own.cyy *= length;
    own.cxy *= length;
    own.length = length;
    own.node = b.meshes.begin[at.block] + corner - b.vertex_begin[at.block];
    own.middle = a + 0.5 * (of.from + of.to) * u;
    points.push_back(own);
  }
}

/// Adds the two dashpots of a piece of an edge.
void add_points(const BlockSet& b, const Boundary& boundary, Index row, const Piece& piece,
                std::vector<Dashpot>& points) {
  const Id v = piece.edge, end = b.next[v], i = b.vertex_block[v];
  const Vec2 a = b.vertex(v), u = b.vertex(end) - a;
  const Vec2 t = unit(u), n = outward_normal(t);
  const double density = b.mass[i] / b.volume[i];
  const double p_speed = boundary.wave_speeds
                             ? boundary.wave_speeds->x
                             : std::sqrt((b.lame_lambda[i] + 2.0 * b.lame_mu[i]) / density);
  const double s_speed =
      boundary.wave_speeds ? boundary.wave_speeds->y : std::sqrt(b.lame_mu[i] / density);
  const double length = (piece.part.to - piece.part.from) * norm(u);
  const bool meshed = b.is_meshed(i);
  // Of a meshed block per length.
  const double half = meshed ? b.thickness * density : 0.5 * b.thickness * length * density;
  const double cn = half * p_speed, ct = half * s_speed;
  Dashpot point{i,
                {},
                cn * n.x * n.x + ct * t.x * t.x,
                cn * n.y * n.y + ct * t.y * t.y,
                cn * n.x * n.y + ct * t.x * t.y,
                row,
                0.5 * length,
                n};
  if (meshed) return add_at_corners(b, piece, point, points);
  const double middle = 0.5 * (piece.part.from + piece.part.to);
  const double off = 0.5 * (piece.part.to - piece.part.from) / std::sqrt(3.0);
  for (const double s : {middle - off, middle + off}) {
    point.weight = weights_at(b, i, a + s * u);
    points.push_back(point);
  }
}

}  // namespace

Result<Dashpots> attach_dashpots(const Model& model, const BlockSet& b) {
  Dashpots dashpots;
  Faults faults;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    if (!has_dashpots(boundary.type)) continue;
    bool in_joints = false;
    const std::vector<Piece> pieces =
        pieces_on(b, boundary_lines(model, b, boundary), WhichFaces::open, boundary_snap(model, b),
                  in_joints);
    for (const Piece& piece : pieces) {
      add_points(b, boundary, static_cast<Index>(q), piece, dashpots.points);
    }
    if (pieces.empty()) {
      faults.push_back({boundary.where, "no open face of a free block lies on this boundary",
                        "give a line that faces of blocks lie on, or sides of the outline"});
    }
  }
  if (!faults.empty()) return faults;
  std::stable_sort(dashpots.points.begin(), dashpots.points.end(),
                   [](const Dashpot& x, const Dashpot& y) {
                     return x.block != y.block ? x.block < y.block : x.node < y.node;
                   });
  for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
    const Id i = dashpots.points[p].block;
    if (!dashpots.blocks.empty() && dashpots.blocks.back() == i) continue;
    dashpots.blocks.push_back(i);
    dashpots.begin.push_back(static_cast<Id>(p));
  }
  dashpots.begin.push_back(static_cast<Id>(dashpots.points.size()));
  dashpots.set_acting(std::vector<ActiveInterval>(model.boundaries.size()));
  return dashpots;
}

void Dashpots::set_acting(const std::vector<ActiveInterval>& boundaries) {
  acts.clear();
  for (const ActiveInterval& interval : boundaries) acts.push_back(interval.acts() ? 1 : 0);
  damped.clear();
  for (const Dashpot& p : points) {
    if (acts[static_cast<std::size_t>(p.boundary)] == 0) continue;
    if (damped.empty() || damped.back() != p.block) damped.push_back(p.block);
  }
}

}  // namespace edda
