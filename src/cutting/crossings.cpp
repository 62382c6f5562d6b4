#include "cutting/crossings.hpp"

#include <cstddef>
#include <cstdint>

namespace edda {
namespace {

struct Segment {
  Vec2 a, b;
};

bool cross_each_other(const Segment& s, const Segment& t) {
  const Vec2 along_s = s.b - s.a, along_t = t.b - t.a;
  const double ta = cross(along_s, t.a - s.a), tb = cross(along_s, t.b - s.a);
  const double sa = cross(along_t, s.a - t.a), sb = cross(along_t, s.b - t.a);
  return ((ta < 0.0) != (tb < 0.0)) && ((sa < 0.0) != (sb < 0.0));
}

/// SplitMix64: the same numbers on every machine.
std::uint64_t next_number(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

}  // namespace

double estimated_crossings(const std::vector<LineString>& lines) {
  std::vector<Segment> segments;
  for (const LineString& line : lines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      segments.push_back({line.points[i - 1], line.points[i]});
    }
  }
  const std::size_t n = segments.size();
  constexpr std::size_t counted = 2000;  // segments
  std::size_t found = 0;
  if (n <= counted) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) found += cross_each_other(segments[i], segments[j]);
    }
    return static_cast<double>(found);
  }
  constexpr std::size_t drawn = 2'000'000, least = 30;  // pairs; of them that cross
  std::uint64_t state = n;
  for (std::size_t k = 0; k < drawn; ++k) {
    const std::size_t i = next_number(state) % n, j = next_number(state) % n;
    found += i != j && cross_each_other(segments[i], segments[j]);
  }
  if (found < least) return 0.0;
  const auto pairs = static_cast<double>(n);
  return static_cast<double>(found) / static_cast<double>(drawn) * 0.5 * pairs * pairs;
}

}  // namespace edda
