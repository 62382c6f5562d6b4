#include "run/simulation_memory.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "blocks/point_mass.hpp"
#include "checkpoint/archive.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/strength.hpp"
#include "forces/viscosity.hpp"
#include "run/attachment_memory.hpp"
#include "run/face_memory.hpp"
#include "run/implicit_memory.hpp"

namespace edda {
namespace {

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
  a("bound.critical_step", s.bound.critical_step);
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
  a("open_close.of_face", s.open_close.of_face);
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
    rows(name, values.size(), n);
  }
  void rows(const char* name, std::size_t has, std::size_t n) {
    if (has != n) note(name, "has another size than the model asks for");
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
  judge_faces(j, s.contacts, s.blocks, s.laws);
  judge_points(j, s.point_contacts, s.blocks, s.laws);
  if (j.flaw().empty()) judge_places(j, s);
}

}  // namespace

template <class Archive>
void list_memory(Archive& a, Simulation& s) {
  list_state(a, s);
  list_faces(a, s.contacts);
  if (s.at_points()) list_points(a, s.point_contacts);
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
  // Saver only reads.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  list_memory(saver, const_cast<Simulation&>(sim));
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
  complete_faces(sim.contacts, sim.blocks, sim.laws);
  set_face_dashpots(sim.contacts, sim.laws, sim.damping.contact);
  complete_points(sim.point_contacts, sim.blocks, sim.pose, sim.laws);
  fill_point_masses(sim.blocks);
  fill_viscosity(sim.blocks, sim.damping);
  return j.flaw();
}

}  // namespace edda
