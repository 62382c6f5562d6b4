// The initial stress of the ground, as a field over the plane (theory, section 3.3).
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// Two forces at the ends of a part of a face, N, with the resultant and the moment of the traction
/// over it. A block of constant strain feels nothing else of a traction.
struct EndForces {
  Vec2 at_from, at_to;
};

/// The field of [initial_stress]. Either sigma(y) = stress + (y - at_y) gradient, or the
/// overburden: syy = -integral of rho |g| from y to the surface, sxx = k0 syy, sxy = 0. The
/// densities are those of the domain and its regions (openings count as the rock before
/// excavation), or of given blocks where there is no domain. Outside of these a point has the
/// density of the rock below it in the column, below all rock that of the lowest, and in a column
/// without rock that of the first body.
class StressField {
 public:
  /// Precondition: model.initial_stress. `origin`: origin of the local coordinates.
  StressField(const Model& model, Vec2 origin);

  /// Total stress at a point, local coordinates, Pa, positive in tension.
  Tensor at(Vec2 point) const;

 private:
  struct Body {
    const Ring* ring;
    double density;
  };
  /// Weight per area of the overburden, Pa.
  double overburden(Vec2 point) const;
  double column(double x, double y) const;

  const Model* model_;
  Vec2 origin_;
  std::vector<Body> bodies_;       ///< where they overlap, the last one counts
  std::vector<Ring> rings_;        ///< outlines of brick walls, each as one body
  double low_ = 0.0, high_ = 0.0;  ///< m, extent in x
};

/// Out-of-plane stress at the start where the stress in the plane is t, Pa: k0_out syy, without
/// k0_out nu (sxx + syy), and 0 in plane stress.
double out_of_plane_stress(const Model& model, const Material& material, const Tensor& t);

/// Fills BlockSet::initial_* with the field's value at each block's centroid.
void set_initial_stress(BlockSet& blocks, const Model& model, const StressField& field);

/// Initial stress of block i, Pa; 0 where there is none.
inline Tensor initial_stress(const BlockSet& b, std::size_t i) {
  if (b.initial_xx.empty()) return {};
  return {b.initial_xx[i], b.initial_yy[i], b.initial_xy[i]};
}

}  // namespace edda
