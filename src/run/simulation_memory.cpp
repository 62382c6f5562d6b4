#include "run/simulation_memory.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "checkpoint/archive.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/strength.hpp"
#include "forces/viscosity.hpp"
#include "run/attachment_memory.hpp"
#include "run/face_memory.hpp"
#include "run/flow_memory.hpp"
#include "run/implicit_memory.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

template <class Archive>
void list_zones(Archive& a, Zones& zones) {
  list_numbers(a, "zones.state", zones.state);
  if (!zones.piece.empty()) list_numbers(a, "zones.piece", zones.piece);
  list_numbers(a, "zones.force", zones.force);
  list_numbers(a, "zones.stress", zones.stress);
  a("zones.yielding", zones.yielding);
  a("zones.stored", zones.stored);
  a("zones.stored_between", zones.stored_between);
  a("zones.dissipated", zones.dissipated);
  list_numbers(a, "zones.viscous", zones.viscous);
  a("zones.damped", zones.damped);
  a("zones.damped_due", zones.damped_due);
  a("zones.pore", zones.pore);
  a("zones.swelling", zones.swelling);
  a("zones.pore_work", zones.pore_work);
  a("zones.pore_work_due", zones.pore_work_due);
}

template <class Archive>
void list_state(Archive& a, Simulation& s) {
  list_vectors(a, "state.position", s.motion.state.position);
  list_vectors(a, "state.velocity", s.motion.state.velocity);
  list_vectors(a, "state.reference", s.motion.state.reference);
  a("damping.mass", s.motion.damping.mass);
  a("damping.local", s.motion.damping.local);
  a("damping.contact", s.motion.damping.contact);
  a("damping.adaptive", s.motion.damping.adaptive);
  a("frequency_estimate.frequency", s.relaxation.estimate.frequency);
  a("frequency_estimate.of_block", s.relaxation.estimate.of_block);
  a("frequency_estimate.least", s.relaxation.estimate.least);
  a("frequency_estimate.since", s.relaxation.estimate.since);
  list_vectors(a, "frequency_estimate.position", s.relaxation.estimate.position);
  list_vectors(a, "frequency_estimate.force", s.relaxation.estimate.force);
  a("loose", s.relaxation.loose);
  a("seeks_equilibrium", s.relaxation.seeks_equilibrium);
  a("balanced", s.relaxation.balanced);
  a("equilibrium_ratio", s.relaxation.equilibrium_ratio);
  a("gradual.at", s.attached.loads.gradual.at);
  a("gradual.part", s.attached.loads.gradual.part);
  a("gradual.settling", s.attached.loads.gradual.settling);
  a("gradual.weight", s.attached.loads.gradual.weight);
  a("gradual.least", s.attached.loads.gradual.least);
  a("gradual.periods", s.attached.loads.gradual.periods);
  double fraction = s.motion.damping.rayleigh ? s.motion.damping.rayleigh->fraction : 0.0;
  double frequency = s.motion.damping.rayleigh ? s.motion.damping.rayleigh->frequency : 0.0;
  a("damping.rayleigh.fraction", fraction);
  a("damping.rayleigh.frequency", frequency);
  if constexpr (Archive::loads) {
    s.motion.damping.rayleigh.reset();
    if (frequency > 0.0) s.motion.damping.rayleigh = {fraction, frequency};
  }
  a("dynamic", s.motion.dynamic);
  a("laws.divided_by", s.motion.laws.divided_by);
  a("laws.time", s.motion.laws.progress.time);
  a("laws.part", s.motion.laws.progress.part);
  a("laws.since", s.motion.laws.progress.since);
  a("law_course.stage", s.motion.law_course.stage);
  a("law_course.began", s.motion.law_course.began);
  a("law_course.time", s.motion.law_course.time);
  a("state.alive", s.motion.state.alive);
  a("state.turns", s.motion.state.turns);
  a("state.time", s.motion.state.time);
  a("state.step", s.motion.state.step);
  a("state.steps", s.motion.state.steps);
  a("pose.x", s.motion.pose.x);
  a("pose.y", s.motion.pose.y);
  a("pose.x1", s.motion.pose.x1);
  a("pose.y1", s.motion.pose.y1);
  a("damping_work", s.accounts.damping_work.joules);
  list_vectors(a, "forces", s.motion.forces);
  list_vectors(a, "on_contacts", s.motion.on_contacts);
  list_vectors(a, "jump", s.motion.jump);
  list_zones(a, s.motion.zones);
  a("locked_x", s.motion.locked.x);
  a("locked_y", s.motion.locked.y);
}

template <class Archive>
void list_counts(Archive& a, Simulation& s) {
  a("bound.critical_step", s.control.bound.critical_step);
  a("bound.block", s.control.bound.block);
  a("bound.contact", s.control.bound.contact);
  a("bound.elastic_part", s.control.bound.elastic_part);
  a("bound.contact_part", s.control.bound.contact_part);
  a("bound.boundary_part", s.control.bound.boundary_part);
  a("bound.bolt_part", s.control.bound.bolt_part);
  a("step_limit", s.control.limit);
  a("last_displacement", s.control.last_displacement);
  a("penetration", s.accounts.penetration);
  a("max_penetration", s.accounts.max_penetration);
  a("step_change_energy", s.accounts.step_change_energy);
  a("external_work", s.accounts.external_work);
  a("steps.smallest", s.accounts.steps.smallest);
  a("steps.largest", s.accounts.steps.largest);
  a("steps.sum", s.accounts.steps.sum);
  a("steps.changes", s.accounts.steps.changes);
  a("steps.over_critical", s.accounts.steps.over_critical);
  a("steps.redone", s.accounts.steps.redone);
  a("open_close.steps", s.accounts.open_close.steps);
  a("open_close.passes", s.accounts.open_close.passes);
  a("open_close.of_face", s.accounts.open_close.of_face);
  a("open_close.of_list", s.accounts.open_close.of_list);
  a("open_close.most", s.accounts.open_close.most);
  a("open_close.switched", s.accounts.open_close.switched);
  a("open_close.not_converged", s.accounts.open_close.not_converged);
  a("seconds.search", s.accounts.seconds.search);
  a("seconds.forces", s.accounts.seconds.forces);
  a("seconds.integrate", s.accounts.seconds.integrate);
  a("start_energy", s.accounts.start_energy);
  a("largest_energy", s.accounts.largest_energy);
  std::vector<SetAside>& aside = s.accounts.set_aside;
  std::size_t count = aside.size();
  a("set_aside.count", count);
  if constexpr (Archive::loads) aside.resize(std::min(count, s.scene->blocks.size()));
  for (std::size_t q = 0; q < aside.size(); ++q) {
    const std::string of = "set_aside." + std::to_string(q) + ".";
    a(of + "block", aside[q].block);
    a(of + "time", aside[q].time);
    a(of + "x", aside[q].place.x);
    a(of + "y", aside[q].place.y);
    if constexpr (Archive::loads) {
      if (aside[q].block >= s.scene->blocks.size()) return a.refuse("set_aside is out of range");
    }
  }
}

/// Records the first value that would lead out of an array or is not finite.
class Examiner {
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

/// Checks that blocks are in one piece and not too far away: the contact search counts cells.
void examine_places(Examiner& j, const Simulation& s) {
  const BlockSet& b = s.scene->blocks;
  double extent = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    extent = std::max({extent, std::abs(b.vertex_x[v]), std::abs(b.vertex_y[v])});
  }
  const double far = 1e6 * extent;
  auto near = [&](const std::vector<double>& x, const std::vector<double>& y, std::size_t v) {
    const Vec2 middle = centroid(s.motion.state.position, b.vertex_block[v]);
    const Vec2 p{x[v], y[v]};
    return norm(p) <= far && norm(p - middle) <= 10.0 * b.radius[b.vertex_block[v]];
  };
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (!near(s.motion.pose.x, s.motion.pose.y, v) ||
        !near(s.motion.pose.x1, s.motion.pose.y1, v)) {
      return j.refuse("pose is not that of these blocks");
    }
    if (!(std::abs(s.motion.contacts.built_x[v]) <= far &&
          std::abs(s.motion.contacts.built_y[v]) <= far)) {
      return j.refuse("faces.built is not of these blocks");
    }
  }
  for (const double length : {s.motion.contacts.reach, s.motion.contacts.reach_behind,
                              s.motion.contacts.travel, s.control.last_displacement}) {
    if (!(length >= 0.0 && length <= extent)) return j.refuse("a length is out of range");
  }
}

void examine(Examiner& j, const Simulation& s, const FaceStates& faces) {
  const std::size_t nb = s.scene->blocks.size(), nv = s.scene->blocks.vertex_count();
  const BlockSet& b = s.scene->blocks;
  for (const BodyVectors* of : {&s.motion.state.position, &s.motion.state.velocity,
                                &s.motion.state.reference, &s.motion.forces, &s.motion.on_contacts})
    if (!fits(b, *of)) j.refuse("state has another size than the model asks for");
  if (!is_empty(s.motion.jump) && !fits(b, s.motion.jump)) j.refuse("jump does not fit");
  const FrequencyEstimate& estimate = s.relaxation.estimate;
  const bool none_yet = is_empty(estimate.position) && is_empty(estimate.force);
  if (!none_yet && !(fits(b, estimate.position) && fits(b, estimate.force)))
    j.refuse("frequency_estimate does not fit");
  for (const auto* locked : {&s.motion.locked.x, &s.motion.locked.y})
    if (!s.motion.locked.x.empty() || !locked->empty()) j.sized("locked", *locked, b.mode_places());
  const Zones& zones = s.motion.zones;
  const std::size_t many = s.scene->zones.shape.size(), pairs = s.scene->zones.pair.size();
  j.sized("zones.state", zones.state, many);
  j.sized("zones.force", zones.force, many);
  j.sized("zones.piece", zones.piece, s.scene->zones.piece.size());
  j.sized("zones.stress", zones.stress, many);
  j.sized("zones.yielding", zones.yielding, many);
  for (const auto* of : {&zones.stored, &zones.stored_between, &zones.dissipated})
    j.sized("zones", *of, pairs);
  const bool viscous = !zones.viscous.empty();
  j.sized("zones.viscous", zones.viscous, viscous ? many : 0);
  for (const auto* of : {&zones.damped, &zones.damped_due})
    j.sized("zones", *of, viscous ? pairs : 0);
  const std::size_t wet = s.attached.loads.wet_zones.empty() ? 0 : many;
  for (const auto* of : {&zones.pore, &zones.swelling, &zones.pore_work, &zones.pore_work_due})
    j.sized("zones", *of, wet);
  j.sized("state.alive", s.motion.state.alive, nb);
  j.sized("state.turns", s.motion.state.turns, nb);
  j.sized("damping_work", s.accounts.damping_work.joules, nb);
  for (const auto* values :
       {&s.motion.pose.x, &s.motion.pose.y, &s.motion.pose.x1, &s.motion.pose.y1}) {
    j.sized("pose", *values, nv);
  }
  j.below("bound.block", {s.control.bound.block}, nb, true);
  if (!s.relaxation.estimate.of_block.empty())
    j.sized("frequency_estimate.of_block", s.relaxation.estimate.of_block, nb);
  j.positive("state.step", s.motion.state.step);
  j.positive("step_limit", s.control.limit);
  if (!s.motion.masses.raised.empty()) j.sized("masses.raised", s.motion.masses.raised, nb);
  for (const auto& mass : s.motion.masses.node) j.sized("node_mass", mass, nb);
  for (const auto& entry : s.motion.masses.inverse) {
    j.sized("inverse_mass", entry, s.scene->blocks.mass_kind == MassKind::consistent ? nb : 0);
  }
  for (std::size_t i = 0; i < s.motion.masses.raised.size() && j.flaw().empty(); ++i) {
    for (const auto& mass : s.motion.masses.node) j.positive("node_mass", mass[i]);
  }
  examine_faces(j, s.motion.contacts, faces, s.scene->blocks, s.motion.laws);
  examine_points(j, s.point_contacts, s.scene->blocks, s.motion.laws);
  if (j.flaw().empty()) examine_places(j, s);
}

/// The stages to come may be others than those of the run before, and the laws that they add, the
/// last before that of the rock: no face has one of these yet.
void fit_laws(Simulation& sim) {
  const std::size_t joints = sim.scene->model.joints.size();
  for (auto* of : {&sim.motion.laws.progress.part, &sim.motion.laws.progress.since}) {
    if (!of->empty()) of->resize(joints);
  }
  for (auto* of :
       {&sim.motion.laws.divided_by, &sim.relaxation.strength_from, &sim.relaxation.strength_to}) {
    if (of->empty()) continue;
    const double rock = of->back();
    of->resize(joints, rock);
    of->push_back(rock);
  }
}

}  // namespace

template <class Archive>
void list_memory(Archive& a, Simulation& s, FaceStates& faces) {
  list_state(a, s);
  list_faces(a, s.motion.contacts, faces);
  if (s.stepper == &paper_stepper) list_points(a, s.point_contacts);
  list_counts(a, s);
  list_slow_loading(a, s);
  list_wall_forces(a, s);
  list_ground(a, s);
  list_bolts(a, s);
  list_flow(a, s);
  a("displacement_cap", s.control.cap);
  a("strength_from", s.relaxation.strength_from);
  a("strength_to", s.relaxation.strength_to);
  a("hold", s.relaxation.hold);
  a("holds_together", s.relaxation.holds_together);
  a("larger_allowed_since", s.control.larger_allowed_since);
  a("target", s.control.target);
  a("nominal_step", s.control.nominal);
  a("step_before", s.control.step_before);
  a("steps_left", s.control.steps_left);
  if (!is_explicit(s)) list_implicit(a, s);
  a("scaled_step", s.control.scaled_step);
  if (s.scene->model.solver.mass_scaling > 0.0 || s.control.scaled_step > 0.0 ||
      s.control.sliver_step > 0.0) {
    // The masses themselves, bit for bit, and not only their factors.
    a("masses.raised", s.motion.masses.raised);
    a("node_mass", s.motion.masses.node);
    a("inverse_mass", s.motion.masses.inverse);
  }
}

void remember(Simulation& sim, RecordSink& sink) {
  Saver saver(sink);
  FaceStates faces = take_faces(sim);
  list_memory(saver, sim, faces);
}

void remember(Simulation& sim, Record& record) {
  RecordKeeper keeper(record);
  remember(sim, keeper);
}

std::string recall(Simulation& sim, const Record& record) {
  Loader loader(record);
  FaceStates faces;
  list_memory(loader, sim, faces);
  if (!loader.flaw().empty()) return loader.flaw();
  fit_laws(sim);
  const std::vector<double> factors = sim.motion.laws.divided_by;
  if (factors.size() != sim.motion.laws.rows.size() ||
      !std::all_of(factors.begin(), factors.end(),
                   [](double f) { return f > 0.0 && std::isfinite(f); })) {
    return "laws.divided_by is not of these laws";
  }
  if (sim.motion.law_course.stage > 0 &&
      sim.motion.law_course.stage >= sim.scene->model.stages.size())
    return "law_course.stage is none of the model";
  const LawProgress progress = sim.motion.laws.progress;
  sim.motion.laws = divided_laws(sim.scene->model, factors, progress);
  sim.motion.zones.material = divided_strength(sim.scene->zones, sim.motion.laws.rock_divided_by());
  Examiner j;
  examine(j, sim, faces);
  if (!j.flaw().empty()) return j.flaw();
  complete_faces(sim.motion.contacts, sim.scene->blocks, sim.motion.laws);
  set_face_dashpots(sim.motion.contacts, sim.motion.laws, sim.motion.damping.contact);
  complete_points(sim.point_contacts, sim.scene->blocks, sim.motion.pose, sim.motion.laws);
  fill_point_masses(sim.motion.masses, sim.scene->blocks);
  fill_viscosity(sim.motion.masses, sim.scene->blocks, sim.motion.damping, sim.scene->zones);
  put_faces(sim, faces);
  return j.flaw();
}

}  // namespace edda
