#include "verification/slope_parts.hpp"

#include <algorithm>
#include <cmath>

#include "verification/scene.hpp"

namespace edda::slopes {

std::string point(Vec2 p) {
  return "[" + number(p.x) + "," + number(p.y) + "]";
}

std::string points(const std::vector<Vec2>& list) {
  std::string text;
  for (const Vec2 p : list) text += (text.empty() ? "[" : ",") + point(p);
  return text + "]";
}

std::string trace(Vec2 a, Vec2 b, const std::string& joint) {
  return "[[trace]]\npoints = " + points({a, b}) + "\njoint = '" + joint + "'\n";
}

std::string law(const std::string& name, double phi, double cohesion) {
  const std::string strength =
      "friction_angle = " + number(phi) + "\ncohesion = " + number(cohesion) + "\n";
  return "[joints." + name + "]\n" + strength + "tensile_strength = " + number(2.0 * cohesion) +
         "\nresidual = { cohesion = " + number(cohesion) +
         ", tensile_strength = " + number(2.0 * cohesion) + " }\n";
}

std::string rock() {
  return "[materials.rock]\nunit_weight = 26e3\nyoung = 5e9\npoisson = 0.25\n"
         "[solver]\nduration = 1\n";
}

std::string ground(const Ring& base, const std::vector<Vec2>& surface) {
  double deep = 0.0, right = 0.0;
  for (const Vec2 p : base) {
    deep = std::max(deep, p.y);
    right = std::max(right, p.x);
  }
  deep = base.front().y - 0.3 * deep;
  right *= 1.2;
  Ring outline{{base.front().x, deep}, {right, deep}, {right, base.back().y}};
  if (surface.front().y == base.back().y) outline.pop_back();
  if (surface.front().y == base.back().y) outline.push_back({right, base.back().y});
  outline.push_back(base.back());
  outline.insert(outline.end(), surface.begin(), surface.end());
  outline.push_back(base.front());
  Ring clean;
  for (const Vec2 p : outline) {
    if (clean.empty() || norm(p - clean.back()) > 1e-9) clean.push_back(p);
  }
  return "[domain]\njoint = 'bed'\noutline = " + points(clean) + "\n[[fixed]]\npoint = " +
         point({0.99 * right, base.front().y + 0.9 * (deep - base.front().y)}) + "\n";
}

std::string water(const std::vector<Vec2>& table, const std::string& flooded) {
  if (table.empty()) return {};
  return "[[water]]\ntable = " + points(table) + "\nflooded = [" + flooded + "]\n";
}

Ring clip(const Ring& ring, const std::function<double(Vec2)>& side) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const double sa = side(a), sb = side(b);
    if (sa >= 0.0) kept.push_back(a);
    if ((sa > 0.0 && sb < 0.0) || (sa < 0.0 && sb > 0.0))
      kept.push_back(a + sa / (sa - sb) * (b - a));
  }
  return kept;
}

double area_of(const Ring& ring) {
  return ring.size() < 3 ? 0.0 : std::abs(signed_area(ring));
}

/// Pressure of the water at a place, Pa.
double pressure(const std::vector<Vec2>& table, Vec2 at) {
  if (table.empty()) return 0.0;
  double level = at.x <= table.front().x ? table.front().y : table.back().y;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const Vec2 a = table[i], b = table[i + 1];
    if (a.x <= at.x && at.x < b.x) level = a.y + (b.y - a.y) * (at.x - a.x) / (b.x - a.x);
  }
  return water_weight * std::max(level - at.y, 0.0);
}

double push(const std::vector<Vec2>& table, Vec2 a, Vec2 b) {
  constexpr int parts = 2000;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += pressure(table, a + (i + 0.5) / parts * (b - a));
  return sum / parts * norm(b - a);
}

std::array<Vec2, 2> inside(const Ring& ring, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  double from = 1.0, to = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i], e = ring[(i + 1) % ring.size()] - p;
    const double across = cross(d, e);
    const double tolerance = 1e-9 * norm(d) * norm(e);
    if (std::abs(across) <= tolerance) {  // lies along it
      if (std::abs(cross(p - a, d)) > 1e-9 * dot(d, d)) continue;
      for (const Vec2 q : {p, p + e}) {
        const double s = std::clamp(dot(q - a, d) / dot(d, d), 0.0, 1.0);
        from = std::min(from, s);
        to = std::max(to, s);
      }
      continue;
    }
    const double s = cross(p - a, e) / across, t = cross(p - a, d) / across;
    if (t < -1e-9 || t > 1.0 + 1e-9) continue;
    from = std::min(from, std::clamp(s, 0.0, 1.0));
    to = std::max(to, std::clamp(s, 0.0, 1.0));
  }
  if (to <= from) return {a, a};
  return {a + from * d, a + to * d};
}

}  // namespace edda::slopes
