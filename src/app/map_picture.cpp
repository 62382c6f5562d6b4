#include "app/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "app/mechanism_picture.hpp"
#include "base/text.hpp"

namespace edda {
namespace {

/// The squares, with corners that neighbours share.
class Squares {
 public:
  explicit Squares(double side) : side_(side) {
    grid_.cell_fields.push_back({"id", 1, {}, {}, true});
  }

  void add(Vec2 middle, double id) {
    constexpr std::array<Vec2, 4> ways{Vec2{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    for (const Vec2 way : ways) grid_.corners.push_back(corner(middle + side_ * way));
    grid_.ends.push_back(static_cast<std::int64_t>(grid_.corners.size()));
    grid_.types.push_back(cell_type::polygon);
    grid_.cell_fields[0].values.push_back(id);
  }
  Grid grid() && { return std::move(grid_); }

 private:
  std::int64_t corner(Vec2 p) {
    if (grid_.points.empty()) first_ = p;
    const Vec2 steps = (1.0 / side_) * (p - first_);
    const auto [at, is_new] = known_.try_emplace({std::lround(steps.x), std::lround(steps.y)},
                                                 static_cast<std::int64_t>(grid_.point_count()));
    if (is_new) grid_.points.insert(grid_.points.end(), {p.x, p.y, 0.0});
    return at->second;
  }
  double side_;
  Vec2 first_;
  Grid grid_;
  std::map<std::pair<long, long>, std::int64_t> known_;
};

}  // namespace

Trouble draw_map(const std::string& title, const StudyMap& where, const KeyBlockMap& map,
                 const std::string& folder) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    if (map.rock[i] > 0) order.push_back(i);
  }
  if (order.empty()) return {};
  // Squares of one value are one shape: a short file, and no seams.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return map.key[i] < map.key[j]; });
  Squares squares(where.spacing);
  Snapshot shot;
  for (const std::size_t i : order) {
    squares.add(map.places[i], static_cast<double>(map.key[i]));
    shot.field.values.push_back(map.part(i));
  }
  shot.blocks = std::move(squares).grid();
  shot.field.kind = ScaleKind::numbers;
  shot.field.label = "part of the samples";
  PlotOptions options;
  options.title = title;
  options.subtitle = fmt::format("How often each place belongs to a key block, of {}",
                                 counted(map.samples, "sample"));
  options.outlines = false;
  options.whole_range = true;
  options.range = {0.0, std::max(map.part(map.most()), 1e-3)};
  return draw_in_both_forms(shot, options, folder, "key_block_map");
}

}  // namespace edda
