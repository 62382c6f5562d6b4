// Layout of a page: title above, one or more drawings side by side with axes left and
// below, legend right, one scale for x and y and for all drawings. Points (1/72 inch), y down.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

struct Box {
  Vec2 low, high;
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
};

/// The box of the points that are finite, with a margin; a unit box where there are none.
Box box_around(const std::vector<Vec2>& points);

/// Sizes that do not depend on what is drawn.
struct Paper {
  double width = 160.0 * 72.0 / 25.4;            ///< pt
  double font = 8.0;                             ///< pt
  double pixels_per_point = 10.0 * 25.4 / 72.0;  ///< of a PNG: 10 per mm
  bool whole = false;  ///< pages of slim models have the full width, too; else they may be narrower
};

/// One drawing on the page.
struct View {
  Box frame;           ///< pt
  Box world;           ///< what it shows, m
  double scale = 1.0;  ///< pt per m
  Vec2 at(Vec2 p) const {
    return {frame.low.x + (p.x - world.low.x) * scale, frame.high.y - (p.y - world.low.y) * scale};
  }
};

struct Layout {
  double width = 0.0, height = 0.0, font = 8.0;
  std::vector<View> views;
  Vec2 legend;         ///< its upper left corner
  double below = 0.0;  ///< width of a legend below: of all drawings together, or of the page
};

/// Space needed beside the drawings.
struct Surroundings {
  std::size_t drawings = 1;
  double left = 0.0;           ///< labels of the y axis
  double top = 0.0;            ///< titles
  double legend_width = 0.0;   ///< on the right; 0: none there
  double legend_height = 0.0;  ///< least, on the right
  double legend_below = 0.0;   ///< height of one below
};

Layout lay_out(const Box& world, const Paper& paper, const Surroundings& room);

}  // namespace edda
