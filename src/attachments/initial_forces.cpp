#include "attachments/initial_forces.hpp"

#include <algorithm>

#include "attachments/boundary_lines.hpp"

namespace edda {
namespace {

Vec2 traction(const Tensor& s, Vec2 n) {
  return {s.xx * n.x + s.xy * n.y, s.xy * n.x + s.yy * n.y};
}

/// The open faces along a boundary.
std::vector<Piece> faces_of(const Model& model, const BlockSet& b, const Boundary& boundary) {
  bool in_joints = false;
  return pieces_on(b, boundary_lines(model, b, boundary), Faces::open, boundary_snap(model, b),
                   in_joints);
}

/// On the two vertices of the piece's face.
EndForces on_vertices(const Piece& p, const EndForces& on_piece) {
  const auto [from, to] = p.part;
  return {(1.0 - from) * on_piece.at_from + (1.0 - to) * on_piece.at_to,
          from * on_piece.at_from + to * on_piece.at_to};
}

}  // namespace

FaceForces::FaceForces(const BlockSet& blocks, const StressField& field, const LoadsNow& at_start)
    : b_(blocks), field_(field), now_(at_start) {}

EndForces FaceForces::on(Id edge, Part part) const {
  const Vec2 a{b_.vertex_x[edge], b_.vertex_y[edge]};
  const Vec2 u = Vec2{b_.vertex_x[b_.next[edge]], b_.vertex_y[b_.next[edge]]} - a;
  const Vec2 n = outward_normal(unit(u));
  const double length = (part.to - part.from) * norm(u) * b_.thickness;
  const Vec2 t0 = traction(field_.at(a + part.from * u), n),
             t1 = traction(field_.at(a + part.to * u), n);
  const EndForces water =
      water_on(b_, now_, b_.vertex_x, b_.vertex_y, edge, part.from, part.to);
  return {length / 6.0 * (2.0 * t0 + t1) - water.at_from,
          length / 6.0 * (t0 + 2.0 * t1) - water.at_to};
}

void hold_initial_stress(BoundarySprings& springs, const Model& model, const BlockSet& b,
                         const FaceForces& faces) {
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    if (!has_springs(model.boundaries[q].type)) continue;
    const auto hold = [&](Id v, Vec2 force) {
      const Id i = b.vertex_block[v];
      for (Id s = springs.block_begin[i]; s < springs.block_begin[i + 1]; ++s) {
        if (springs.vertex[s] != v || springs.boundary[s] != static_cast<Index>(q)) continue;
        springs.held_x[s] += force.x;
        springs.held_y[s] += force.y;
      }
    };
    for (const Piece& p : faces_of(model, b, model.boundaries[q])) {
      const EndForces on = on_vertices(p, faces.on(p.edge, p.part));
      hold(p.edge, on.at_from);
      hold(b.next[p.edge], on.at_to);
    }
  }
}

void load_initial_stress(Loads& loads, const Model& model, const BlockSet& b,
                         const FaceForces& faces) {
  std::vector<PointLoad> more;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    const bool stress = boundary.type == BoundaryType::stress && !boundary.traction;
    if (!stress && boundary.type != BoundaryType::viscous) continue;
    const auto row = static_cast<Index>(model.loads.size() + q);
    const auto load = [&](Id v, Vec2 force) {
      more.push_back({b.vertex_block[v],
                      {b.weight[0][v], b.weight[1][v], b.weight[2][v]},
                      force,
                      row});
    };
    for (const Piece& p : faces_of(model, b, boundary)) {
      const EndForces on = on_vertices(p, faces.on(p.edge, p.part));
      load(p.edge, on.at_from);
      load(b.next[p.edge], on.at_to);
    }
  }
  if (!more.empty()) add_point_loads(b, more, loads);
}

}  // namespace edda
