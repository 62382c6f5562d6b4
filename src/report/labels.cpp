#include "report/labels.hpp"

#include <algorithm>
#include <array>

namespace edda {
namespace {

double overlap(const Box& a, const Box& b) {
  const double x = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
  const double y = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
  return x > 0.0 && y > 0.0 ? x * y : 0.0;
}

double area(const Box& b) {
  return b.width() * b.height();
}

}  // namespace

void Labels::avoid(Vec2 at, double radius) {
  taken_.push_back({at - Vec2{radius, radius}, at + Vec2{radius, radius}});
}

double Labels::crowding(const Box& box) const {
  double sum = 3.0 * (area(box) - overlap(box, frame_));
  for (const Box& b : taken_) sum += overlap(box, b);
  return sum;
}

void Labels::write(Canvas& canvas, const std::string& text, Vec2 at, double radius) {
  const double wide = canvas.text_width(text, font_, true), high = 0.85 * font_,
               off = radius + 0.15 * font_;
  // Low left corners, best sides first; then further away.
  std::vector<Vec2> corners;
  for (const double d : {off, off + 1.1 * font_, off + 2.2 * font_}) {
    corners.insert(corners.end(), {{d, -d}, {-d - wide, -d}, {d, d + high}, {-d - wide, d + high}});
    corners.insert(
        corners.end(),
        {{d, 0.5 * high}, {-d - wide, 0.5 * high}, {-0.5 * wide, -d}, {-0.5 * wide, d + high}});
  }
  Box best;
  double least = 1e300;
  for (const Vec2 corner : corners) {
    const Vec2 p = at + corner;
    const Box box{{p.x, p.y - high}, {p.x + wide, p.y}};
    if (const double crowded = crowding(box); crowded < least) {
      least = crowded;
      best = box;
    }
    if (least <= 0.0) break;
  }
  taken_.push_back(best);
  canvas.text(text, {best.low.x, best.high.y},
              {.size = font_, .align = Align::left, .bold = true, .halo = true});
}

}  // namespace edda
