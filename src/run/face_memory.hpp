// Checkpoint data of the faces, and their validation.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"
#include "paper/points.hpp"

namespace edda {

/// One of the fields of all faces.
template <class Archive>
void list_field(Archive& a, const std::string& name, std::vector<FaceFields>& faces,
                double FaceFields::*field) {
  std::vector<double> values(faces.size());
  for (std::size_t k = 0; k < faces.size(); ++k) values[k] = faces[k].*field;
  a(name, values);
  if constexpr (Archive::loads) {
    if (values.size() != faces.size()) return a.refuse(name + " is not of these faces");
    for (std::size_t k = 0; k < values.size(); ++k) faces[k].*field = values[k];
  }
}

template <class Archive>
void list_faces(Archive& a, FaceSet& c, FaceStates& states) {
  a("faces.edge", c.edge);
  a("faces.facing", c.facing);
  a("faces.law", c.law);
  a("faces.flags", c.flags);
  if constexpr (Archive::loads) {
    if (c.facing.size() != c.size() || c.law.size() != c.size() || c.flags.size() != c.size()) {
      return a.refuse("faces do not fit together");
    }
    c.clear_rows(c.size());
    states = FaceStates(c.size());
  }
  for (const auto& column : face_properties) {
    if (column.kept) a(std::string("faces.") + column.name, c.*column.values);
  }
  for (const FaceField& field : face_fields) {
    list_field(a, std::string("faces.now.") + field.name, states.now, field.value);
    list_field(a, std::string("faces.before.") + field.name, states.before, field.value);
  }
  a("faces.locked_start", c.locked_start);
  a("faces.locked_end", c.locked_end);
  a("faces.built_x", c.built_x);
  a("faces.built_y", c.built_y);
  a("faces.noise", c.noise);
  a("faces.reach", c.reach);
  a("faces.reach_behind", c.reach_behind);
  a("faces.travel", c.travel);
  a("faces.rebuilds", c.rebuilds);
  a("faces.gluing", c.gluing);
  a("faces.bond_strength", c.bond_strength);
  a("faces.dashpots", c.dashpots);
  a("faces.broken", c.broken);
  a("faces.cracks_tension", c.cracks_tension);
  a("faces.cracks_shear", c.cracks_shear);
  a("faces.removed_friction", c.removed_friction);
  a("faces.removed_damping", c.removed_damping);
  a("faces.removed_fracture", c.removed_fracture);
  a("faces.removed_transfer", c.removed_transfer);
}

template <class Archive>
void list_points(Archive& a, PointSet& c) {
  a("points.vertex", c.vertex);
  a("points.edge", c.edge);
  a("points.law", c.law);
  for (std::size_t q = 0; q < std::size(point_columns); ++q) {
    a("points.column." + std::to_string(q), c.*point_columns[q]);
  }
  a("points.energy", c.energy);
  a("points.friction", c.friction);
  a("points.due", c.due);
  a("points.deepest", c.deepest);
}

/// Checks the assumptions of complete_points() and of the step.
template <class Examiner>
void examine_points(Examiner& j, const PointSet& c, const BlockSet& b, const LawTable& laws) {
  for (const auto column : point_columns) j.sized("points", c.*column, c.vertex.size());
  j.sized("points.edge", c.edge, c.vertex.size());
  j.sized("points.law", c.law, c.vertex.size());
  j.below("points.vertex", c.vertex, b.vertex_count());
  j.below("points.edge", c.edge, b.vertex_count());
  j.below("points.law", {c.law.begin(), c.law.end()}, laws.rows.size());
}

/// Whether the numbers of a face are finite.
inline bool is_finite(const FaceFields& m) {
  return std::all_of(std::begin(face_fields), std::end(face_fields),
                     [&](const FaceField& field) { return std::isfinite(m.*field.value); });
}

/// Checks the assumptions of complete_faces() and of the step: sizes, indices, finite numbers.
/// Examiner: that of simulation_memory.cpp.
template <class Examiner>
void examine_faces(Examiner& j, const FaceSet& c, const FaceStates& states, const BlockSet& b,
                   const LawTable& laws) {
  const std::size_t n = c.size(), nv = b.vertex_count();
  j.rows("faces", c.rows(), n);
  j.sized("faces.facing", c.facing, n);
  j.sized("faces.law", c.law, n);
  j.sized("faces.flags", c.flags, n);
  for (const auto* values : {&c.built_x, &c.built_y}) j.sized("faces.built", *values, nv);
  if (!c.locked_start.empty()) j.sized("faces.locked", c.locked_start, nv);
  j.sized("faces.locked", c.locked_end, c.locked_start.size());
  j.below("faces.edge", c.edge, nv);
  j.below("faces.facing", c.facing, nv);
  j.below("faces.law", {c.law.begin(), c.law.end()}, laws.rows.size());
  const auto pair_of = [&](std::size_t k) { return std::pair(c.edge[k], c.facing[k]); };
  for (std::size_t k = 0; j.flaw().empty() && k < n; ++k) {
    const auto [e, f] = pair_of(k);
    const bool sorted = k == 0 || pair_of(k - 1) < pair_of(k);
    if (!sorted || e >= f || b.vertex_block[e] == b.vertex_block[f])
      j.refuse("faces do not belong together");
    const bool two_bonds = c.is(FaceFlag::intact, k) && c.is(FaceFlag::cracked, k);
    if ((c.flags[k] & ~all_face_flags) != 0 || two_bonds) j.refuse("faces have no such flags");
  }
  const auto finite = [](const std::vector<FaceFields>& all) {
    return std::all_of(all.begin(), all.end(), [](const FaceFields& m) { return is_finite(m); });
  };
  if (!finite(states.now) || !finite(states.before))
    j.refuse("faces have a number that is not finite");
}

}  // namespace edda
