// Checkpoint data of the attachments: ground motion, boundaries and bolts.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

template <class Archive>
void list_bolt_springs(Archive& a, const std::string& of, BoltSprings& s) {
  a(of + "stiffness", s.stiffness);
  a(of + "strength", s.strength);
  a(of + "plastic", s.plastic);
  a(of + "force", s.force);
  a(of + "force_1", s.force_1);
  a(of + "yielded", s.yielded);
  a(of + "broken", s.broken);
}

inline bool fits(const BoltSprings& s, std::size_t nodes) {
  for (const auto* values : {&s.stiffness, &s.strength, &s.plastic, &s.force, &s.force_1}) {
    if (values->size() != nodes) return false;
  }
  return s.yielded.size() == nodes && s.broken.size() == nodes;
}

/// Whether rows and nodes are those of bolts of the model in its blocks.
inline bool fits(const Bolts& b, const Simulation& s) {
  const std::size_t nodes = b.size(), known = all_bolts(s.scene->model).size();
  for (const Nodes* of_host : {&b.weight, &b.along}) {
    for (const auto& values : *of_host) {
      if (values.size() != nodes) return false;
    }
  }
  for (const auto* values : {&b.distance, &b.bonded, &b.length, &b.slip}) {
    if (values->size() != nodes) return false;
  }
  if (b.crossing.size() != nodes || b.hinges.size() != nodes || b.on_host.size() != nodes) {
    return false;
  }
  if (b.begin.size() != b.rows.size() + 1 || b.begin.front() != 0 || b.begin.back() != nodes) {
    return false;
  }
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    if (b.rows[r].row < 0 || static_cast<std::size_t>(b.rows[r].row) >= known) return false;
    if (b.begin[r] >= b.begin[r + 1]) return false;
  }
  if (b.zone.size() != nodes) return false;
  const BlockSet& blocks = s.scene->blocks;
  for (std::size_t k = 0; k < nodes; ++k) {
    const Id i = b.host[k], z = b.zone[k];
    if (i >= blocks.size() || blocks.is_meshed(i) != (z != no_id)) return false;
    const auto& begin = blocks.meshes.zone_begin;
    if (z != no_id && (z < begin[i] || z >= begin[i + 1])) return false;
  }
  return fits(b.bonds, nodes) && fits(b.bars, nodes) && fits(b.dowels, nodes);
}

template <class Archive>
void list_bolts(Archive& a, Simulation& s) {
  if (!has_bolts(s.scene->model)) return;
  Bolts& b = s.attached.bolts;
  std::vector<Index> rows;
  for (const BoltData& row : b.rows) rows.push_back(row.row);
  std::vector<Vec2> pushes;
  for (const auto& f : b.on_host) pushes.insert(pushes.end(), f.begin(), f.end());
  a("bolts.rows", rows);
  a("bolts.begin", b.begin);
  a("bolts.host", b.host);
  a("bolts.zone", b.zone);
  a("bolts.weight", b.weight);
  a("bolts.along", b.along);
  a("bolts.distance", b.distance);
  a("bolts.bonded", b.bonded);
  a("bolts.length", b.length);
  a("bolts.crossing", b.crossing);
  a("bolts.hinges", b.hinges);
  a("bolts.slip", b.slip);
  list_bolt_springs(a, "bolts.bonds.", b.bonds);
  list_bolt_springs(a, "bolts.bars.", b.bars);
  list_bolt_springs(a, "bolts.dowels.", b.dowels);
  a("bolts.slipped", b.slipped);
  a("bolts.fractured", b.fractured);
  a("bolts.work_pending", b.work_pending);
  a("bolts.pending_friction", b.pending_friction);
  a("bolts.pending_fracture", b.pending_fracture);
  list_points(a, "bolts.on_host", pushes);
  if constexpr (Archive::loads) {
    b.rows.assign(rows.size(), {});
    for (std::size_t r = 0; r < rows.size(); ++r) b.rows[r].row = rows[r];
    b.on_host.assign(b.size(), {});
    if (b.rows.empty() && b.begin.size() <= 1 && b.size() == 0) return;
    if (pushes.size() != nodes_per_block * b.size() || !fits(b, s))
      return a.refuse("bolts do not fit the model");
    auto push = pushes.begin();
    for (NodeVectors& f : b.on_host) {
      for (Vec2& on_node : f) on_node = *push++;
    }
    complete_bolts(b, s.scene->model, s.scene->blocks.size());
  }
}

/// Returns false if the number of values differs from that of the model.
template <class Archive>
bool list_stepped(Archive& a, const std::string& of, std::vector<SteppedValue>& values) {
  std::vector<double> value, before, changed;
  for (const SteppedValue& v : values) {
    value.push_back(v.value);
    before.push_back(v.before);
    changed.push_back(v.changed);
  }
  a(of + ".value", value);
  a(of + ".before", before);
  a(of + ".changed", changed);
  const std::size_t count = values.size();
  if (value.size() != count || before.size() != count || changed.size() != count) return false;
  for (std::size_t k = 0; k < count; ++k) values[k] = {value[k], before[k], changed[k]};
  return true;
}

/// What ramps and trials have made of gravity and loads.
template <class Archive>
void list_slow_loading(Archive& a, Simulation& s) {
  SlowLoading& slow = s.attached.loads.slow;
  std::vector<SteppedValue> gravity{slow.kh,   slow.kv,     slow.tilt, slow.gravity,
                                    slow.flow, slow.change, slow.time};
  bool fits = list_stepped(a, "slow.gravity", gravity);
  fits = list_stepped(a, "slow.loads", slow.loads) && fits;
  fits = list_stepped(a, "slow.waters", slow.waters) && fits;
  fits = list_stepped(a, "slow.boundaries", slow.boundaries) && fits;
  if constexpr (Archive::loads) {
    if (!fits) return a.refuse("ramped loads do not fit the model");
    slow.kh = gravity[0];
    slow.kv = gravity[1];
    slow.tilt = gravity[2];
    slow.gravity = gravity[3];
    slow.flow = gravity[4];
    slow.change = gravity[5];
    slow.time = gravity[6];
  }
}

/// Wall forces of excavated rock and of replaced boundaries, and the fractions of them that still
/// act.
template <class Archive>
void list_wall_forces(Archive& a, Simulation& s) {
  std::vector<Id> vertex;
  std::vector<Vec2> force;
  std::vector<Index> owner;
  for (const WallForce& f : s.attached.wall_forces) {
    vertex.push_back(f.vertex);
    force.push_back(f.force);
    owner.push_back(f.owner);
  }
  a("wall_force.vertex", vertex);
  list_points(a, "wall_force.force", force);
  a("wall_force.owner", owner);
  const bool all = list_stepped(a, "remaining", s.attached.loads.remaining);
  if constexpr (Archive::loads) {
    const auto owners = static_cast<std::size_t>(Owners(s.scene->model).of_walls());
    bool fits = all && force.size() == vertex.size() && owner.size() == vertex.size();
    for (std::size_t k = 0; fits && k < vertex.size(); ++k) {
      fits = vertex[k] < s.scene->blocks.vertex_count() && owner[k] >= 0 &&
             static_cast<std::size_t>(owner[k]) < owners;
    }
    if (!fits) return a.refuse("forces that are kept do not fit the model");
    for (std::size_t k = 0; k < owners; ++k) {
      remove_wall_forces(s.scene->model, s.scene->blocks, static_cast<Index>(k), s.attached.loads);
    }
    s.attached.wall_forces.clear();
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      s.attached.wall_forces.push_back({vertex[k], force[k], owner[k]});
    }
    keep_wall_forces(s.scene->model, s.scene->blocks, s.attached.wall_forces, s.attached.loads);
  }
}

/// Returns false if the number of intervals differs from that of the model.
template <class Archive>
bool list_intervals(Archive& a, const std::string& of, std::vector<ActiveInterval>& intervals) {
  std::vector<double> since, until;
  for (const ActiveInterval& interval : intervals) {
    since.push_back(interval.since);
    until.push_back(interval.until);
  }
  a("since." + of, since);
  a("until." + of, until);
  if (since.size() != intervals.size() || until.size() != intervals.size()) return false;
  for (std::size_t q = 0; q < intervals.size(); ++q) intervals[q] = {since[q], until[q]};
  return true;
}

/// The state of the ground, and the active intervals of ground motions, loads, waters and
/// boundaries.
template <class Archive>
void list_ground(Archive& a, Simulation& s) {
  std::vector<Vec2> ground{s.attached.ground.velocity, s.attached.ground.shift,
                           s.attached.ground.shift_1};
  list_points(a, "ground", ground);
  list_points(a, "springs.shift", s.attached.springs.shift);
  list_points(a, "springs.shift_1", s.attached.springs.shift_1);
  for (std::size_t q = 0; q < s.attached.free_field.columns.size(); ++q) {
    FreeFieldColumn& column = s.attached.free_field.columns[q];
    const std::size_t nodes = column.moved.size();
    list_points(a, fmt::format("free_field.{}.moved", q), column.moved);
    list_points(a, fmt::format("free_field.{}.velocity", q), column.velocity);
    if constexpr (Archive::loads) {
      if (column.moved.size() != nodes || column.velocity.size() != nodes) {
        return a.refuse("free-field columns do not fit the model");
      }
    }
  }
  a("springs.start_x", s.attached.springs.start_x);
  a("springs.start_y", s.attached.springs.start_y);
  ActiveIntervals& intervals = s.attached.loads.intervals;
  bool fit = list_intervals(a, "loads", intervals.loads);
  fit = list_intervals(a, "waters", intervals.waters) && fit;
  fit = list_intervals(a, "boundaries", intervals.boundaries) && fit;
  fit = list_intervals(a, "shakings", intervals.shakings) && fit;
  if constexpr (Archive::loads) {
    const std::size_t rows = s.scene->model.boundaries.size();
    const bool fits = fit && ground.size() == 3 && s.attached.springs.shift.size() == rows &&
                      s.attached.springs.shift_1.size() == rows &&
                      s.attached.springs.start_x.size() == s.attached.springs.size() &&
                      s.attached.springs.start_y.size() == s.attached.springs.size();
    if (!fits) return a.refuse("ground does not fit the model");
    s.attached.ground.velocity = ground[0];
    s.attached.ground.shift = ground[1];
    s.attached.ground.shift_1 = ground[2];
    for (std::size_t q = 0; q < s.attached.springs.size(); ++q) {
      const auto row = static_cast<std::size_t>(s.attached.springs.boundary[q]);
      const bool acts = intervals.boundaries[row].acts();
      s.attached.springs.kxx[q] = acts ? s.attached.springs.acting_k[q][0] : 0.0;
      s.attached.springs.kyy[q] = acts ? s.attached.springs.acting_k[q][1] : 0.0;
      s.attached.springs.kxy[q] = acts ? s.attached.springs.acting_k[q][2] : 0.0;
    }
    s.attached.dashpots.set_acting(intervals.boundaries);
  }
}

}  // namespace edda
