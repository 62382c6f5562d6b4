// How much of what is drawn lies inside a ring.
#pragma once

#include "base/rings.hpp"
#include "cutting/line_work.hpp"

namespace edda::test {

/// Length of all straight lines of `work` inside `ring`, m.
inline double length_inside(const LineWork& work, const Ring& ring, double snap) {
  double sum = 0.0;
  for (const LineString& line : work.lines) {
    const Vec2 a = line.points[0], b = line.points[1];
    const double length = norm(b - a);
    for (const Stretch& part :
         common(clip_line(ring, a, (b - a) / length, snap), {{0.0, length}})) {
      sum += part.second - part.first;
    }
  }
  return sum;
}

}  // namespace edda::test
