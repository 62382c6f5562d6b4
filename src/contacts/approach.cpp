#include "contacts/approach.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.hpp"
#include "blocks/kinematics.hpp"

namespace edda {

double mean_width(const BlockSet& b, const State& state) {
  double area = 0.0, count = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, state, i)) continue;
    area += b.area[i];
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(area / count) : 1.0;
}

namespace {

using Extent = NeighbourGroups::Extent;

/// Width of a group, of the widths of its blocks: the wider, the fewer pairs, and the more blocks
/// of a group move apart.
constexpr double widths_of_group = 3.0;

/// Distance between two of them, m.
double gap(const Extent& a, const Extent& b) {
  const double x = std::max({0.0, a.left - b.right, b.left - a.right});
  const double y = std::max({0.0, a.low - b.high, b.low - a.high});
  return std::hypot(x, y);
}

Extent extent_of_block(const BlockSet& b, const ListOrigin& then, Id i) {
  Extent box;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) box.include(at(then.x, then.y, v));
  return box;
}

/// A block, and the square of a grid in which it lies; blocks larger than that have their own.
struct Placed {
  std::int64_t column, row;
  Id alone;  ///< the block itself where it is a group of its own, else no_id
  Id block;
  bool same_group(const Placed& o) const {
    return column == o.column && row == o.row && alone == o.alone;
  }
};

std::vector<Placed> place_in_grid(const BlockSet& b, const State& state,
                                  const std::vector<Extent>& boxes, double cell) {
  std::vector<Placed> all;
  for (Id i = 0; i < b.size(); ++i) {
    if (!state.alive[i]) continue;
    const Extent& box = boxes[i];
    const bool large = std::max(box.right - box.left, box.high - box.low) > cell;
    const auto square = [&](double from, double to) {
      return large ? 0 : static_cast<std::int64_t>(std::floor(0.5 * (from + to) / cell));
    };
    all.push_back({square(box.left, box.right), square(box.low, box.high), large ? i : no_id, i});
  }
  std::sort(all.begin(), all.end(), [](const Placed& p, const Placed& q) {
    return std::tie(p.alone, p.column, p.row, p.block) <
           std::tie(q.alone, q.column, q.row, q.block);
  });
  return all;
}

/// Pairs of groups nearer to each other than `far`, each with itself, too.
void pair_groups(NeighbourGroups& g, const std::vector<Extent>& boxes, double reach) {
  std::vector<Id> order(boxes.size());
  for (Id n = 0; n < boxes.size(); ++n) order[n] = n;
  std::sort(order.begin(), order.end(),
            [&](Id m, Id n) { return std::pair(boxes[m].left, m) < std::pair(boxes[n].left, n); });
  g.pairs.clear();
  for (std::size_t m = 0; m < order.size(); ++m) {
    const Extent& box = boxes[order[m]];
    for (std::size_t n = m; n < order.size(); ++n) {
      const Extent& other = boxes[order[n]];
      if (other.left > box.right + g.far) break;
      const double apart = gap(box, other);
      if (apart < g.far) g.pairs.push_back({order[m], order[n], std::max(0.0, apart - reach)});
    }
  }
}

void make_groups(NeighbourGroups& g, const BlockSet& b, const State& state,
                 const ListOrigin& then) {
  std::vector<Extent> boxes(b.size());
  for (Id i = 0; i < b.size(); ++i) boxes[i] = extent_of_block(b, then, i);
  g.far = widths_of_group * mean_width(b, state);
  const std::vector<Placed> placed = place_in_grid(b, state, boxes, g.far);
  g.begin.clear();
  g.blocks.clear();
  std::vector<Extent> of_groups;
  for (std::size_t n = 0; n < placed.size(); ++n) {
    if (n == 0 || !placed[n].same_group(placed[n - 1])) {
      g.begin.push_back(static_cast<Id>(n));
      of_groups.push_back({});
    }
    g.blocks.push_back(placed[n].block);
    of_groups.back().include(boxes[placed[n].block]);
  }
  g.begin.push_back(static_cast<Id>(placed.size()));
  pair_groups(g, of_groups, then.reach);
  g.of_list = then.list;
}

void measure(NeighbourGroups& g, const BlockSet& b, const Pose& pose, const ListOrigin& then) {
  g.moved.resize(g.begin.size() - 1);
  parallel_chunks(g.moved.size(), 16, 150, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      Extent moved;
      for (Id p = g.begin[q]; p < g.begin[q + 1]; ++p) {
        const Id i = g.blocks[p];
        for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v)
          moved.include(at(pose.x, pose.y, v) - at(then.x, then.y, v));
      }
      g.moved[q] = moved;
    }
  });
}

/// Largest relative displacement of a vertex of one group and one of another, m.
double relative_displacement(const Extent& one, const Extent& other) {
  const double x = std::max(one.right - other.left, other.right - one.left);
  const double y = std::max(one.high - other.low, other.high - one.low);
  return std::sqrt(x * x + y * y);
}

}  // namespace

double largest_approach(NeighbourGroups& g, const BlockSet& b, const State& state, const Pose& pose,
                        const ListOrigin& then) {
  if (g.of_list != then.list) make_groups(g, b, state, then);
  measure(g, b, pose, then);
  if (g.moved.empty()) return 0.0;
  Extent all;
  for (const Extent& moved : g.moved) all.include(moved);
  const double apart = relative_displacement(all, all);
  double approach = std::max(0.0, apart - std::max(0.0, g.far - then.reach)) + all.not_finite;
  for (const NeighbourGroups::Pair& p : g.pairs) {
    approach =
        std::max(approach, relative_displacement(g.moved[p.one], g.moved[p.other]) - p.spare);
  }
  return approach;
}

}  // namespace edda
