#include <cmath>

#include "contacts/chunk_columns.hpp"
#include "contacts/face_parts.hpp"

namespace edda {
namespace {

/// The corners of two edges on their way: where they are, how far each comes in a step, and by how
/// much it may stray from there at any time in so many steps, m.
struct OnTheWay {
  FacePoints at, pace;
  double steps, margin;

  /// Least value of n . (b - a) on the way, n of length 1: on straight paths that of the beginning
  /// or of the end.
  EDDA_INLINE double least_along(Vec2 n, Vec2 FacePoints::*a, Vec2 FacePoints::*b) const {
    const Vec2 w = at.*b - at.*a, end = w + steps * (pace.*b - pace.*a);
    return smaller(dot(n, w), dot(n, end)) - 2.0 * margin;
  }
  /// Upper bound of the length of b - a on the way.
  EDDA_INLINE double longest(Vec2 FacePoints::*a, Vec2 FacePoints::*b) const {
    const Vec2 w = at.*b - at.*a, end = w + steps * (pace.*b - pace.*a);
    return larger(std::abs(w.x), std::abs(end.x)) + larger(std::abs(w.y), std::abs(end.y)) +
           2.0 * margin;
  }
  /// Upper bound of the change of b - a on the way.
  EDDA_INLINE double change(Vec2 FacePoints::*a, Vec2 FacePoints::*b) const {
    const Vec2 by = pace.*b - pace.*a;
    return steps * (std::abs(by.x) + std::abs(by.y)) + 2.0 * margin;
  }
};

/// Whether nothing can change, on the way, of a face that carries nothing: its gate was shut and
/// remains so; or it was open and remains so, and the surfaces apart. With the length |g| of E - F,
/// both edges over their lengths, the sine of the angle by which the frame turns is at most that by
/// which g changes, over |g|; so a vector along t changes by its length times about that beside its
/// own change. The edges do not overlap as long as p2 lies before q2 along t, or q1 before p1.
/// Where all of f lies beyond all of e along n, their surfaces stay apart as long as n turns by
/// less than a right angle.
EDDA_INLINE bool stays_as_it_is(const ChunkColumns& c, const FacePair& pair, const EdgeGeometry& o,
                                std::size_t k, const OnTheWay& way) {
  using P = FacePoints;
  const double change = way.change(&P::p1, &P::p2) * pair.inverse_e +
                        way.change(&P::q1, &P::q2) * pair.inverse_f;  // of g
  const double turn =
      1.1 * change * o.per_base;  // of t: an angle below 0.5 is 1.1 times its sine at most
  const Vec2 t{o.tx, o.ty}, n = outward_normal(t);
  const auto lies_before = [&](Vec2 P::*a, Vec2 P::*b) {  // along t, all the way
    return way.least_along(t, a, b) > turn * way.longest(a, b);
  };
  constexpr double stretch = 1.5;  // the cosine is that of edges stretched by less than this
  const double faces_by = o.cosine - pair.gate_from;
  const bool firm = (turn < 0.5) & (change < 0.25);
  const bool shut = (change < 0.25) & (faces_by + stretch * change < 0.0);
  const bool past_e = lies_before(&P::p2, &P::q2), short_of_e = lies_before(&P::q1, &P::p1);
  const bool beside = firm & (past_e | short_of_e);
  const bool e_goes_on = lies_before(&P::p1, &P::p2), f_goes_back = lies_before(&P::q2, &P::q1);
  const bool begins = lies_before(&P::q2, &P::p2), ends = lies_before(&P::p1, &P::q1);
  const bool opposed =
      firm & (faces_by - stretch * change > 0.0) & e_goes_on & f_goes_back & begins & ends;
  const double gap =
      smaller(smaller(way.least_along(n, &P::p1, &P::q1), way.least_along(n, &P::p2, &P::q1)),
              smaller(way.least_along(n, &P::p1, &P::q2), way.least_along(n, &P::p2, &P::q2)));
  const double locked = positive_part(larger(pair.offset.a, pair.offset.b));
  const bool open = opposed & (gap > locked) & (pair.stiffness > 0.0);
  const bool loose = (c.bonded[k] == 0.0) & (pair.carries_tension == 0.0);
  const bool was_off = (c.was & (bit_of_lane[k] << lane_bits::on)) == 0;
  return loose & ((was_off & (shut | beside)) | ((was_off == 0) & open));
}

/// Whether the edges are opposed and a corner touches the other edge, to rounding.
EDDA_INLINE bool touches_as_drawn(const FacePair& pair, const EdgeGeometry& o, double noise) {
  const double most = larger(pair.offset.a + o.closure_at_0 + o.closure_slope * o.ma,
                             pair.offset.b + o.closure_at_0 + o.closure_slope * o.mb);
  return (o.cosine > pair.gate_from) & (o.mb > o.ma) & (most > -noise);
}

}  // namespace

EDDA_VECTOR OpenLanes open_lanes(const ChunkView& given, double margin, double steps) {
  const ChunkColumns c = columns_of<Tables::constants_alone>(given);
  LaneBits stay = 0, near = 0;
#pragma omp simd reduction(| : stay, near)
  for (std::size_t k = 0; k < lanes; ++k) {
    const FacePair pair = pair_of(c, k);
    const OnTheWay way{points_of(*c.e, *c.f, k), points_of(*c.e_then, *c.f_then, k), steps, margin};
    const EdgeGeometry o = geometry_of_edges(way.at, pair);
    const LaneBits bit = bit_of_lane[k];
    stay |= stays_as_it_is(c, pair, o, k, way) ? bit : 0;
    near |= touches_as_drawn(pair, o, c.noise) ? bit : 0;
  }
  return {static_cast<unsigned>(near), static_cast<unsigned>(stay)};
}

}  // namespace edda
