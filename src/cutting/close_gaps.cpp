#include "cutting/close_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "cutting/geos.hpp"

namespace edda {
namespace {

/// An edge of a block, counter-clockwise, so that its outside is on its right.
struct OuterEdge {
  std::size_t block = 0, corner = 0;
  Vec2 from, to;

  double length() const { return norm(to - from); }
  Vec2 along() const { return unit(to - from); }
};

std::vector<OuterEdge> edges_of(const std::vector<BlockPolygon>& blocks) {
  std::vector<OuterEdge> edges;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Ring& ring = blocks[b].rings[0];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 to = ring[i + 1 == ring.size() ? 0 : i + 1];
      if (!(ring[i] == to)) edges.push_back({b, i, ring[i], to});
    }
  }
  return edges;
}

/// Where an edge goes: the line fitted to the middles of its gaps, offset at + slope t along it.
struct Middle {
  double weight = 0.0, t = 0.0, offset = 0.0, tt = 0.0, t_offset = 0.0;

  void add(double w, double at, double by) {
    weight += w;
    t += w * at;
    offset += w * by;
    tt += w * at * at;
    t_offset += w * at * by;
  }
  std::pair<double, double> at_and_slope() const {
    const double spread = weight * tt - t * t;
    const double slope =
        spread > 1e-12 * weight * tt ? (weight * t_offset - t * offset) / spread : 0.0;
    return {(offset - slope * t) / weight, slope};
  }
};

/// The gap between an edge and another that faces it, at the two ends of what faces, as points of
/// the edge, each with its middle; false where they do not face each other within the width.
bool add_gap(const OuterEdge& a, const OuterEdge& b, double width, Middle& middle) {
  constexpr double facing = 0.94;  // cosine of 20 degrees
  const Vec2 u = a.along(), n = outward_normal(u);
  if (dot(u, b.along()) > -facing) return false;
  const double t0 = dot(b.to - a.from, u), t1 = dot(b.from - a.from, u);
  const double from = std::max(0.0, t0), to = std::min(a.length(), t1);
  constexpr double least = 0.1;  // of the shorter edge: corners that pass each other do not face
  if (!(to - from > least * std::min(a.length(), b.length()))) return false;
  const double g0 = dot(b.to - a.from, n), g1 = dot(b.from - a.from, n);
  const auto gap = [&](double t) { return g0 + (g1 - g0) * (t - t0) / (t1 - t0); };
  const double most = std::max(gap(from), gap(to)), sum = gap(from) + gap(to);
  constexpr double digits = 1.0 + 1e-9;
  if (most > digits * width || sum < 0.0 || std::min(gap(from), gap(to)) < -0.1 * width)
    return false;
  middle.add(to - from, from, 0.5 * gap(from));
  middle.add(to - from, to, 0.5 * gap(to));
  return true;
}

struct MovedEdge {
  Vec2 from, to;
};

/// The corner between two moved edges: where their lines meet, or, of edges in one line, between
/// their ends.
Vec2 corner_of(const MovedEdge& before, const MovedEdge& next) {
  const Vec2 u = before.to - before.from, v = next.to - next.from;
  const double sine = cross(u, v);
  constexpr double parallel = 0.05;
  if (std::abs(sine) <= parallel * norm(u) * norm(v)) return 0.5 * (before.to + next.from);
  return before.from + (cross(next.from - before.from, v) / sine) * u;
}

std::vector<Middle> middles_of(const std::vector<OuterEdge>& edges, double width) {
  geos::index::strtree::TemplateSTRtree<std::size_t> tree(10, edges.size());
  const auto box = [&](const OuterEdge& e, double by) {
    return geos::geom::Envelope(std::min(e.from.x, e.to.x) - by, std::max(e.from.x, e.to.x) + by,
                                std::min(e.from.y, e.to.y) - by, std::max(e.from.y, e.to.y) + by);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) tree.insert(box(edges[i], 0.0), i);
  std::vector<Middle> middles(edges.size());
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    near.clear();
    tree.query(box(edges[i], width), near);
    std::sort(near.begin(), near.end());
    for (const std::size_t j : near) {
      if (edges[j].block != edges[i].block) add_gap(edges[i], edges[j], width, middles[i]);
    }
  }
  return middles;
}

}  // namespace

std::string close_gaps(std::vector<BlockPolygon>& blocks, double width) {
  if (!(width > 0.0)) return {};
  const std::vector<OuterEdge> edges = edges_of(blocks);
  const std::vector<Middle> middles = middles_of(edges, width);
  std::vector<std::vector<MovedEdge>> moved(blocks.size());
  std::set<std::size_t> grown;
  std::size_t count = 0;
  double largest = 0.0, before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const OuterEdge& e = edges[i];
    MovedEdge line{e.from, e.to};
    if (middles[i].weight > 0.0) {
      const auto [at, slope] = middles[i].at_and_slope();
      const Vec2 n = outward_normal(e.along());
      line = {e.from + at * n, e.to + (at + slope * e.length()) * n};
      const double by = std::max(std::abs(at), std::abs(at + slope * e.length()));
      if (by > 0.0) ++count, grown.insert(e.block);
      largest = std::max(largest, by);
    }
    moved[e.block].push_back(line);
  }
  if (count == 0) return {};
  for (const std::size_t b : grown) {
    Ring& ring = blocks[b].rings[0];
    before += signed_area(ring);
    const std::vector<MovedEdge>& lines = moved[b];
    if (lines.size() != ring.size()) continue;  // it has repeated corners
    for (std::size_t i = 0; i < ring.size(); ++i) {
      ring[i] = corner_of(lines[i == 0 ? lines.size() - 1 : i - 1], lines[i]);
    }
    after += signed_area(ring);
  }
  return "close_gaps: " + counted(count, "edge") + " of " + counted(grown.size(), "block") +
         " moved by up to " + number_text(largest, 3) + " m; these blocks grew by " +
         number_text(100.0 * (after / before - 1.0), 3) + " %";
}

}  // namespace edda
