// Faults, models and their blocks.
#include <atomic>
#include <chrono>
#include <future>

#include "python/bindings.hpp"

namespace edda::python {
namespace {

/// edda.ModelError with the same list of faults.
// As pybind11 calls it. NOLINTNEXTLINE(performance-unnecessary-value-param)
void raise_model_error(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const api::Error& error) {
    const py::module_ errors = py::module_::import("edda._errors");
    py::list faults;
    for (const api::Fault& f : error.faults()) {
      faults.append(errors.attr("Fault")(f.key, f.problem, f.remedy, f.file, f.line, f.column));
    }
    const py::object type = errors.attr("ModelError");
    PyErr_SetObject(type.ptr(), type(faults).ptr());
  }
}

using Overrides = std::vector<std::string>;

api::Model read(const py::object& path, const Overrides& overrides) {
  const auto name = py::module_::import("os").attr("fspath")(path).cast<std::string>();
  const py::gil_scoped_release release;
  return api::Model::read(name, overrides);
}

api::Model parse(const std::string& toml, const std::string& name, const Overrides& overrides) {
  const py::gil_scoped_release release;
  return api::Model::parse(toml, name, overrides);
}

api::Cut cut(const api::Model& model) {
  const py::gil_scoped_release release;
  return api::cut(model);
}

/// Runs a function without the GIL in a thread of its own, so that Ctrl-C ends it.
template <class Work>
auto interruptible(Work work) {
  std::atomic<bool> stop{false};
  auto result = [&] {
    const py::gil_scoped_release release;
    return std::async(std::launch::async, [&] { return work(&stop); });
  }();
  constexpr auto look_at_signals = std::chrono::milliseconds(50);
  bool interrupted = false;
  while (true) {
    {
      const py::gil_scoped_release release;
      if (result.wait_for(look_at_signals) == std::future_status::ready) break;
    }
    if (!interrupted && PyErr_CheckSignals() != 0) {
      interrupted = true;
      stop = true;
    }
  }
  if (interrupted) throw py::error_already_set();
  return result.get();
}

api::FactorOfSafety fos(const api::Model& model) {
  return interruptible([&](const std::atomic<bool>* stop) { return api::fos(model, stop); });
}

api::LimitLoad limit(const api::Model& model) {
  const py::gil_scoped_release release;
  return api::limit(model);
}

api::Verification verify(const api::Model& model) {
  return interruptible([&](const std::atomic<bool>* stop) { return api::verify(model, stop); });
}

api::ModelCheck check(const api::Model& model) {
  const py::gil_scoped_release release;
  return api::check(model);
}

std::vector<std::string> warnings(const api::Model& model) {
  const py::gil_scoped_release release;
  return model.warnings();
}

py::list rings_of(const api::CutBlock& block) {
  py::list rings;
  for (const auto& ring : block.rings) rings.append(array_of(ring));
  return rings;
}

py::tuple state_of(const api::CutBlock& block) {
  return py::make_tuple(block.name, block.material, block.fixed, block.area, rings_of(block),
                        block.joints);
}

api::CutBlock block_of(const py::tuple& state) {
  api::CutBlock block;
  block.name = state[0].cast<std::string>();
  block.material = state[1].cast<int>();
  block.fixed = state[2].cast<bool>();
  block.area = state[3].cast<double>();
  for (const py::handle& ring : state[4]) {
    const auto array = ring.cast<py::array_t<double>>();
    const auto points = array.unchecked<2>();
    auto& made = block.rings.emplace_back();
    for (py::ssize_t i = 0; i < points.shape(0); ++i) made.push_back({points(i, 0), points(i, 1)});
  }
  block.joints = state[5].cast<std::vector<std::vector<int>>>();
  return block;
}

void add_model(py::module_& m) {
  py::class_<api::Model>(m, "Model", "A checked model; never changes.")
      .def_static("read", &read, py::arg("path"), py::arg("overrides") = Overrides{},
                  "Reads a TOML file; overrides as of --set, \"solver.duration=0.2\".")
      .def_static(
          "parse", &parse, py::arg("toml"), py::arg("name") = "model",
          py::arg("overrides") = Overrides{},
          "The same of a text; faults call it `name`, and paths in it count from that file.")
      .def_property_readonly("title", &api::Model::title, "As the model says.")
      .def_property_readonly("file", &api::Model::file, "Path or name that it was read from.")
      .def_property_readonly("duration", &api::Model::duration, "s; 0: none is given")
      .def_property_readonly("materials", &api::Model::materials, "Names, in order.")
      .def_property_readonly("joints", &api::Model::joints, "Names of the laws, in order.")
      .def_property_readonly("openings", &api::Model::openings, "Names, in order.")
      .def_property_readonly("stages", &api::Model::stages, "Names, in order.")
      .def_property_readonly("warnings", &warnings,
                             "Warnings of edda check, a sentence each; the model is cut when they "
                             "are first asked for.")
      .def("to_toml", &api::Model::to_toml, "The model with every key and default filled in.")
      .def("cut", &cut, "Its blocks as polygons.")
      // It never changes.
      .def("__copy__", [](const py::object& self) { return self; })
      .def("__deepcopy__", [](const py::object& self, const py::object&) { return self; })
      .def("__reduce__",
           [](const api::Model&) -> py::object {
             throw py::type_error(
                 "a Model cannot be pickled: give another process its path, its dict or its "
                 "to_toml()");
           })
      .def("__repr__", [](const api::Model& model) { return "<edda.Model " + model.file() + ">"; });
}

void add_cut(py::module_& m) {
  py::class_<api::CutBlock>(m, "CutBlock", "One block as cut.")
      .def(py::pickle(&state_of, &block_of))
      .def_readonly("name", &api::CutBlock::name, "Of a [[block]], else empty.")
      .def_readonly("material", &api::CutBlock::material, "Row of Model.materials, -1: none.")
      .def_readonly("fixed", &api::CutBlock::fixed, "Whether it is fixed.")
      .def_readonly("area", &api::CutBlock::area, "m2")
      .def_property_readonly(
          "rings", &rings_of,
          "Arrays (n, 2), m: the outer ring counter-clockwise, then holes, clockwise.")
      .def_property_readonly(
          "joints",
          [](const api::CutBlock& block) {
            py::list rings;
            for (const auto& joints : block.joints) {
              rings.append(
                  py::array_t<int>(static_cast<py::ssize_t>(joints.size()), joints.data()));
            }
            return rings;
          },
          "Arrays (n,): row of Model.joints of the edge from each vertex to the next, -1: none.");

  py::class_<api::Cut>(m, "Cut", "The model's blocks, and what the cut did to its lines.")
      .def(py::pickle(
          [](const api::Cut& c) {
            return py::make_tuple(c.blocks, c.trimmed, c.merged, c.smallest_area, c.smallest_edge,
                                  c.smallest_angle, c.notes);
          },
          [](const py::tuple& state) {
            return api::Cut{state[0].cast<std::vector<api::CutBlock>>(),
                            state[1].cast<int>(),
                            state[2].cast<int>(),
                            state[3].cast<double>(),
                            state[4].cast<double>(),
                            state[5].cast<double>(),
                            state[6].cast<std::vector<std::string>>()};
          }))
      .def_readonly("blocks", &api::Cut::blocks, "In the order of their ids.")
      .def_readonly("trimmed", &api::Cut::trimmed, "Ends of joints inside a block.")
      .def_readonly("merged", &api::Cut::merged, "Slivers joined to a neighbour.")
      .def_readonly("smallest_area", &api::Cut::smallest_area, "m2")
      .def_readonly("smallest_edge", &api::Cut::smallest_edge, "m")
      .def_readonly("smallest_angle", &api::Cut::smallest_angle, "degrees")
      .def_readonly("notes", &api::Cut::notes,
                    "What was imported, drawn at random, left out, and which joints cut nothing.");
}

}  // namespace

py::array_t<double> array_of(const std::vector<api::Point>& points) {
  py::array_t<double> array({points.size(), std::size_t{2}});
  auto out = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    out(row, 0) = points[i].x;
    out(row, 1) = points[i].y;
  }
  return array;
}

void add_models(py::module_& m) {
  py::register_exception_translator(&raise_model_error);
  m.def(
      "version", [] { return std::string(api::version()); }, "The version, \"0.1.0\".");
  m.def("set_threads", &api::set_threads, py::arg("threads"),
        "Threads that simulations of this process use; results do not depend on it.");
  add_model(m);
  m.def("check", &check, py::arg("model"), "What edda check reports about a model.");
  m.def("fos", &fos, py::arg("model"), "The factor of safety, as [fos] of the model defines it.");
  m.def("limit", &limit, py::arg("model"),
        "The limit load of the blocks, taken as rigid, of what [fos] of the model varies.");
  m.def("verify", &verify, py::arg("model"), "The error bars of the model's monitors.");
  add_cut(m);
}

}  // namespace edda::python
