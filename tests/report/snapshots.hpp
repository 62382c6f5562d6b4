// Snapshots of small models and what is drawn of them.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "report/plot.hpp"
#include "report/scene.hpp"
#include "report/two_blocks.hpp"
#include "scratch_folder.hpp"

namespace edda::testing {

inline Snapshot snapshot(const std::string& field) {
  Snapshot shot{two_blocks()};
  shot.field = shown_field(field, shot.blocks, nullptr).value();
  return shot;
}

inline std::string drawn(std::span<const Snapshot> shots, const PlotOptions& options,
                         const std::string& name = "plot.svg") {
  const ScratchFolder folder;
  EXPECT_FALSE(plot(shots, options, folder.at(name)));
  return read_file(folder.at(name)).value();
}

/// A row of 60 squares that move by up to 6 mm, beside them a crumb that has fallen by 167 mm.
inline Snapshot crumb() {
  Grid g;
  Field id{"id", 1, {}, {}, true}, u{"displacement", 3, {}, {}, false};
  for (int k = 0; k <= 60; ++k) {
    const double x = k < 60 ? k : 66.0, size = k < 60 ? 1.0 : 0.1;
    for (const Vec2 p : {Vec2{0, 0}, Vec2{size, 0}, Vec2{size, size}, Vec2{0, size}}) {
      g.corners.push_back(static_cast<std::int64_t>(g.point_count()));
      g.points.insert(g.points.end(), {x + p.x, p.y, 0.0});
    }
    g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
    g.types.push_back(cell_type::polygon);
    id.values.push_back(k);
    u.values.insert(u.values.end(), {0.0, k < 60 ? 1e-4 * (k + 1) : -0.167, 0.0});
  }
  g.cell_fields = {id, u};
  Snapshot shot{g};
  shot.field = shown_field("displacement", shot.blocks, nullptr).value();
  return shot;
}

}  // namespace edda::testing
