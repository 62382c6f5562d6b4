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
  constexpr int rings = 12;
  Vec2 from;  // the mark of the best place, and whether it is so far that a line leads to it
  bool far = false;
  for (int ring = 0; ring < rings && least > 0.0; ++ring) {
    const double d = off + 1.1 * font_ * ring;
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
        const double before = least;
        if (least > 0.0) try_at(at + corner);
        if (least < before) from = at, far = ring > 0;
      }
    }
  }
  if (far) {
    const Vec2 to{std::clamp(from.x, best.low.x, best.high.x),
                  std::clamp(from.y, best.low.y, best.high.y)};
    canvas.line(from + radius * unit(to - from), to, 0.4);
  }
  taken_.push_back(best);
  canvas.text(text, {best.low.x, best.high.y},
              {.size = font_, .align = Align::left, .bold = true, .halo = true});
}

}  // namespace edda
