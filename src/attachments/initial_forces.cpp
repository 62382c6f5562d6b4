#include "attachments/initial_forces.hpp"

#include <algorithm>
#include <map>

#include "attachments/boundary_lines.hpp"
#include "attachments/boundary_springs.hpp"
#include "attachments/dashpots.hpp"

namespace edda {
namespace {

Vec2 traction(const Tensor& s, Vec2 n) {
  return {s.xx * n.x + s.xy * n.y, s.xy * n.x + s.yy * n.y};
}

/// The open faces along a boundary.
std::vector<Piece> faces_of(const Model& model, const BlockSet& b, const Boundary& boundary) {
  bool in_joints = false;
  return pieces_on(b, boundary_lines(model, b, boundary), WhichFaces::open, boundary_snap(model, b),
                   in_joints);
}

/// Parts of faces already supported by a boundary, by edge.
using SupportedParts = std::map<Id, std::vector<Part>>;

/// The parts of the faces of a boundary that no other boundary supports yet; marks them as
/// supported.
std::vector<Piece> newly_supported(const Model& model, const BlockSet& b, const Boundary& boundary,
                                   SupportedParts& supported) {
  std::vector<Piece> mine;
  for (const Piece& p : faces_of(model, b, boundary)) {
    std::vector<Part>& others = supported[p.edge];
    for (const Part part : without(p.part, others)) {
      if (part.to > part.from) mine.push_back({p.edge, part});
    }
    others.push_back(p.part);
  }
  return mine;
}

/// Adds what holds a piece of a face in the initial stress.
void add_wall(std::vector<WallForce>& forces, const BlockSet& b, const FaceForces& faces,
              const Piece& p, Index owner) {
  const EndForces on = on_vertices(p.part.from, p.part.to, faces.on(p.edge, p.part));
  forces.push_back({p.edge, on.at_from, owner});
  forces.push_back({b.next[p.edge], on.at_to, owner});
}

}  // namespace

FaceForces::FaceForces(const BlockSet& blocks, const StressField& field, const LoadsNow& at_start)
    : b_(blocks), field_(field), now_(at_start) {}

EndForces FaceForces::on(Id edge, Part part) const {
  const Vec2 a = b_.vertex(edge);
  const Vec2 u = b_.vertex(b_.next[edge]) - a;
  const Vec2 n = outward_normal(unit(u));
  const double length = (part.to - part.from) * norm(u) * b_.thickness;
  const Vec2 t0 = traction(field_.at(a + part.from * u), n),
             t1 = traction(field_.at(a + part.to * u), n);
  const EndForces water = water_on(b_, now_, b_.vertex_x, b_.vertex_y, edge, part.from, part.to);
  return {length / 6.0 * (2.0 * t0 + t1) - water.at_from,
          length / 6.0 * (t0 + 2.0 * t1) - water.at_to};
}

std::vector<WallForce> supported_initial_stress(const Model& model, const BlockSet& b,
                                                const ActiveIntervals& intervals,
                                                const FaceForces& faces) {
  std::vector<WallForce> forces;
  SupportedParts supported;
  const auto each = [&](auto is_meant, bool keeps) {
    for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
      const Boundary& boundary = model.boundaries[q];
      if (!intervals.boundaries[q].acts() || !is_meant(boundary.type)) continue;
      const auto owner = Owners(model).of_boundary(static_cast<Index>(q));
      for (const Piece& p : newly_supported(model, b, boundary, supported)) {
        if (!keeps) continue;
        add_wall(forces, b, faces, p, owner);
      }
    }
  };
  each(has_springs, true);
  each([](BoundaryType type) { return type == BoundaryType::stress; }, false);
  each(has_dashpots, true);
  return forces;
}

std::vector<WallForce> initial_wall_forces(const Model& model, const BlockSet& b,
                                           const FaceForces& faces) {
  std::vector<WallForce> forces;
  for (std::size_t q = 0; q < model.openings.size(); ++q) {
    if (model.openings[q].staged) continue;
    const Ring& ring = model.openings[q].polygon;
    std::vector<Line> lines;
    for (std::size_t k = 0; k < ring.size(); ++k)
      lines.push_back({ring[k] - b.origin, ring[(k + 1) % ring.size()] - b.origin});
    bool in_joints = false;
    for (const Piece& p : pieces_on(b, lines, WhichFaces::open, boundary_snap(model, b), in_joints))
      add_wall(forces, b, faces, p, static_cast<Index>(q));
  }
  return forces;
}

void load_initial_stress(Loads& loads, const Model& model, const BlockSet& b,
                         const FaceForces& faces) {
  std::vector<EdgeLoad> more;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    if (boundary.type != BoundaryType::stress || boundary.traction) continue;
    const auto row = static_cast<Index>(model.loads.size() + q);
    for (const Piece& p : faces_of(model, b, boundary)) {
      more.push_back({p.edge, p.part.from, p.part.to, {}, 0.0, row, faces.on(p.edge, p.part)});
    }
  }
  if (!more.empty()) add_edge_loads(b, more, loads);
}

ModeVectors initial_mode_forces(const BlockSet& b, const StressField& field) {
  BodyVectors on = zero_vectors(b);
  const LoadsNow no_water;
  const FaceForces faces(b, field, no_water);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.bends(i)) continue;
    BlockForces of_block{b, i};
    for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
      const EndForces all = faces.on(e, {0.0, 1.0});
      of_block.bend_at(e, all.at_from);
      of_block.bend_at(b.next[e], all.at_to);
    }
    store(of_block.sum, b, on, i);
  }
  return on.modes;
}

}  // namespace edda
