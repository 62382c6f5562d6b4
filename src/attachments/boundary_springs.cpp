#include "attachments/boundary_springs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "attachments/boundary_lines.hpp"
#include "base/parallel.hpp"
#include "model/contact_springs.hpp"

namespace edda {
namespace {

struct Spring {
  Id vertex;
  Index boundary;
  double kxx, kyy, kxy;
};

/// Default stiffness of a boundary per vertex, Pa: that of the joints of the vertex's block, so
/// that the boundary neither reduces the step nor deforms more than they do.
class AsJoints {
 public:
  AsJoints(const Model& model, const BlockSet& blocks, const std::vector<Line>& lines, double snap)
      : model_(model), springs_(contact_springs(model)), b_(blocks), lines_(lines), snap_(snap) {}

  /// across: a unit vector normal to the line; faces along other lines do not count; or 0, where
  /// all do.
  double at(Id v, Vec2 across) const {
    const double given = stiffest(b_.vertex_block[v]);
    if (given == 0.0 && springs_.normal_over_young == 0.0) return springs_.normal;
    const auto kn = [&](Id e) {
      return given > 0.0 ? given : 2.0 * springs_.normal_over_young / b_.compliance[e];
    };
    double sum = 0.0, least = std::numeric_limits<double>::infinity();
    for (const Id e : {v, b_.previous[v]}) {
      const double of_edge = 0.5 * b_.edge_length[e] * kn(e);
      if (on_line(e) && lies_along(e, across)) sum += of_edge;
      least = std::min(least, of_edge);
    }
    return sum > 0.0 ? sum : least;
  }

 private:
  double stiffest(Id block) const {
    double most = 0.0;
    for (Id e = b_.vertex_begin[block]; e < b_.vertex_begin[block + 1]; ++e) {
      const Index named = b_.edge_joint[e];
      const Index law = named != none ? named : model_.contact.joint;
      if (law != none && static_cast<std::size_t>(law) < model_.joints.size()) {
        most = std::max(most, model_.joints[static_cast<std::size_t>(law)].kn.value_or(0.0));
      }
    }
    return most;
  }
  bool lies_along(Id e, Vec2 across) const {
    return std::abs(dot(b_.vertex(b_.next[e]) - b_.vertex(e), across)) <= snap_;
  }
  bool on_line(Id e) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
      return distance_to_segment(b_.vertex(e), line.a, line.b) <= snap_ &&
             distance_to_segment(b_.vertex(b_.next[e]), line.a, line.b) <= snap_;
    });
  }
  const Model& model_;
  ContactSprings springs_;
  const BlockSet& b_;
  const std::vector<Line>& lines_;
  double snap_;
};

/// The spring of a vertex on these lines, or nothing where it lies on none. At a corner of two
/// lines that slide it acts across both lines; pieces of one straight line count once.
std::optional<Spring> spring_at(Id v, Index row, const Boundary& boundary, const BlockSet& b,
                                const std::vector<Line>& lines, const AsJoints& as_joints,
                                double snap) {
  Spring s{v, row, 0.0, 0.0, 0.0};
  bool on = false;
  std::vector<Vec2> across;  // directions in which the vertex is supported
  for (const Line& line : lines) {
    if (distance_to_segment(b.vertex(v), line.a, line.b) > snap) continue;
    on = true;
    const auto stiffness = [&](Vec2 n) {
      return b.thickness * (boundary.stiffness ? *boundary.stiffness : as_joints.at(v, n));
    };
    if (!boundary.slides()) {
      s.kxx = s.kyy = stiffness({});
      break;
    }
    const Vec2 n = perp(unit(line.b - line.a));
    const bool known = std::any_of(across.begin(), across.end(),
                                   [&](Vec2 other) { return std::abs(cross(n, other)) < 1e-9; });
    if (known) continue;
    across.push_back(n);
    const double k = stiffness(n);
    s.kxx += k * n.x * n.x;
    s.kyy += k * n.y * n.y;
    s.kxy += k * n.x * n.y;
  }
  if (!on) return {};
  return s;
}

/// Sorts the springs by block and boundary.
BoundarySprings in_order(std::vector<Spring> found, const BlockSet& b, std::size_t boundaries) {
  std::sort(found.begin(), found.end(), [&](const Spring& s, const Spring& t) {
    return std::make_pair(s.vertex, s.boundary) < std::make_pair(t.vertex, t.boundary);
  });
  BoundarySprings springs;
  springs.shift.assign(boundaries, Vec2{});
  springs.shift_1 = springs.shift;
  springs.block_begin.assign(b.size() + 1, 0);
  for (const Spring& s : found) {
    springs.vertex.push_back(s.vertex);
    springs.boundary.push_back(s.boundary);
    springs.kxx.push_back(s.kxx);
    springs.kyy.push_back(s.kyy);
    springs.kxy.push_back(s.kxy);
    springs.acting_k.push_back({s.kxx, s.kyy, s.kxy});
    springs.start_x.push_back(b.vertex_x[s.vertex]);
    springs.start_y.push_back(b.vertex_y[s.vertex]);
    ++springs.block_begin[b.vertex_block[s.vertex] + 1];
  }
  for (std::size_t i = 0; i < b.size(); ++i) springs.block_begin[i + 1] += springs.block_begin[i];
  return springs;
}

}  // namespace

Result<BoundarySprings> attach_boundaries(const Model& model, const BlockSet& b) {
  const double snap = boundary_snap(model, b);
  std::vector<Spring> found;
  Faults faults;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    if (!has_springs(boundary.type)) continue;
    const std::vector<Line> lines = boundary_lines(model, b, boundary);
    const AsJoints as_joints(model, b, lines, snap);
    const std::size_t before = found.size();
    for (Id v = 0; v < b.vertex_count(); ++v) {
      if (b.fixed[b.vertex_block[v]]) continue;
      const auto spring = spring_at(v, static_cast<Index>(q), boundary, b, lines, as_joints, snap);
      if (spring) found.push_back(*spring);
    }
    if (found.size() == before) {
      faults.push_back({boundary.where, "no vertex of a free block lies on this boundary",
                        "give a line that block corners lie on, or sides of the outline"});
    }
  }
  if (!faults.empty()) return faults;
  return in_order(std::move(found), b, model.boundaries.size());
}

void BoundarySprings::release(Index row) {
  for (std::size_t q = 0; q < size(); ++q) {
    if (boundary[q] == row) kxx[q] = kyy[q] = kxy[q] = 0.0;
  }
}

void BoundarySprings::start_at(std::size_t q, const std::vector<double>& x,
                               const std::vector<double>& y) {
  const Vec2 moved = shift[static_cast<std::size_t>(boundary[q])];
  start_x[q] = x[vertex[q]] - moved.x;
  start_y[q] = y[vertex[q]] - moved.y;
}

void BoundarySprings::engage(Index row, const std::vector<double>& x,
                             const std::vector<double>& y) {
  for (std::size_t q = 0; q < size(); ++q) {
    if (boundary[q] != row) continue;
    kxx[q] = acting_k[q][0];
    kyy[q] = acting_k[q][1];
    kxy[q] = acting_k[q][2];
    start_at(q, x, y);
  }
}

void BoundarySprings::engage_block(Id block, const std::vector<double>& x,
                                   const std::vector<double>& y) {
  for (std::size_t q = block_begin[block]; q < block_begin[block + 1]; ++q) start_at(q, x, y);
}

double boundary_energy(const BoundarySprings& s, const Pose& pose) {
  return ordered_sum(s.size(), [&](std::size_t q) {
    const Id v = s.vertex[q];
    const auto row = static_cast<std::size_t>(s.boundary[q]);
    const Vec2 now = s.shift[row], before = s.shift_1[row];
    const double ux = pose.x[v] - s.start_x[q] - now.x, uy = pose.y[v] - s.start_y[q] - now.y;
    const double wx = pose.x1[v] - s.start_x[q] - before.x;
    const double wy = pose.y1[v] - s.start_y[q] - before.y;
    return 0.5 * (wx * (s.kxx[q] * ux + s.kxy[q] * uy) + wy * (s.kxy[q] * ux + s.kyy[q] * uy));
  });
}

}  // namespace edda
