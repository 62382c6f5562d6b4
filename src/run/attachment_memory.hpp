// What a checkpoint holds of the attachments: the ground and what is driven with it, and bolts.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

template <class Archive>
void list_points(Archive& a, const std::string& name, std::vector<Vec2>& points) {
  std::vector<double> flat;
  for (const Vec2 p : points) {
    flat.push_back(p.x);
    flat.push_back(p.y);
  }
  a(name, flat);
  if constexpr (Archive::loads) {
    points.clear();
    for (std::size_t k = 0; k + 1 < flat.size(); k += 2) points.push_back({flat[k], flat[k + 1]});
  }
}

template <class Archive>
void list_bolt_springs(Archive& a, const std::string& of, BoltSprings& s) {
  a(of + "plastic", s.plastic);
  a(of + "force", s.force);
  a(of + "force_1", s.force_1);
  a(of + "yielded", s.yielded);
  a(of + "broken", s.broken);
}

/// Bolts: where they sit follows from the model, what has become of them does not.
template <class Archive>
void list_bolts(Archive& a, Simulation& s) {
  Bolts& b = s.bolts;
  if (b.rows.empty()) return;
  const std::size_t nodes = b.size();
  a("bolts.slip", b.slip);
  list_bolt_springs(a, "bolts.bonds.", b.bonds);
  list_bolt_springs(a, "bolts.bars.", b.bars);
  list_bolt_springs(a, "bolts.dowels.", b.dowels);
  a("bolts.slipped", b.slipped);
  a("bolts.fractured", b.fractured);
  a("bolts.will_slip", b.will_slip);
  a("bolts.will_fracture", b.will_fracture);
  std::vector<Vec2> pushes;
  for (const auto& f : b.on_host) pushes.insert(pushes.end(), f.begin(), f.end());
  list_points(a, "bolts.on_host", pushes);
  if constexpr (Archive::loads) {
    bool fits = b.slip.size() == nodes && pushes.size() == 3 * nodes;
    for (const BoltSprings* q : {&b.bonds, &b.bars, &b.dowels}) {
      fits = fits && q->plastic.size() == nodes && q->force.size() == nodes &&
             q->force_1.size() == nodes && q->yielded.size() == nodes && q->broken.size() == nodes;
    }
    if (!fits) return a.refuse("bolts do not fit the model");
    for (std::size_t k = 0; k < nodes; ++k) {
      std::copy_n(pushes.begin() + static_cast<std::ptrdiff_t>(3 * k), 3, b.on_host[k].begin());
    }
  }
}

/// What rock taken out did to its walls, and how much of that is still there.
template <class Archive>
void list_walls(Archive& a, Simulation& s) {
  std::vector<Id> vertex;
  std::vector<Vec2> force;
  std::vector<Index> opening;
  for (const WallForce& w : s.walls) {
    vertex.push_back(w.vertex);
    force.push_back(w.force);
    opening.push_back(w.opening);
  }
  a("walls.vertex", vertex);
  list_points(a, "walls.force", force);
  a("walls.opening", opening);
  a("walls.held", s.loads.held);
  if constexpr (Archive::loads) {
    const std::size_t openings = s.model.openings.size();
    bool fits = force.size() == vertex.size() && opening.size() == vertex.size() &&
                s.loads.held.size() == openings;
    for (std::size_t k = 0; fits && k < vertex.size(); ++k) {
      fits = vertex[k] < s.blocks.vertex_count() && opening[k] >= 0 &&
             static_cast<std::size_t>(opening[k]) < openings;
    }
    if (!fits) return a.refuse("walls of openings do not fit the model");
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      s.walls.push_back({vertex[k], force[k], opening[k]});
    }
    hold_walls(s.model, s.blocks, s.walls, s.loads);
  }
}

/// The ground, and when what shakes and drives it began.
template <class Archive>
void list_ground(Archive& a, Simulation& s) {
  std::vector<Vec2> ground{s.ground.velocity, s.ground.shift, s.ground.shift_1};
  list_points(a, "ground", ground);
  list_points(a, "springs.shift", s.springs.shift);
  list_points(a, "springs.shift_1", s.springs.shift_1);
  a("since.boundaries", s.loads.since.boundaries);
  a("since.shakings", s.loads.since.shakings);
  if constexpr (Archive::loads) {
    const std::size_t rows = s.model.boundaries.size();
    const bool fits = ground.size() == 3 && s.springs.shift.size() == rows &&
                      s.springs.shift_1.size() == rows && s.loads.since.boundaries.size() == rows &&
                      s.loads.since.shakings.size() == s.model.shakings.size();
    if (!fits) return a.refuse("ground does not fit the model");
    s.ground.velocity = ground[0];
    s.ground.shift = ground[1];
    s.ground.shift_1 = ground[2];
  }
}

}  // namespace edda
