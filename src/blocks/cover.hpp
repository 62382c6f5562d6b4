// Covers: the patch nodes, three of them, that carry a block (theory, sections 1 and 2).
#pragma once

#include <array>
#include <span>

#include "base/polygon.hpp"
#include "blocks/nodes.hpp"

namespace edda {

using Cover = NodeVectors;  ///< node positions X_k, counter-clockwise, m

/// The cover whose consistent mass matrix is M/3 times the identity: X_k = C + A e_k,
/// A = sqrt(2 S / M), with S/M the second moments per area about the centroid C and e_k the unit
/// equilateral triangle (theory, section 2.2). Needs a region of positive area.
Cover matched_cover(const Moments& m);

/// The paper's cover (Fig. 1): the smallest equilateral triangle centred on the centroid that
/// contains `ring` (theory, section 2.3).
Cover covering_cover(std::span<const Vec2> ring, Vec2 centroid);

/// Gradients G_k of the area coordinates w_k of a triangle (Eq. 22), 1/m.
NodeVectors gradients(const Cover& cover);

/// Consistent mass matrix of Eq. 23 per unit mass, entries 11 12 13 22 23 33:
/// integral of w_k w_l / area = w_k(C) w_l(C) + G_k . (S/M) G_l. `centroid_weight` is w_k(C).
std::array<double, 6> consistent_mass(const Moments& m, const NodeVectors& gradient,
                                      const NodeWeights& centroid_weight);

/// Inverse of a symmetric positive definite 3 x 3 matrix in the same packing.
std::array<double, 6> inverse_symmetric(const std::array<double, 6>& a);

}  // namespace edda
