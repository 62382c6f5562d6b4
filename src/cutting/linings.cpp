#include "cutting/linings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/rings.hpp"

namespace edda {
namespace {

/// A line with the lining on its left; closed: from its last point to its first, too.
struct Path {
  std::vector<Vec2> points;
  bool closed = false;
  EndSections ends = {};
  std::size_t pieces() const { return closed ? points.size() : points.size() - 1; }
  Vec2 after(std::size_t k) const { return points[(k + 1) % points.size()]; }
  double length() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < pieces(); ++k) sum += norm(after(k) - points[k]);
    return sum;
  }
};

Path round_outline(Ring ring) {
  if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  return {std::move(ring), true};
}

/// Part of an outline, from one ray from its centroid to another one, counter-clockwise.
Path part_of_outline(const Path& whole, double from_angle, double to_angle) {
  constexpr double degree = std::numbers::pi / 180.0;
  const std::size_t n = whole.points.size();
  const Vec2 middle = moments(std::span<const Ring>(&whole.points, 1)).centroid;
  // Where a ray leaves the outline: edge, and fraction of it.
  const auto leaves = [&](double angle) {
    const Vec2 t{std::cos(angle * degree), std::sin(angle * degree)};
    double out = 0.0, fraction = 0.0;
    std::size_t edge = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 a = whole.points[k] - middle, u = whole.after(k) - whole.points[k];
      const double slope = cross(t, u), on_edge = cross(a, t) / slope, far = cross(a, u) / slope;
      if (slope == 0.0 || on_edge < 0.0 || on_edge >= 1.0 || !(far > out)) continue;
      out = far;
      edge = k;
      fraction = on_edge;
    }
    return std::pair{edge, fraction};
  };
  const auto [first, at_first] = leaves(from_angle);
  const auto [last, at_last] = leaves(to_angle);
  const auto point = [&](std::size_t edge, double fraction) {
    return whole.points[edge] + fraction * (whole.after(edge) - whole.points[edge]);
  };
  Path part;
  part.points.push_back(point(first, at_first));
  const bool round = first == last && at_last <= at_first;
  for (std::size_t k = first; k != last || (round && part.points.size() == 1); k = (k + 1) % n)
    part.points.push_back(whole.after(k));
  part.points.push_back(point(last, at_last));
  constexpr double same = 1e-9;
  const double size = whole.length();
  const auto twice = [&](Vec2 a, Vec2 b) { return norm(a - b) < same * size; };
  part.points.erase(std::unique(part.points.begin(), part.points.end(), twice), part.points.end());
  return part;
}

/// The inner side of another lining; empty where that is faulty itself.
Path path_on(const Model& model, const PolygonSet& polygons, const std::string& name) {
  const auto below =
      std::find_if(polygons.blocks.begin(), polygons.blocks.end(), [&](const BlockPolygon& b) {
        return b.lining != none && model.linings[static_cast<std::size_t>(b.lining)].name == name;
      });
  if (below == polygons.blocks.end()) return {};
  const StripSections s = sections_of(*below);
  const Ring& ring = below->rings[s.closed ? 1 : 0];
  Path inner{{ring.rbegin(), ring.rend()}, s.closed};
  if (s.closed) return inner;
  inner.points.resize(s.count);
  const auto across = [&](std::uint32_t k) { return ring[s.inner(k)] - ring[s.outer(k)]; };
  inner.ends = {across(0), across(s.count - 1)};
  return inner;
}

/// In the coordinates of the polygons.
Path path_on_wall(const Model& model, const PolygonSet& polygons, const Lining& lining) {
  const auto local = [&](Path path) {
    for (Vec2& p : path.points) p -= polygons.origin;
    return path;
  };
  if (!lining.along.empty()) {
    std::vector<Vec2> points = lining.along;
    const bool closed = points.size() > 3 && points.front() == points.back();
    if (!closed) return local({std::move(points), false});
    points.pop_back();
    return local(round_outline(std::move(points)));
  }
  const auto opening = std::find_if(model.openings.begin(), model.openings.end(),
                                    [&](const Opening& o) { return o.name == lining.opening; });
  const Path whole = round_outline(opening->polygon);
  return local(lining.from_angle ? part_of_outline(whole, *lining.from_angle, *lining.to_angle)
                                 : whole);
}

/// Those of all linings; empty for layers on others. Where one goes on as another one, both end in
/// the section that halves the angle between them. within: of the smaller thickness.
std::vector<Path> paths_on_walls(const Model& model, const PolygonSet& polygons, double within) {
  std::vector<Path> paths(model.linings.size());
  for (std::size_t q = 0; q < paths.size(); ++q)
    if (model.linings[q].on.empty()) paths[q] = path_on_wall(model, polygons, model.linings[q]);
  for (std::size_t p = 0; p < paths.size(); ++p) {
    for (std::size_t q = 0; q < paths.size(); ++q) {
      Path &one = paths[p], &next = paths[q];
      if (p == q || one.closed || next.closed || one.points.empty() || next.points.empty())
        continue;
      const double thickness =
          std::min(model.linings[p].drawn_thickness(), model.linings[q].drawn_thickness());
      if (norm(one.points.back() - next.points.front()) > within * thickness) continue;
      const Vec2 in = one.points.back() - one.points.end()[-2],
                 out = next.points[1] - next.points[0];
      one.ends.last = next.ends.first = perp(unit(in) + unit(out));
    }
  }
  return paths;
}

Path divided(const Path& path, double size) {
  Path fine{{}, path.closed, path.ends};
  for (std::size_t k = 0; k < path.pieces(); ++k) {
    const Vec2 from = path.points[k], whole = path.after(k) - from;
    const auto parts = static_cast<int>(std::max(1.0, std::ceil(norm(whole) / size - 1e-6)));
    for (int q = 0; q < parts; ++q) fine.points.push_back(from + (q / double(parts)) * whole);
  }
  if (!path.closed) fine.points.push_back(path.points.back());
  return fine;
}

/// Whether each piece is a convex quadrilateral.
bool is_whole(const Path& outer, const std::vector<Vec2>& inner) {
  const std::size_t n = inner.size();
  for (std::size_t k = 0; k < outer.pieces(); ++k) {
    const Vec2 q[4] = {outer.points[k], outer.after(k), inner[(k + 1) % n], inner[k]};
    for (std::size_t c = 0; c < 4; ++c) {
      if (!(cross(q[(c + 1) % 4] - q[c], q[(c + 2) % 4] - q[(c + 1) % 4]) > 0.0)) return false;
    }
  }
  return true;
}

/// Whether a corner or the middle of a side of a lining lies on a block.
bool touches(const BlockPolygon& lining, std::span<const BlockPolygon> blocks, double within) {
  const auto apart = [&](const BlockPolygon& block, Vec2 axis) {
    const auto [low, high] = extent_along(lining.rings[0], axis);
    const auto [least, most] = extent_along(block.rings[0], axis);
    return least > high + within || most < low - within;
  };
  return std::any_of(blocks.begin(), blocks.end(), [&](const BlockPolygon& block) {
    if (apart(block, {1, 0}) || apart(block, {0, 1})) return false;
    for (const Ring& ring : lining.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 middle = 0.5 * (ring[k] + ring[(k + 1) % ring.size()]);
        if (side_of(block.rings, ring[k], within) == 0 || side_of(block.rings, middle, within) == 0)
          return true;
      }
    }
    return false;
  });
}

/// Whether the middle of a piece lies in a block of rock that stays.
bool lies_within(const BlockPolygon& lining, std::span<const BlockPolygon> blocks, double within) {
  const StripSections s = sections_of(lining);
  const std::vector<Vec2> corner = all_corners(lining);
  for (std::uint32_t p = 0; p < s.pieces(); ++p) {
    Vec2 middle;
    for (const std::uint32_t v : s.corners(p)) middle += 0.25 * corner[v];
    const auto holds = [&](const BlockPolygon& block) {
      return block.opening == none && block.fill == none &&
             side_of(block.rings, middle, within) > 0;
    };
    if (std::any_of(blocks.begin(), blocks.end(), holds)) return true;
  }
  return false;
}

BlockPolygon strip_of(const Lining& lining, const Path& path, std::vector<Vec2> inner) {
  std::reverse(inner.begin(), inner.end());
  BlockPolygon strip;
  strip.rings = {path.points};
  if (path.closed) {
    strip.rings.push_back(std::move(inner));
  } else {
    strip.rings[0].insert(strip.rings[0].end(), inner.begin(), inner.end());
  }
  for (const Ring& ring : strip.rings) strip.joint.emplace_back(ring.size(), lining.interface);
  strip.material = lining.material;
  strip.name = lining.name;
  strip.where = lining.where;
  return strip;
}

}  // namespace

std::vector<Vec2> inner_side(std::span<const Vec2> outer, bool closed, double thickness,
                             const EndSections& ends) {
  const std::size_t n = outer.size();
  std::vector<Vec2> inner;
  for (std::size_t k = 0; k < n; ++k) {
    const bool first = !closed && k == 0, last = !closed && k + 1 == n;
    const Vec2 p = outer[k];
    const Vec2 in = first ? Vec2{} : perp(unit(p - outer[(k + n - 1) % n])),
               out = last ? Vec2{} : perp(unit(outer[(k + 1) % n] - p));
    const Vec2 given = first ? ends.first : last ? ends.last : Vec2{};
    const Vec2 section = given == Vec2{} ? in + out : given;
    inner.push_back(p + thickness / dot(section, first ? out : in) * section);
  }
  return inner;
}

std::vector<Vec2> all_corners(const BlockPolygon& lining) {
  std::vector<Vec2> all;
  for (const Ring& ring : lining.rings) all.insert(all.end(), ring.begin(), ring.end());
  return all;
}

StripSections sections_of(const BlockPolygon& lining) {
  const bool closed = lining.rings.size() == 2;
  const std::size_t corners = lining.rings[0].size();
  return {static_cast<std::uint32_t>(closed ? corners : corners / 2), closed};
}

Faults add_linings(const Model& model, PolygonSet& polygons) {
  constexpr double rounding = 1e-3;  // of the thickness
  const std::vector<Path> walls = paths_on_walls(model, polygons, rounding);
  Faults faults;
  for (std::size_t q = 0; q < model.linings.size(); ++q) {
    const Lining& lining = model.linings[q];
    Path path = lining.on.empty() ? walls[q] : path_on(model, polygons, lining.on);
    if (path.points.empty()) continue;
    const double thickness = lining.drawn_thickness();
    path = divided(path, lining.size.value_or(std::max(2.0 * thickness, path.length() / 32.0)));
    std::vector<Vec2> inner = inner_side(path.points, path.closed, thickness, path.ends);
    if (!is_whole(path, inner)) {
      faults.push_back({lining.where, "is too thick for its corners",
                        "give longer pieces (size), less thickness, or a line whose corners are "
                        "further apart"});
      continue;
    }
    BlockPolygon strip = strip_of(lining, path, std::move(inner));
    strip.lining = static_cast<Index>(q);
    if (!polygons.blocks.empty() && !touches(strip, polygons.blocks, rounding * thickness)) {
      faults.push_back(
          {lining.where, "touches no block", "move it to a wall (edda cut draws the blocks)"});
      continue;
    }
    if (lies_within(strip, polygons.blocks, rounding * thickness)) {
      faults.push_back({lining.where, "lies within a block",
                        lining.along.empty()
                            ? "give less thickness, or make room for it"
                            : "write its line the other way round: a lining lies on its left"});
      continue;
    }
    polygons.blocks.push_back(std::move(strip));
  }
  return faults;
}

}  // namespace edda
