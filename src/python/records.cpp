// Small records that a simulation returns.
#include <type_traits>

#include "python/bindings.hpp"

namespace edda::python {
namespace {

/// "Name(a=1, b=2)" of the attributes that the class names.
template <class T>
void add_repr(py::class_<T>& type, std::vector<std::string> names) {
  type.def("__repr__", [names = std::move(names)](const py::object& self) {
    std::string text = py::str(py::type::of(self).attr("__name__"));
    std::string separator = "(";
    for (const std::string& name : names) {
      text += separator + name + "=" + std::string(py::repr(self.attr(name.c_str())));
      separator = ", ";
    }
    return text + ")";
  });
}

template <class F>
py::object packed(const F& value) {
  if constexpr (std::is_enum_v<F>) {
    return py::int_(static_cast<int>(value));
  } else {
    return py::cast(value);
  }
}

template <class F>
F unpacked(const py::handle& value) {
  if constexpr (std::is_enum_v<F>) {
    return static_cast<F>(value.cast<int>());
  } else {
    return value.cast<F>();
  }
}

/// Pickling and copying of a record with these fields.
template <class T, class... F>
void add_pickling(py::class_<T>& type, F T::*... fields) {
  type.def(
      py::pickle([fields...](const T& record) { return py::make_tuple(packed(record.*fields)...); },
                 [fields...](const py::tuple& state) {
                   if (state.size() != sizeof...(F)) {
                     throw py::value_error("pickled by another version of edda");
                   }
                   T record;
                   std::size_t k = 0;
                   ((record.*fields = unpacked<F>(state[k++])), ...);
                   return record;
                 }));
}

void add_outcome(py::module_& m) {
  py::class_<api::Outcome> outcome(m, "Outcome", "How a run ended.");
  outcome
      .def_property_readonly(
          "status", [](const api::Outcome& o) { return std::string(name_of(o.status)); },
          "completed, equilibrium, collapsed, interrupted or failed.")
      .def_readonly("message", &api::Outcome::message, "One sentence.")
      .def_readonly("time", &api::Outcome::time, "s, reached.")
      .def_readonly("steps", &api::Outcome::steps, "Steps made.")
      .def_readonly("contacts", &api::Outcome::contacts, "Closed at the end.")
      .def_readonly("drift", &api::Outcome::drift,
                    "Error of the energy balance, a ratio: the largest in size of all rows of the "
                    "history, not the last one's.")
      .def_readonly("wall_seconds", &api::Outcome::wall_seconds, "s")
      .def_readonly(
          "at_rest", &api::Outcome::at_rest,
          "Whether the model is in equilibrium at the end; also for a run that has completed.")
      .def_readonly("fastest", &api::Outcome::fastest,
                    "Block with the fastest corner at the end, -1: none is free.")
      .def_readonly("speed", &api::Outcome::speed, "m/s, of that corner.")
      .def_readonly("failed_checks", &api::Outcome::failed_checks,
                    "Checks of summary.json that do not hold, a sentence each.");
  add_pickling(outcome, &api::Outcome::status, &api::Outcome::message, &api::Outcome::time,
               &api::Outcome::steps, &api::Outcome::contacts, &api::Outcome::drift,
               &api::Outcome::wall_seconds, &api::Outcome::at_rest, &api::Outcome::fastest,
               &api::Outcome::speed, &api::Outcome::failed_checks);
  add_repr(outcome, {"status", "message", "time", "steps"});
}

void add_check(py::module_& m) {
  py::class_<api::ModelCheck> check(m, "ModelCheck", "What edda.check() finds.");
  check.def_readonly("blocks", &api::ModelCheck::blocks, "How many there are.")
      .def_readonly("held", &api::ModelCheck::held, "How many of them are fixed.")
      .def_readonly("contacts", &api::ModelCheck::contacts, "Closed at the start.")
      .def_readonly("critical_step", &api::ModelCheck::critical_step, "s")
      .def_readonly("time_step", &api::ModelCheck::time_step, "s, the first.")
      .def_readonly("steps", &api::ModelCheck::steps, "To expect.")
      .def_readonly("at_most", &api::ModelCheck::at_most, "Whether stages may end before.")
      .def_readonly("steps_per_second", &api::ModelCheck::steps_per_second, "Of wall time.")
      .def_readonly("governed_by", &api::ModelCheck::governed_by, "What governs the time step.")
      .def_readonly("loads", &api::ModelCheck::loads, "A sentence each.")
      .def_readonly("initial_stress", &api::ModelCheck::initial_stress, "A sentence each.")
      .def_readonly("strain_damping", &api::ModelCheck::strain_damping, "A sentence each.")
      .def_readonly("warnings", &api::ModelCheck::warnings, "Warnings, a sentence each.");
  add_pickling(check, &api::ModelCheck::blocks, &api::ModelCheck::held, &api::ModelCheck::contacts,
               &api::ModelCheck::critical_step, &api::ModelCheck::time_step,
               &api::ModelCheck::steps, &api::ModelCheck::at_most,
               &api::ModelCheck::steps_per_second, &api::ModelCheck::governed_by,
               &api::ModelCheck::loads, &api::ModelCheck::initial_stress,
               &api::ModelCheck::strain_damping, &api::ModelCheck::warnings);
  add_repr(check, {"blocks", "held", "time_step", "steps", "warnings"});
}

void add_trial(py::module_& m) {
  py::class_<api::FosTrial> trial(m, "FosTrial", "One factor that was tried.");
  trial.def_readonly("factor", &api::FosTrial::factor, "What was tried.")
      .def_readonly("holds", &api::FosTrial::holds, "Whether the model reached equilibrium.")
      .def_readonly("reason", &api::FosTrial::reason, "A few words.")
      .def_readonly("displacement", &api::FosTrial::displacement,
                    "m, largest of a corner since the start of the trial.")
      .def_readonly("block", &api::FosTrial::block, "Whose corner that is, -1: none.")
      .def_readonly("velocity", &api::FosTrial::velocity, "m/s, at its end.")
      .def_readonly("time", &api::FosTrial::time, "s that it took.");
  add_pickling(trial, &api::FosTrial::factor, &api::FosTrial::holds, &api::FosTrial::reason,
               &api::FosTrial::displacement, &api::FosTrial::block, &api::FosTrial::velocity,
               &api::FosTrial::time);
  add_repr(trial, {"factor", "holds", "reason"});
}

void add_factor_of_safety(py::module_& m) {
  py::class_<api::FactorOfSafety> fos(m, "FactorOfSafety", "What edda.fos() finds.");
  fos.def_readonly("status", &api::FactorOfSafety::status,
                   "found, below, above, unstable or interrupted.")
      .def_readonly("message", &api::FactorOfSafety::message, "One sentence.")
      .def_readonly("factor", &api::FactorOfSafety::factor,
                    "The middle of the bracket; None where there is no bracket.")
      .def_readonly("holds", &api::FactorOfSafety::holds, "The largest factor that holds, or None.")
      .def_readonly("fails", &api::FactorOfSafety::fails,
                    "The smallest factor that fails, or None.")
      .def_readonly("mechanism", &api::FactorOfSafety::mechanism,
                    "What moves at this factor, a sentence; empty where nothing failed.")
      .def_readonly("trials", &api::FactorOfSafety::trials, "Every factor that was tried.")
      .def_readonly("warnings", &api::FactorOfSafety::warnings, "A sentence each.")
      .def_readonly("wall_seconds", &api::FactorOfSafety::wall_seconds, "s");
  add_pickling(fos, &api::FactorOfSafety::status, &api::FactorOfSafety::message,
               &api::FactorOfSafety::factor, &api::FactorOfSafety::holds,
               &api::FactorOfSafety::fails, &api::FactorOfSafety::mechanism,
               &api::FactorOfSafety::trials, &api::FactorOfSafety::warnings,
               &api::FactorOfSafety::wall_seconds);
  add_repr(fos, {"status", "factor", "holds", "fails"});
}

void add_limit_joint(py::module_& m) {
  py::class_<api::LimitJoint> joint(m, "LimitJoint",
                                    "The force of a joint between two blocks at their limit load.");
  joint.def_readonly("block_i", &api::LimitJoint::block_i, "Id of one block.")
      .def_readonly("block_j", &api::LimitJoint::block_j, "Id of the other block.")
      .def_readonly("joint", &api::LimitJoint::joint, "Name of its law.")
      .def_readonly("x", &api::LimitJoint::x, "m, of the point through which its resultant goes.")
      .def_readonly("y", &api::LimitJoint::y, "m, of the same point.")
      .def_readonly("fx", &api::LimitJoint::fx, "N, on block_i to the right.")
      .def_readonly("fy", &api::LimitJoint::fy, "N, on block_i upwards.")
      .def_readonly("normal_force", &api::LimitJoint::normal_force, "N, positive in compression.")
      .def_readonly("mobilised", &api::LimitJoint::mobilised, "Shear force over shear strength.");
  add_pickling(joint, &api::LimitJoint::block_i, &api::LimitJoint::block_j, &api::LimitJoint::joint,
               &api::LimitJoint::x, &api::LimitJoint::y, &api::LimitJoint::fx, &api::LimitJoint::fy,
               &api::LimitJoint::normal_force, &api::LimitJoint::mobilised);
  add_repr(joint, {"block_i", "block_j", "fx", "fy"});
}

void add_limit_load(py::module_& m) {
  py::class_<api::LimitLoad> limit(m, "LimitLoad", "What edda.limit() finds.");
  limit.def_readonly("status", &api::LimitLoad::status, "found, unlimited, unstable or unsolved.")
      .def_readonly("message", &api::LimitLoad::message, "One sentence.")
      .def_readonly("limit", &api::LimitLoad::limit,
                    "The largest value with an equilibrium (static theorem), or None.")
      .def_readonly("upper", &api::LimitLoad::upper, "The same by the kinematic theorem, or None.")
      .def_readonly("other_end", &api::LimitLoad::other_end,
                    "The smallest value with an equilibrium, or None.")
      .def_readonly("without_dilation", &api::LimitLoad::without_dilation,
                    "The limit of joints that slide without dilating, or None.")
      .def_readonly("residual", &api::LimitLoad::residual,
                    "The limit of joints with their residual strength, or None.")
      .def_readonly("mechanism", &api::LimitLoad::mechanism,
                    "What moves at the limit, a sentence; empty: none.")
      .def_readonly("joints", &api::LimitLoad::joints,
                    "A LimitJoint for each that carries a force.")
      .def_readonly("warnings", &api::LimitLoad::warnings, "A sentence each.")
      .def_readonly("wall_seconds", &api::LimitLoad::wall_seconds, "s");
  add_pickling(limit, &api::LimitLoad::status, &api::LimitLoad::message, &api::LimitLoad::limit,
               &api::LimitLoad::upper, &api::LimitLoad::other_end,
               &api::LimitLoad::without_dilation, &api::LimitLoad::residual,
               &api::LimitLoad::mechanism, &api::LimitLoad::joints, &api::LimitLoad::warnings,
               &api::LimitLoad::wall_seconds);
  add_repr(limit, {"status", "limit", "without_dilation"});
}

void add_error_bar(py::module_& m) {
  py::class_<api::ErrorBar> bar(
      m, "ErrorBar", "A monitor's displacement at the end, and how far other runs end from it, m.");
  bar.def_readonly("monitor", &api::ErrorBar::monitor, "Its name.")
      .def_readonly("ux", &api::ErrorBar::ux, "m")
      .def_readonly("uy", &api::ErrorBar::uy, "m")
      .def_readonly("step", &api::ErrorBar::step, "m, at half the step.")
      .def_readonly("stiffness", &api::ErrorBar::stiffness, "m, with springs three times as stiff.")
      .def_readonly("order", &api::ErrorBar::order, "m, with the blocks in the other order.");
  add_pickling(bar, &api::ErrorBar::monitor, &api::ErrorBar::ux, &api::ErrorBar::uy,
               &api::ErrorBar::step, &api::ErrorBar::stiffness, &api::ErrorBar::order);
  add_repr(bar, {"monitor", "ux", "uy", "step", "stiffness", "order"});
}

void add_verification(py::module_& m) {
  py::class_<api::Verification> verification(m, "Verification", "What edda.verify() finds.");
  verification
      .def_readonly("monitors", &api::Verification::monitors, "An ErrorBar for each monitor.")
      .def_readonly("time", &api::Verification::time, "s, of the model.")
      .def_readonly("largest_drift", &api::Verification::largest_drift,
                    "Of the energy, over all runs.")
      .def_readonly("failed", &api::Verification::failed,
                    "Which run did not reach its end, and why; empty: none.");
  add_pickling(verification, &api::Verification::monitors, &api::Verification::time,
               &api::Verification::largest_drift, &api::Verification::failed);
  add_repr(verification, {"time", "monitors", "failed"});
}

void add_progress(py::module_& m) {
  py::class_<api::Progress> progress(m, "Progress", "How far a run has come.");
  progress.def_readonly("fraction", &api::Progress::fraction, "Of the duration.")
      .def_readonly("time", &api::Progress::time, "s, simulated.")
      .def_readonly("steps", &api::Progress::steps, "Steps made.")
      .def_readonly("rate", &api::Progress::rate, "Steps per second of wall time.")
      .def_readonly("seconds_left", &api::Progress::seconds_left,
                    "s of wall time; -1 while unknown.")
      .def_readonly("kinetic", &api::Progress::kinetic, "J")
      .def_readonly("largest_overlap", &api::Progress::largest_overlap, "m")
      .def_readonly("largest_velocity", &api::Progress::largest_velocity,
                    "m/s, of the blocks' centroids.")
      .def_readonly("stage", &api::Progress::stage, "The current one, from 1.")
      .def_readonly("stages", &api::Progress::stages, "Of the model; 1 where it has none.")
      .def_readonly("stage_name", &api::Progress::stage_name, "Empty where it has none.");
  add_pickling(progress, &api::Progress::fraction, &api::Progress::time, &api::Progress::steps,
               &api::Progress::rate, &api::Progress::seconds_left, &api::Progress::kinetic,
               &api::Progress::largest_overlap, &api::Progress::largest_velocity,
               &api::Progress::stage, &api::Progress::stages, &api::Progress::stage_name);
  add_repr(progress, {"fraction", "time", "steps"});
}

void add_ledger(py::module_& m) {
  py::class_<api::Ledger> ledger(m, "Ledger", "Energies since t = 0, J; drift is a ratio.");
  ledger.def_readonly("kinetic", &api::Ledger::kinetic, "J")
      .def_readonly("strain", &api::Ledger::strain, "J")
      .def_readonly("contact", &api::Ledger::contact, "J")
      .def_readonly("gravity", &api::Ledger::gravity, "J")
      .def_readonly("friction", &api::Ledger::friction, "J, dissipated.")
      .def_readonly("damping", &api::Ledger::damping, "J, dissipated.")
      .def_readonly("fracture", &api::Ledger::fracture, "J, dissipated.")
      .def_readonly("external", &api::Ledger::external, "J, work done on the blocks.")
      .def_readonly("step_change", &api::Ledger::step_change,
                    "J, removed by changes of the time step.")
      .def_readonly("drift", &api::Ledger::drift,
                    "Error of the energy balance, over the largest energy.")
      .def_readonly("transfer", &api::Ledger::transfer,
                    "J, removed by numerical rules without physical meaning; negative: added.");
  add_pickling(ledger, &api::Ledger::kinetic, &api::Ledger::strain, &api::Ledger::contact,
               &api::Ledger::gravity, &api::Ledger::friction, &api::Ledger::damping,
               &api::Ledger::fracture, &api::Ledger::external, &api::Ledger::step_change,
               &api::Ledger::drift, &api::Ledger::transfer);
  add_repr(ledger, {"kinetic", "strain", "contact", "gravity", "friction", "damping", "fracture",
                    "external", "step_change", "drift", "transfer"});
}

void add_monitor_reading(py::module_& m) {
  py::class_<api::MonitorReading> reading(
      m, "MonitorReading", "A material point and its block: m, m/s, Pa (tension positive).");
  reading.def_readonly("ux", &api::MonitorReading::ux, "m")
      .def_readonly("uy", &api::MonitorReading::uy, "m")
      .def_readonly("vx", &api::MonitorReading::vx, "m/s")
      .def_readonly("vy", &api::MonitorReading::vy, "m/s")
      .def_readonly("sxx", &api::MonitorReading::sxx, "Pa")
      .def_readonly("syy", &api::MonitorReading::syy, "Pa")
      .def_readonly("sxy", &api::MonitorReading::sxy, "Pa");
  add_pickling(reading, &api::MonitorReading::ux, &api::MonitorReading::uy,
               &api::MonitorReading::vx, &api::MonitorReading::vy, &api::MonitorReading::sxx,
               &api::MonitorReading::syy, &api::MonitorReading::sxy);
  add_repr(reading, {"ux", "uy", "vx", "vy", "sxx", "syy", "sxy"});
}

}  // namespace

void add_records(py::module_& m) {
  add_outcome(m);
  add_check(m);
  add_trial(m);
  add_factor_of_safety(m);
  add_limit_joint(m);
  add_limit_load(m);
  add_error_bar(m);
  add_verification(m);
  add_progress(m);
  add_ledger(m);
  add_monitor_reading(m);
}

}  // namespace edda::python
