// Where each face of a cut lies: in rock, in an opening, in a region, outside.
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "lines/face_polygons.hpp"
#include "lines/line_work.hpp"
#include "lines/planar_graph.hpp"
#include "model/model.hpp"

namespace edda {

/// The faces and where each lies.
struct Partition {
  Faces faces;
  std::vector<Zone> zone;
  std::vector<Index> opening;  ///< of lowest number; none outside openings
  std::vector<int> rock;       ///< -1 where there is no rock; 0 in rock, 1 + opening in that of an
                               ///< opening that a stage takes out: what is merged is of one number
};

/// Faces found and laid to a zone. `framed`: the outline is but a box round lines that bound the
/// blocks themselves; what touches it lies outside. Faults: the outline has come apart, or an
/// opening lies outside it.
Result<Partition> partition(const Model& model, const PlanarGraph& graph, Cycles cycles,
                            const LineWork& work, bool framed);

/// The region on the left of each half-edge: the last of those that hold it, or none; empty where
/// the model has no regions. Fault: a region that lies wholly outside the domain.
Result<std::vector<Index>> regions_of_half_edges(const Model& model, const PlanarGraph& graph,
                                                 const Partition& parts, const LineWork& work);

/// The region of a face: that of the longest part of its boundary. Faces are merged across a
/// region's outline only where they are thinner than domain.snap, so hardly anything else is there.
Index region_of(const PlanarGraph& graph, const Faces& faces, int face,
                const std::vector<Index>& of_half_edges);

long long count(const Partition& parts, Zone zone);

}  // namespace edda
