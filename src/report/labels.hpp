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
  /// Writes `text` beside the mark at `at`, on whichever side it is most in the clear.
  void write(Canvas& canvas, const std::string& text, Vec2 at, double radius);

 private:
  double crowding(const Box& box) const;
  Box frame_;
  double font_;
  std::vector<Box> taken_;
};

}  // namespace edda
