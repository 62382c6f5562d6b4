#include "cutting/snapping.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace edda {
namespace {

using geos::geom::Coordinate;
using geos::noding::NodedSegmentString;
using geos::noding::SegmentString;

/// One segment of a string.
struct Part {
  NodedSegmentString* string;
  std::size_t number;

  const Coordinate& start() const { return string->getCoordinate(number); }
  const Coordinate& end() const { return string->getCoordinate(number + 1); }
  void add_node(const Coordinate& p) const { string->addIntersection(p, number); }
};

/// Whether two segments follow each other on one string, so that they share a vertex.
bool adjacent(const Part& s, const Part& t) {
  if (s.string != t.string) return false;
  const std::size_t low = std::min(s.number, t.number), high = std::max(s.number, t.number);
  return high - low == 1 || (s.string->isClosed() && low == 0 && high + 2 == s.string->size());
}

/// A vertex p of s that lies near t, but near neither of its ends: those have been snapped already.
void add_near_vertex(const Part& s, const Coordinate& p, const Part& t, double tolerance) {
  if (p.distance(t.start()) < tolerance || p.distance(t.end()) < tolerance) return;
  if (geos::algorithm::Distance::pointToSegment(p, t.start(), t.end()) >= tolerance) return;
  t.add_node(p);
  s.add_node(p);
}

}  // namespace

std::size_t SnapPoints::Hash::operator()(const Cell& cell) const {
  std::uint64_t h = std::bit_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15ULL ^
                    std::bit_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4fULL;
  h ^= h >> 29U;
  return static_cast<std::size_t>(h * 0xbf58476d1ce4e5b9ULL >> 16U);
}

/// A whole number, never -0; a double, since lines may extend beyond the range of integers.
double SnapPoints::index(double u) const {
  constexpr double cell =
      4.0;  // in tolerances; for most points only one cell then has to be searched
  return std::floor(u / (cell * tolerance_)) + 0.0;
}

const Coordinate* SnapPoints::nearest(const Coordinate& p) const {
  const double left = index(p.x - tolerance_), right = index(p.x + tolerance_);
  const double low = index(p.y - tolerance_), high = index(p.y + tolerance_);
  const Coordinate* best = nullptr;
  const auto look_into = [&](double x, double y) {
    const auto [from, to] = points_.equal_range({x, y});
    for (auto it = from; it != to; ++it) {
      const Coordinate& q = it->second;
      const double d = p.distance(q);
      if (d > tolerance_) continue;
      const double least = best == nullptr ? d : p.distance(*best);
      if (best == nullptr || d < least || (d == least && q.compareTo(*best) < 0)) best = &q;
    }
  };
  look_into(left, low);
  if (right != left) look_into(right, low);
  if (high != low) look_into(left, high);
  if (right != left && high != low) look_into(right, high);
  return best;
}

Coordinate SnapPoints::snap(const Coordinate& p) {
  if (const Coordinate* known = nearest(p)) return *known;
  points_.insert({{index(p.x), index(p.y)}, p});
  return p;
}

void SnappingAdder::processIntersections(SegmentString* a, std::size_t i, SegmentString* b,
                                         std::size_t j) {
  if (a == b && i == j) return;
  const Part s{static_cast<NodedSegmentString*>(a), i}, t{static_cast<NodedSegmentString*>(b), j};
  if (!adjacent(s, t)) {
    meeting_.computeIntersection(s.start(), s.end(), t.start(), t.end());
    // Where segments coincide, the ends of both are near vertices.
    if (meeting_.hasIntersection() && meeting_.getIntersectionNum() == 1) {
      const Coordinate node = points_.snap(meeting_.getIntersection(0));
      s.add_node(node);
      t.add_node(node);
    }
  }
  add_near_vertex(s, s.start(), t, tolerance_);
  add_near_vertex(s, s.end(), t, tolerance_);
  add_near_vertex(t, t.start(), s, tolerance_);
  add_near_vertex(t, t.end(), s, tolerance_);
}

}  // namespace edda
