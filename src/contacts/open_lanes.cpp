#include <cmath>

#include "contacts/chunk_columns.hpp"
#include "contacts/face_parts.hpp"

namespace edda {
namespace {

/// Vector from one corner to another, m, and its change in a step as they go on, m.
struct Between {
  Vec2 w, pace;
};
EDDA_INLINE Between between(Vec2 from, Vec2 to, Vec2 pace_from, Vec2 pace_to) {
  return {to - from, pace_to - pace_from};
}
EDDA_INLINE Between reversed(const Between& b) {
  return {-1.0 * b.w, -1.0 * b.pace};
}

/// Outward normal of an edge with the direction w, of length 1.
EDDA_INLINE Vec2 normal_of(Vec2 w) {
  const double length = norm(w);
  return (1.0 / (length > 0.0 ? length : 1.0)) * outward_normal(w);
}

/// The way of corners for so many steps, in which each may stray from its straight path by up to
/// `margin` (m).
struct OnTheWay {
  double steps, margin;

  /// Least value of n . w on the way, n of length 1: on straight paths that of the beginning or of
  /// the end.
  EDDA_INLINE double least_along(Vec2 n, const Between& b) const {
    const double begin = dot(n, b.w), end = begin + steps * dot(n, b.pace);
    return smaller(begin, end) - 2.0 * margin;
  }
  /// Upper bound of the length of w on the way.
  EDDA_INLINE double longest(const Between& b) const {
    const Vec2 end = b.w + steps * b.pace;
    return larger(std::abs(b.w.x), std::abs(end.x)) + larger(std::abs(b.w.y), std::abs(end.y)) +
           2.0 * margin;
  }
  /// Upper bound of the change of w on the way.
  EDDA_INLINE double change(const Between& b) const {
    return steps * (std::abs(b.pace.x) + std::abs(b.pace.y)) + 2.0 * margin;
  }
  /// Whether n . w > -by all the way, where n turns by up to `turn` (rad, small).
  EDDA_INLINE bool ahead(Vec2 n, double turn, const Between& b, double by = 0.0) const {
    return least_along(n, b) + by > turn * longest(b);
  }
};

/// Whether nothing can change, on the way, of a face that carries nothing: its gate was shut and
/// remains so; or it was open and remains so, and the surfaces apart. With the length |g| of E - F,
/// both edges over their lengths, the sine of the angle by which the frame turns is at most that by
/// which g changes, over |g|; so a vector along t changes by its length times about that beside its
/// own change. The edges do not overlap as long as p2 lies before q2 along t, or q1 before p1, or
/// not farther beyond it than by an overlap that does not count.
/// Where all of f lies beyond all of e along n, their surfaces stay apart as long as n turns by
/// less than a right angle. The same holds along the normals of e and of f, of which one parts the
/// edges wherever they do not cross: as both edges go on along t all the way, n stays within a
/// right angle of either.
EDDA_INLINE bool stays_as_it_is(const ChunkColumns& c, const FacePair& pair, const EdgeGeometry& o,
                                std::size_t k, const FacePoints& at, const FacePoints& pace,
                                const OnTheWay& way) {
  const Between e = between(at.p1, at.p2, pace.p1, pace.p2),
                f = between(at.q2, at.q1, pace.q2, pace.q1),
                p1_q1 = between(at.p1, at.q1, pace.p1, pace.q1),
                p2_q1 = between(at.p2, at.q1, pace.p2, pace.q1),
                p1_q2 = between(at.p1, at.q2, pace.p1, pace.q2),
                p2_q2 = between(at.p2, at.q2, pace.p2, pace.q2);
  const double change = way.change(e) * pair.inverse_e + way.change(f) * pair.inverse_f;  // of g
  const double turn =
      1.1 * change * o.per_base;  // of t: an angle below 0.5 is 1.1 times its sine at most
  const Vec2 t{o.tx, o.ty}, n = outward_normal(t);
  constexpr double stretch = 1.5;  // the cosine is that of edges stretched by less than this
  const double faces_by = o.cosine - pair.gate_from;
  const bool firm = (turn < 0.5) & (change < 0.25);
  const bool shut = (change < 0.25) & (faces_by + stretch * change < 0.0);
  const double least = least_overlap * pair.passing;
  const bool past_e = way.ahead(t, turn, p2_q2, least),
             short_of_e = way.ahead(t, turn, reversed(p1_q1), least);
  const bool beside = firm & (past_e | short_of_e);
  const bool e_goes_on = way.ahead(t, turn, e), f_goes_back = way.ahead(t, turn, f);
  const bool begins = way.ahead(t, turn, reversed(p2_q2), -least),
             ends = way.ahead(t, turn, p1_q1, -least);
  const bool opposed =
      firm & (faces_by - stretch * change > 0.0) & e_goes_on & f_goes_back & begins & ends;
  const auto gap_along = [&](Vec2 m) __attribute__((always_inline)) {
    return smaller(smaller(way.least_along(m, p1_q1), way.least_along(m, p2_q1)),
                   smaller(way.least_along(m, p1_q2), way.least_along(m, p2_q2)));
  };
  const double gap =
      larger(gap_along(n), larger(gap_along(normal_of(e.w)), gap_along(normal_of(f.w))));
  const double locked = positive_part(larger(pair.offset.a, pair.offset.b));
  const bool open = opposed & (gap > locked) & (pair.stiffness > 0.0);
  const bool loose = (c.bonded[k] == 0.0) & (pair.carries_tension == 0.0);
  const bool was_off = (c.was & (bit_of_lane[k] << lane_bits::on)) == 0;
  return loose & ((was_off & (shut | beside)) | ((was_off == 0) & open));
}

/// Whether the edges are opposed and a corner touches the other edge, to rounding.
EDDA_INLINE bool corner_touches_edge(const FacePair& pair, const EdgeGeometry& o, double noise) {
  const double most = larger(pair.offset.a + o.closure_at_0 + o.closure_slope * o.ma,
                             pair.offset.b + o.closure_at_0 + o.closure_slope * o.mb);
  return (o.cosine > pair.gate_from) & overlaps(o.ma, o.mb, pair) & (most > -noise);
}

EDDA_INLINE void test_open_lane(const ChunkColumns& c, std::size_t k, const RestMargins& margins,
                                double steps, LaneBits& stay, LaneBits& near) {
  const FacePair pair = pair_of(c, k);
  const FacePoints at = points_of(*c.e, *c.f, k), pace = points_of(*c.e_then, *c.f_then, k);
  const EdgeGeometry o = geometry_of_edges(at, pair);
  const LaneBits bit = bit_of_lane[k];
  const auto stays_at = [&](unsigned level) __attribute__((always_inline)) {
    const OnTheWay way{steps, margins[level]};
    return stays_as_it_is(c, pair, o, k, at, pace, way) ? bit << lanes * level : 0;
  };
  static_assert(rest_levels == 2);  // no loop within a loop over lanes
  stay |= stays_at(0) | stays_at(1);
  near |= corner_touches_edge(pair, o, c.noise) ? bit : 0;
}

}  // namespace

EDDA_VECTOR OpenLanes open_lanes(const ChunkView& given, const RestMargins& margins, double steps) {
  const ChunkColumns c = columns_of<Tables::constants_alone>(given);
  const RestMargins copy = margins;
  LaneBits stay = 0, near = 0;
#pragma omp simd reduction(| : stay, near)
  for (std::size_t k = 0; k < lanes; ++k) test_open_lane(c, k, copy, steps, stay, near);
  return {near, stay};
}

}  // namespace edda
