// The parts of GEOS used here; its headers do not compile without warnings under our flags. GEOS
// promises its C interface alone, which has no noding with sources. What differs between the
// versions of Debian 12 (3.11), Ubuntu 24.04 (3.12) and Debian 13 (3.13) is settled at the end.
#pragma once

#include <memory>
#include <utility>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wdeprecated-copy"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#endif
#include <geos/algorithm/Distance.h>
#include <geos/algorithm/LineIntersector.h>
#include <geos/algorithm/Orientation.h>
#include <geos/geom/Coordinate.h>
#include <geos/version.h>
#if GEOS_VERSION_MAJOR > 3 || GEOS_VERSION_MINOR >= 12
#include <geos/geom/CoordinateSequence.h>
#else
#include <geos/geom/CoordinateArraySequence.h>
#endif
#include <geos/geom/Envelope.h>
#include <geos/geom/Geometry.h>
#include <geos/geom/GeometryFactory.h>
#include <geos/geom/LinearRing.h>
#include <geos/geom/Polygon.h>
#include <geos/geom/PrecisionModel.h>
#include <geos/index/strtree/TemplateSTRtree.h>
#include <geos/noding/FastNodingValidator.h>
#include <geos/noding/MCIndexNoder.h>
#include <geos/noding/NodedSegmentString.h>
#include <geos/noding/SegmentIntersector.h>
#include <geos/noding/snapround/SnapRoundingNoder.h>
#include <geos/triangulate/VoronoiDiagramBuilder.h>
#include <geos/triangulate/polygon/ConstrainedDelaunayTriangulator.h>
#pragma GCC diagnostic pop

namespace edda {

#if GEOS_VERSION_MAJOR > 3 || GEOS_VERSION_MINOR >= 12
using GeosPoints = geos::geom::CoordinateSequence;

inline geos::noding::NodedSegmentString* noded_string(std::unique_ptr<GeosPoints> points,
                                                      const void* data) {
  return new geos::noding::NodedSegmentString(points.release(), false, false, data);
}
#else
using GeosPoints = geos::geom::CoordinateArraySequence;

/// A string to be noded; the caller owns it.
inline geos::noding::NodedSegmentString* noded_string(std::unique_ptr<GeosPoints> points,
                                                      const void* data) {
  return new geos::noding::NodedSegmentString(points.release(), data);
}
#endif

}  // namespace edda
