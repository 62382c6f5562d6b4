// Notation: a corner is a vertex that must stay (the law changes, or the ring turns by 90 degrees
// or more); a run goes from one kept vertex to the next; its chord is the edge that would replace
// it. Runs are split at the vertex farthest from the chord until all are within tolerance (Douglas
// and Peucker 1973), so that errors do not add up along a run. Distances are to the chord itself,
// not to its line.
#include "cutting/straight_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace edda {
namespace {

struct Run {
  std::size_t from, to;  ///< vertices; to > from, both taken modulo the ring's size
};

struct Departure {
  std::size_t vertex = 0;
  double amount = -1.0;
  bool straight() const { return amount < 1.0; }
};

/// The largest deviation within a run.
Departure departure(const Ring& ring, Run run, double tolerance) {
  const std::size_t n = ring.size();
  const Vec2 a = ring[run.from % n], b = ring[run.to % n];
  Departure largest;
  for (std::size_t i = run.from + 1; i < run.to; ++i) {
    const Vec2 p = ring[i % n];
    const double d = distance_to_segment(p, a, b);
    const double amount = std::max(d / tolerance, 8.0 * d / std::min(norm(p - a), norm(p - b)));
    if (amount > largest.amount) largest = {i, amount};
  }
  return largest;
}

std::vector<std::uint8_t> corners(const Ring& ring, const std::vector<Index>& law) {
  const std::size_t n = ring.size();
  std::vector<std::uint8_t> corner(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const Vec2 in = ring[i] - ring[before], out = ring[(i + 1) % n] - ring[i];
    corner[i] = law[before] != law[i] || dot(in, out) <= 0.0;
  }
  return corner;
}

/// Whether the ring is so thin that the tolerance is no longer small beside its width (2 area /
/// perimeter).
bool is_thin(const Ring& ring, double tolerance) {
  double perimeter = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    perimeter += norm(ring[(i + 1) % ring.size()] - ring[i]);
  }
  return 2.0 * std::abs(signed_area(ring)) < 4.0 * tolerance * perimeter;
}

bool anything_straight(const Ring& ring, const std::vector<std::uint8_t>& corner,
                       double tolerance) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (corner[i]) continue;
    if (departure(ring, {i + n - 1, i + n + 1}, tolerance).straight()) return true;
  }
  return false;
}

std::size_t farthest_vertex(const Ring& ring, Vec2 p) {
  const auto nearer = [&](Vec2 a, Vec2 b) { return norm(a - p) < norm(b - p); };
  return static_cast<std::size_t>(std::max_element(ring.begin(), ring.end(), nearer) -
                                  ring.begin());
}

/// The vertices where runs begin: the corners, and where there are fewer than two, further ones.
std::vector<std::uint8_t> first_kept(const Ring& ring, std::vector<std::uint8_t> kept) {
  const auto count = std::count(kept.begin(), kept.end(), std::uint8_t{1});
  if (count >= 2) return kept;
  const auto corner = std::find(kept.begin(), kept.end(), std::uint8_t{1});
  std::size_t first = static_cast<std::size_t>(corner - kept.begin());
  if (count == 0) first = farthest_vertex(ring, ring[0]);
  kept[first] = kept[farthest_vertex(ring, ring[first])] = 1;
  return kept;
}

std::size_t next_kept(const std::vector<std::uint8_t>& kept, std::size_t i) {
  const std::size_t n = kept.size();
  do ++i;
  while (!kept[i % n]);
  return i;
}

void split_runs(const Ring& ring, std::vector<std::uint8_t>& kept, double tolerance) {
  const std::size_t n = ring.size();
  std::vector<Run> waiting;
  for (std::size_t i = 0; i < n; ++i) {
    if (kept[i]) waiting.push_back({i, next_kept(kept, i)});
  }
  while (!waiting.empty()) {
    const Run run = waiting.back();
    waiting.pop_back();
    const Departure most = departure(ring, run, tolerance);
    if (most.straight()) continue;
    kept[most.vertex % n] = 1;
    waiting.push_back({run.from, most.vertex});
    waiting.push_back({most.vertex, run.to});
  }
}

/// Drops vertices on straight sides where runs began or were split, but which are no corners.
void drop_needless(const Ring& ring, const std::vector<std::uint8_t>& corner,
                   std::vector<std::uint8_t>& kept, double tolerance) {
  const std::size_t n = ring.size();
  auto left = std::count(kept.begin(), kept.end(), std::uint8_t{1});
  for (std::size_t i = 0; i < n && left > 3; ++i) {
    if (!kept[i] || corner[i]) continue;
    std::size_t before = n + i - 1;
    while (!kept[before % n]) --before;
    const Run run{before, next_kept(kept, n + i)};
    if (!departure(ring, run, tolerance).straight()) continue;
    kept[i] = 0;
    --left;
  }
}

/// Gives the edge of each kept vertex the table of the longest part of its run.
void name_runs(const Ring& ring, const std::vector<std::uint8_t>& kept, std::vector<Index>& table) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!kept[i]) continue;
    std::map<Index, double> length;
    const std::size_t end = next_kept(kept, i);
    for (std::size_t e = i; e < end; ++e)
      length[table[e % n]] += norm(ring[(e + 1) % n] - ring[e % n]);
    table[i] = std::max_element(length.begin(), length.end(), [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
  }
}

}  // namespace

void remove_straight_runs(Ring& ring, std::vector<Index>& law, double tolerance,
                          std::vector<Index>* table) {
  if (ring.size() <= 3) return;
  const std::vector<std::uint8_t> corner = corners(ring, law);
  if (!anything_straight(ring, corner, tolerance) || is_thin(ring, tolerance)) return;
  std::vector<std::uint8_t> kept = first_kept(ring, corner);
  split_runs(ring, kept, tolerance);
  drop_needless(ring, corner, kept, tolerance);
  if (std::count(kept.begin(), kept.end(), std::uint8_t{1}) < 3) return;
  if (table != nullptr) name_runs(ring, kept, *table);
  const auto keep = [&](auto& values) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i]) values[count++] = values[i];
    }
    values.resize(count);
  };
  keep(ring);
  keep(law);
  if (table != nullptr) keep(*table);
}

}  // namespace edda
