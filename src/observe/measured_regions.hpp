// Mean stress and strain of a region, such as a sample between platens ([[measurement]];
// docs/loading.md).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "blocks/block_point.hpp"
#include "observe/observe.hpp"

namespace edda {

/// A piece of the outline that lies in one block, or in none, where there is a void.
struct OutlinePiece {
  struct InBlock {
    BlockPoint from, middle, to;
  };
  Vec2 from, to;  ///< at the start, m
  std::optional<InBlock> in;
};

/// A region of the model at the start, and what lies in it.
struct MeasuredRegion {
  std::string name;
  double area = 0.0;                                   ///< m2
  std::vector<std::pair<std::size_t, double>> blocks;  ///< those that are not meshed, with their
                                                       ///< area inside, m2
  struct ZonePart {
    std::size_t block = 0, zone = 0;
    double area = 0.0;  ///< m2
  };
  std::vector<ZonePart> zones;        ///< of meshed blocks
  std::vector<OutlinePiece> outline;  ///< in sequence, counter-clockwise
};

/// A fault for each whose outline has a corner in no block.
Result<std::vector<MeasuredRegion>> place_measurements(const Simulation& sim);

struct MeanState {
  BlockStress stress;  ///< Pa, positive in tension
  Tensor strain;       ///< positive in extension; xy is half the angle of shear
};

/// Mean stress, sum_k A_k sigma_k / A over the blocks and zones in the region of area A, so that
/// voids and excavated blocks count without stress; and mean strain, by Gauss's theorem
///   (1/A) oint (u n^T + n u^T)/2 ds
/// over the outline at the start, with what joints have opened and slipped, u being the
/// displacement since the start or the last reset. A void is crossed in a straight line along which
/// u varies linearly.
MeanState mean_state(const Simulation& sim, const Instant& at, const MeasuredRegion& region);

}  // namespace edda
