#include "contacts/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contacts/gap.hpp"

namespace edda {
namespace {

/// Cells of a uniform grid, hashed into a fixed number of buckets. Two cells may share a bucket:
/// that only costs a distance test.
struct Grid {
  double cell = 1.0;
  std::uint64_t mask = 0;
  std::vector<Id> begin;  ///< [buckets + 1]
  std::vector<Id> edges;

  std::uint64_t bucket(std::int64_t ix, std::int64_t iy) const {
    std::uint64_t h = static_cast<std::uint64_t>(ix) * 0x9e3779b97f4a7c15ull ^
                      static_cast<std::uint64_t>(iy) * 0xc2b2ae3d27d4eb4full;
    h ^= h >> 29;
    return h & mask;
  }
  std::int64_t index(double u) const { return static_cast<std::int64_t>(std::floor(u / cell)); }
};

/// Calls visit(ix, iy) for every cell that the edge a-b, widened by reach, may touch. Column by
/// column, so that a long slanted edge does not fill its whole box.
template <class Visit>
void for_cells(const Grid& grid, Vec2 a, Vec2 b, double reach, Visit visit) {
  if (a.x > b.x) std::swap(a, b);
  const std::int64_t first = grid.index(a.x - reach), last = grid.index(b.x + reach);
  const double dx = b.x - a.x;
  for (std::int64_t ix = first; ix <= last; ++ix) {
    double lo = 0.0, hi = 1.0;
    if (dx > 0.0) {
      const double left = static_cast<double>(ix) * grid.cell - reach;
      lo = std::clamp((left - a.x) / dx, 0.0, 1.0);
      hi = std::clamp((left + grid.cell + 2.0 * reach - a.x) / dx, 0.0, 1.0);
    }
    const double y0 = a.y + lo * (b.y - a.y), y1 = a.y + hi * (b.y - a.y);
    const std::int64_t low = grid.index(std::min(y0, y1) - reach);
    const std::int64_t high = grid.index(std::max(y0, y1) + reach);
    for (std::int64_t iy = low; iy <= high; ++iy) visit(ix, iy);
  }
}

Grid make_grid(const BlockSet& b, const std::vector<std::uint8_t>& alive,
               const std::vector<double>& x, const std::vector<double>& y, double reach) {
  Grid grid;
  const std::size_t nv = b.vertex_count();
  double total = 0.0;
  for (double l : b.edge_length) total += l;
  grid.cell =
      std::max(4.0 * reach, 0.5 * total / static_cast<double>(std::max<std::size_t>(nv, 1)));
  grid.mask = std::bit_ceil(4 * std::max<std::uint64_t>(nv, 16)) - 1;
  std::vector<Id> count(grid.mask + 2, 0);
  auto each = [&](auto&& visit) {
    for (Id e = 0; e < nv; ++e) {
      if (!alive[b.vertex_block[e]]) continue;
      for_cells(grid, at(x, y, e), at(x, y, b.next[e]), reach,
                [&](std::int64_t ix, std::int64_t iy) { visit(grid.bucket(ix, iy), e); });
    }
  };
  each([&](std::uint64_t k, Id) { ++count[k + 1]; });
  for (std::size_t k = 1; k < count.size(); ++k) count[k] += count[k - 1];
  grid.begin = count;
  grid.edges.resize(count.back());
  each([&](std::uint64_t k, Id e) { grid.edges[count[k]++] = e; });
  return grid;
}

}  // namespace

std::vector<NearPair> near_pairs(const BlockSet& b, const std::vector<std::uint8_t>& alive,
                                 const std::vector<double>& x, const std::vector<double>& y,
                                 double reach) {
  const Grid grid = make_grid(b, alive, x, y, reach);
  const std::size_t nv = b.vertex_count();
  // Chunks of vertices are searched in parallel and joined in order: the list does not depend on
  // the number of threads.
  constexpr std::size_t chunk = 2048;
  std::vector<std::vector<NearPair>> found((nv + chunk - 1) / chunk);
#pragma omp parallel for schedule(static) if (found.size() > 1)
  for (std::size_t c = 0; c < found.size(); ++c) {
    std::vector<Id> edges;
    for (std::size_t v = c * chunk; v < std::min(nv, (c + 1) * chunk); ++v) {
      const Id vertex = static_cast<Id>(v);
      const Id block = b.vertex_block[v];
      if (!alive[block]) continue;
      const Vec2 p = at(x, y, vertex);
      const std::uint64_t k = grid.bucket(grid.index(p.x), grid.index(p.y));
      edges.clear();
      for (Id q = grid.begin[k]; q < grid.begin[k + 1]; ++q) {
        const Id e = grid.edges[q];
        const Id other = b.vertex_block[e];
        if (other == block || (b.fixed[block] && b.fixed[other])) continue;
        const Vec2 start = at(x, y, e), end = at(x, y, b.next[e]);
        if (distance_to_segment(p, start, end) >= reach) continue;
        if (may_face(b, x, y, vertex, edge_frame(start, end), reach)) edges.push_back(e);
      }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (Id e : edges) found[c].push_back({vertex, e});
    }
  }
  std::size_t total = 0;
  for (const auto& part : found) total += part.size();
  std::vector<NearPair> pairs;
  pairs.reserve(total);
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

}  // namespace edda
