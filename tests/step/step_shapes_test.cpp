// The bound of the step from the shape of the blocks alone against the true limit, for blocks of
// ten shapes that touch others on all sides.
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "base/polygon.hpp"
#include "step/glued_scene.hpp"

namespace edda::step_shapes_test {
namespace {

std::string block(const Ring& ring, bool fixed) {
  std::string text = fixed ? "[[block]]\nfixed = true\npolygon = [" : "[[block]]\npolygon = [";
  char point[80];
  for (const Vec2 p : ring) {
    std::snprintf(point, sizeof point, "[%.17g, %.17g],", p.x, p.y);
    text += point;
  }
  return text + "]\n";
}

Vec2 direction(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {std::cos(a), std::sin(a)};
}

/// 3 x 3 cells surrounded by a ring of fixed cells; `cell` gives the rings of cell (i, j).
std::string among_held(const std::function<std::vector<Ring>(int, int)>& cell) {
  constexpr int n = 3;
  std::string text;
  for (int i = -1; i <= n; ++i) {
    for (int j = -1; j <= n; ++j) {
      for (const Ring& ring : cell(i, j)) text += block(ring, i < 0 || j < 0 || i == n || j == n);
    }
  }
  return text;
}

/// Parallelograms of the sides u and v, or their halves; every other row shifted by a part of u.
std::string parallelograms(Vec2 u, Vec2 v, double shift = 0.0, bool halves = false) {
  return among_held([=](int i, int j) -> std::vector<Ring> {
    const Vec2 p = (i + (j % 2 != 0 ? shift : 0.0)) * u + static_cast<double>(j) * v;
    if (!halves) return {{p, p + u, p + u + v, p + v}};
    return {{p, p + u, p + v}, {p + u, p + u + v, p + v}};
  });
}

std::string hexagons() {
  return among_held([](int i, int j) -> std::vector<Ring> {
    const Vec2 centre{std::sqrt(3.0) * (i + (j % 2 != 0 ? 0.5 : 0.0)), 1.5 * j};
    Ring ring;
    for (int q = 0; q < 6; ++q) ring.push_back(centre + direction(30.0 + 60.0 * q));
    return {ring};
  });
}

/// A square of 1 m beside nine of a third of it.
std::string large_and_small() {
  return among_held([](int i, int j) {
    const bool small = i >= 0 && j >= 0 && i < 3 && j < 3 && (i + j) % 2 == 0;
    const int parts = small ? 3 : 1;
    const double size = 1.0 / parts;
    std::vector<Ring> rings;
    for (int a = 0; a < parts * parts; ++a) {
      const Vec2 p{i + size * (a % parts), j + size * (a / parts)};
      rings.push_back({p, p + Vec2{size, 0}, p + Vec2{size, size}, p + Vec2{0, size}});
    }
    return rings;
  });
}

struct Case {
  const char* name;
  std::string geometry;
  double least = 0.8;  ///< fraction of the true limit
};

std::vector<Case> cases() {
  const Vec2 x{1.0, 0.0}, y{0.0, 1.0};
  return {{"squares", parallelograms(x, y)},
          {"bricks", parallelograms(2.0 * x, y, 0.5)},
          {"plates", parallelograms(5.0 * x, y)},
          {"rhombs of 60 degrees", parallelograms(x, direction(60))},
          {"rhombs of 30 degrees", parallelograms(x, direction(30)), 0.79},
          {"triangles", parallelograms(x, direction(60), 0.0, true)},
          // At a sharp corner the sides of its neighbours count, too, which are also opposed, and
          // without a kn are stiffer per length where they are shorter.
          {"triangles of 30 degrees", parallelograms(x, direction(30), 0.0, true), 0.7},
          {"hexagons", hexagons()},
          {"large and small", large_and_small()},
          {"rhombs of 75 degrees in bond", parallelograms(2.0 * x, direction(75), 0.5), 0.7}};
}

TEST(StepBound, OfBlocksThatTouchAllRound) {
  for (const Case& c : cases()) {
    for (const char* law : {"", "kn = 1e11\nks = 5e10\n"}) {
      Simulation s = glued(c.geometry, 0.0, {}, law);
      const double part = s.control.bound.critical_step / true_critical_step(s, 500);
      EXPECT_LE(part, 1.0 + 1e-4) << c.name << ' ' << law;
      EXPECT_GE(part, c.least) << c.name << ' ' << law;
    }
  }
}

}  // namespace
}  // namespace edda::step_shapes_test
