// Covers: the three patch nodes that carry a block (method.md sections 1 and 2).
#pragma once

#include <array>
#include <span>

#include "base/polygon.hpp"
#include "base/vec2.hpp"

namespace edda {

using Cover = std::array<Vec2, 3>;  ///< node positions X_k, counter-clockwise, m

/// The cover whose consistent mass matrix is (M/3) times the identity:
/// X_k = C + A e_k, A = sqrt(2 S / M), S/M the second moments per area about the centroid C, e_k
/// the unit equilateral triangle (method.md section 2, `matched`). Needs a region of positive area.
Cover matched_cover(const Moments& m);

/// The paper's cover (Fig. 1): an equilateral triangle centred on the centroid that contains
/// `ring`, of its orientations the one of least circumradius (method.md section 2, `covering`).
Cover covering_cover(std::span<const Vec2> ring, Vec2 centroid);

/// Gradients G_k of the area coordinates w_k of a triangle (Eq. 22), 1/m.
std::array<Vec2, 3> gradients(const Cover& cover);

/// Consistent mass matrix of Eq. 23 per unit mass, entries 11 12 13 22 23 33:
/// integral of w_k w_l / area = w_k(C) w_l(C) + G_k . (S/M) G_l. `centroid_weight` is w_k(C).
std::array<double, 6> consistent_mass(const Moments& m, const std::array<Vec2, 3>& gradient,
                                      const std::array<double, 3>& centroid_weight);

/// Inverse of a symmetric positive definite 3 x 3 matrix in the same packing.
std::array<double, 6> inverse_symmetric(const std::array<double, 6>& a);

}  // namespace edda
