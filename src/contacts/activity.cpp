#include "contacts/activity.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_preload.hpp"
#include "contacts/inside.hpp"

namespace edda {
namespace {

/// The points of both edges at the fraction x of the overlap.
struct Opposite {
  Vec2 on_edge, on_facing;
};
Opposite opposite_at(const FacePoints& p, const Face& face, double x) {
  const double xi = face.xi.a + x * (face.xi.b - face.xi.a);
  const double eta = face.eta.a + x * (face.eta.b - face.eta.a);
  return {(1.0 - xi) * p.p1 + xi * p.p2, eta * p.q1 + (1.0 - eta) * p.q2};
}

/// Position of the resultant of the pressure, as a fraction of the overlap; at least one end is
/// closed.
double centre_of_pressure(double da, double db) {
  if (da >= 0.0 && db >= 0.0) return da + db > 0.0 ? (da + 2.0 * db) / (3.0 * (da + db)) : 0.5;
  return da > 0.0 ? da / (da - db) / 3.0 : 1.0 - db / (db - da) / 3.0;
}

/// The points of both edges of a closed face at its centre of pressure.
Opposite where_pressed(const FacePoints& at, const Face& face) {
  return opposite_at(at, face, centre_of_pressure(face.closure.a, face.closure.b));
}

/// Depth in the other block of the deeper of the two corners that bound the overlap, m.
double deepest_corner(const FaceSet& c, const BlockSet& b, const Pose& pose, const FacePoints& at,
                      const Face& face, std::size_t k) {
  const auto depth = [&](double of_first, Vec2 p, Vec2 q) {
    const bool of_edge = of_first >= 0.5;
    const Id other = b.vertex_block[of_edge ? c.facing[k] : c.edge[k]];
    return depth_inside(b, pose, of_edge ? p : q, other);
  };
  return std::max(depth(face.of_first.a, at.p1, at.q2), depth(face.of_first.b, at.p2, at.q1));
}

/// Whether a face that comes into being with a closure acts: whether the blocks overlap there, and
/// do not lie between its edges as where these are the far sides of two thin blocks. Either the
/// points at the centre of pressure lie in the other block; or a corner that bounds the overlap
/// does, by a part of the closure. The corner counts where edges begin to overlap while they lie
/// behind each other, as where a corner sinks past a corner, and an edge beside them is so inclined
/// that these points are not inside yet.
bool acts_from_the_start(const FaceSet& c, const BlockSet& b, const Pose& pose,
                         const FacePoints& at, const Face& face, std::size_t k) {
  const double closure = std::max(face.closure.a, face.closure.b);
  if (closure <= 0.0) return false;
  const Opposite p = where_pressed(at, face);
  if (lies_inside(b, pose, p.on_facing, b.vertex_block[c.edge[k]]) &&
      lies_inside(b, pose, p.on_edge, b.vertex_block[c.facing[k]]))
    return true;
  constexpr double inside = 0.05;
  return deepest_corner(c, b, pose, at, face, k) > inside * closure;
}

/// Calls visit(i) for the blocks that face block j, until one of the calls returns true.
template <class Visit>
bool any_neighbour(const FaceSet& c, const BlockSet& b, Id j, Visit visit) {
  bool found = false;
  c.for_faces(b.vertex_begin[j], b.vertex_begin[j + 1], [&](Id q, bool of_edge) {
    found = found || visit(b.vertex_block[of_edge ? c.facing[q] : c.edge[q]]);
  });
  return found;
}
std::size_t faces_of(const FaceSet& c, const BlockSet& b, Id j) {
  return c.begin_of_edge[b.vertex_begin[j + 1]] - c.begin_of_edge[b.vertex_begin[j]];
}

/// Whether `meets` holds for one of the blocks that face one of these two. Of a block with very
/// many faces, such as the floor of a model, only those count that also face a neighbour of the
/// other.
template <class Meets>
bool any_third_block(const FaceSet& c, const BlockSet& b, const std::array<Id, 2>& own,
                     Meets meets) {
  constexpr std::size_t many = 256;
  const auto third = [&](Id i) { return i != own[0] && i != own[1] && meets(i); };
  for (std::size_t n = 0; n < own.size(); ++n) {
    const Id j = own[n], other = own[1 - n];
    if (faces_of(c, b, j) <= many) {
      if (any_neighbour(c, b, j, third)) return true;
    } else if (faces_of(c, b, other) <= many) {
      if (any_neighbour(c, b, other, [&](Id i) {
            return i != j && faces_of(c, b, i) <= many && any_neighbour(c, b, i, third);
          }))
        return true;
    }
  }
  return false;
}

/// Whether the corner that bounds the end of larger closure leans on the other edge, that is,
/// whether no third block lies beside it between the two edges. Where one does, as at a point where
/// five wedges meet, the exact integral of the pressure holds and the corner has no spring of its
/// own.
bool corner_leans(const FaceSet& c, const BlockSet& b, const Pose& pose, const FacePoints& at,
                  const Face& face, std::size_t k) {
  constexpr double beside = 0.1;  // of the overlap
  const Opposite points =
      opposite_at(at, face, face.closure.b >= face.closure.a ? 1.0 - beside : beside);
  const Vec2 between = 0.5 * (points.on_edge + points.on_facing);
  const std::array own{b.vertex_block[c.edge[k]], b.vertex_block[c.facing[k]]};
  return !any_third_block(c, b, own, [&](Id i) { return lies_inside(b, pose, between, i); });
}

}  // namespace

bool decide_activity(FaceSet& c, const BlockSet& b, const Pose& pose, WasActive before,
                     std::size_t k) {
  const auto verdict = [&] {
    return std::tuple{c.acts(k), c.leans(k), c.locked_closure_a[k], c.locked_closure_b[k]};
  };
  const auto was = verdict();
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const Face face = face_at(c, b, pose.x, pose.y, k);
  const double closure = std::max(face.drawn.a, face.drawn.b);
  if (!before.stored) c.set(FaceFlag::leans, k, corner_leans(c, b, pose, at, face, k));
  if (!before.on) {
    const FaceEnds locked = c.leans(k) ? locked_closure(c, face, k) : FaceEnds{};
    c.locked_closure_a[k] = locked.a;
    c.locked_closure_b[k] = locked.b;
  }
  if (closure <= c.noise) {
    c.set(FaceFlag::acts, k);
  } else if (!before.on) {
    c.set(FaceFlag::acts, k, acts_from_the_start(c, b, pose, at, face, k));
  }
  return verdict() != was;
}

bool overlap_where_pressed(const FaceSet& c, const BlockSet& b, const Pose& pose, const Face& face,
                           std::size_t k) {
  if (std::max(face.closure.a, face.closure.b) <= 0.0) return false;
  const Opposite p = where_pressed(face_points(c, pose.x, pose.y, k), face);
  const Id edge = b.vertex_block[c.edge[k]], facing = b.vertex_block[c.facing[k]];
  const Vec2 middle = 0.5 * (p.on_edge + p.on_facing);
  return lies_inside(b, pose, p.on_edge, facing) || lies_inside(b, pose, p.on_facing, edge) ||
         (lies_inside(b, pose, middle, edge) && lies_inside(b, pose, middle, facing));
}

}  // namespace edda
