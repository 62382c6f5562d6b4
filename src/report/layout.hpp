// Where things go on a picture: title above, axes left and below, legend right, one scale for x and
// y.
#pragma once

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

struct Layout {
  double width = 0.0, height = 0.0;  ///< of the picture, px
  double unit = 1.0;                 ///< size of text relative to a picture 1600 px wide
  Box frame;                         ///< of the drawing on the picture, px, y down
  Box world;                         ///< what it shows, m
  double scale = 1.0;                ///< px per m
  Vec2 px(Vec2 p) const {
    return {frame.low.x + (p.x - world.low.x) * scale, frame.high.y - (p.y - world.low.y) * scale};
  }
};

/// `width` px for pictures that are not much taller than wide, less for those that are.
/// `legend`: keeps room for one on the right.
Layout layout_for(const Box& world, double width, bool legend);

}  // namespace edda
