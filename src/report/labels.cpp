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

void Labels::write(Canvas& canvas, const std::string& text, const std::vector<Vec2>& places,
                   double radius) {
  const double wide = canvas.text_width(text, font_, true), high = 0.85 * font_,
               off = radius + 0.15 * font_;
  Box best;
  double least = 1e300;
  const auto try_at = [&](Vec2 p) {
    const Box box{{p.x, p.y - high}, {p.x + wide, p.y}};
    if (const double crowded = crowding(box); crowded < least) {
      least = crowded;
      best = box;
    }
  };
  for (const double d : {off, off + 1.1 * font_, off + 2.2 * font_}) {
    // Lower left corners of the label, best sides first; then further away.
    const std::array<Vec2, 8> corners{{{d, -d},
                                       {-d - wide, -d},
                                       {d, d + high},
                                       {-d - wide, d + high},
                                       {d, 0.5 * high},
                                       {-d - wide, 0.5 * high},
                                       {-0.5 * wide, -d},
                                       {-0.5 * wide, d + high}}};
    for (const Vec2 at : places) {
      for (const Vec2 corner : corners) {
        if (least > 0.0) try_at(at + corner);
      }
    }
  }
  taken_.push_back(best);
  canvas.text(text, {best.low.x, best.high.y},
              {.size = font_, .align = Align::left, .bold = true, .halo = true});
}

}  // namespace edda
