// A frame with two linear axes, into which bars, lines and points are drawn.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/layout.hpp"

namespace edda {

class Chart {
 public:
  /// frame: pt; world: what its sides stand for.
  Chart(Canvas& canvas, const Box& frame, const Box& world, double font)
      : canvas_(canvas), frame_(frame), world_(world), font_(font) {}

  Vec2 at(double x, double y) const {
    return {frame_.low.x + (x - world_.low.x) / world_.width() * frame_.width(),
            frame_.high.y - (y - world_.low.y) / world_.height() * frame_.height()};
  }

  /// Grid, ticks with their labels, frame. An axis without a name has no labels.
  void draw_axes(const std::string& x, const std::string& y);
  /// Labels of a second vertical axis on the right, from 0 to `most`.
  void draw_right_axis(const std::string& name, double most);
  /// From the lower axis upwards.
  void draw_bar(double low, double high, double value, Colour colour);
  void draw_line(const std::vector<Vec2>& points, double width, Colour colour);
  /// Between two lines over the same places.
  void draw_band(const std::vector<Vec2>& low, const std::vector<Vec2>& high, Colour colour);
  void draw_point(Vec2 point, double radius, Colour colour);
  void draw_upright(double x, Colour colour);

 private:
  Canvas& canvas_;
  Box frame_, world_;
  double font_;
};

}  // namespace edda
