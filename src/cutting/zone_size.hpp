// How large the zones of meshed blocks are ([zones] of the model).
#pragma once

#include "cutting/mesh.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

class ZoneSizes {
 public:
  /// Keeps references to both.
  ZoneSizes(const Model& model, const PolygonSet& polygons);

  /// Size in a block: that of the model or of its material, larger with the distance from the
  /// openings; half the width of the block at most, but not less than an eighth of that size.
  MeshSize of(const BlockPolygon& block) const;

 private:
  double distance_from_openings(Vec2 point) const;

  const Model& model_;
  Vec2 origin_;
  double size_, growth_;
};

}  // namespace edda
