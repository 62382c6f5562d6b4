// [map] of a study's file.
#include <fmt/format.h>

#include <algorithm>

#include "model/study/complete_study.hpp"
#include "model/study/study_keys.hpp"

namespace edda {
namespace {

struct Extent {
  Vec2 lowest, highest;
};

Extent extent_of(const Ring& ring) {
  Extent e{ring.front(), ring.front()};
  for (const Vec2 p : ring) {
    e.lowest = {std::min(e.lowest.x, p.x), std::min(e.lowest.y, p.y)};
    e.highest = {std::max(e.highest.x, p.x), std::max(e.highest.y, p.y)};
  }
  return e;
}

}  // namespace

std::vector<Vec2> places_of(const StudyMap& map) {
  const auto [lowest, highest] = extent_of(map.region);
  std::vector<Vec2> places;
  for (double j = 0.5; lowest.y + j * map.spacing < highest.y; j += 1.0) {
    for (double i = 0.5; lowest.x + i * map.spacing < highest.x; i += 1.0) {
      const Vec2 place = lowest + map.spacing * Vec2{i, j};
      if (side_of({&map.region, 1}, place, 0.0) >= 0) places.push_back(place);
    }
  }
  return places;
}

void complete_map(const Completing& c) {
  if (!c.plan.map || !c.reading.faults.empty()) return;
  const StudyMap& map = *c.plan.map;
  const Value* table = find(&c.root, "map");
  const auto wrong = [&](std::string_view key, const std::string& problem,
                         const std::string& remedy) {
    c.fault(table, key, "map", problem, remedy);
  };
  const auto [lowest, highest] = extent_of(map.region);
  const Vec2 size = (1.0 / map.spacing) * (highest - lowest);
  constexpr double most_looked_at = 100.0 * most_places;
  const double all = size.x * size.y;
  const double count = all > most_looked_at ? all : static_cast<double>(places_of(map).size());
  if (count > most_places) {
    wrong("spacing", fmt::format("makes {:.0f} places", count),
          fmt::format("choose a larger one, or a smaller region: at most {:.0f} places",
                      most_places));
  } else if (count == 0.0) {
    wrong("spacing", "leaves no place in the region", "choose a smaller one");
  }
  const auto asks = [](const Ask& a) { return a.of == Analysis::keyblocks; };
  if (std::none_of(c.plan.ask.begin(), c.plan.ask.end(), asks))
    wrong("spacing", "makes a map of key blocks, and no [ask] is of them",
          "add an [ask] with of = \"keyblocks\"");
  if (!is_random(c.plan.sampling.method))
    wrong("spacing",
          fmt::format("makes a map, which does not go with method {}",
                      word_of(c.plan.sampling.method)),
          "use monte-carlo, latin-hypercube or sobol, of which parts are probabilities");
}

}  // namespace edda
