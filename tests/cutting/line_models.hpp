// Models of line work for the tests of this room, and ways to move a model about.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "cutting/build_polygons.hpp"

namespace edda::test {

inline Model domain_model(Ring outline, double snap) {
  Model model;
  Domain domain;
  domain.outline = std::move(outline);
  domain.material = 0;
  domain.snap = snap;
  domain.max_blocks = 3'000'000;
  domain.where = {"domain", "test.toml", 3, 1};
  model.domain = domain;
  return model;
}

inline Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline void add_trace(Model& model, std::vector<Vec2> points, Index joint = none) {
  Trace trace;
  trace.points = std::move(points);
  trace.joint = joint;
  trace.where = {"trace." + std::to_string(model.traces.size()), "test.toml", 9, 1};
  model.traces.push_back(trace);
}

inline void add_set(Model& model, double angle, double spacing, Vec2 origin, Index joint = none,
                    Ring region = {}) {
  JointSet set;
  set.angle = angle;
  set.spacing = spacing;
  set.origin = origin;
  set.joint = joint;
  set.region = std::move(region);
  set.where = {"joint_set." + std::to_string(model.joint_sets.size()), "test.toml", 9, 1};
  model.joint_sets.push_back(set);
}

inline void add_opening(Model& model, Ring polygon, Index joint = none) {
  Opening opening;
  opening.polygon = std::move(polygon);
  opening.joint = joint;
  opening.where = {"opening." + std::to_string(model.openings.size()), "test.toml", 9, 1};
  model.openings.push_back(opening);
}

inline void add_block(Model& model, Ring polygon, bool fixed = false) {
  BlockInput block;
  block.polygon = std::move(polygon);
  block.fixed = fixed;
  block.where = {"block." + std::to_string(model.blocks.size()), "test.toml", 9, 1};
  model.blocks.push_back(block);
}

/// Every point of a model through `move`; angles of sets turned by `turn` degrees, spacings and
/// snap times `scale`.
inline Model moved(Model model, const std::function<Vec2(Vec2)>& move, double turn = 0.0,
                   double scale = 1.0) {
  const auto all = [&](auto& points) {
    for (Vec2& p : points) p = move(p);
  };
  if (model.domain) {
    all(model.domain->outline);
    model.domain->snap *= scale;
  }
  for (auto& t : model.traces) all(t.points);
  for (auto& o : model.openings) all(o.polygon);
  for (auto& b : model.blocks) all(b.polygon);
  for (auto& h : model.fixed) h.point = move(h.point);
  for (auto& s : model.joint_sets) {
    all(s.region);
    s.origin = move(s.origin);
    s.angle += turn;
    s.spacing *= scale;
  }
  return model;
}

inline Model turned(const Model& model, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return moved(
      model, [a](Vec2 p) { return rotated(p, a); }, degrees);
}

inline Model shifted(const Model& model, Vec2 by) {
  return moved(model, [by](Vec2 p) { return p + by; });
}

inline Model scaled(const Model& model, double by) {
  return moved(
      model, [by](Vec2 p) { return by * p; }, 0.0, by);
}

/// n lines in general position, each right across the box.
inline Model random_lines(int n, unsigned seed, double width = 10.0, double height = 7.0) {
  Model model = domain_model(box(0, 0, width, height), 1e-13 * width);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(0.0, width), y(0.0, height),
      angle(0.0, std::numbers::pi);
  for (int i = 0; i < n; ++i) {
    const Vec2 p{x(random), y(random)};
    const Vec2 d = rotated({width + height, 0.0}, angle(random));
    add_trace(model, {p - d, p + d}, i);
  }
  return model;
}

/// The cavern: two joint sets round a horseshoe whose roof is an arc of `segments` edges.
inline Model cavern(int segments) {
  Model model = domain_model(box(-30, -25, 30, 25), 6e-8);
  add_set(model, 65.0, 4.0, {3.5, 0.0}, 0);
  add_set(model, -15.0, 4.0, {0.0, 0.5}, 1);
  // The circle through (-9, 4), (0, 10), (9, 4): radius (9^2 + 6^2) / (2 6).
  const double radius = 117.0 / 12.0, centre = 10.0 - radius;
  const double start = std::atan2(4.0 - centre, 9.0);
  Ring ring = {{-9, -8}, {9, -8}, {9, 4}};
  for (int i = 1; i < segments; ++i) {
    const double a = start + (std::numbers::pi - 2.0 * start) * i / segments;
    ring.push_back({radius * std::cos(a), centre + radius * std::sin(a)});
  }
  ring.push_back({-9, 4});
  add_opening(model, ring);
  return model;
}

inline double total_area(const std::vector<BlockPolygon>& blocks) {
  double sum = 0.0;
  for (const BlockPolygon& block : blocks) sum += moments(block.rings).area;
  return sum;
}

}  // namespace edda::test
