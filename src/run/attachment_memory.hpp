// What a checkpoint holds of the attachments: the ground and what is driven with it, and bolts.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
  const std::size_t nodes = b.size(), known = all_bolts(s.model).size();
  for (std::size_t k = 0; k < 3; ++k) {
    if (b.weight[k].size() != nodes || b.along[k].size() != nodes) return false;
  }
  for (const auto* values : {&b.distance, &b.bonded, &b.length, &b.slip}) {
    if (values->size() != nodes) return false;
  }
  if (b.crossing.size() != nodes || b.on_host.size() != nodes) return false;
  if (b.begin.size() != b.rows.size() + 1 || b.begin.front() != 0 || b.begin.back() != nodes) {
    return false;
  }
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    if (b.rows[r].row < 0 || static_cast<std::size_t>(b.rows[r].row) >= known) return false;
    if (b.begin[r] >= b.begin[r + 1]) return false;
  }
  const bool in_blocks =
      std::all_of(b.host.begin(), b.host.end(), [&](Id i) { return i < s.blocks.size(); });
  return in_blocks && fits(b.bonds, nodes) && fits(b.bars, nodes) && fits(b.dowels, nodes);
}

template <class Archive>
void list_bolts(Archive& a, Simulation& s) {
  if (!has_bolts(s.model)) return;
  Bolts& b = s.bolts;
  std::vector<Index> rows;
  for (const BoltData& row : b.rows) rows.push_back(row.row);
  std::vector<Vec2> pushes;
  for (const auto& f : b.on_host) pushes.insert(pushes.end(), f.begin(), f.end());
  a("bolts.rows", rows);
  a("bolts.begin", b.begin);
  a("bolts.host", b.host);
  a("bolts.weight", b.weight);
  a("bolts.along", b.along);
  a("bolts.distance", b.distance);
  a("bolts.bonded", b.bonded);
  a("bolts.length", b.length);
  a("bolts.crossing", b.crossing);
  a("bolts.slip", b.slip);
  list_bolt_springs(a, "bolts.bonds.", b.bonds);
  list_bolt_springs(a, "bolts.bars.", b.bars);
  list_bolt_springs(a, "bolts.dowels.", b.dowels);
  a("bolts.slipped", b.slipped);
  a("bolts.fractured", b.fractured);
  a("bolts.owed", b.owed);
  a("bolts.will_slip", b.will_slip);
  a("bolts.will_fracture", b.will_fracture);
  list_points(a, "bolts.on_host", pushes);
  if constexpr (Archive::loads) {
    b.rows.assign(rows.size(), {});
    for (std::size_t r = 0; r < rows.size(); ++r) b.rows[r].row = rows[r];
    b.on_host.assign(b.size(), {});
    if (b.rows.empty() && b.begin.size() <= 1 && b.size() == 0) return;
    if (pushes.size() != 3 * b.size() || !fits(b, s)) return a.refuse("bolts do not fit the model");
    for (std::size_t k = 0; k < b.size(); ++k) {
      std::copy_n(pushes.begin() + static_cast<std::ptrdiff_t>(3 * k), 3, b.on_host[k].begin());
    }
    complete_bolts(b, s.model, s.blocks.size());
  }
}

/// What rock taken out and boundaries taken over from did, and how much of that is still there.
template <class Archive>
void list_kept(Archive& a, Simulation& s) {
  std::vector<Id> vertex;
  std::vector<Vec2> force;
  std::vector<Index> keeper;
  for (const KeptForce& f : s.kept) {
    vertex.push_back(f.vertex);
    force.push_back(f.force);
    keeper.push_back(f.keeper);
  }
  a("kept.vertex", vertex);
  list_points(a, "kept.force", force);
  a("kept.keeper", keeper);
  std::vector<double> part, before, changed;
  for (const Hold& hold : s.loads.held) {
    part.push_back(hold.part);
    before.push_back(hold.before);
    changed.push_back(hold.changed);
  }
  a("kept.part", part);
  a("kept.before", before);
  a("kept.changed", changed);
  if constexpr (Archive::loads) {
    const std::size_t keepers = s.model.openings.size() + s.model.boundaries.size();
    bool fits = force.size() == vertex.size() && keeper.size() == vertex.size() &&
                part.size() == keepers && before.size() == keepers && changed.size() == keepers;
    for (std::size_t k = 0; fits && k < vertex.size(); ++k) {
      fits = vertex[k] < s.blocks.vertex_count() && keeper[k] >= 0 &&
             static_cast<std::size_t>(keeper[k]) < keepers;
    }
    if (!fits) return a.refuse("forces that are kept do not fit the model");
    for (std::size_t k = 0; k < keepers; ++k) {
      s.loads.held[k] = {part[k], before[k], changed[k]};
    }
    for (std::size_t k = 0; k < keepers; ++k) {
      drop_forces(s.model, s.blocks, static_cast<Index>(k), s.loads);
    }
    s.kept.clear();
    for (std::size_t k = 0; k < vertex.size(); ++k) {
      s.kept.push_back({vertex[k], force[k], keeper[k]});
    }
    keep_forces(s.model, s.blocks, s.kept, s.loads);
  }
}

/// False: there are not as many as the model has.
template <class Archive>
bool list_spells(Archive& a, const std::string& of, std::vector<Spell>& spells) {
  std::vector<double> since, until;
  for (const Spell& spell : spells) {
    since.push_back(spell.since);
    until.push_back(spell.until);
  }
  a("since." + of, since);
  a("until." + of, until);
  if (since.size() != spells.size() || until.size() != spells.size()) return false;
  for (std::size_t q = 0; q < spells.size(); ++q) spells[q] = {since[q], until[q]};
  return true;
}

/// The ground, and when what shakes and drives it began.
template <class Archive>
void list_ground(Archive& a, Simulation& s) {
  std::vector<Vec2> ground{s.ground.velocity, s.ground.shift, s.ground.shift_1};
  list_points(a, "ground", ground);
  list_points(a, "springs.shift", s.springs.shift);
  list_points(a, "springs.shift_1", s.springs.shift_1);
  for (std::size_t q = 0; q < s.free_field.columns.size(); ++q) {
    FreeFieldColumn& column = s.free_field.columns[q];
    const std::size_t nodes = column.moved.size();
    list_points(a, fmt::format("free_field.{}.moved", q), column.moved);
    list_points(a, fmt::format("free_field.{}.velocity", q), column.velocity);
    if constexpr (Archive::loads) {
      if (column.moved.size() != nodes || column.velocity.size() != nodes) {
        return a.refuse("free-field columns do not fit the model");
      }
    }
  }
  a("springs.start_x", s.springs.start_x);
  a("springs.start_y", s.springs.start_y);
  Spells& spells = s.loads.spells;
  bool fit = list_spells(a, "loads", spells.loads);
  fit = list_spells(a, "waters", spells.waters) && fit;
  fit = list_spells(a, "boundaries", spells.boundaries) && fit;
  fit = list_spells(a, "shakings", spells.shakings) && fit;
  if constexpr (Archive::loads) {
    const std::size_t rows = s.model.boundaries.size();
    const bool fits = fit && ground.size() == 3 && s.springs.shift.size() == rows &&
                      s.springs.shift_1.size() == rows &&
                      s.springs.start_x.size() == s.springs.size() &&
                      s.springs.start_y.size() == s.springs.size();
    if (!fits) return a.refuse("ground does not fit the model");
    s.ground.velocity = ground[0];
    s.ground.shift = ground[1];
    s.ground.shift_1 = ground[2];
    for (std::size_t q = 0; q < s.springs.size(); ++q) {
      const auto row = static_cast<std::size_t>(s.springs.boundary[q]);
      const bool acts = spells.boundaries[row].acts();
      s.springs.kxx[q] = acts ? s.springs.acting_k[q][0] : 0.0;
      s.springs.kyy[q] = acts ? s.springs.acting_k[q][1] : 0.0;
      s.springs.kxy[q] = acts ? s.springs.acting_k[q][2] : 0.0;
    }
    s.dashpots.set_acting(spells.boundaries);
  }
}

}  // namespace edda
