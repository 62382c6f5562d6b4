// Plane vectors. x right, y up; units are the caller's (metres unless stated otherwise).
#pragma once

#include <algorithm>
#include <cmath>

namespace edda {

struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator-(Vec2 a) {
  return {-a.x, -a.y};
}
constexpr Vec2 operator*(double s, Vec2 a) {
  return {s * a.x, s * a.y};
}
constexpr Vec2 operator*(Vec2 a, double s) {
  return {s * a.x, s * a.y};
}
constexpr Vec2 operator/(Vec2 a, double s) {
  return {a.x / s, a.y / s};
}
constexpr Vec2& operator+=(Vec2& a, Vec2 b) {
  return a = a + b;
}
constexpr Vec2& operator-=(Vec2& a, Vec2 b) {
  return a = a - b;
}

constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of a x b: positive when b lies counter-clockwise of a.
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
/// a rotated by +90 degrees.
constexpr Vec2 perp(Vec2 a) {
  return {-a.y, a.x};
}
/// Outward normal of an edge of unit direction t whose block lies on its left.
constexpr Vec2 outward_normal(Vec2 t) {
  return {t.y, -t.x};
}
inline double norm(Vec2 a) {
  return std::sqrt(dot(a, a));
}
inline Vec2 unit(Vec2 a) {
  return a / norm(a);
}
/// Distance of p from the segment from a to b (from a, where they are one point).
inline double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double length2 = dot(u, u);
  const double s = length2 > 0.0 ? std::clamp(dot(p - a, u) / length2, 0.0, 1.0) : 0.0;
  return norm(p - (a + s * u));
}
/// a rotated counter-clockwise by `angle` radians.
inline Vec2 rotated(Vec2 a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y};
}

}  // namespace edda
