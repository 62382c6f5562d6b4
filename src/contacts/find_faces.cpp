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

/// Cosine of the angle up to which a face acts wholly, and of that at which it is gone: 60 and 85
/// degrees, and for a needle of alpha < 90 degrees, whose two edges stand across it at 90 -
/// alpha/2, (90 - alpha)/2 more.
struct AngleGate {
  double whole, none;
};
constexpr double most_beyond = std::numbers::pi / 4.0;  ///< rad: at a needle
double cosine_of_none(double beyond) {
  return std::cos(85.0 / 180.0 * std::numbers::pi + beyond);
}
AngleGate angle_gate(const BlockSet& b, Id e, Id f) {
  const double sharpest =
      std::min({b.corner[e], b.corner[b.next[e]], b.corner[f], b.corner[b.next[f]]});
  const double beyond = std::max(0.0, most_beyond - 0.5 * sharpest);
  return {std::cos(std::numbers::pi / 3.0 + beyond), cosine_of_none(beyond)};
}

/// Whether the edges may come to be opposed before a vertex has moved by half of `reach`.
bool may_oppose(const BlockSet& b, const Pose& pose, Id e, Id f, double reach) {
  const Vec2 u = at(pose.x, pose.y, b.next[e]) - at(pose.x, pose.y, e);
  const Vec2 v = at(pose.x, pose.y, b.next[f]) - at(pose.x, pose.y, f);
  const double le = norm(u), lf = norm(v);
  const double turn = reach / le + reach / lf;  // of the one against the other, at most, rad
  const double reached = -dot(u, v) / (le * lf) + turn;
  // Most pairs need no gate of their own: it lies between those of blunt corners and of a needle.
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

/// A pair of the new list, and the face that it was.
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

/// Corners pass each other smoothly within this part of the shorter edge (face.hpp).
constexpr double passing_part = 0.15;

/// Where faces stand in the list: those that carry, those that soon may, the others; of each kind
/// those first that are plain (is_plain()), so that a chunk of the list mostly has one kind.
int kind_in_list(const FaceSet& old, const BlockSet& b, const Pose& pose, double reach,
                 const Listed& f) {
  const auto [e, q] = f.pair;
  const double shorter = std::min(b.edge_length[e], b.edge_length[q]);
  const AngleGate gate = angle_gate(b, e, q);
  FacePair pair;
  pair.inverse_e = 1.0 / b.edge_length[e];
  pair.inverse_f = 1.0 / b.edge_length[q];
  pair.gate_from = gate.none;
  pair.gate_scale = 1.0 / (gate.whole - gate.none);
  pair.passing = passing_part * shorter;
  const FacePoints points{at(pose.x, pose.y, e), at(pose.x, pose.y, b.next[e]),
                          at(pose.x, pose.y, q), at(pose.x, pose.y, b.next[q])};
  const Opposition o = opposition_of(points, pair);
  constexpr double near = 0.01, overlaps = 0.01;
  const double closure = o.apart_0 + std::max(o.steeper * o.ma, o.steeper * o.mb);
  const bool near_by = o.s2 > 0.0 && o.r1 > o.r2 && o.cosine > gate.none &&
                       o.mb - o.ma > -near * reach && closure > -near * reach;
  bool carries = near_by && o.mb - o.ma > overlaps * shorter;
  bool bonded = false;
  if (const Id k = f.old; k != no_id) {
    carries = old.now.energy[k] > 0.0 || old.bonded[k] > 0.0 || old.pulls[k] > 0.0;
    bonded = old.bonded[k] > 0.0;
    pair.pulls = old.pulls[k];
    pair.offset = {old.offset_a[k], old.offset_b[k]};
  }
  const int kind = carries ? 0 : near_by ? 1 : 2;
  return 2 * kind + (is_plain(o, pair) && !bonded ? 0 : 1);
}

void fill_constants(FaceSet& c, const BlockSet& b, const LawTable& laws, std::size_t k) {
  const Id e = c.edge[k], f = c.facing[k];
  const double shorter = std::min(b.edge_length[e], b.edge_length[f]);
  const Law& law = laws.rows[c.law[k]];
  c.inverse_e[k] = 1.0 / b.edge_length[e];
  c.inverse_f[k] = 1.0 / b.edge_length[f];
  const AngleGate gate = angle_gate(b, e, f);
  c.gate_from[k] = gate.none;
  c.gate_scale[k] = 1.0 / (gate.whole - gate.none);
  c.passing[k] = passing_part * shorter;
  c.at_ends[k] = law.kn > 0.0 ? 0.0 : 1.0;
  // A penalty is a spring at each end of the shorter edge.
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
  // What fills up the last chunk has no length, and no division by nothing.
  for (std::size_t k = n; k < c.chunks() * FaceSet::chunk; ++k) c.passing[k] = 1.0;
  list_by_edge(c, b.vertex_count());
  c.stirs.assign(c.chunks(), 0);
  c.deepest.assign(c.chunks(), 0.0);
  c.tears.assign(c.chunks(), 0);
  c.plain.assign(c.chunks(), 1);
  for (std::size_t k = 0; k < n; ++k) {
    if (c.breaks[k] != 0.0) c.tears[k / FaceSet::chunk] = 1;
  }
  for (FaceMemory* m : {&c.now, &c.before}) m->idle.assign(c.chunks(), 0);
  note_bonds(c);
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
  next.retired_friction = faces.retired_friction;
  next.retired_damping = faces.retired_damping;
  next.retired_fracture = faces.retired_fracture;
  next.retired_transfer = faces.retired_transfer;
  next.broken = faces.broken;
  next.gluing = faces.gluing;
  next.locked_start = std::move(faces.locked_start);
  next.locked_end = std::move(faces.locked_end);
  const auto retire = [&](std::size_t k) {
    next.retired_friction += faces.friction_work[k];
    next.retired_damping += faces.damping_work[k];
    next.retired_fracture += faces.fracture_work[k];
    next.retired_transfer += faces.transfer[k];
  };
  for (std::size_t k = 0; k < n; ++k) {
    const auto [e, f] = list[k].pair;
    const Id old = list[k].old;
    next.edge[k] = e;
    next.facing[k] = f;
    if (old != no_id) {
      stays[old] = 1;
      next.copy_row(k, faces, old, [](const auto& column) { return column.kept; });
      next.now.copy_row(k, faces.now, old);
      next.before.copy_row(k, faces.before, old);
      std::copy_n(&faces.force[8 * old], 8, &next.force[8 * k]);
      next.law[k] = faces.law[old];
    } else {
      next.law[k] = laws.resolve_met(b.edge_joint[e], b.edge_joint[f],
                                     b.material[b.vertex_block[e]], b.material[b.vertex_block[f]]);
      take_residual(next, laws, k);
      next.pulls[k] = 0.0;  // what comes to touch has no tensile strength
    }
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (stays[k] == 0) retire(k);
  }
  complete_faces(next, b, laws);
  next.noise = rounding_of_closures(pose);
  next.reach = reach;
  next.built_x = pose.x;
  next.built_y = pose.y;
  next.rebuilds = faces.rebuilds + 1;
  faces = std::move(next);
}

}  // namespace edda
