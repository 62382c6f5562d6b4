#include "sampling/place_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "results/columns.hpp"

namespace edda {
namespace {

constexpr std::string_view letters = "nrk";  // in the order of AtPlace

}  // namespace

AtPlace what_is_at(std::optional<std::size_t> generation, long long generations) {
  if (!generation) return AtPlace::no_rock;
  const bool counts = *generation > 0 && *generation <= static_cast<std::size_t>(generations);
  return counts ? AtPlace::key_block : AtPlace::rock;
}

std::string places_text(std::span<const AtPlace> places) {
  std::string text;
  for (std::size_t i = 0; i < places.size();) {
    std::size_t end = i;
    while (end < places.size() && places[end] == places[i]) ++end;
    text += fmt::format("{}{}", end - i, letters[static_cast<std::size_t>(places[i])]);
    i = end;
  }
  return text;
}

std::vector<AtPlace> places_in(std::string_view text, std::size_t count) {
  std::vector<AtPlace> places;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at != end;) {
    std::size_t many = 0;
    const auto [after, error] = std::from_chars(at, end, many);
    const std::size_t what = after == end ? letters.npos : letters.find(*after);
    if (error != std::errc{} || what == letters.npos || many > count - places.size()) return {};
    places.insert(places.end(), many, static_cast<AtPlace>(what));
    at = after + 1;
  }
  return places.size() == count ? places : std::vector<AtPlace>{};
}

std::size_t KeyBlockMap::most() const {
  return static_cast<std::size_t>(std::max_element(key.begin(), key.end()) - key.begin());
}

KeyBlockMap key_block_map(const StudyPlan& plan, const StudyRun& run) {
  KeyBlockMap map;
  map.places = places_of(*plan.map);
  map.rock.assign(map.places.size(), 0);
  map.key.assign(map.places.size(), 0);
  for (const auto& [sample, answer] : run.rows) {
    if (sample >= run.samples) continue;
    const std::vector<AtPlace> there = places_in(answer.cells.back(), map.places.size());
    if (there.empty()) continue;
    ++map.samples;
    for (std::size_t i = 0; i < there.size(); ++i) {
      map.rock[i] += there[i] != AtPlace::no_rock;
      map.key[i] += there[i] == AtPlace::key_block;
    }
  }
  return map;
}

std::string map_csv(const KeyBlockMap& map) {
  Csv csv = begin_table(ResultFile::map);
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    if (map.rock[i] == 0) continue;
    csv.add(map.places[i].x).add(map.places[i].y).add(map.rock[i]).add(map.key[i]);
    csv.add(map.part(i)).end();
  }
  return csv.text();
}

}  // namespace edda
