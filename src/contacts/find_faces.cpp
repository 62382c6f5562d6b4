#include "contacts/find_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "contacts/face_bonds.hpp"
#include "contacts/search.hpp"

namespace edda {
namespace {

using EdgePair = std::pair<Id, Id>;

/// Cosine of the angle up to which a face carries its full load, and of that at which it carries
/// none: 60 and 85 degrees. Beside a corner of alpha < 90 degrees both are (90 - alpha)/2 larger,
/// since its two edges stand at 90 - alpha/2 to an edge that it strikes at a right angle.
struct AngleGate {
  double whole, none;
};
constexpr double most_beyond = std::numbers::pi / 4.0;  ///< rad: for a needle
double cosine_of_none(double beyond) {
  return std::cos(85.0 / 180.0 * std::numbers::pi + beyond);
}
AngleGate angle_gate(const BlockSet& b, Id e, Id f) {
  const double sharpest =
      std::min({b.corner[e], b.corner[b.next[e]], b.corner[f], b.corner[b.next[f]]});
  const double beyond = std::max(0.0, most_beyond - 0.5 * sharpest);
  return {std::cos(std::numbers::pi / 3.0 + beyond), cosine_of_none(beyond)};
}

/// Whether the edges may become opposed before a vertex has moved by half of `reach`.
bool may_oppose(const BlockSet& b, const Pose& pose, Id e, Id f, double reach) {
  const Vec2 u = at(pose.x, pose.y, b.next[e]) - at(pose.x, pose.y, e);
  const Vec2 v = at(pose.x, pose.y, b.next[f]) - at(pose.x, pose.y, f);
  const double le = norm(u), lf = norm(v);
  const double turn = reach / le + reach / lf;  // largest relative rotation of the two edges, rad
  const double reached = -dot(u, v) / (le * lf) + turn;
  // For most pairs the gate need not be computed: it lies between those of blunt corners and of a
  // needle.
  static const double of_blunt = cosine_of_none(0.0), of_needle = cosine_of_none(most_beyond);
  return reached > of_blunt || (reached > of_needle && reached > angle_gate(b, e, f).none);
}

std::vector<EdgePair> wanted_faces(const FaceSet& old, const BlockSet& b, const State& state,
                                   const Pose& pose, double reach) {
  std::vector<EdgePair> list;
  const auto add = [&](Id e, Id f) {
    if (may_oppose(b, pose, e, f, reach)) list.push_back(std::minmax(e, f));
  };
  for (const NearPair& near : near_pairs(b, state.alive, pose.x, pose.y, reach)) {
    add(near.vertex, near.edge);
    add(b.previous[near.vertex], near.edge);
  }
  for (std::size_t k = 0; k < old.size(); ++k) {
    const bool stays = state.alive[b.vertex_block[old.edge[k]]] != 0 &&
                       state.alive[b.vertex_block[old.facing[k]]] != 0;
    if (stays && (old.now.energy[k] > 0.0 || old.bonded[k] > 0.0))
      list.push_back({old.edge[k], old.facing[k]});
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

/// A pair of edges of the new list, and its face in the old one.
struct Listed {
  EdgePair pair;
  Id old;  ///< no_id: none
  int kind = 0;
};
std::vector<Listed> with_old_faces(const std::vector<EdgePair>& list, const FaceSet& old) {
  std::vector<Id> order(old.size());
  std::iota(order.begin(), order.end(), Id{0});
  const auto pair_of = [&](Id k) { return EdgePair{old.edge[k], old.facing[k]}; };
  std::sort(order.begin(), order.end(), [&](Id i, Id j) { return pair_of(i) < pair_of(j); });
  std::vector<Listed> all;
  all.reserve(list.size());
  auto next = order.begin();
  for (const EdgePair& pair : list) {
    while (next != order.end() && pair_of(*next) < pair) ++next;
    const bool was = next != order.end() && pair_of(*next) == pair;
    all.push_back({pair, was ? *next : no_id, 0});
  }
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

/// Position of a face in the list: first those that carry load, then those that soon may, then the
/// others; within each kind first those that are plain (is_plain()), so that most chunks of the
/// list hold one kind.
int kind_in_list(const FaceSet& old, const BlockSet& b, const Pose& pose, double reach,
                 const Listed& f) {
  const auto [e, q] = f.pair;
  const double shorter = std::min(b.edge_length[e], b.edge_length[q]);
  FacePair pair = pair_of_edges(b, e, q);
  const FacePoints points{at(pose.x, pose.y, e), at(pose.x, pose.y, b.next[e]),
                          at(pose.x, pose.y, q), at(pose.x, pose.y, b.next[q])};
  const EdgeGeometry o = geometry_of_edges(points, pair);
  constexpr double near = 0.01, overlaps = 0.01;
  const double closure = o.closure_at_0 + std::max(o.closure_slope * o.ma, o.closure_slope * o.mb);
  const bool near_by = o.s2 > 0.0 && o.r1 > o.r2 && o.cosine > pair.gate_from &&
                       o.mb - o.ma > -near * reach && closure > -near * reach;
  bool carries = near_by && o.mb - o.ma > overlaps * shorter;
  bool bonded = false;
  if (const Id k = f.old; k != no_id) {
    carries = old.now.energy[k] > 0.0 || old.bonded[k] > 0.0 || old.carries_tension[k] > 0.0;
    bonded = old.bonded[k] > 0.0;
    pair.carries_tension = old.carries_tension[k];
    pair.offset = {old.locked_closure_a[k], old.locked_closure_b[k]};
  }
  const int kind = carries ? 0 : near_by ? 1 : 2;
  return 2 * kind + (is_plain(o, pair) && !bonded ? 0 : 1);
}

void fill_constants(FaceSet& c, const BlockSet& b, const LawTable& laws, std::size_t k) {
  const Id e = c.edge[k], f = c.facing[k];
  const double shorter = std::min(b.edge_length[e], b.edge_length[f]);
  const Law& law = laws.rows[c.law[k]];
  const FacePair pair = pair_of_edges(b, e, f);
  c.inverse_e[k] = pair.inverse_e;
  c.inverse_f[k] = pair.inverse_f;
  c.gate_from[k] = pair.gate_from;
  c.gate_scale[k] = pair.gate_scale;
  c.passing[k] = pair.passing;
  c.at_ends[k] = law.kn > 0.0 ? 0.0 : 1.0;
  // A penalty is one spring at each end of the shorter edge.
  c.stiffness[k] = laws.normal_stiffness(law, shorter);
  c.shear_stiffness[k] = laws.shear_stiffness(law, shorter);
}

double rounding_of_closures(const Pose& pose) {
  double largest = 0.0;
  for (const auto* values : {&pose.x, &pose.y}) {
    for (const double u : *values) largest = std::max(largest, std::abs(u));
  }
  constexpr double digits = 8.0;
  return digits * std::numeric_limits<double>::epsilon() * largest;
}

/// Fills begin_of_edge and on_edge.
void list_by_edge(FaceSet& c, std::size_t edges) {
  c.begin_of_edge.assign(edges + 1, 0);
  for (const auto* of : {&c.edge, &c.facing}) {
    for (const Id e : *of) ++c.begin_of_edge[e + 1];
  }
  for (std::size_t e = 0; e < edges; ++e) c.begin_of_edge[e + 1] += c.begin_of_edge[e];
  std::vector<Id> fill(c.begin_of_edge.begin(), c.begin_of_edge.end() - 1);
  c.on_edge.resize(2 * c.size());
  for (std::size_t k = 0; k < c.size(); ++k) {
    for (const Id e : {c.edge[k], c.facing[k]}) c.on_edge[fill[e]++] = static_cast<Id>(k);
  }
  for (Id e = 0; e < edges; ++e) {
    const auto first = c.on_edge.begin() + c.begin_of_edge[e],
               last = c.on_edge.begin() + c.begin_of_edge[e + 1];
    const auto other = [&](Id k) { return c.edge[k] == e ? c.facing[k] : c.edge[k]; };
    std::sort(first, last, [&](Id i, Id j) { return other(i) < other(j); });
    for (auto q = first; q != last; ++q) {
      const Id k = *q;
      *q = 8 * k + (c.edge[k] == e ? 0 : 4);
    }
  }
}

/// Whether any dashpot has done work in the last step or has yet to do it, by the faces at its end.
bool dashpots_work(const FaceMemory& m) {
  for (const auto column : dashpot_columns) {
    for (std::size_t k = 0; k < (m.*column).size(); ++k) {
      if ((m.*column)[k] != 0.0) return true;
    }
  }
  return false;
}

/// Moves what does not belong to any one face to the new list.
void move_totals(FaceSet& next, FaceSet& old) {
  next.removed_friction = old.removed_friction;
  next.removed_damping = old.removed_damping;
  next.removed_fracture = old.removed_fracture;
  next.removed_transfer = old.removed_transfer;
  next.broken = old.broken;
  next.gluing = old.gluing;
  next.locked_start = std::move(old.locked_start);
  next.locked_end = std::move(old.locked_end);
}

/// Row k of the new list becomes a face of the old one, with its memory.
void copy_face(FaceSet& next, std::size_t k, const FaceSet& faces, Id old) {
  next.copy_row(k, faces, old, [](const auto& column) { return column.kept; });
  next.now.copy_row(k, faces.now, old);
  next.before.copy_row(k, faces.before, old);
  std::copy_n(&faces.force[8 * old], 8, &next.force[8 * k]);
  next.law[k] = faces.law[old];
}

/// Adds the energies of a face that is no longer in the list to the totals.
void retire(FaceSet& next, const FaceSet& old, std::size_t k) {
  next.removed_friction += old.friction_work[k];
  next.removed_damping += old.damping_work[k];
  next.removed_fracture += old.fracture_work[k];
  next.removed_transfer += old.transfer[k];
}

}  // namespace

void complete_faces(FaceSet& c, const BlockSet& b, const LawTable& laws) {
  const std::size_t n = c.size();
  c.edge_end.resize(n);
  c.facing_end.resize(n);
  c.corners.assign(c.chunks() * 4 * FaceSet::chunk, 0);
  for (std::size_t k = 0; k < n; ++k) {
    c.edge_end[k] = b.next[c.edge[k]];
    c.facing_end[k] = b.next[c.facing[k]];
    Id* const corner = c.corners.data() + k / FaceSet::chunk * 4 * FaceSet::chunk;
    for (std::size_t q = 0; const Id v : {c.edge[k], c.edge_end[k], c.facing[k], c.facing_end[k]}) {
      corner[q++ * FaceSet::chunk + k % FaceSet::chunk] = v;
    }
    fill_constants(c, b, laws, k);
  }
  // Padding rows of the last chunk have zero length; `passing` must not be zero, since it is
  // divided by.
  for (std::size_t k = n; k < c.chunks() * FaceSet::chunk; ++k) c.passing[k] = 1.0;
  list_by_edge(c, b.vertex_count());
  c.switching.assign(c.chunks(), 0);
  c.deepest.assign(c.chunks(), 0.0);
  c.chunk_fails.assign(c.chunks(), 0);
  c.plain.assign(c.chunks(), 1);
  for (std::size_t k = 0; k < n; ++k) {
    if (c.failure[k] != 0.0) c.chunk_fails[k / FaceSet::chunk] = 1;
  }
  for (FaceMemory* m : {&c.now, &c.before}) m->inactive.assign(c.chunks(), 0);
  mark_bonded_chunks(c);
}

void find_faces(FaceSet& faces, const BlockSet& b, const State& state, const Pose& pose,
                const LawTable& laws, double reach) {
  std::vector<Listed> list = with_old_faces(wanted_faces(faces, b, state, pose, reach), faces);
  for (Listed& f : list) f.kind = kind_in_list(faces, b, pose, reach, f);
  std::stable_sort(list.begin(), list.end(),
                   [](const Listed& f, const Listed& g) { return f.kind < g.kind; });
  const std::size_t n = list.size();
  FaceSet next;
  next.clear_rows(n);
  next.now.clear_rows(n);
  next.before.clear_rows(n);
  next.law.resize(n);
  next.edge.resize(n);
  next.facing.resize(n);
  next.force.assign(next.force_size(), 0.0);
  std::vector<std::uint8_t> stays(faces.size(), 0);
  move_totals(next, faces);
  for (std::size_t k = 0; k < n; ++k) {
    const auto [e, f] = list[k].pair;
    const Id old = list[k].old;
    next.edge[k] = e;
    next.facing[k] = f;
    if (old != no_id) {
      stays[old] = 1;
      copy_face(next, k, faces, old);
    } else {
      next.law[k] = laws.resolve_met(b.edge_joint[e], b.edge_joint[f],
                                     b.material[b.vertex_block[e]], b.material[b.vertex_block[f]]);
      set_residual_strength(next, laws, k);
      next.carries_tension[k] = 0.0;  // contacts that form later have no tensile strength
    }
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (stays[k] == 0) retire(next, faces, k);
  }
  complete_faces(next, b, laws);
  next.dashpots = dashpots_work(next.now);
  next.noise = rounding_of_closures(pose);
  next.reach = reach;
  next.built_x = pose.x;
  next.built_y = pose.y;
  next.rebuilds = faces.rebuilds + 1;
  faces = std::move(next);
}

}  // namespace edda
