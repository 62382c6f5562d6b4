// The stress in the ground at the start, as a field over the plane.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// Two forces at the ends of a part of a face, N: with the resultant and the moment of what is
/// spread over it. In a block of constant strain nothing else of it is felt.
struct EndForces {
  Vec2 at_from, at_to;
};

/// Of [initial_stress]. Either sigma(y) = stress + (y - at_y) gradient, or the weight of the rock
/// above, syy = -integral of rho |g| from y to the surface, sxx = k0 syy, sxy = 0. The densities
/// are those of the domain and its regions (openings count as rock that was there before them), of
/// given blocks where there is no domain; what lies above or beside all of them is as dense as the
/// rock next to it in the column.
class StressField {
 public:
  /// Precondition: model.initial_stress. `origin`: of the local coordinates.
  StressField(const Model& model, Vec2 origin);

  /// Total stress at a point, local coordinates, Pa, positive in tension.
  Tensor at(Vec2 point) const;

 private:
  struct Body {
    const Ring* ring;
    double density;
  };
  /// Weight per area of the rock above, Pa.
  double overburden(Vec2 point) const;
  double column(double x, double y) const;

  const Model* model_;
  Vec2 origin_;
  std::vector<Body> bodies_;       ///< later ones count where they overlap
  std::vector<Ring> rings_;        ///< of walls: bricks as one
  double low_ = 0.0, high_ = 0.0;  ///< m, extent in x
};

/// Fills BlockSet::initial_*: the field's value at each block's centroid. Out of the plane k0_out
/// syy, else nu (sxx + syy), 0 in plane stress.
void set_initial_stress(BlockSet& blocks, const Model& model, const StressField& field);

/// Of block i, Pa; 0 where there is none.
inline Tensor initial_stress(const BlockSet& b, std::size_t i) {
  if (b.initial_xx.empty()) return {};
  return {b.initial_xx[i], b.initial_yy[i], b.initial_xy[i]};
}

}  // namespace edda
