#include "contacts/find_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

/// A face of the new list, and its row in the old one.
struct Listed {
  Id edge, facing;
  Id old;  ///< no_id: none
};

/// The faces of the pairs of edges `near`, and those of the old list that stay whatever lies
/// between their edges: they carry, are bonded or have a crack, and both blocks are there. Both
/// lists are sorted by their edges.
std::vector<Listed> wanted_faces(const std::vector<EdgePair>& near, const FaceSet& old,
                                 const std::vector<std::uint8_t>& carry, const BlockSet& b,
                                 const State& state) {
  const auto stays = [&](std::size_t k) {
    return (carry[k] != 0 || old.bonded(k) || old.is_broken(k)) &&
           state.alive[b.vertex_block[old.edge[k]]] != 0 &&
           state.alive[b.vertex_block[old.facing[k]]] != 0;
  };
  std::vector<Listed> all;
  all.reserve(near.size());
  std::size_t k = 0;
  const auto add_old_before = [&](const EdgePair& pair) {
    for (; k < old.size() && EdgePair{old.edge[k], old.facing[k]} < pair; ++k) {
      if (stays(k)) all.push_back({old.edge[k], old.facing[k], static_cast<Id>(k)});
    }
  };
  for (const EdgePair& pair : near) {
    add_old_before(pair);
    const bool was = k < old.size() && EdgePair{old.edge[k], old.facing[k]} == pair;
    all.push_back({pair.first, pair.second, was ? static_cast<Id>(k++) : no_id});
  }
  add_old_before({no_id, no_id});
  return all;
}

/// FacePair::passing as a fraction of the shorter edge (theory, section 4.5).
constexpr double passing_part = 0.15;

/// The constants of a face that follow from its two edges alone.
FacePair pair_of_edges(const BlockSet& b, Id e, Id f) {
  const AngleGate gate = angle_gate(b, e, f);
  FacePair pair;
  pair.inverse_e = 1.0 / b.edge_length[e];
  pair.inverse_f = 1.0 / b.edge_length[f];
  pair.gate_from = gate.none;
  pair.gate_scale = 1.0 / (gate.whole - gate.none);
  pair.passing = passing_part * std::min(b.edge_length[e], b.edge_length[f]);
  return pair;
}

void fill_constants_of_edges(FaceSet& c, const BlockSet& b, std::size_t k) {
  const FacePair pair = pair_of_edges(b, c.edge[k], c.facing[k]);
  c.inverse_e[k] = pair.inverse_e;
  c.inverse_f[k] = pair.inverse_f;
  c.gate_from[k] = pair.gate_from;
  c.gate_scale[k] = pair.gate_scale;
  c.passing[k] = pair.passing;
}

void fill_constants_of_law(FaceSet& c, const BlockSet& b, const LawTable& laws, std::size_t k) {
  const FaceSides sides = sides_of(b, c.edge[k], c.facing[k]);
  const Law& law = laws.rows[c.law[k]];
  c.stiffness[k] = laws.normal_stiffness(law, sides);
  c.shear_stiffness[k] = laws.shear_stiffness(law, sides);
}

double rounding_of_closures(const Pose& pose) {
  double largest = 0.0;
  for (const auto* values : {&pose.x, &pose.y}) {
    for (const double u : *values) largest = std::max(largest, std::abs(u));
  }
  constexpr double digits = 8.0;
  return digits * std::numeric_limits<double>::epsilon() * largest;
}

/// Fills begin_of_edge and on_edge. Faces are sorted by `edge`, then by `facing`: of the faces of
/// an edge come first those in which it is `facing`, as the other edge has the lower number there.
void list_by_edge(FaceSet& c, std::size_t edges) {
  c.begin_of_edge.assign(edges + 1, 0);
  for (const auto* of : {&c.edge, &c.facing}) {
    for (const Id e : *of) ++c.begin_of_edge[e + 1];
  }
  for (std::size_t e = 0; e < edges; ++e) c.begin_of_edge[e + 1] += c.begin_of_edge[e];
  std::vector<Id> next(c.begin_of_edge.begin(), c.begin_of_edge.end() - 1);
  resize_afresh(c.on_edge, 2 * c.size());
  for (std::size_t k = 0; k < c.size(); ++k)
    c.on_edge[next[c.facing[k]]++] = static_cast<Id>(8 * k + 4);
  for (std::size_t k = 0; k < c.size(); ++k) c.on_edge[next[c.edge[k]]++] = static_cast<Id>(8 * k);
}

/// Moves what does not belong to any one face to the new list.
void move_totals(FaceSet& next, FaceSet& old) {
  next.removed_friction = old.removed_friction;
  next.removed_damping = old.removed_damping;
  next.removed_fracture = old.removed_fracture;
  next.removed_transfer = old.removed_transfer;
  next.broken = old.broken;
  next.cracks_tension = old.cracks_tension;
  next.cracks_shear = old.cracks_shear;
  next.of_laws = old.of_laws;
  next.gluing = old.gluing;
  next.bond_strength = old.bond_strength;
  next.locked_start = std::move(old.locked_start);
  next.locked_end = std::move(old.locked_end);
}

/// Row k of the new list becomes a face of the old one. The constants are those of its edges.
void copy_face(FaceSet& next, std::size_t k, const FaceSet& faces, Id old) {
  next.copy_row(k, faces, old);
  next.law[k] = faces.law[old];
  next.flags[k] = faces.flags[old];
}
/// Row k becomes a face that was not in the old list.
void begin_face(FaceSet& next, std::size_t k, const BlockSet& b, const LawTable& laws) {
  const Id e = next.edge[k], f = next.facing[k];
  next.clear_row(k);
  next.flags[k] = 0;
  next.law[k] = law_between(laws, b, e, f, false);
  set_residual_strength(next, laws, k);
  // Contacts that form later have no tensile strength.
  next.set(FaceFlag::carries_tension, k, false);
  fill_constants_of_edges(next, b, k);
}

/// Adds the energies of a face that is no longer in the list to the totals.
void retire(FaceSet& next, const FaceSet& old, std::size_t k) {
  next.removed_friction += old.friction_work[k];
  next.removed_damping += old.damping_work[k];
  next.removed_fracture += old.fracture_work[k];
  next.removed_transfer += old.transfer[k];
}

/// Fills what follows from the edges of the faces but for the constants of each of them.
void complete_list(FaceSet& c, const BlockSet& b, const LawTable& laws) {
  c.slip_laws = laws.any_changes;
  c.of_laws.resize(laws.rows.size());
  for (std::size_t r = 0; r < laws.rows.size(); ++r)
    c.of_laws[r].at_ends = !(laws.rows[r].kn > 0.0);
  const std::size_t n = c.size();
  c.edge_end.resize(n);
  c.facing_end.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    c.edge_end[k] = b.next[c.edge[k]];
    c.facing_end[k] = b.next[c.facing[k]];
  }
  list_by_edge(c, b.vertex_count());
  c.group_fails.assign(c.failure_groups(), 0);
  for (std::size_t k = 0; k < n; ++k) {
    if (c.is(FaceFlag::fails, k)) c.group_fails[k / FaceSet::failure_group] = 1;
  }
}

}  // namespace

void complete_faces(FaceSet& c, const BlockSet& b, const LawTable& laws) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    fill_constants_of_edges(c, b, k);
    fill_constants_of_law(c, b, laws, k);
  }
  complete_list(c, b, laws);
}

void note_list(FaceSet& c, const Pose& pose, const Reach& reach) {
  c.noise = rounding_of_closures(pose);
  c.reach = reach.apart;
  c.reach_behind = reach.behind;
  c.built_x = pose.x;
  c.built_y = pose.y;
  c.travel = 0.0;
  ++c.rebuilds;
}

std::vector<Id> find_faces(FaceSet& faces, const BlockSet& b, const State& state, const Pose& pose,
                           const LawTable& laws, const Reach& reach, NearEdges& near,
                           const std::vector<std::uint8_t>& carry) {
  const std::vector<Listed> list =
      wanted_faces(edges_within(near, b, state, pose, reach), faces, carry, b, state);
  const std::size_t n = list.size();
  FaceSet next;
  next.set_rows(n);
  next.law.resize(n);
  next.flags.resize(n);
  next.edge.resize(n);
  next.facing.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    next.edge[k] = list[k].edge;
    next.facing[k] = list[k].facing;
  }
  move_totals(next, faces);
  std::vector<std::uint8_t> stays(faces.size(), 0);
  const auto fill = [&](std::size_t k) {
    const Id old = list[k].old;
    if (old == no_id) {
      begin_face(next, k, b, laws);
    } else {
      stays[old] = 1;
      copy_face(next, k, faces, old);
    }
    fill_constants_of_law(next, b, laws, k);
  };
  parallel_for(n, fill, 50);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (stays[k] == 0) retire(next, faces, k);
  }
  complete_list(next, b, laws);
  next.dashpots = faces.dashpots;
  next.rebuilds = faces.rebuilds;
  note_list(next, pose, reach);
  faces = std::move(next);
  std::vector<Id> old(n);
  for (std::size_t k = 0; k < n; ++k) old[k] = list[k].old;
  return old;
}

}  // namespace edda
