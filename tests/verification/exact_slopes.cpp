#include "verification/exact_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "verification/scene.hpp"
#include "verification/slope_parts.hpp"

namespace edda {

using slopes::point;

TopplingSlope::TopplingSlope() {
  for (int n = 1; n <= count; ++n) {
    height[static_cast<std::size_t>(n)] =
        n <= crest ? n * (a1 - b) : height[static_cast<std::size_t>(n - 1)] - a2 - b;
  }
}

double TopplingSlope::tie(double phi) const {
  const double t = std::tan(radians(phi)), s = std::sin(radians(dip)), c = std::cos(radians(dip));
  double p = 0.0;
  for (int n = count; n >= 1; --n) {
    const double w = unit_weight * width * y(n);
    const double m = n < crest ? y(n) : y(n) - a2, l = n <= crest ? y(n) - a1 : y(n);
    const double topples =
        l > 0.0 ? (p * (m - width * t) + 0.5 * w * (y(n) * s - width * c)) / l : 0.0;
    const double slides = p - w * (c * t - s) / (1.0 - t * t);
    p = std::max(topples, slides);
    if (n > 1) p = std::max(p, 0.0);
  }
  return p;
}

double TopplingSlope::limit() const {
  double low = 30.0, high = 44.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (tie(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

std::string TopplingSlope::toml(double phi) const {
  const double c = std::cos(radians(dip)), s = std::sin(radians(dip));
  const auto at = [&](double u, double v) { return point({u * c - v * s, u * s + v * c}); };
  std::string text =
      "[materials.rock]\nunit_weight = 25e3\nyoung = 5e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = " +
      number(phi) + "\n[solver]\nduration = 1\n[[block]]\nfixed = true\npolygon = [" +
      at(-40, -20) + "," + at(190, -20) + "," + at(190, b * (count - 1));
  for (int n = count - 1; n >= 1; --n) {
    text += "," + at(n * width, n * b) + "," + at(n * width, (n - 1) * b);
  }
  text += "," + at(-40, 0) + "]\n";
  for (int n = 1; n <= count; ++n) {
    const double u = (n - 1) * width, v = (n - 1) * b;
    text += "[[block]]\npolygon = [" + at(u, v) + "," + at(u + width, v) + "," +
            at(u + width, v + y(n)) + "," + at(u, v + y(n)) + "]\n";
  }
  return text;
}

std::vector<ExactSlope> exact_slopes() {
  std::vector<ExactSlope> all;
  const auto bedded = [&](const char* name, const BeddedSlope& s) {
    all.push_back({name, s.toml(), "", "sliding along bed:", s.exact()});
  };
  const auto sliced = [&](const char* name, const SlicedSlope& s) {
    all.push_back({name, s.toml(), "'inner'", "sliding along bed", s.exact()});
  };
  const auto up = [](double dip, double u, double v) {
    const double c = std::cos(radians(dip)), s = std::sin(radians(dip));
    return Vec2{u * c - v * s, u * s + v * c};
  };

  // A slab on a plane, in two layers.
  BeddedSlope slab{35.0, 2.0, 4.0,  90.0,
                   0.0,  0.0, 45.0, {up(35, 40, 0), up(35, 40, 4), up(35, 0, 4), {}}};
  bedded("slab on a plane", slab);
  // A plane through the toe, with cohesion and a crack at the back.
  BeddedSlope plane{35.0, 2.0,  3.0,  90.0,
                    1.0,  15e3, 30.0, {up(35, 16, 0), up(35, 16, 4.0), {7.0, 12.0}, {}}};
  plane.surface[1] = up(35, 16, (12.0 - 16 * std::sin(radians(35))) / std::cos(radians(35)));
  bedded("plane with cohesion", plane);
  BeddedSlope wet = plane;
  wet.table = {
      {0.0, 0.0}, {up(35, 16, 0).x - 1.5, up(35, 16, 0).y + 1.5}, {30.0, up(35, 16, 0).y + 1.5}};
  bedded("plane with cohesion and water", wet);
  // A base in steps.
  BeddedSlope path{
      36.0, 1.0, 2.5, 90.0, 0.0, 0.0, 42.0, {}, {{5.0, 1.0}, {10.0, 1.0}, {15.0, 1.0}}};
  path.surface = {up(36, 25, 3.0), {12.0, up(36, 25, 3.0).y}, {}};
  bedded("step-path", path);
  BeddedSlope wet_path = path;
  wet_path.cohesion = 12e3;
  wet_path.table = {{0.0, 0.0}, {10.0, 8.0}, {30.0, up(36, 25, 3.0).y - 1.0}};
  bedded("step-path with cohesion and water", wet_path);
  SlicedSlope two{{{0, 0}, {12, 3.2}, {20, 14}}, {{0, 0}, {9, 14}, {20, 14}}, 0.0, 35.0, 0.0, 30.0};
  sliced("active and passive wedge", two);
  SlicedSlope six{{{0, 0}, {5, 0.4}, {10, 1.9}, {14.5, 4.6}, {18.5, 8.6}, {21.5, 13.2}, {23.5, 18}},
                  {{0, 0}, {4.2, 6}, {8.4, 12}, {12.6, 18}, {17.0, 18}, {20.6, 18}, {23.5, 18}},
                  20e3,
                  25.0,
                  10e3,
                  30.0};
  sliced("six slices", six);
  six.table = {{0, 0}, {12, 7}, {20, 11.5}, {40, 13}};
  sliced("six slices with water", six);
  const TopplingSlope toppling;
  all.push_back({"toppling", toppling.toml(38.15), "",
                 "toppling:", std::tan(radians(38.15)) / std::tan(radians(toppling.limit()))});
  const double h = 30.0, x = h / std::tan(radians(38.0));
  BeddedSlope large{38.0, 0.7, 0.9,  52.0,
                    0.3,  8e3, 40.0, {{x, h}, {h / std::tan(radians(60.0)), h}, {}}};
  bedded("many beds", large);
  return all;
}

}  // namespace edda
