#include "contacts/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/search.hpp"
#include "contacts/shares.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {
namespace {

using DoubleArray = std::vector<double> ContactSet::*;

/// What a candidate remembers from one list to the next.
constexpr std::array<DoubleArray, 21> memory = {&ContactSet::tension,
                                                &ContactSet::depth,
                                                &ContactSet::depth_1,
                                                &ContactSet::depth_2,
                                                &ContactSet::foot,
                                                &ContactSet::share,
                                                &ContactSet::rest,
                                                &ContactSet::anchor,
                                                &ContactSet::kn,
                                                &ContactSet::ks,
                                                &ContactSet::length,
                                                &ContactSet::friction,
                                                &ContactSet::cohesion,
                                                &ContactSet::alpha,
                                                &ContactSet::normal,
                                                &ContactSet::shear,
                                                &ContactSet::shear_1,
                                                &ContactSet::slip_trial,
                                                &ContactSet::fracture_work,
                                                &ContactSet::friction_work,
                                                &ContactSet::damping_work};

/// Filled anew; only their size matters here.
constexpr std::array<DoubleArray, 5> scratch_arrays = {
    &ContactSet::before, &ContactSet::beyond, &ContactSet::span, &ContactSet::tx, &ContactSet::ty};

void resize(ContactSet& c, std::size_t n) {
  for (DoubleArray a : memory) (c.*a).assign(n, 0.0);
  for (DoubleArray a : scratch_arrays) (c.*a).assign(n, 0.0);
  c.force.assign(2 * n, 0.0);
  c.reaction.assign(4 * n, 0.0);
  c.state.assign(n, 0);
  c.why.assign(n, Blocked::no);
  c.law.assign(n, 0);
  c.edge_end.resize(n);
  c.block_i.resize(n);
  c.block_j.resize(n);
  c.deepest.assign((n + ContactSet::chunk - 1) / ContactSet::chunk, 0.0);
}

/// Near pairs and closed contacts of the old list, sorted, each once.
std::vector<NearPair> wanted(const ContactSet& old, const BlockSet& b, const State& state,
                             const Pose& pose, double reach) {
  std::vector<NearPair> list = near_pairs(b, state.alive, pose.x, pose.y, reach);
  const std::size_t found = list.size();
  for (std::size_t c = 0; c < old.size(); ++c) {
    if (old.is(c, contact_state::closed) && state.alive[old.block_i[c]] &&
        state.alive[old.block_j[c]]) {
      list.push_back({old.vertex[c], old.edge[c]});
    }
  }
  std::inplace_merge(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(found), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

/// A candidate seen for the first time.
void start_candidate(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                     std::size_t k) {
  c.depth_1[k] = c.depth_2[k] = previous_gap(c, pose, k).depth;
  c.share[k] = 1.0;
  c.alpha[k] = 1.0;
  set_spring(c, b, pose, laws, k);
}

void extend_edges(ContactSet& c, const BlockSet& b) {
  list_run_ons(c, b);
  for (const RunOn& r : c.run_ons) {
    c.before[r.candidate] = r.before;
    c.beyond[r.candidate] = r.beyond;
  }
}

/// Where the entries of each vertex (or edge) begin in a list sorted by it.
std::vector<Id> begins(const std::vector<Id>& of, std::size_t vertices) {
  std::vector<Id> begin(vertices + 1, 0);
  for (const Id v : of) ++begin[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  return begin;
}

/// Segments and blocked candidates by their new numbers.
void renumber(ContactSet& next, const ContactSet& old, const std::vector<Id>& new_of_old) {
  for (const Segment& s : old.segments) {
    Segment kept;
    for (Id m : s.members) {
      if (new_of_old[m] != no_id) kept.members.push_back(new_of_old[m]);
    }
    if (!kept.members.empty()) next.segments.push_back(std::move(kept));
  }
  for (std::size_t k = 0; k < next.size(); ++k) {
    if (next.is(k, contact_state::blocked)) next.blocked.push_back(static_cast<Id>(k));
  }
}

}  // namespace

void list_by_corner(ContactSet& c, std::size_t vertices) {
  c.begin_of_vertex = begins(c.vertex, vertices);
  c.begin_of_edge = begins(c.edge, vertices);
  c.slot.resize(c.size());
  c.of_slot.resize(c.size());
  std::vector<Id> fill(c.begin_of_edge.begin(), c.begin_of_edge.end() - 1);
  for (std::size_t k = 0; k < c.size(); ++k) {
    c.slot[k] = fill[c.edge[k]]++;
    c.of_slot[c.slot[k]] = static_cast<Id>(k);
  }
}

void list_run_ons(ContactSet& c, const BlockSet& b) {
  c.run_ons.clear();
  const auto reentrant = [&](Id v) { return b.corner[v] > std::numbers::pi * 1.01; };
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id e = c.edge[k], f = c.edge_end[k];
    if (!reentrant(e) && !reentrant(f)) continue;
    const double run_on = 0.05 * b.edge_length[e];
    c.run_ons.push_back(
        {static_cast<Id>(k), reentrant(e) ? run_on : 0.0, reentrant(f) ? run_on : 0.0});
  }
}

double contact_length(const BlockSet& b, const Pose& pose, Id vertex, Id edge) {
  // Corners that only meet, as at every crossing of two joints, overlap by rounding or by nothing:
  // both are an overlap that begins.
  constexpr double rounding = 1e-9;
  const EdgeFrame e = edge_frame(at(pose.x, pose.y, edge), at(pose.x, pose.y, b.next[edge]));
  double length = 0.0;
  for (Id f : {b.previous[vertex], vertex}) {
    const Vec2 p = at(pose.x, pose.y, f), q = at(pose.x, pose.y, b.next[f]);
    if (dot(unit(q - p), e.t) > -opposite) continue;
    const double z0 = dot(q - e.start, e.t), z1 = dot(p - e.start, e.t);
    const double overlap = std::min(z1, e.length) - std::max(z0, 0.0);
    const double least = rounding * std::min(e.length, norm(q - p));
    if (overlap > -least) length += 0.5 * std::max(overlap, least);
  }
  return length;
}

double smaller_size(const ContactSet& c, const BlockSet& b, std::size_t k) {
  return std::sqrt(std::min(b.area[c.block_i[k]], b.area[c.block_j[k]]));
}

double carried_length(const ContactSet& c, const BlockSet& b, std::size_t k) {
  const double least = 0.01 * std::min({b.edge_length[c.edge[k]], b.edge_length[c.vertex[k]],
                                        b.edge_length[b.previous[c.vertex[k]]]});
  return std::max(c.length[k], least);
}

void set_spring(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                std::size_t k) {
  const Law& law = laws.rows[c.law[k]];
  const double length = contact_length(b, pose, c.vertex[k], c.edge[k]);
  c.length[k] = length;
  const double stands_for = carried_length(c, b, k);
  const bool lone_corner = length == 0.0;
  c.kn[k] = laws.normal_spring(law, lone_corner ? 0.0 : stands_for);
  c.ks[k] = laws.shear_spring(law, lone_corner ? 0.0 : stands_for);
  c.friction[k] = law.residual_friction;
  c.cohesion[k] = law.residual_cohesion * length * laws.thickness;
}

void set_dashpots(ContactSet& c, const LawTable& laws) {
  constexpr double as_others = -1.0;
  const std::size_t n = laws.any_dashpots ? c.size() : 0;
  for (auto* values : {&c.zeta, &c.shear_zeta, &c.drag}) values->assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Law& law = laws.rows[c.law[k]];
    c.zeta[k] = laws.damping_of(law, as_others);
    c.shear_zeta[k] = law.dashpots ? law.shear_damping : 0.0;
  }
}

bool grow_springs(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws) {
  // A stiffer spring may cost a new bound of the step.
  constexpr double worth = 1.02, worth_bound = 1.1;
  bool grown = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Law& law = laws.rows[c.law[k]];
    if (law.kn == 0.0 && law.ks == 0.0 && law.residual_cohesion == 0.0) continue;
    if (!c.is(k, contact_state::closed) || c.is(k, contact_state::bonded)) continue;
    const double length = contact_length(b, pose, c.vertex[k], c.edge[k]);
    const double more = law.kn > 0.0 || law.ks > 0.0 ? worth_bound : worth;
    if (length == 0.0 || (length <= more * c.length[k] && c.length[k] <= worth * length)) continue;
    const bool grows = length > c.length[k];
    const double part = length / c.length[k];
    const double energy = stored_energy(c, k), e = c.effective(k), slip = trial_slip(c, k);
    const double kn = c.kn[k], ks = c.ks[k], friction = c.friction[k];
    const bool was_cut = c.cut(k);
    set_spring(c, b, pose, laws, k);
    c.friction[k] = friction;
    if (grows) {
      // A lone corner was stiffer: it stays so, or energy would be made.
      c.kn[k] = std::max(c.kn[k], kn);
      c.ks[k] = std::max(c.ks[k], ks);
      c.rest[k] = c.depth[k] - e * kn / c.kn[k];
      c.anchor[k] = (c.foot[k] - slip * ks / c.ks[k]) / c.span[k];
      c.forget_cut(k);
    } else {
      // As deep as before, and of the same slip: what has gone takes its force and energy along.
      // (What once was a lone corner's spring stays out of proportion to its law.)
      if (law.kn > 0.0) c.kn[k] = std::max(c.kn[k], part * kn);
      if (law.ks > 0.0) c.ks[k] = std::max(c.ks[k], part * ks);
      c.kn[k] = std::min(c.kn[k], kn);
      c.ks[k] = std::min(c.ks[k], ks);
      c.tension[k] *= part;
      c.shear[k] *= c.ks[k] / ks;
      c.shear_1[k] *= c.ks[k] / ks;
      if (!was_cut) c.forget_cut(k);
    }
    c.friction_work[k] += energy - stored_energy(c, k);
    c.stir(k);
    grown |= c.kn[k] > kn || c.ks[k] > ks;
  }
  return grown;
}

/// What a gap may be wrong by, m: a few times the last digit of the largest coordinate.
static double rounding_of(const Pose& pose) {
  double largest = 0.0;
  for (const auto* values : {&pose.x, &pose.y}) {
    for (const double u : *values) largest = std::max(largest, std::abs(u));
  }
  constexpr double digits = 8.0;
  return digits * std::numeric_limits<double>::epsilon() * largest;
}

void rebuild_candidates(ContactSet& contacts, const BlockSet& b, const State& state,
                        const Pose& pose, const LawTable& laws, double reach) {
  const std::vector<NearPair> list = wanted(contacts, b, state, pose, reach);
  ContactSet next;
  resize(next, list.size());
  next.reach = reach;
  next.noise = rounding_of(pose);
  if (laws.any_changes) {
    next.slid.resize(list.size());
    next.owed.assign(list.size(), 0.0);
  }
  next.vertex.reserve(list.size());
  next.edge.reserve(list.size());
  std::vector<Id> new_of_old(contacts.size(), no_id), old_of_new(list.size(), no_id);
  if (!contacts.lent.empty()) next.lent.assign(list.size(), 0);
  std::size_t old = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const NearPair pair = list[k];
    next.vertex.push_back(pair.vertex);
    next.edge.push_back(pair.edge);
    next.edge_end[k] = b.next[pair.edge];
    next.block_i[k] = b.vertex_block[pair.vertex];
    next.block_j[k] = b.vertex_block[pair.edge];
    const Vec2 n =
        edge_frame(at(pose.x, pose.y, pair.edge), at(pose.x, pose.y, next.edge_end[k])).normal();
    while (old < contacts.size() && NearPair{contacts.vertex[old], contacts.edge[old]} < pair)
      ++old;
    if (old < contacts.size() && NearPair{contacts.vertex[old], contacts.edge[old]} == pair) {
      for (DoubleArray a : memory) (next.*a)[k] = (contacts.*a)[old];
      next.slip_trial[k] = contacts.slip_before_cut(old);
      if (laws.any_changes) {
        next.slid[k] = contacts.slid[old];
        next.owed[k] = contacts.owed[old];
      }
      for (std::size_t e = 0; e < 2; ++e) next.force[2 * k + e] = contacts.force[2 * old + e];
      next.state[k] = contacts.state[old];
      next.why[k] = contacts.why[old];
      if (!contacts.lent.empty()) next.lent[k] = contacts.lent[old];
      next.law[k] = contacts.law[old];
      new_of_old[old] = static_cast<Id>(k);
      old_of_new[k] = static_cast<Id>(old);
    } else {
      next.law[k] = laws.resolve(b.edge_joint[pair.edge],
                                 b.edge_joint[facing_edge(b, pose.x, pose.y, pair.vertex, n)],
                                 b.material[next.block_j[k]], b.material[next.block_i[k]]);
      start_candidate(next, b, pose, laws, k);
      if (laws.any_changes) next.slid[k] = first_slip(laws.rows[next.law[k]]);
    }
  }
  set_dashpots(next, laws);
  next.broken = contacts.broken;
  next.retired_friction = contacts.retired_friction;
  next.retired_damping = contacts.retired_damping;
  next.retired_fracture = contacts.retired_fracture;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (new_of_old[k] != no_id) continue;
    next.retired_friction += contacts.friction_work[k];
    next.retired_damping += contacts.damping_work[k];
    next.retired_fracture += contacts.fracture_work[k];
  }
  renumber(next, contacts, new_of_old);
  next.look_everywhere();
  extend_edges(next, b);
  for (std::size_t k = 0; k < next.size(); ++k) update_gap(next, pose, k);
  list_by_corner(next, b.vertex_count());
  for (std::size_t k = 0; k < old_of_new.size(); ++k) {
    if (old_of_new[k] == no_id) continue;
    const Id from = contacts.slot[old_of_new[k]], to = next.slot[k];
    std::copy_n(contacts.reaction.begin() + 4 * std::ptrdiff_t{from}, 4,
                next.reaction.begin() + 4 * std::ptrdiff_t{to});
  }
  pair_corners(next, b, pose);
  next.built_x = pose.x;
  next.built_y = pose.y;
  next.built_at = state.steps;
  next.rebuilds = contacts.rebuilds + 1;
  contacts = std::move(next);
}

void bond_contacts(ContactSet& c, const BlockSet& b, const State& state, const Pose& pose,
                   const LawTable& laws) {
  std::map<std::pair<Id, Id>, Segment> by_edges;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Law& law = laws.rows[c.law[k]];
    const bool weakens = law.type == LawType::slip_weakening;
    const bool has_bond = weakens || law.glued || law.peak_cohesion > 0.0 ||
                          law.peak_tension > 0.0 || law.peak_friction > law.residual_friction;
    const double size = smaller_size(c, b, k);
    const bool near_edge = c.on_edge(k) && c.share[k] > 0.0;
    if (!has_bond || !near_edge || c.length[k] <= 0.0 || c.depth[k] < -1e-6 * size ||
        c.is(k, contact_state::blocked) || !state.alive[c.block_i[k]]) {
      continue;
    }
    const Id f = facing_edge(b, pose.x, pose.y, c.vertex[k], normal_of(c, k));
    if (weakens) c.slid[k] = 0.0;
    if (weakens && law.peak_tension == 0.0) continue;
    c.set(k, contact_state::closed);
    if (!weakens) c.set(k, contact_state::bonded);
    if (law.glued) c.set(k, contact_state::glued);
    if (law.glued || law.peak_tension > 0.0) c.set(k, contact_state::pulls);
    c.tension[k] = law.peak_tension * c.length[k] * laws.thickness;
    // A bond that pulls is made where the blocks are: a gap of 1e-6 carries nothing.
    if (c.depth[k] < 0.0 && c.is(k, contact_state::pulls)) c.rest[k] = c.depth[k];
    c.anchor[k] = c.foot[k] / c.span[k];
    c.friction[k] = law.peak_friction;
    c.cohesion[k] = law.peak_cohesion * c.length[k] * laws.thickness;
    if (!weakens) by_edges[std::minmax(c.edge[k], f)].members.push_back(static_cast<Id>(k));
  }
  for (auto& [edges, segment] : by_edges) c.segments.push_back(std::move(segment));
}

}  // namespace edda
