// Names beside points, so that none lies on another.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/layout.hpp"

namespace edda {

class Labels {
 public:
  /// Names stay within `frame`, pt.
  Labels(Box frame, double font) : frame_(frame), font_(font) {}
  /// Keeps names off a mark of that radius.
  void avoid(Vec2 at, double radius);
  /// Writes `text` beside the mark at the first of `places` where it is in the clear on a side;
  /// else where it is most so.
  void write(Canvas& canvas, const std::string& text, const std::vector<Vec2>& places,
             double radius);

 private:
  double crowding(const Box& box) const;
  Box frame_;
  double font_;
  std::vector<Box> taken_;
};

}  // namespace edda
