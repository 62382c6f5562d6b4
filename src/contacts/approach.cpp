#include "contacts/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/parallel.hpp"
#include "blocks/kinematics.hpp"

namespace edda {
namespace {

/// Width of a group, of the widths of its blocks: the wider, the fewer pairs, and the more blocks
/// of a group move apart.
constexpr double widths_of_group = 3.0;

struct Box {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  double low = left, high = -left;
};

/// Distance between two boxes, m.
double gap(const Box& a, const Box& b) {
  const double x = std::max({0.0, a.left - b.right, b.left - a.right});
  const double y = std::max({0.0, a.low - b.high, b.low - a.high});
  return std::hypot(x, y);
}

Box box_of_block(const BlockSet& b, const FaceSet& list, Id i) {
  Box box;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    box.left = std::min(box.left, list.built_x[v]);
    box.right = std::max(box.right, list.built_x[v]);
    box.low = std::min(box.low, list.built_y[v]);
    box.high = std::max(box.high, list.built_y[v]);
  }
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

double mean_width(const BlockSet& b, const State& state) {
  double area = 0.0, count = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, state, i)) continue;
    area += b.area[i];
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(area / count) : 1.0;
}

std::vector<Placed> place_in_grid(const BlockSet& b, const State& state,
                                  const std::vector<Box>& boxes, double cell) {
  std::vector<Placed> all;
  for (Id i = 0; i < b.size(); ++i) {
    if (!state.alive[i]) continue;
    const Box& box = boxes[i];
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
void pair_groups(NeighbourGroups& g, const std::vector<Box>& boxes, double reach) {
  std::vector<Id> order(boxes.size());
  for (Id n = 0; n < boxes.size(); ++n) order[n] = n;
  std::sort(order.begin(), order.end(),
            [&](Id m, Id n) { return std::pair(boxes[m].left, m) < std::pair(boxes[n].left, n); });
  g.pairs.clear();
  for (std::size_t m = 0; m < order.size(); ++m) {
    const Box& box = boxes[order[m]];
    for (std::size_t n = m; n < order.size(); ++n) {
      const Box& other = boxes[order[n]];
      if (other.left > box.right + g.far) break;
      const double apart = gap(box, other);
      if (apart < g.far) g.pairs.push_back({order[m], order[n], std::max(0.0, apart - reach)});
    }
  }
}

void make_groups(NeighbourGroups& g, const BlockSet& b, const State& state, const FaceSet& list) {
  std::vector<Box> boxes(b.size());
  for (Id i = 0; i < b.size(); ++i) boxes[i] = box_of_block(b, list, i);
  g.far = widths_of_group * mean_width(b, state);
  const std::vector<Placed> placed = place_in_grid(b, state, boxes, g.far);
  g.begin.clear();
  g.blocks.clear();
  std::vector<Box> of_groups;
  for (std::size_t n = 0; n < placed.size(); ++n) {
    if (n == 0 || !placed[n].same_group(placed[n - 1])) {
      g.begin.push_back(static_cast<Id>(n));
      of_groups.push_back({});
    }
    g.blocks.push_back(placed[n].block);
    const Box& of_block = boxes[placed[n].block];
    Box& box = of_groups.back();
    box.left = std::min(box.left, of_block.left);
    box.right = std::max(box.right, of_block.right);
    box.low = std::min(box.low, of_block.low);
    box.high = std::max(box.high, of_block.high);
  }
  g.begin.push_back(static_cast<Id>(placed.size()));
  pair_groups(g, of_groups, list.reach);
  g.of_list = list.rebuilds;
}

/// Fills the displacements of the vertices of each group.
void measure(NeighbourGroups& g, const BlockSet& b, const Pose& pose, const FaceSet& list) {
  const std::size_t n = g.begin.size() - 1;
  for (auto* of : {&g.least_x, &g.least_y, &g.most_x, &g.most_y}) of->resize(n);
  parallel_chunks(n, 64, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      Box box;
      double lost = 0.0;  // not a number where a position is not
      for (Id p = g.begin[q]; p < g.begin[q + 1]; ++p) {
        const Id i = g.blocks[p];
        for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
          const double x = pose.x[v] - list.built_x[v], y = pose.y[v] - list.built_y[v];
          box.left = std::min(box.left, x);
          box.right = std::max(box.right, x);
          box.low = std::min(box.low, y);
          box.high = std::max(box.high, y);
          lost += 0.0 * (x + y);
        }
      }
      g.least_x[q] = box.left + lost;
      g.most_x[q] = box.right + lost;
      g.least_y[q] = box.low + lost;
      g.most_y[q] = box.high + lost;
    }
  });
}

/// Largest relative displacement of a vertex of one group and one of another, m.
double relative_displacement(const NeighbourGroups& g, Id one, Id other) {
  const double x = std::max(g.most_x[one] - g.least_x[other], g.most_x[other] - g.least_x[one]);
  const double y = std::max(g.most_y[one] - g.least_y[other], g.most_y[other] - g.least_y[one]);
  return std::sqrt(x * x + y * y);
}

}  // namespace

double largest_approach(NeighbourGroups& g, const BlockSet& b, const State& state, const Pose& pose,
                        const FaceSet& list) {
  if (g.of_list != list.rebuilds) make_groups(g, b, state, list);
  measure(g, b, pose, list);
  if (g.begin.size() < 2) return 0.0;
  Box all;
  double lost = 0.0;
  for (std::size_t q = 0; q + 1 < g.begin.size(); ++q) {
    all.left = std::min(all.left, g.least_x[q]);
    all.right = std::max(all.right, g.most_x[q]);
    all.low = std::min(all.low, g.least_y[q]);
    all.high = std::max(all.high, g.most_y[q]);
    lost += 0.0 * (g.least_x[q] + g.least_y[q]);
  }
  const double apart = std::hypot(all.right - all.left, all.high - all.low);
  double approach = std::max(0.0, apart - std::max(0.0, g.far - list.reach)) + lost;
  for (const NeighbourGroups::Pair& p : g.pairs) {
    approach = std::max(approach, relative_displacement(g, p.one, p.other) - p.spare);
  }
  return approach;
}

}  // namespace edda
