// Queries and changes of a Simulation.
#include <map>

#include "python/runner.hpp"

namespace edda::python {
namespace {

api::Simulation& of(const py::object& self) {
  return self.cast<Runner&>().get();
}

template <class Nodes>
py::tuple node_views(const Nodes& nodes, const py::object& owner) {
  py::tuple views(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) views[k] = view_of(nodes[k], owner);
  return views;
}

api::Field field_called(const std::string& name) {
  static const std::map<std::string, api::Field> fields{
      {"centroid", api::Field::centroid},    {"displacement", api::Field::displacement},
      {"rotation", api::Field::rotation},    {"velocity", api::Field::velocity},
      {"omega", api::Field::omega},          {"stress", api::Field::stress},
      {"overstress", api::Field::overstress}};
  const auto found = fields.find(name);
  if (found != fields.end()) return found->second;
  std::string known;
  for (const auto& [other, value] : fields) known += (known.empty() ? "" : ", ") + other;
  throw py::value_error("\"" + name + "\" is no field: give one of " + known);
}

using Numbers = py::array_t<double, py::array::c_style>;

Numbers field(Runner& self, const std::string& name, const py::object& out) {
  const api::Simulation& simulation = self.get();
  const api::Field field = field_called(name);
  const std::size_t width = api::components_of(field), nb = simulation.block_count();
  std::vector<std::size_t> shape{nb};
  if (width > 1) shape.push_back(width);
  if (!out.is_none() && !Numbers::check_(out)) {
    throw py::type_error("out is no contiguous array of float64");
  }
  const py::object needed = py::tuple(py::cast(shape));
  if (!out.is_none() && !py::object(out.attr("shape")).equal(needed)) {
    throw py::value_error("out has the shape " + std::string(py::str(out.attr("shape"))) + ", \"" +
                          name + "\" needs " + std::string(py::str(needed)));
  }
  Numbers values = out.is_none() ? Numbers(shape) : py::reinterpret_borrow<Numbers>(out);
  double* const data = values.mutable_data();
  simulation.field(field, {data, static_cast<std::size_t>(values.size())});
  return values;
}

/// Per block its rings, the outer one first.
py::list polygons(Runner& self) {
  const api::Simulation& simulation = self.get();
  std::vector<double> xy(2 * simulation.vertex_count());
  simulation.vertices(xy);
  const api::BlockViews blocks = simulation.blocks();
  py::list all;
  for (std::size_t i = 0; i < simulation.block_count(); ++i) {
    py::list rings;
    std::vector<api::Point> ring;
    for (std::uint32_t v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
      ring.push_back({xy[2 * v], xy[2 * v + 1]});
      if (blocks.next[v] > v) continue;
      rings.append(array_of(ring));
      ring.clear();
    }
    all.append(rings);
  }
  return all;
}

/// Raises IndexError where there is no such block, TypeError where it is not an integer.
std::size_t checked_number(const api::Simulation& simulation, const py::object& block) {
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(block.ptr()));
  if (!whole) throw py::error_already_set();
  const Py_ssize_t number = PyNumber_AsSsize_t(whole.ptr(), PyExc_IndexError);
  if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  const auto count = static_cast<Py_ssize_t>(simulation.block_count());
  if (number >= 0 && number < count) return static_cast<std::size_t>(number);
  throw py::index_error("there is no block " + std::to_string(number) +
                        ": give a number from 0 to " + std::to_string(count - 1));
}

std::size_t block_called(const api::Simulation& simulation, const std::string& name) {
  if (const auto found = simulation.block_called(name)) return *found;
  throw py::key_error("no block is called \"" + name + "\"");
}

std::size_t number_or_name(const api::Simulation& simulation, const py::object& block) {
  if (!py::isinstance<py::str>(block)) return checked_number(simulation, block);
  return block_called(simulation, block.cast<std::string>());
}

using Names = std::vector<std::string>;

void add_numbers(py::class_<Runner>& type) {
  const auto add = [&](const char* name, auto get, const char* text) {
    type.def_property_readonly(
        name, [get](Runner& self) { return get(self.get()); }, text);
  };
  add(
      "model", [](auto& s) { return s.model(); }, "The model.");
  add(
      "time", [](auto& s) { return s.time(); }, "s");
  add(
      "steps", [](auto& s) { return s.steps(); }, "Steps made.");
  add(
      "time_step", [](auto& s) { return s.time_step(); },
      "s, the current one; 0 before the first step.");
  add(
      "critical_step", [](auto& s) { return s.critical_step(); },
      "s, the largest that is stable now.");
  add(
      "governed_by", [](auto& s) { return s.governed_by(); }, "What governs the time step.");
  add(
      "warnings", [](auto& s) { return s.warnings(); }, "What to look at before running.");
  add(
      "stage", [](auto& s) { return s.stage(); }, "The current one, from 1.");
  add(
      "over", [](auto& s) { return s.over(); }, "Whether the run has ended.");
  add(
      "ledger", [](auto& s) { return s.ledger(); }, "Energies now, J.");
  add(
      "unbalanced", [](auto& s) { return s.unbalanced(); },
      "Mean resultant over mean contact force.");
  add(
      "block_count", [](auto& s) { return s.block_count(); },
      "nb, with those that have been excavated.");
  add(
      "vertex_count", [](auto& s) { return s.vertex_count(); }, "nv, of all blocks.");
  add(
      "monitors", [](auto& s) { return s.monitors(); }, "Names, those of the model first.");
  add(
      "origin", [](auto& s) { return py::make_tuple(s.origin().x, s.origin().y); },
      "(x, y), m: node positions count from here.");
}

void add_views(py::class_<Runner>& type) {
  const auto add = [&](const char* name, auto get, const char* text) {
    type.def_property_readonly(
        name, [get](const py::object& self) { return view_of(get(of(self)), self); }, text);
  };
  add(
      "area", [](auto& s) { return s.blocks().area; },
      "(nb,) m2 at the start; a view, not to be written to.");
  add(
      "mass", [](auto& s) { return s.blocks().mass; }, "(nb,) kg; a view, not to be written to.");
  add(
      "material", [](auto& s) { return s.blocks().material; },
      "(nb,) row of Model.materials, -1: none; a view, not to be written to.");
  add(
      "fixed", [](auto& s) { return s.blocks().fixed; },
      "(nb,) 1: fixed; a view, not to be written to.");
  add(
      "alive", [](auto& s) { return s.alive(); },
      "(nb,) 0: excavated; a view, not to be written to.");
  constexpr const char* velocities =
      "Three views (nb,) to read and write, m/s, half a step before the positions.\n\n"
      "What is written for blocks that are not free is put back by the next call; what is no "
      "finite "
      "number, or written once the run is over, is its ModelError.";
  const auto add_nodes = [&](const char* name, auto get, const char* text) {
    type.def_property_readonly(
        name, [get](const py::object& self) { return node_views(get(of(self)), self); }, text);
  };
  add_nodes(
      "node_x", [](auto& s) { return s.node_x(); },
      "Three views (nb,), m from origin, not to be written to.");
  add_nodes(
      "node_y", [](auto& s) { return s.node_y(); },
      "Three views (nb,), m from origin, not to be written to.");
  add_nodes(
      "node_vx", [](auto& s) { return s.node_vx(); }, velocities);
  add_nodes(
      "node_vy", [](auto& s) { return s.node_vy(); }, velocities);
}

void add_looking(py::class_<Runner>& type) {
  type.def("field", &field, py::arg("name"), py::arg("out") = py::none(),
           R"(Of all blocks, into `out` where one is given.

centroid, displacement (m), velocity (m/s): (nb, 2), x y; stress (Pa, tension positive):
(nb, 4), xx yy zz xy; rotation (rad), omega (rad/s), overstress (part of the strength used):
(nb,). Of excavated blocks as they were then.)")
      .def("polygons", &polygons, "Per block its rings, arrays (n, 2), m, as they are now.")
      .def(
          "contacts",
          [](Runner& self) {
            const std::vector<api::Contact> found = self.get().contacts();
            return py::array_t<api::Contact>(static_cast<py::ssize_t>(found.size()), found.data());
          },
          R"(A structured array (n,) of contacts that are closed or were before, as joints.csv.

A row is a face, an edge of block_i against one of block_j; joint (row of Model.joints,
-1: glued), state (0 open, 1 stick, 2 slide, 3 bonded); x, y (m), middle of the overlap;
normal_force (N, compression positive), shear_force (N, positive where it drives block i
from end a to end b); opening (m, negative: closed), slip (m, from a to b);
mobilised (shear over shear strength); ever_slipped, ever_opened (0 or 1); length of the
overlap, closed_length of its closed part, its ends x_a, y_a, x_b, y_b (m); normal_stress (Pa,
compression positive), the mean over the overlap, normal_stress_a and normal_stress_b at its
ends, shear_stress (Pa). Forces are those of the model's thickness.)")
      .def(
          "name",
          [](Runner& self, const py::object& block) {
            return self.get().name(checked_number(self.get(), block));
          },
          py::arg("block"),
          "Of a block by its number, empty where it has none; IndexError: no such block.")
      .def(
          "block_called",
          [](Runner& self, const std::string& name) { return block_called(self.get(), name); },
          py::arg("name"), "The number of a block; KeyError: no such name.")
      .def(
          "add_monitor",
          [](Runner& self, const std::string& name, std::pair<double, double> point) {
            self.get().add_monitor(name, {point.first, point.second});
          },
          py::arg("name"), py::arg("point"),
          "Follows the material point at (x, y) of the start, m.")
      .def(
          "read", [](Runner& self, const std::string& m) { return self.get().read(m); },
          py::arg("monitor"), "The present values of a monitor.");
}

void add_changing(py::class_<Runner>& type) {
  type.def(
          "set_velocity",
          [](Runner& self, const py::object& block, std::pair<double, double> v, double omega) {
            api::Simulation& s = self.get();
            s.set_velocity(number_or_name(s, block), {v.first, v.second}, omega);
          },
          py::arg("block"), py::arg("velocity"), py::arg("omega") = 0.0,
          "Of a free block by number or name: (vx, vy) of its centroid, m/s, and rate of rotation, "
          "rad/s.")
      .def(
          "set_damping",
          [](Runner& self, double mass, double local, double contact) {
            self.get().set_damping(mass, local, contact);
          },
          py::arg("mass") = 0.0, py::arg("local") = 0.0, py::arg("contact") = 0.0,
          R"(From now on.

mass: mass-proportional, 1/s. local: part of the unbalanced force, 0 to 1. contact: part of
critical, 0 to 10. Adaptive damping and Rayleigh's stay as they are.)")
      .def(
          "set_strength_factor",
          [](Runner& self, double factor, const std::optional<std::string>& joint) {
            if (joint) return self.get().set_strength_factor(*joint, factor);
            self.get().set_strength_factor(factor);
          },
          py::arg("factor"), py::arg("joint") = py::none(),
          "Strength of all joints, or of one, as the model gives it, divided by the factor.")
      .def(
          "excavate", [](Runner& self, const Names& names) { self.get().excavate(names); },
          py::arg("openings"), "Excavates openings that a stage of the model names.")
      .def(
          "relax",
          [](Runner& self, const std::string& name, double part) { self.get().relax(name, part); },
          py::arg("opening"), py::arg("part"),
          "Releases a part (0 to 1, all calls and stages together) of the wall forces of excavated "
          "rock.")
      .def(
          "switch_over",
          [](Runner& self, const Names& off, const Names& on) { self.get().switch_over(off, on); },
          py::arg("deactivate") = Names{}, py::arg("activate") = Names{},
          "Loads, water, boundaries and ground motions by name, as in a stage.")
      .def(
          "install", [](Runner& self, const Names& names) { self.get().install(names); },
          py::arg("bolts"), "Installs bolts and patterns by name.")
      .def(
          "reset_displacements", [](Runner& self) { self.get().reset_displacements(); },
          "Displacements count from here.");
}

std::string repr(const Runner& self) {
  if (self.is_busy()) return "<edda.Simulation, going on>";
  const api::Simulation& s = self.at_rest();
  const std::string time = py::str(py::float_(s.time()));
  return "<edda.Simulation of " + std::to_string(s.block_count()) + " blocks at " + time +
         " s, step " + std::to_string(s.steps()) + ">";
}

}  // namespace

void add_simulation(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(api::Contact, block_i, block_j, joint, state, x, y, normal_force,
                       shear_force, opening, slip, mobilised, ever_slipped, ever_opened, length,
                       closed_length, x_a, y_a, x_b, y_b, normal_stress, normal_stress_a,
                       normal_stress_b, shear_stress);
  py::class_<Runner> type = add_runner(m);
  type.def("__repr__", &repr);
  add_numbers(type);
  add_views(type);
  add_looking(type);
  add_changing(type);
}

}  // namespace edda::python
