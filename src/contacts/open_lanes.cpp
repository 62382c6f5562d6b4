#include <cmath>

#include "contacts/chunk_columns.hpp"
#include "contacts/face_parts.hpp"

namespace edda {
namespace {

/// Whether nothing of a face can change that carries nothing: its gate was shut and remains so; or
/// it was open and remains so, and the surfaces apart. Both edges and the vectors between their
/// corners change by at most `relative` (r below); |g| is the length of E - F with both edges over
/// their lengths.
///   The sine of the angle by which the frame turns is at most r (1/le + 1/lf)/|g|, and so a
///   coordinate s along it changes by at most r + (L + r) times about that, where no corner lies
///   farther from p1 than L; the ends of the overlap by the same, its length by twice that. Where
///   all of f lies beyond all of e by more than r along n, their surfaces stay apart as long as n
///   turns by less than a right angle.
EDDA_INLINE bool stays_as_it_is(const ChunkColumns& c, const FacePair& pair, const EdgeGeometry& o,
                                std::size_t k, double relative) {
  const double change = relative * (pair.inverse_e + pair.inverse_f);  // of g
  const double turn = 1.1 * change * o.per_base;                       // of t, no more than this
  const auto far_from_p1 = [](double s, double y) { return std::abs(s) + std::abs(y); };
  const double farthest =
      larger(far_from_p1(o.s2, o.y2), larger(far_from_p1(o.r1, o.z1), far_from_p1(o.r2, o.z2)));
  const double shift = relative + (farthest + relative) * turn;
  constexpr double stretch = 1.5;  // the cosine is that of edges stretched by less than this
  const double overlap = o.mb - o.ma, faces_by = o.cosine - pair.gate_from;
  const bool firm = (turn < 0.5) & (change < 0.25);
  const bool shut = (change < 0.25) & (faces_by + stretch * change < 0.0);
  const bool beside = firm & (overlap + 2.0 * shift < 0.0);
  const bool opposed = firm & (faces_by - stretch * change > 0.0) & (o.s2 > shift) &
                       (o.r1 - o.r2 > 2.0 * shift) & (overlap > 2.0 * shift);
  const double gap = smaller(o.z1, o.z2) - positive_part(o.y2);
  const double locked = positive_part(larger(pair.offset.a, pair.offset.b));
  const bool open = opposed & (gap > relative + locked) & (pair.stiffness > 0.0);
  const bool loose = (c.bonded[k] == 0.0) & (pair.carries_tension == 0.0);
  const bool was_off = (c.was & (bit_of_lane[k] << lane_bits::on)) == 0;
  return loose & ((was_off & (shut | beside)) | ((was_off == 0) & open));
}

/// Half of the largest distance that any two of these points can have at most.
EDDA_INLINE double apart(const FacePoints& p) {
  const auto square = [&](Vec2 v) { return dot(v - p.p1, v - p.p1); };
  return std::sqrt(larger(square(p.p2), larger(square(p.q1), square(p.q2))));
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
    const EdgeGeometry o = geometry_of_edges(points_of(*c.e, *c.f, k), pair);
    const LaneBits bit = bit_of_lane[k];
    const double relative = 2.0 * (margin + steps * apart(points_of(*c.e_then, *c.f_then, k)));
    stay |= stays_as_it_is(c, pair, o, k, relative) ? bit : 0;
    near |= touches_as_drawn(pair, o, c.noise) ? bit : 0;
  }
  return {static_cast<unsigned>(near), static_cast<unsigned>(stay)};
}

}  // namespace edda
