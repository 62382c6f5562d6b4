#include "verification/exact_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "verification/scene.hpp"

namespace edda {
namespace {

constexpr double unit_weight = 26e3, water_weight = 9810.0;

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

/// Rock below a base from the toe (its first point) up, and what lies on it.
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
  return "[domain]\njoint = 'bed'\noutline = " + points(clean) + "\n[[held]]\npoint = " +
         point({0.99 * right, base.front().y + 0.9 * (deep - base.front().y)}) + "\n";
}

std::string water(const std::vector<Vec2>& table, const std::string& flooded = {}) {
  if (table.empty()) return {};
  return "[[water]]\ntable = " + points(table) + "\nflooded = [" + flooded + "]\n";
}

/// Part of a ring where `side` is positive.
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

/// Its integral from a to b, N/m.
double push(const std::vector<Vec2>& table, Vec2 a, Vec2 b) {
  constexpr int parts = 2000;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += pressure(table, a + (i + 0.5) / parts * (b - a));
  return sum / parts * norm(b - a);
}

/// What of the line from a to b lies in a ring (all of it on one side of any of its ends): where
/// the ring is convex along it.
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

}  // namespace

Vec2 BeddedSlope::along() const {
  return {std::cos(radians(dip)), std::sin(radians(dip))};
}

/// Of the cross joints, upward.
Vec2 BeddedSlope::riser() const {
  return {std::cos(radians(dip + lean)), std::sin(radians(dip + lean))};
}

/// u along the bed through (0, 0), then along a cross joint to v across the beds.
Vec2 BeddedSlope::place(double u, double v) const {
  return u * along() + v / std::sin(radians(lean)) * riser();
}

Ring BeddedSlope::profile() const {
  Ring base{{0.0, 0.0}};
  double level = 0.0;
  for (const auto& [u, rise] : steps) {
    base.push_back(place(u, level));
    level += rise;
    base.push_back(place(u, level));
  }
  base.push_back(surface.front());
  return base;
}

Ring BeddedSlope::mass() const {
  Ring ring = profile();
  ring.insert(ring.end(), surface.begin() + 1, surface.end() - 1);
  return ring;
}

double BeddedSlope::exact() const {
  const Ring whole = mass();
  const double c = std::cos(radians(dip)), s = std::sin(radians(dip));
  const Vec2 bed_way = along(), off{-bed_way.y, bed_way.x}, joint_way = riser(),
             in{-joint_way.y, joint_way.x};
  const auto across = [&](Vec2 p) { return dot(p, off); };
  const auto foot = [&](Vec2 p) { return dot(p, bed_way) - across(p) / std::tan(radians(lean)); };
  double u_from = 1e9, u_to = -1e9, v_to = 0.0;
  for (const Vec2 p : whole) {
    u_from = std::min(u_from, foot(p));
    u_to = std::max(u_to, foot(p));
    v_to = std::max(v_to, across(p));
  }
  const int first = static_cast<int>(std::floor((u_from - cross_from) / cross));
  const int last = static_cast<int>(std::ceil((u_to - cross_from) / cross));
  const int levels = static_cast<int>(std::ceil(v_to / bed)) + 1;
  const double tan_phi = std::tan(radians(phi));
  struct Part {
    double resists = 0.0, drives = 0.0;
  };
  // [cell][level]: what lies on this bed between two cross joints, and on all above it
  std::vector<std::vector<Part>> parts;
  std::vector<std::vector<double>> risers;  // [cell][level]: water on the joint before it, below
  const double pulls = -dot(in, bed_way), lifts = dot(in, off);  // of that water
  std::vector<int> lowest;
  for (int k = first; k < last; ++k) {
    const double u0 = cross_from + k * cross, u1 = u0 + cross;
    Ring cell = clip(whole, [&](Vec2 p) { return foot(p) - u0; });
    cell = clip(cell, [&](Vec2 p) { return u1 - foot(p); });
    double base = 0.0;
    for (const auto& [u, rise] : steps) base += u < 0.5 * (u0 + u1) ? rise : 0.0;
    lowest.push_back(static_cast<int>(std::llround(base / bed)));
    parts.emplace_back();
    risers.emplace_back(1, 0.0);
    for (int j = 0; j < levels; ++j) {
      const double v = j * bed;
      const double weight =
          unit_weight * area_of(clip(cell, [&](Vec2 p) { return across(p) - v; }));
      const auto [a, b] = inside(whole, place(std::max(u0, u_from - 1.0), v), place(u1, v));
      const bool lies = weight > 0.0;
      const double lift = lies ? push(table, a, b) : 0.0;
      parts.back().push_back(
          {lies ? cohesion * norm(b - a) + (weight * c - lift) * tan_phi : 0.0, weight * s});
      const auto [q, r] = inside(whole, place(u0, v), place(u0, v + bed));
      risers.back().push_back(risers.back().back() + push(table, q, r));
    }
    // The back, where it is a joint.
    if (k == last - 1 && !table.empty()) {
      for (int j = 0; j < levels; ++j) {
        const auto [q, r] = inside(whole, place(u_to, j * bed), place(u_to, v_to));
        Part& part = parts.back()[static_cast<std::size_t>(j)];
        part.drives += pulls * push(table, q, r);
        part.resists -= lifts * tan_phi * push(table, q, r);
      }
    }
  }
  double factor = std::numeric_limits<double>::infinity();
  double guess = 10.0;
  for (int rounds = 0; rounds < 100; ++rounds) {
    // Least of resists - guess drives over all paths that only step up.
    struct Best {
      double value = 0.0, resists = 0.0, drives = 0.0;
    };
    std::vector<Best> best(static_cast<std::size_t>(levels));
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::vector<Best> next(best.size());
      for (std::size_t j = 0; j < best.size(); ++j) {
        next[j].value = std::numeric_limits<double>::infinity();
        if (static_cast<int>(j) < lowest[k]) continue;
        for (std::size_t i = 0; i <= j; ++i) {
          if (!std::isfinite(best[i].value)) continue;
          const double riser = risers[k][j] - risers[k][i];
          const Part& part = parts[k][j];
          const double drives = best[i].drives + part.drives + pulls * riser,
                       resists = best[i].resists + part.resists - lifts * tan_phi * riser;
          const double value = resists - guess * drives;
          if (value < next[j].value) next[j] = {value, resists, drives};
        }
      }
      best = next;
    }
    const Best least = *std::min_element(
        best.begin(), best.end(), [](const Best& a, const Best& b) { return a.value < b.value; });
    if (!(least.value < -1e-9 * least.resists)) break;
    factor = guess = least.resists / least.drives;
  }
  return factor;
}

std::string BeddedSlope::toml() const {
  const Ring base = profile();
  std::string text = rock() + law("bed", phi, cohesion) + law("cross", phi, 0.0) +
                     ground(base, surface) + water(table);
  for (std::size_t i = 0; i + 1 < base.size(); ++i) {
    text += trace(base[i], base[i + 1], i % 2 == 0 ? "bed" : "cross");
  }
  const auto set = [&](const char* name, double angle, double spacing, Vec2 origin) {
    return std::string("[[joint_set]]\njoint = '") + name + "'\nangle = " + number(angle) +
           "\nspacing = " + number(spacing) + "\norigin = " + point(origin) +
           "\nregion = " + points(mass()) + "\n";
  };
  return text + set("bed", dip, bed, {}) +
         set("cross", dip + lean, cross * std::sin(radians(lean)), place(cross_from, 0.0));
}

double SlicedSlope::exact() const {
  const std::size_t n = base.size() - 1;
  /// Push that the toe needs from outside.
  const auto needs = [&](double factor) {
    Vec2 from_above;
    for (std::size_t i = n; i-- > 0;) {
      const Vec2 along = (1.0 / norm(base[i + 1] - base[i])) * (base[i + 1] - base[i]);
      const Vec2 across{-along.y, along.x};
      const double t = std::tan(radians(base_phi)) / factor;
      const Vec2 base_way = across + t * along;  // per effective normal force
      const Vec2 foot = base[i] + (i > 0 ? hollow : 0.0) * along;
      const Vec2 from_base = base_cohesion / factor * norm(base[i + 1] - foot) * along +
                             push(table, foot, base[i + 1]) * across;
      if (i == 0) {  // a push along the base
        const Ring slice{base[0], base[1], surface[1], surface[0]};
        const Vec2 rest = Vec2{0.0, -unit_weight * area_of(slice)} + from_above + from_base;
        return dot(rest, across) * t - dot(rest, along);
      }
      // The joint below: presses against the slice, and holds it up.
      const Vec2 up = (1.0 / norm(surface[i] - base[i])) * (surface[i] - base[i]);
      const Vec2 in{up.y, -up.x};
      const double joint_t = std::tan(radians(joint_phi)) / factor;
      const Vec2 joint_way = in + joint_t * up;
      const Vec2 edge = base[i] + hollow * up, across_hollow{edge.y - foot.y, foot.x - edge.x};
      const Vec2 from_joint = joint_cohesion / factor * norm(surface[i] - edge) * up;
      const Ring slice{foot, base[i + 1], surface[i + 1], surface[i], edge};
      const Vec2 rest = Vec2{0.0, -unit_weight * area_of(slice)} + from_above + from_base +
                        from_joint + push(table, edge, surface[i]) * in +
                        push(table, edge, foot) / norm(across_hollow) * across_hollow;
      // rest + N base_way + E joint_way = 0
      const double det = edda::cross(base_way, joint_way);
      const double push_of_joint = -edda::cross(base_way, rest) / det;
      from_above =
          -1.0 * (from_joint + push_of_joint * joint_way + push(table, base[i], surface[i]) * in);
    }
    return 0.0;
  };
  double low = 0.1, high = 10.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (needs(middle) > 0.0 ? high : low) = middle;
  }
  return low;
}

std::string SlicedSlope::toml() const {
  Ring top(surface.rbegin(), surface.rend());
  if (norm(surface.front() - base.front()) < 1e-9) top.pop_back();
  std::string text = rock() + law("bed", base_phi, base_cohesion) +
                     law("slice", joint_phi, joint_cohesion) + law("inner", 60.0, 10e6) +
                     ground(base, top);
  std::string flooded;
  const auto middle = [&](std::size_t i) { return 0.5 * (base[i] + surface[i]); };
  for (std::size_t i = 0; i + 1 < base.size(); ++i) {
    text += trace(base[i], base[i + 1], "bed");
    if (i > 0) text += trace(base[i], surface[i], "slice");
    if (i > 0 && i + 2 < base.size()) text += trace(middle(i), middle(i + 1), "inner");
    if (i > 0) {
      const Vec2 along = (1.0 / norm(base[i + 1] - base[i])) * (base[i + 1] - base[i]);
      const Vec2 up = (1.0 / norm(surface[i] - base[i])) * (surface[i] - base[i]);
      const std::string name = "'hollow " + std::to_string(i) + "'";
      text += "[[opening]]\nname = " + name +
              "\npolygon = " + points({base[i], base[i] + hollow * along, base[i] + hollow * up}) +
              "\n";
      flooded += name + ",";
    }
  }
  return text + water(table, flooded);
}

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
