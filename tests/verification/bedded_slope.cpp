#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/exact_slopes.hpp"
#include "verification/scene.hpp"
#include "verification/slope_parts.hpp"

namespace edda {

using namespace slopes;

/// Forces along the beds, N/m.
struct BeddedSlope::Part {
  double resists = 0.0, drives = 0.0;
};

/// The mass between cross joints, upward from the one at the toe.
struct BeddedSlope::Cells {
  /// [cell][level]: forces of the rock on this bed between two cross joints, up to the surface.
  std::vector<std::vector<Part>> parts;
  /// [cell][level]: water force on the cross joint before it, below the level.
  std::vector<std::vector<double>> risers;
  std::vector<int> lowest;  ///< [cell]: level of the base
  int levels = 0;
};

/// Extent of a mass, in the coordinates of place().
struct BeddedSlope::Extent {
  double u_from = 1e9, u_to = -1e9, v_to = 0.0;
};

/// A path through beds and cross joints.
struct BeddedSlope::Path {
  double value = 0.0;  ///< resists - guess drives
  double resists = 0.0, drives = 0.0;
};

Vec2 BeddedSlope::along() const {
  return {std::cos(radians(dip)), std::sin(radians(dip))};
}

/// Direction of the cross joints, upward.
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

/// Coordinates of a point, as in place().
double BeddedSlope::v_of(Vec2 p) const {
  const Vec2 bed_way = along();
  return dot(p, Vec2{-bed_way.y, bed_way.x});
}

double BeddedSlope::u_of(Vec2 p) const {
  return dot(p, along()) - v_of(p) / std::tan(radians(lean));
}

/// Components of a unit force of water on a cross joint: along the beds, where it drives, and
/// across them, where it lifts.
Vec2 BeddedSlope::push_on_riser() const {
  const Vec2 bed_way = along(), off{-bed_way.y, bed_way.x}, joint_way = riser(),
             in{-joint_way.y, joint_way.x};
  return {-dot(in, bed_way), dot(in, off)};
}

BeddedSlope::Extent BeddedSlope::extent_of(const Ring& whole) const {
  Extent extent;
  for (const Vec2 p : whole) {
    extent.u_from = std::min(extent.u_from, u_of(p));
    extent.u_to = std::max(extent.u_to, u_of(p));
    extent.v_to = std::max(extent.v_to, v_of(p));
  }
  return extent;
}

/// Adds cell k, counted from the cross joint at cross_from.
void BeddedSlope::add_cell(Cells& cells, const Ring& whole, const Extent& extent, int k) const {
  const double c = std::cos(radians(dip)), s = std::sin(radians(dip));
  const double tan_phi = std::tan(radians(phi));
  const double u0 = cross_from + k * cross, u1 = u0 + cross;
  Ring cell = clip(whole, [&](Vec2 p) { return u_of(p) - u0; });
  cell = clip(cell, [&](Vec2 p) { return u1 - u_of(p); });
  double base = 0.0;
  for (const auto& [u, rise] : steps) base += u < 0.5 * (u0 + u1) ? rise : 0.0;
  cells.lowest.push_back(static_cast<int>(std::llround(base / bed)));
  std::vector<Part>& parts = cells.parts.emplace_back();
  std::vector<double>& risers = cells.risers.emplace_back(1, 0.0);
  for (int j = 0; j < cells.levels; ++j) {
    const double v = j * bed;
    const double weight = unit_weight * area_of(clip(cell, [&](Vec2 p) { return v_of(p) - v; }));
    const auto [a, b] = inside(whole, place(std::max(u0, extent.u_from - 1.0), v), place(u1, v));
    const bool lies = weight > 0.0;
    const double lift = lies ? push(table, a, b) : 0.0;
    parts.push_back(
        {lies ? cohesion * norm(b - a) + (weight * c - lift) * tan_phi : 0.0, weight * s});
    const auto [q, r] = inside(whole, place(u0, v), place(u0, v + bed));
    risers.push_back(risers.back() + push(table, q, r));
  }
}

/// Adds the water at the back of the last cell, which is a joint.
void BeddedSlope::add_water_at_back(Cells& cells, const Ring& whole, const Extent& extent) const {
  const auto [driving, lifts] = push_on_riser();
  const double tan_phi = std::tan(radians(phi));
  for (int j = 0; j < cells.levels; ++j) {
    const auto [q, r] = inside(whole, place(extent.u_to, j * bed), place(extent.u_to, extent.v_to));
    Part& part = cells.parts.back()[static_cast<std::size_t>(j)];
    part.drives += driving * push(table, q, r);
    part.resists -= lifts * tan_phi * push(table, q, r);
  }
}

/// Least of resists - guess drives over all paths that only step up.
BeddedSlope::Path BeddedSlope::least_path(const Cells& cells, double guess) const {
  const auto [driving, lifts] = push_on_riser();
  const double tan_phi = std::tan(radians(phi));
  std::vector<Path> best(static_cast<std::size_t>(cells.levels));
  for (std::size_t k = 0; k < cells.parts.size(); ++k) {
    std::vector<Path> next(best.size());
    for (std::size_t j = 0; j < best.size(); ++j) {
      next[j].value = std::numeric_limits<double>::infinity();
      if (static_cast<int>(j) < cells.lowest[k]) continue;
      for (std::size_t i = 0; i <= j; ++i) {
        if (!std::isfinite(best[i].value)) continue;
        const double riser = cells.risers[k][j] - cells.risers[k][i];
        const Part& part = cells.parts[k][j];
        const double drives = best[i].drives + part.drives + driving * riser,
                     resists = best[i].resists + part.resists - lifts * tan_phi * riser;
        const double value = resists - guess * drives;
        if (value < next[j].value) next[j] = {value, resists, drives};
      }
    }
    best = next;
  }
  return *std::min_element(best.begin(), best.end(),
                           [](const Path& a, const Path& b) { return a.value < b.value; });
}

double BeddedSlope::exact() const {
  const Ring whole = mass();
  const Extent extent = extent_of(whole);
  const int first = static_cast<int>(std::floor((extent.u_from - cross_from) / cross));
  const int last = static_cast<int>(std::ceil((extent.u_to - cross_from) / cross));
  Cells cells;
  cells.levels = static_cast<int>(std::ceil(extent.v_to / bed)) + 1;
  for (int k = first; k < last; ++k) add_cell(cells, whole, extent, k);
  if (last > first && !table.empty()) add_water_at_back(cells, whole, extent);
  double factor = std::numeric_limits<double>::infinity();
  double guess = 10.0;
  for (int rounds = 0; rounds < 100; ++rounds) {
    const Path least = least_path(cells, guess);
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

}  // namespace edda
