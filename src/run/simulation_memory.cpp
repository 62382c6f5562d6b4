#include "run/simulation_memory.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "blocks/point_mass.hpp"
#include "checkpoint/archive.hpp"
#include "contacts/candidates.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/shares.hpp"
#include "contacts/strength.hpp"
#include "forces/viscosity.hpp"
#include "run/attachment_memory.hpp"
#include "run/face_memory.hpp"
#include "run/implicit_memory.hpp"

namespace edda {
namespace {

template <class Archive>
void list_contacts(Archive& a, ContactSet& c) {
  a("contacts.vertex", c.vertex);
  a("contacts.edge", c.edge);
  a("contacts.edge_end", c.edge_end);
  a("contacts.block_i", c.block_i);
  a("contacts.block_j", c.block_j);
  a("contacts.law", c.law);
  a("contacts.depth", c.depth);
  a("contacts.depth_1", c.depth_1);
  a("contacts.depth_2", c.depth_2);
  a("contacts.foot", c.foot);
  a("contacts.span", c.span);
  a("contacts.tx", c.tx);
  a("contacts.ty", c.ty);
  a("contacts.share", c.share);
  a("contacts.before", c.before);
  a("contacts.beyond", c.beyond);
  a("contacts.deepest", c.deepest);
  a("contacts.state", c.state);
  a("contacts.rest", c.rest);
  a("contacts.anchor", c.anchor);
  a("contacts.kn", c.kn);
  a("contacts.ks", c.ks);
  a("contacts.length", c.length);
  a("contacts.lent", c.lent);
  a("contacts.friction", c.friction);
  a("contacts.cohesion", c.cohesion);
  a("contacts.tension", c.tension);
  a("contacts.alpha", c.alpha);
  a("contacts.normal", c.normal);
  a("contacts.shear", c.shear);
  a("contacts.shear_1", c.shear_1);
  a("contacts.slip_trial", c.slip_trial);
  a("contacts.slid", c.slid);
  a("contacts.owed", c.owed);
  a("contacts.friction_work", c.friction_work);
  a("contacts.damping_work", c.damping_work);
  a("contacts.fracture_work", c.fracture_work);
  a("contacts.force", c.force);
  a("contacts.reaction", c.reaction);
  a("contacts.why", c.why);
  a("contacts.blocked", c.blocked);
  a("contacts.lone_pairs", c.lone_pairs);
  a("contacts.pair_of", c.pair_of);
  a("contacts.built_x", c.built_x);
  a("contacts.built_y", c.built_y);
  a("contacts.noise", c.noise);
  a("contacts.reach", c.reach);
  a("contacts.travel", c.travel);
  a("contacts.built_at", c.built_at);
  a("contacts.rebuilds", c.rebuilds);
  a("contacts.broken", c.broken);
  a("contacts.retired_friction", c.retired_friction);
  a("contacts.retired_damping", c.retired_damping);
  a("contacts.retired_fracture", c.retired_fracture);
}

/// Pairs and segments as flat arrays.
template <class Archive>
void list_groups(Archive& a, ContactSet& c) {
  std::vector<Id> first, second, members, ends;
  std::vector<bool> first_at_start, second_at_start;
  std::vector<double> reach;
  for (const CornerPair& p : c.pairs) {
    first.push_back(p.first);
    second.push_back(p.second);
    first_at_start.push_back(p.first_at_start);
    second_at_start.push_back(p.second_at_start);
    reach.push_back(p.reach);
  }
  for (const Segment& s : c.segments) {
    members.insert(members.end(), s.members.begin(), s.members.end());
    ends.push_back(static_cast<Id>(members.size()));
  }
  a("pairs.first", first);
  a("pairs.second", second);
  a("pairs.first_at_start", first_at_start);
  a("pairs.second_at_start", second_at_start);
  a("pairs.reach", reach);
  PairMemory& m = c.pair_memory;
  a("pairs.first_seen", m.first_seen);
  a("pairs.second_seen", m.second_seen);
  a("pairs.against", m.against);
  a("segments.members", members);
  a("segments.ends", ends);
  if constexpr (Archive::loads) {
    c.pairs.clear();
    const std::size_t n = std::min(
        {first.size(), second.size(), first_at_start.size(), second_at_start.size(), reach.size()});
    for (std::size_t k = 0; k < n; ++k) {
      c.pairs.push_back({first[k], second[k], first_at_start[k], second_at_start[k], reach[k]});
    }
    c.segments.clear();
    std::size_t begin = 0;
    for (const Id end : ends) {
      if (end < begin || end > members.size()) break;
      const auto from = members.begin() + static_cast<std::ptrdiff_t>(begin);
      c.segments.push_back({{from, members.begin() + static_cast<std::ptrdiff_t>(end)}});
      begin = end;
    }
  }
}

template <class Archive>
void list_state(Archive& a, Simulation& s) {
  a("state.x", s.state.x);
  a("state.y", s.state.y);
  a("state.vx", s.state.vx);
  a("state.vy", s.state.vy);
  a("state.from_x", s.state.from_x);
  a("state.from_y", s.state.from_y);
  a("damping.mass", s.damping.mass);
  a("damping.local", s.damping.local);
  a("damping.contact", s.damping.contact);
  a("damping.adaptive", s.damping.adaptive);
  a("pace.frequency", s.pace.frequency);
  a("pace.least", s.pace.least);
  a("pace.since", s.pace.since);
  a("pace.x", s.pace.x);
  a("pace.y", s.pace.y);
  a("pace.fx", s.pace.fx);
  a("pace.fy", s.pace.fy);
  a("aloof", s.aloof);
  a("settles", s.settles);
  a("balanced", s.balanced);
  a("rest_ratio", s.rest_ratio);
  a("gentle.at", s.loads.gentle.at);
  a("gentle.part", s.loads.gentle.part);
  a("gentle.weight", s.loads.gentle.weight);
  double fraction = s.damping.rayleigh ? s.damping.rayleigh->fraction : 0.0;
  double frequency = s.damping.rayleigh ? s.damping.rayleigh->frequency : 0.0;
  a("damping.rayleigh.fraction", fraction);
  a("damping.rayleigh.frequency", frequency);
  if constexpr (Archive::loads) {
    s.damping.rayleigh.reset();
    if (frequency > 0.0) s.damping.rayleigh = {fraction, frequency};
  }
  a("dynamic", s.dynamic);
  a("laws.divided_by", s.laws.divided_by);
  a("state.alive", s.state.alive);
  a("state.turns", s.state.turns);
  a("state.time", s.state.time);
  a("state.step", s.state.step);
  a("state.steps", s.state.steps);
  a("pose.x", s.pose.x);
  a("pose.y", s.pose.y);
  a("pose.x1", s.pose.x1);
  a("pose.y1", s.pose.y1);
  a("damping_work", s.damping_work.joules);
  a("forces.x", s.forces.x);
  a("forces.y", s.forces.y);
}

template <class Archive>
void list_counts(Archive& a, Simulation& s) {
  a("bound.critical_step", s.bound.critical_step);
  a("bound.likely_step", s.bound.likely_step);
  a("bound.block", s.bound.block);
  a("bound.contact", s.bound.contact);
  a("bound.elastic_part", s.bound.elastic_part);
  a("bound.contact_part", s.bound.contact_part);
  a("bound.boundary_part", s.bound.boundary_part);
  a("bound.bolt_part", s.bound.bolt_part);
  a("step_limit", s.step_limit);
  a("last_displacement", s.last_displacement);
  a("penetration", s.penetration);
  a("max_penetration", s.max_penetration);
  a("step_change_energy", s.step_change_energy);
  a("external_work", s.external_work);
  a("steps.smallest", s.steps.smallest);
  a("steps.largest", s.steps.largest);
  a("steps.sum", s.steps.sum);
  a("steps.changes", s.steps.changes);
  a("steps.over_critical", s.steps.over_critical);
  a("steps.redone", s.steps.redone);
  a("open_close.steps", s.open_close.steps);
  a("open_close.passes", s.open_close.passes);
  a("open_close.of_contact", s.open_close.of_contact);
  a("open_close.of_list", s.open_close.of_list);
  a("open_close.most", s.open_close.most);
  a("open_close.switched", s.open_close.switched);
  a("open_close.unsettled", s.open_close.unsettled);
  a("seconds.search", s.seconds.search);
  a("seconds.forces", s.seconds.forces);
  a("seconds.integrate", s.seconds.integrate);
  a("start_energy", s.start_energy);
  a("largest_energy", s.largest_energy);
}

/// The first thing that would lead out of an array, or to no number.
class Judge {
 public:
  const std::string& flaw() const { return flaw_; }
  template <class T>
  void sized(const char* name, const std::vector<T>& values, std::size_t n) {
    if (values.size() != n) note(name, "has another size than the model asks for");
  }
  void below(const char* name, const std::vector<Id>& values, std::size_t n, bool none = false) {
    for (const Id v : values) {
      if (v >= n && !(none && v == no_id)) return note(name, "points to what is not there");
    }
  }
  void positive(const char* name, double value) {
    if (!(value > 0.0)) note(name, "is not above zero");
  }
  void refuse(const char* what) { note(what, ""); }

 private:
  void note(const char* name, const char* what) {
    if (flaw_.empty()) flaw_ = *what ? std::string(name) + " " + what : name;
  }
  std::string flaw_;
};

/// Vertices and edges are those of their blocks, and stand in order.
bool belong_together(const ContactSet& c, const BlockSet& b) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (b.vertex_block[c.vertex[k]] != c.block_i[k] || b.vertex_block[c.edge[k]] != c.block_j[k] ||
        b.next[c.edge[k]] != c.edge_end[k] || c.block_i[k] == c.block_j[k]) {
      return false;
    }
    if (k > 0 && std::pair(c.vertex[k - 1], c.edge[k - 1]) >= std::pair(c.vertex[k], c.edge[k])) {
      return false;
    }
  }
  return true;
}

void judge_contacts(Judge& j, const ContactSet& c, const BlockSet& b, const LawTable& laws) {
  const std::size_t nc = c.size(), nv = b.vertex_count();
  for (const auto* ids : {&c.edge, &c.edge_end, &c.block_i, &c.block_j, &c.pair_of}) {
    j.sized("contacts", *ids, nc);
  }
  for (const auto* values :
       {&c.depth,        &c.depth_1,      &c.depth_2, &c.foot,     &c.span,       &c.tx,
        &c.ty,           &c.share,        &c.before,  &c.beyond,   &c.rest,       &c.anchor,
        &c.kn,           &c.ks,           &c.length,  &c.friction, &c.cohesion,   &c.tension,
        &c.alpha,        &c.normal,       &c.shear,   &c.shear_1,  &c.slip_trial, &c.friction_work,
        &c.damping_work, &c.fracture_work}) {
    j.sized("contacts", *values, nc);
  }
  j.sized("contacts.slid", c.slid, laws.any_changes ? nc : 0);
  j.sized("contacts.owed", c.owed, laws.any_changes ? nc : 0);
  j.sized("contacts.force", c.force, 2 * nc);
  j.sized("contacts.reaction", c.reaction, 4 * nc);
  j.sized("contacts.law", c.law, nc);
  j.sized("contacts.state", c.state, nc);
  j.sized("contacts.why", c.why, nc);
  if (!c.lent.empty()) j.sized("contacts.lent", c.lent, nc);
  j.sized("contacts.deepest", c.deepest, c.chunks());
  if (!c.on_faces) {
    j.sized("contacts.built_x", c.built_x, nv);
    j.sized("contacts.built_y", c.built_y, nv);
  }
  j.below("contacts.vertex", c.vertex, nv);
  j.below("contacts.edge", c.edge, nv);
  j.below("contacts.edge_end", c.edge_end, nv);
  j.below("contacts.block_i", c.block_i, b.size());
  j.below("contacts.block_j", c.block_j, b.size());
  j.below("contacts.law", {c.law.begin(), c.law.end()}, laws.rows.size());
  j.below("contacts.blocked", c.blocked, nc);
  j.below("contacts.pair_of", c.pair_of, c.pairs.size(), true);
  if (j.flaw().empty() && !belong_together(c, b)) j.refuse("contacts do not belong together");
  if (c.lone_pairs > c.pairs.size()) j.refuse("contacts.lone_pairs is too large");
  const PairMemory& m = c.pair_memory;
  for (const auto* values : {&m.first_seen, &m.second_seen, &m.against}) {
    j.sized("pairs", *values, c.pairs.size());
  }
  for (const CornerPair& p : c.pairs) j.below("pairs", {p.first, p.second}, nc);
  for (const Segment& s : c.segments) j.below("segments", s.members, nc);
}

/// Blocks in one piece and not at the end of the world: the search for contacts counts cells.
void judge_places(Judge& j, const Simulation& s) {
  const BlockSet& b = s.blocks;
  double extent = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    extent = std::max({extent, std::abs(b.vertex_x[v]), std::abs(b.vertex_y[v])});
  }
  const double far = 1e6 * extent;
  auto near = [&](const std::vector<double>& x, const std::vector<double>& y, std::size_t v) {
    const Vec2 middle = centroid(s.state.x, s.state.y, b.vertex_block[v]);
    const Vec2 p{x[v], y[v]};
    return norm(p) <= far && norm(p - middle) <= 10.0 * b.radius[b.vertex_block[v]];
  };
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (!near(s.pose.x, s.pose.y, v) || !near(s.pose.x1, s.pose.y1, v)) {
      return j.refuse("pose is not that of these blocks");
    }
    if (s.on_faces()) continue;
    if (!(std::abs(s.contacts.built_x[v]) <= far && std::abs(s.contacts.built_y[v]) <= far)) {
      return j.refuse("contacts.built is not of these blocks");
    }
  }
  for (const double length : {s.contacts.reach, s.contacts.travel, s.last_displacement}) {
    if (!(length >= 0.0 && length <= extent)) return j.refuse("a length is out of range");
  }
}

void judge(Judge& j, const Simulation& s) {
  const std::size_t nb = s.blocks.size(), nv = s.blocks.vertex_count();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto* nodes : {&s.state.x, &s.state.y, &s.state.vx, &s.state.vy, &s.state.from_x,
                              &s.state.from_y, &s.forces.x, &s.forces.y}) {
      j.sized("state", (*nodes)[k], nb);
    }
  }
  for (const auto* jump : {&s.jump.x, &s.jump.y}) {
    for (const auto& values : *jump) {
      if (!s.jump.x[0].empty() || !values.empty()) j.sized("jump", values, nb);
    }
  }
  j.sized("state.alive", s.state.alive, nb);
  j.sized("state.turns", s.state.turns, nb);
  j.sized("damping_work", s.damping_work.joules, nb);
  for (const auto* values : {&s.pose.x, &s.pose.y, &s.pose.x1, &s.pose.y1}) {
    j.sized("pose", *values, nv);
  }
  j.below("bound.block", {s.bound.block}, nb, true);
  j.positive("state.step", s.state.step);
  j.positive("step_limit", s.step_limit);
  if (!s.inertia.empty()) j.sized("inertia", s.inertia, nb);
  for (const auto& mass : s.blocks.node_mass) j.sized("node_mass", mass, nb);
  for (const auto& entry : s.blocks.inverse_mass) {
    j.sized("inverse_mass", entry, s.blocks.mass_kind == MassKind::consistent ? nb : 0);
  }
  for (std::size_t i = 0; i < s.inertia.size() && j.flaw().empty(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) j.positive("node_mass", s.blocks.node_mass[k][i]);
  }
  judge_contacts(j, s.contacts, s.blocks, s.laws);
  judge_faces(j, s.contacts.faces, s.blocks, s.laws);
  if (j.flaw().empty()) judge_places(j, s);
}

}  // namespace

template <class Archive>
void list_memory(Archive& a, Simulation& s) {
  list_state(a, s);
  list_contacts(a, s.contacts);
  list_faces(a, s.contacts.faces);
  list_groups(a, s.contacts);
  list_counts(a, s);
  list_kept(a, s);
  list_ground(a, s);
  list_bolts(a, s);
  a("displacement_cap", s.displacement_cap_);
  a("strength_from", s.strength_from_);
  a("strength_to", s.strength_to_);
  a("larger_since", s.larger_since_);
  a("target", s.target_);
  a("nominal_step", s.nominal_step_);
  a("step_before", s.step_before_);
  a("steps_left", s.steps_left_);
  if (!s.explicit_method()) list_implicit(a, s);
  a("scaled_step", s.scaled_step_);
  a("jump_x", s.jump.x);
  a("jump_y", s.jump.y);
  if (s.model.solver.mass_scaling > 0.0 || s.scaled_step_ > 0.0 || s.sliver_step_ > 0.0) {
    // Masses by their bits, not by their factors.
    a("inertia", s.inertia);
    a("node_mass", s.blocks.node_mass);
    a("inverse_mass", s.blocks.inverse_mass);
  }
}

void remember(const Simulation& sim, Record& record) {
  Saver saver(record);
  // Saver only reads, and the slips that are filled in are those that were taken for granted.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  Simulation& listed = const_cast<Simulation&>(sim);
  for (std::size_t k = 0; k < sim.contacts.size(); ++k) listed.contacts.keep_slips(k);
  list_memory(saver, listed);
}

std::string recall(Simulation& sim, const Record& record) {
  Loader loader(record);
  list_memory(loader, sim);
  if (!loader.flaw().empty()) return loader.flaw();
  const std::vector<double> factors = sim.laws.divided_by;
  if (factors.size() != sim.laws.rows.size() ||
      !std::all_of(factors.begin(), factors.end(),
                   [](double f) { return f > 0.0 && std::isfinite(f); })) {
    return "laws.divided_by is not of these laws";
  }
  sim.laws = divided_laws(sim.model, factors);
  Judge j;
  judge(j, sim);
  if (!j.flaw().empty()) return j.flaw();
  sim.contacts.look_everywhere();
  set_dashpots(sim.contacts, sim.laws);
  complete_faces(sim.contacts.faces, sim.blocks, sim.laws);
  set_face_dashpots(sim.contacts.faces, sim.laws, sim.damping.contact);
  fill_point_masses(sim.blocks);
  fill_viscosity(sim.blocks, sim.damping);
  list_by_corner(sim.contacts, sim.blocks.vertex_count());
  list_run_ons(sim.contacts, sim.blocks);
  list_pairs(sim.contacts);
  return j.flaw();
}

}  // namespace edda
