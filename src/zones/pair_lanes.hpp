// Eight pairs of zones at once (zone.hpp), where no rock yields.
//
// With b = F_e F_e^T = m 1 + D, r = |D| of its deviator,
//   ln V_e = (ln det F_e) 1/2 + (atanh(r/m)/r) D/2,
// so that principal directions are not needed. Logarithms and atanh are series, for volumes that
// change by less than a fifth and shears of less than a tenth. What is beyond, may yield or has a
// foliation is for evaluate_zones(), pair by pair.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "zones/zone.hpp"

namespace edda {

inline constexpr std::size_t pairs_at_once = 8;
/// Of the pairs of a group.
using OfPairs = std::array<double, pairs_at_once>;

/// Both zones of eight pairs. One by itself has a second one like it, without volume.
struct PairShapes {
  std::array<std::array<OfPairs, 2>, 2> gradient_x, gradient_y;  ///< [zones][g_1 and g_2] 1/m
  std::array<OfPairs, 2> volume;                                 ///< [zones] m3
  OfPairs lambda, mu;                                            ///< Pa
};
/// Where their nodes are, and what they remember.
struct PairInputs {
  std::array<std::array<OfPairs, 3>, 2> x, y;     ///< [zones][nodes] m
  std::array<std::array<OfPairs, 4>, 2> plastic;  ///< [zones] F_p^-1: xx, xy, yx, yy
  std::array<OfPairs, 2> elastic_zz, locked;      ///< [zones]
};
/// As if nothing flowed.
struct PairResults {
  std::array<std::array<OfPairs, 3>, 2> force_x, force_y;  ///< [zones][nodes] N
  std::array<std::array<OfPairs, 4>, 2> remembered;        ///< [zones] ZoneState::stress
  std::array<std::array<OfPairs, 4>, 2> stress;            ///< [zones] ZoneResult::stress
  std::array<OfPairs, 2> mean, square, out_of_plane;  ///< [zones] Kirchhoff, before the mean of
                                                      ///< the pair: in the plane, mean and
                                                      ///< radius of Mohr's circle squared
  OfPairs stored;                                     ///< J
  OfPairs within;                                     ///< 1: the series hold; 0: they do not
};

void set_shape(PairShapes& shapes, std::size_t pair, const std::array<ZoneShape, 2>& shape,
               const IsotropicElasticity& elastic);
void set_inputs(PairInputs& inputs, std::size_t pair, const std::array<std::array<Vec2, 3>, 2>& x,
                const std::array<const ZoneState*, 2>& state);
void evaluate_pairs(const PairShapes& shapes, const PairInputs& inputs, PairResults& results);

/// Whether zone q of the pair may flow, so that evaluate_zones() decides. slip: of a band in it, m.
bool may_flow(const PairResults& results, std::size_t pair, std::size_t q, const ZoneMaterial& rock,
              double slip);

}  // namespace edda
