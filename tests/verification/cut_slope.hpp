// Rock slopes cut by two joint sets whose angles and spacings vary, and which blocks touch each
// other by geometry alone: every block against every block, by points in polygons.
#pragma once

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/scene.hpp"

namespace edda {

struct CutSlope {
  unsigned seed = 1;
  double angle = 4.0;                    ///< degrees: deviation of the directions of both sets
  std::string distribution = "uniform";  ///< of angles and spacings
  double cohesion = 0.0;                 ///< Pa, of all joints; they are bonded where it is given
  double height = 30.0;                  ///< m
  std::string more = {};                 ///< further lines of the model
};

/// Slope number n of the study: deviations of 0 to 8 degrees in each of the three distributions,
/// every other one with bonded joints.
inline CutSlope cut_slope(unsigned n, double height = 30.0) {
  const char* const kinds[] = {"normal", "uniform", "exponential"};
  return {n + 1, static_cast<double>(n % 9), kinds[(n / 9) % 3], n % 2 == 0 ? 5e3 : 0.0, height};
}

inline std::string slope_model(const CutSlope& s) {
  const bool random = s.distribution == "exponential";  // as wide as it may be
  const auto set = [&](const char* name, double angle, double spacing, double deviation) {
    return "[[joint_set]]\nname = '" + std::string(name) + "'\njoint = '" + name +
           "'\nangle = " + number(angle) + "\nspacing = " + number(spacing) +
           "\norigin = [0.3, 0.2]\nseed = " + std::to_string(s.seed) +
           "\ndeviation = { angle = " + number(s.angle) +
           ", spacing = " + number(random ? spacing : deviation) + ", distribution = '" +
           s.distribution + "' }\n";
  };
  return "[materials.rock]\ndensity = 2600.0\nyoung = 5e9\npoisson = 0.25\n"
         "[solver]\nduration = 10.0\n[joints.bedding]\nfriction_angle = 30.0\ncohesion = " +
         number(s.cohesion) +
         "\n[joints.cross]\nfriction_angle = 35.0\ncohesion = " + number(s.cohesion) +
         "\n"
         "[slope]\ntoe = [0.0, 0.0]\nheight = " +
         number(s.height) + "\nface_angle = 60.0\nbase_y = " + number(-s.height / 3.0) +
         "\nextent = [" + number(-s.height) + ", " + number(8.0 / 3.0 * s.height) +
         "]\n[domain]\n" + set("bedding", 38.0, 2.0, 0.8) + set("cross", -62.0, 2.5, 1.0) +
         "[[boundary]]\nname = 'ground'\nsides = ['left', 'right', 'bottom']\ntype = 'fixed'\n" +
         s.more;
}

/// Edges of a block in its present position.
using Outline = std::vector<std::pair<Vec2, Vec2>>;

inline std::vector<Outline> outlines(const BlockSet& b, const Pose& pose) {
  std::vector<Outline> all(b.size());
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const Id w = b.next[v];
    all[b.vertex_block[v]].push_back({{pose.x[v], pose.y[v]}, {pose.x[w], pose.y[w]}});
  }
  return all;
}

/// Distance of p from the outline, m; below zero outside.
inline double depth_in(const Outline& block, Vec2 p) {
  bool in = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : block) {
    const Vec2 u = b - a;
    const double s = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
    nearest = std::min(nearest, norm(p - a - s * u));
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * u.x > p.x) in = !in;
  }
  return in ? nearest : -nearest;
}

struct Box {
  double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
  bool meets(const Box& o) const { return x0 <= o.x1 && o.x0 <= x1 && y0 <= o.y1 && o.y0 <= y1; }
};

inline Box box_of(const Outline& block) {
  Box box;
  for (const auto& [a, b] : block) {
    box.x0 = std::min(box.x0, a.x);
    box.y0 = std::min(box.y0, a.y);
    box.x1 = std::max(box.x1, a.x);
    box.y1 = std::max(box.y1, a.y);
  }
  return box;
}

/// Depth of one block in another, m: of its corners, and of five points along each edge.
inline double overlap_of(const Outline& block, const Outline& other) {
  double deepest = 0.0;
  for (const auto& [a, b] : block) {
    for (int k = 0; k < 6; ++k) {
      const double part = k / 6.0;
      deepest = std::max(deepest, depth_in(other, (1.0 - part) * a + part * b));
    }
  }
  return deepest;
}

/// Largest depth of any block in any other, m.
inline double deepest_overlap(const std::vector<Outline>& blocks) {
  std::vector<Box> boxes;
  for (const Outline& block : blocks) boxes.push_back(box_of(block));
  double deepest = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t j = 0; j < blocks.size(); ++j) {
      if (i != j && boxes[i].meets(boxes[j]))
        deepest = std::max(deepest, overlap_of(blocks[i], blocks[j]));
    }
  }
  return deepest;
}

/// A contact that carries a normal force: its point, and the depth of that point in the other block
/// according to the program.
struct Pressing {
  Id block, other;
  Vec2 point;
  double depth;  ///< m
  double force;  ///< N
};

/// The only function that depends on how contacts are stored.
inline std::vector<Pressing> pressing(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  std::vector<Pressing> list;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const FaceRow row = face_row(sim, k);
    const FaceFields& m = row.state;
    const double force = normal_force(row);
    if (!is_closed(row) || force <= 0.0) continue;
    // The corner that bounds the deeper end lies in the other block.
    const Vec2 point = deeper_end(face_points(c, sim.motion.pose.x, sim.motion.pose.y, k),
                                  {m.closure_a, m.closure_b}, {m.xi_a, m.xi_b}, {m.eta_a, m.eta_b});
    const double xi = m.closure_b >= m.closure_a ? m.xi_b : m.xi_a;
    const bool of_edge = xi == 0.0 || xi == 1.0;
    const Id e = block_of_edge(sim.scene->blocks, c, k),
             f = block_of_facing(sim.scene->blocks, c, k);
    list.push_back({of_edge ? e : f, of_edge ? f : e, point, closure_of(row), force});
  }
  return list;
}

/// Largest excess of the closure of a contact over the depth in the geometry, m.
inline double false_depth(const Simulation& sim, const std::vector<Outline>& blocks) {
  double worst = 0.0;
  for (const Pressing& p : pressing(sim)) {
    worst = std::max(worst, p.depth - std::max(depth_in(blocks[p.other], p.point), 0.0));
  }
  return worst;
}

/// The largest force between two blocks before anything has moved, over the weight of the heavier
/// one.
inline double largest_push(const Simulation& sim) {
  double largest = 0.0;
  for (const Pressing& p : pressing(sim)) {
    const double mass = std::max(sim.scene->blocks.mass[p.block], sim.scene->blocks.mass[p.other]);
    largest = std::max(largest, p.force / (9.81 * mass));
  }
  return largest;
}

/// Pairs of blocks with a common boundary longer than `least` (m), each once, the smaller number
/// first.
inline std::set<std::pair<Id, Id>> neighbours(const std::vector<Outline>& blocks, double least) {
  std::set<std::pair<Id, Id>> pairs;
  std::vector<Box> boxes;
  for (const Outline& block : blocks) boxes.push_back(box_of(block));
  const auto share = [&](const std::pair<Vec2, Vec2>& e, const std::pair<Vec2, Vec2>& f) {
    const double length = norm(e.second - e.first);
    const Vec2 t = (e.second - e.first) / length;
    const auto off = [&](Vec2 p) { return std::abs(cross(t, p - e.first)); };
    const double from = std::max(0.0, dot(t, f.second - e.first)),
                 to = std::min(length, dot(t, f.first - e.first));
    return to - from > least && off(f.first) < 1e-7 && off(f.second) < 1e-7;
  };
  for (Id i = 0; i < blocks.size(); ++i) {
    for (Id j = i + 1; j < blocks.size(); ++j) {
      if (!boxes[i].meets(boxes[j])) continue;
      for (const auto& e : blocks[i]) {
        for (const auto& f : blocks[j]) {
          if (share(e, f)) pairs.insert({i, j});
        }
      }
    }
  }
  return pairs;
}

/// Number of the pairs of blocks that penetrate each other by more than `depth` (m) and carry no
/// contact force.
inline std::size_t unfelt(const Simulation& sim, const std::vector<Outline>& blocks,
                          const std::set<std::pair<Id, Id>>& pairs, double depth) {
  std::set<std::pair<Id, Id>> felt;
  for (const Pressing& p : pressing(sim)) felt.insert(std::minmax(p.block, p.other));
  std::size_t count = 0;
  for (const auto& [i, j] : pairs) {
    if (felt.contains({i, j}) || (sim.scene->blocks.fixed[i] && sim.scene->blocks.fixed[j]))
      continue;
    count += std::max(overlap_of(blocks[i], blocks[j]), overlap_of(blocks[j], blocks[i])) > depth;
  }
  return count;
}

struct SlopeLook {
  std::size_t blocks = 0, pairs = 0;
  double drawn_overlap = 0.0;      ///< m, deepest of blocks as cut
  double drawn_false_depth = 0.0;  ///< m
  double drawn_push = 0.0;         ///< of a block's weight
  double drawn_energy = 0.0;       ///< J, stored in contacts at the start
  std::uint64_t steps = 0;
  double overlap = 0.0;      ///< m, deepest after these steps
  double false_depth = 0.0;  ///< m, after these steps
  std::size_t unfelt = 0;    ///< neighbours that then penetrate each other and carry no force
  double error = 0.0;        ///< of the energy balance
  std::string failure;

  // A corner of a sliver may be closed by the rounding of its coordinates, some 1e-12 m: a face has
  // two ends, and each the spring of two corners.
  static constexpr double push_of_rounding = 4e-3;

  bool good() const {
    return failure.empty() && pairs > blocks && drawn_overlap < 1e-9 && drawn_false_depth < 1e-9 &&
           drawn_push < push_of_rounding && drawn_energy < 1e-6 && overlap < 1e-4 &&
           false_depth < 1e-5 && unfelt == 0 && error < 1e-4;
  }
};

/// Runs a slope for some steps with default settings.
inline SlopeLook look_at_slope(const CutSlope& slope, std::uint64_t steps) {
  Simulation sim = scene(slope_model(slope));
  SlopeLook look;
  look.blocks = sim.scene->blocks.size();
  std::vector<Outline> blocks = outlines(sim.scene->blocks, sim.motion.pose);
  const auto pairs = neighbours(blocks, 1e-3);
  look.pairs = pairs.size();
  look.drawn_overlap = deepest_overlap(blocks);
  look.drawn_false_depth = false_depth(sim, blocks);
  look.drawn_push = largest_push(sim);
  start(sim, 1.0);
  look.drawn_energy = std::abs(account_energy(sim).contact);
  while (sim.motion.state.steps < steps && look.failure.empty()) {
    if (const auto failure = step(sim)) look.failure = failure->message;
    if (sim.motion.state.steps % 50 == 0)
      look.error = std::max(look.error, std::abs(account_energy(sim).error));
  }
  look.steps = sim.motion.state.steps;
  blocks = outlines(sim.scene->blocks, sim.motion.pose);
  look.overlap = deepest_overlap(blocks);
  look.false_depth = false_depth(sim, blocks);
  look.unfelt = unfelt(sim, blocks, pairs, 1e-9);
  return look;
}

}  // namespace edda
