// The location of each face of a cut: in rock, in an opening, in a region, or outside.
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "cutting/face_polygons.hpp"
#include "cutting/line_work.hpp"
#include "cutting/planar_graph.hpp"
#include "model/model.hpp"

namespace edda {

/// The faces and their locations.
struct Partition {
  Faces faces;
  std::vector<Zone> zone;
  std::vector<Index> opening;  ///< of lowest number; none outside openings
  std::vector<int> rock;       ///< -1 where there is no rock; 0 in rock, 1 + opening in rock of an
                          ///< opening that a stage excavates; only faces of one number are merged
};

/// Finds the faces and their locations. `framed`: the outline is only a box around lines that bound
/// the blocks themselves; faces that touch it lie outside. Faults: the outline is interrupted, or
/// an opening lies outside it.
Result<Partition> partition(const Model& model, const PlanarGraph& graph, Cycles cycles,
                            const LineWork& work, bool framed);

/// The region on the left of each half-edge: the last of those that contain it, or none; empty
/// where the model has no regions. Fault: a region that lies wholly outside the domain.
Result<std::vector<Index>> regions_of_half_edges(const Model& model, const PlanarGraph& graph,
                                                 const Partition& parts, const LineWork& work);

/// The region of a face: that of the longest part of its boundary. Faces are merged across a
/// region's outline only where they are thinner than domain.snap, so the rest is negligible.
Index region_of(const PlanarGraph& graph, const Faces& faces, int face,
                const std::vector<Index>& of_half_edges);

long long count(const Partition& parts, Zone zone);

}  // namespace edda
