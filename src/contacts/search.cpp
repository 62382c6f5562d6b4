#include "contacts/search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/parallel.hpp"
#include "blocks/pose.hpp"

namespace edda {
namespace {

/// Square cells of several sizes, hashed into a fixed number of buckets. An edge is entered in
/// cells of about the width of its block, so that no cell holds many edges, however small or thin
/// the blocks are. Two cells may share a bucket, which only costs a distance test.
struct Grid {
  std::vector<double> cell;  ///< m, of each size in use
  std::uint64_t mask = 0;
  std::vector<Id> begin;  ///< [buckets + 1]
  std::vector<Id> edges;

  std::int64_t index(std::size_t size, double u) const {
    return static_cast<std::int64_t>(std::floor(u / cell[size]));
  }
  std::uint64_t bucket(std::size_t size, std::int64_t ix, std::int64_t iy) const {
    std::uint64_t h = static_cast<std::uint64_t>(ix) * 0x9e3779b97f4a7c15ull ^
                      static_cast<std::uint64_t>(iy) * 0xc2b2ae3d27d4eb4full;
    h += size * 0xd6e8feb86659fd93ull;
    h ^= h >> 29;
    return h & mask;
  }
};

/// Calls visit(ix, iy) for every cell of a size that the edge a-b, widened by reach, may touch. It
/// proceeds column by column, so that a long inclined edge does not fill its whole bounding box.
template <class Visit>
void for_cells(const Grid& grid, std::size_t size, Vec2 a, Vec2 b, double reach, Visit visit) {
  if (a.x > b.x) std::swap(a, b);
  const double cell = grid.cell[size];
  const std::int64_t first = grid.index(size, a.x - reach), last = grid.index(size, b.x + reach);
  const double dx = b.x - a.x;
  for (std::int64_t ix = first; ix <= last; ++ix) {
    double lo = 0.0, hi = 1.0;
    if (dx > 0.0) {
      const double left = static_cast<double>(ix) * cell - reach;
      lo = std::clamp((left - a.x) / dx, 0.0, 1.0);
      hi = std::clamp((left + cell + 2.0 * reach - a.x) / dx, 0.0, 1.0);
    }
    const double y0 = a.y + lo * (b.y - a.y), y1 = a.y + hi * (b.y - a.y);
    const std::int64_t low = grid.index(size, std::min(y0, y1) - reach);
    const std::int64_t high = grid.index(size, std::max(y0, y1) + reach);
    for (std::int64_t iy = low; iy <= high; ++iy) visit(ix, iy);
  }
}

constexpr std::size_t most_sizes = 16;

/// The cell size that suits an edge, as a power of four times the smallest cell.
std::size_t fitting_size(const BlockSet& b, Id e, double smallest) {
  constexpr double most_cells = 64.0;  // along one edge
  const double wanted = std::max(b.inradius[b.vertex_block[e]], b.edge_length[e] / most_cells);
  const double power = std::round(0.5 * std::log2(wanted / smallest));
  return static_cast<std::size_t>(std::clamp(power, 0.0, most_sizes - 1.0));
}

/// Every vertex is looked up in one cell of each size. Edges of a size that few edges have go to
/// the next larger size in use, which saves look-ups. Returns, for each power of four, the number
/// of the size in use.
std::array<std::size_t, most_sizes> choose_sizes(const std::vector<std::uint8_t>& power,
                                                 double smallest, Grid& grid) {
  std::array<std::size_t, most_sizes> edges{};
  for (const std::uint8_t p : power) ++edges[p];
  std::size_t last = most_sizes - 1;
  while (last > 0 && edges[last] == 0) --last;
  const std::size_t few = power.size() / 32;
  std::array<std::size_t, most_sizes> size{};
  std::size_t waiting = 0;
  for (std::size_t p = 0; p <= last; ++p) {
    size[p] = grid.cell.size();
    waiting += edges[p];
    if (waiting <= few && p < last) continue;
    grid.cell.push_back(std::ldexp(smallest, 2 * static_cast<int>(p)));
    waiting = 0;
  }
  return size;
}

Grid make_grid(const BlockSet& b, const std::vector<std::uint8_t>& alive,
               const std::vector<double>& x, const std::vector<double>& y, double reach) {
  Grid grid;
  const std::size_t nv = b.vertex_count();
  const double smallest = 4.0 * reach;
  std::vector<std::uint8_t> power(nv);
  parallel_for(nv, [&](std::size_t e) {
    power[e] = static_cast<std::uint8_t>(fitting_size(b, static_cast<Id>(e), smallest));
  });
  const auto size = choose_sizes(power, smallest, grid);
  grid.mask = std::bit_ceil(4 * std::max<std::uint64_t>(nv, 16)) - 1;
  std::vector<Id> count(grid.mask + 2, 0);
  auto each = [&](auto&& visit) {
    for (Id e = 0; e < nv; ++e) {
      if (!alive[b.vertex_block[e]]) continue;
      const std::size_t s = size[power[e]];
      for_cells(grid, s, at(x, y, e), at(x, y, b.next[e]), reach,
                [&](std::int64_t ix, std::int64_t iy) { visit(grid.bucket(s, ix, iy), e); });
    }
  };
  each([&](std::uint64_t k, Id) { ++count[k + 1]; });
  for (std::size_t k = 1; k < count.size(); ++k) count[k] += count[k - 1];
  grid.begin = count;
  grid.edges.resize(count.back());
  each([&](std::uint64_t k, Id e) { grid.edges[count[k]++] = e; });
  return grid;
}

/// Whether p is farther than reach from the line through a and b. Needs no division and excludes
/// most of what a cell holds. False in doubt: the margins exceed all rounding.
bool off_line(Vec2 p, Vec2 a, Vec2 b, double reach) {
  const Vec2 u = b - a;
  const double side = cross(u, p - a), length2 = dot(u, u);
  return side * side > (1.000002 * reach * reach + 1e-24 * length2) * length2;
}

}  // namespace

std::vector<NearPair> near_pairs(const BlockSet& b, const std::vector<std::uint8_t>& alive,
                                 const std::vector<double>& x, const std::vector<double>& y,
                                 double reach) {
  const Grid grid = make_grid(b, alive, x, y, reach);
  const std::size_t nv = b.vertex_count();
  // Chunks of vertices are searched in parallel and joined in order: the list does not depend on
  // the number of threads.
  constexpr std::size_t chunk = 256;
  std::vector<std::vector<NearPair>> found((nv + chunk - 1) / chunk);
  parallel_chunks(nv, chunk, 400, [&](std::size_t c, std::size_t from, std::size_t to) {
    std::vector<Id> edges;
    for (std::size_t v = from; v < to; ++v) {
      const Id vertex = static_cast<Id>(v);
      const Id block = b.vertex_block[v];
      if (!alive[block]) continue;
      const Vec2 p = at(x, y, vertex);
      edges.clear();
      for (std::size_t s = 0; s < grid.cell.size(); ++s) {
        const std::uint64_t k = grid.bucket(s, grid.index(s, p.x), grid.index(s, p.y));
        for (Id q = grid.begin[k]; q < grid.begin[k + 1]; ++q) {
          const Id e = grid.edges[q];
          const Id other = b.vertex_block[e];
          if (other == block || (b.fixed[block] && b.fixed[other])) continue;
          const Vec2 start = at(x, y, e), end = at(x, y, b.next[e]);
          if (off_line(p, start, end, reach)) continue;
          if (distance_to_segment(p, start, end) < reach) edges.push_back(e);
        }
      }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (Id e : edges) found[c].push_back({vertex, e});
    }
  });
  std::size_t total = 0;
  for (const auto& part : found) total += part.size();
  std::vector<NearPair> pairs;
  pairs.reserve(total);
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

}  // namespace edda
