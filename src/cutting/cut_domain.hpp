// The domain cut into blocks by its line work (theory, section 15.1).
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"
#include "imports/imports.hpp"
#include "model/model.hpp"

namespace edda {

struct DomainCut {
  std::vector<BlockPolygon> blocks;   ///< rock, by centroid (y, then x); m, local
  std::vector<BlockPolygon> removed;  ///< rock inside openings, likewise
  std::vector<std::string> tables;    ///< PolygonSet::tables
  CutReport report;                   ///< all but the smallest_* members
};

/// Cuts model.domain relative to `origin`: line work, noding, faces, trimming, slivers, polygons.
/// Faults as in build_polygons(). `framed`: model.domain is the frame_of() the imports.
/// Precondition: model.domain is set.
Result<DomainCut> cut_domain(const Model& model, Vec2 origin, const Imports& imports, bool framed);

/// domain.snap, or its default where the model leaves it at 0; m. Precondition: model.domain is
/// set.
double snap_of(const Model& model);

}  // namespace edda
