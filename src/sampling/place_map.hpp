// How often each place of a map belongs to a key block.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sampling/lead_study.hpp"

namespace edda {

enum class AtPlace { no_rock, rock, key_block };
/// generation: as KeyBlocks::at_place; those up to `generations` count.
AtPlace what_is_at(std::optional<std::size_t> generation, long long generations);

/// What is at the places of a sample, as its cell has it: how many of them in turn are n (no rock),
/// r (rock) or k (in a key block), "12n30r4k".
std::string places_text(std::span<const AtPlace> places);
/// And back; empty where the text is of another number of places.
std::vector<AtPlace> places_in(std::string_view text, std::size_t count);

struct KeyBlockMap {
  std::vector<Vec2> places;       ///< m, of StudyPlan::map
  std::vector<std::size_t> rock,  ///< [places] samples in which there is rock
      key;                        ///< those in which it belongs to a key block
  std::size_t samples = 0;        ///< that have an answer
  double part(std::size_t place) const {
    return samples > 0 ? static_cast<double>(key[place]) / static_cast<double>(samples) : 0.0;
  }
  /// The place that most often belongs to one.
  std::size_t most() const;
};

/// plan.map must be there.
KeyBlockMap key_block_map(const StudyPlan& plan, const StudyRun& run);

/// key_block_map.csv: the places where there is rock in any sample.
std::string map_csv(const KeyBlockMap& map);

}  // namespace edda
