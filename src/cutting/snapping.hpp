// Noding with a tolerance. It has the rules of GEOS's SnappingNoder and gives the same bits; that
// noder keeps its points in a search tree, which degenerates to a list for the rows of points that
// joint sets make.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "cutting/geos.hpp"

namespace edda {

/// Points of which no two lie within a tolerance of each other.
class SnapPoints {
 public:
  explicit SnapPoints(double tolerance) : tolerance_(tolerance) {}
  /// The nearest point within the tolerance, of two the smaller one; else p itself, which is added.
  /// O(1).
  geos::geom::Coordinate snap(const geos::geom::Coordinate& p);

 private:
  struct Cell {
    double x, y;  ///< whole numbers
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  double index(double u) const;
  const geos::geom::Coordinate* nearest(const geos::geom::Coordinate& p) const;

  double tolerance_;
  std::unordered_multimap<Cell, geos::geom::Coordinate, Hash> points_;
};

/// Adds a node where two segments cross and where a vertex lies within the tolerance of a segment.
class SnappingAdder : public geos::noding::SegmentIntersector {
 public:
  SnappingAdder(double tolerance, SnapPoints& points) : tolerance_(tolerance), points_(points) {}
  void processIntersections(geos::noding::SegmentString* a, std::size_t i,
                            geos::noding::SegmentString* b, std::size_t j) override;

 private:
  double tolerance_;
  SnapPoints& points_;
  geos::algorithm::LineIntersector meeting_;
};

}  // namespace edda
