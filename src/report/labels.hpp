// Names beside points, placed such that none covers another.
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
  /// Keeps names away from a mark of this radius.
  void avoid(Vec2 at, double radius);
  /// Writes `text` beside the mark at the first of `places` where a side is free; else where it
  /// covers least.
  void write(Canvas& canvas, const std::string& text, const std::vector<Vec2>& places,
             double radius);

 private:
  double crowding(const Box& box) const;
  Box frame_;
  double font_;
  std::vector<Box> taken_;
};

}  // namespace edda
