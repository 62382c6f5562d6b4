// Small records that a simulation returns.
#include <sstream>

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

}  // namespace

void add_records(py::module_& m) {
  py::class_<api::Outcome> outcome(m, "Outcome", "How a run ended.");
  outcome
      .def_property_readonly(
          "status", [](const api::Outcome& o) { return std::string(name_of(o.status)); },
          "completed, equilibrium, collapsed, interrupted or failed.")
      .def_readonly("message", &api::Outcome::message, "One sentence.")
      .def_readonly("time", &api::Outcome::time, "s reached")
      .def_readonly("steps", &api::Outcome::steps, "Steps made.")
      .def_readonly("contacts", &api::Outcome::contacts, "Closed at the end.")
      .def_readonly("drift", &api::Outcome::drift,
                    "Of the energy: the largest in size of all rows, not the last one's.")
      .def_readonly("wall_seconds", &api::Outcome::wall_seconds, "s");
  add_repr(outcome, {"status", "message", "time", "steps"});

  py::class_<api::Progress> progress(m, "Progress", "How far a run has come.");
  progress.def_readonly("fraction", &api::Progress::fraction, "Of the duration.")
      .def_readonly("time", &api::Progress::time, "s simulated")
      .def_readonly("steps", &api::Progress::steps, "Steps made.")
      .def_readonly("rate", &api::Progress::rate, "Steps per second of wall time.")
      .def_readonly("seconds_left", &api::Progress::seconds_left, "s of wall time; -1: unknown.")
      .def_readonly("kinetic", &api::Progress::kinetic, "J")
      .def_readonly("largest_overlap", &api::Progress::largest_overlap, "m")
      .def_readonly("largest_velocity", &api::Progress::largest_velocity,
                    "m/s, of the blocks' centroids.")
      .def_readonly("stage", &api::Progress::stage, "In hand, from 0.")
      .def_readonly("stages", &api::Progress::stages, "Of the model; 1 where it has none.")
      .def_readonly("stage_name", &api::Progress::stage_name, "Empty where it has none.");
  add_repr(progress, {"fraction", "time", "steps"});

  py::class_<api::Ledger> ledger(m, "Ledger", "Energies since t = 0, J; drift is a ratio.");
  ledger.def_readonly("kinetic", &api::Ledger::kinetic, "J")
      .def_readonly("strain", &api::Ledger::strain, "J")
      .def_readonly("contact", &api::Ledger::contact, "J")
      .def_readonly("gravity", &api::Ledger::gravity, "J")
      .def_readonly("friction", &api::Ledger::friction, "J, dissipated")
      .def_readonly("damping", &api::Ledger::damping, "J, dissipated")
      .def_readonly("fracture", &api::Ledger::fracture, "J, dissipated")
      .def_readonly("external", &api::Ledger::external, "J, work done on the blocks")
      .def_readonly("step_change", &api::Ledger::step_change, "J, taken out by changed steps")
      .def_readonly("drift", &api::Ledger::drift, "What does not add up, over the largest energy.");
  add_repr(ledger, {"kinetic", "strain", "contact", "gravity", "friction", "damping", "fracture",
                    "external", "step_change", "drift"});

  py::class_<api::MonitorReading> reading(m, "MonitorReading", "A material point and its block.");
  reading.def_readonly("ux", &api::MonitorReading::ux, "m")
      .def_readonly("uy", &api::MonitorReading::uy, "m")
      .def_readonly("vx", &api::MonitorReading::vx, "m/s")
      .def_readonly("vy", &api::MonitorReading::vy, "m/s")
      .def_readonly("sxx", &api::MonitorReading::sxx, "Pa")
      .def_readonly("syy", &api::MonitorReading::syy, "Pa")
      .def_readonly("sxy", &api::MonitorReading::sxy, "Pa");
  add_repr(reading, {"ux", "uy", "vx", "vy", "sxx", "syy", "sxy"});
}

}  // namespace edda::python
