#include "python/runner.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace edda::python {
namespace {

void check_callable(const py::object& action, const char* what) {
  if (PyCallable_Check(action.ptr()) != 0) return;
  throw py::type_error(std::string(what) + " cannot be called");
}

Callback hold(const py::object& action) {
  // Explicit is what it is. NOLINTNEXTLINE(modernize-return-braced-init-list)
  return Callback(new py::object(action), [](py::object* held) {
    const py::gil_scoped_acquire acquire;
    delete held;
  });
}

/// Nothing where None stands for no callable.
Callback hold_optional(const py::object& action, const char* what) {
  if (action.is_none()) return {};
  check_callable(action, what);
  return hold(action);
}

/// A model, or what edda.load() makes one of.
api::Model model_of(const py::object& source) {
  if (py::isinstance<api::Model>(source)) return source.cast<api::Model>();
  return py::module_::import("edda").attr("load")(source).cast<api::Model>();
}

std::string path_or_empty(const py::object& path) {
  return path.is_none() ? "" : py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

/// All simulations, used only at the exit of Python. Requires the GIL.
std::set<Runner*>& runners() {
  static std::set<Runner*> all;
  return all;
}

/// Null while `self` is being made.
Runner* runner_of(PyObject* self) {
  auto* const instance = reinterpret_cast<py::detail::instance*>(self);
  const py::detail::value_and_holder held = instance->get_value_and_holder();
  return held.holder_constructed() ? held.value_ptr<Runner>() : nullptr;
}

/// Callables refer to objects, often to the simulation itself; Python's garbage collector must see
/// such cycles.
void take_part_in_collection(PyHeapTypeObject* heap_type) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    const Runner* const runner = runner_of(self);
    return runner == nullptr ? 0 : runner->traverse(visit, arg);
  };
  type.tp_clear = [](PyObject* self) {
    if (Runner* const runner = runner_of(self)) runner->let_go();
    return 0;
  };
}

}  // namespace

Runner::Runner(const py::object& model, const py::object& results, bool resume,
               std::optional<std::size_t> from_stage, const py::object& progress,
               double progress_every, const py::object& warn)
    : progress_(hold_optional(progress, "progress")),
      warn_(hold_optional(warn, "warn")),
      progress_every_(progress_every) {
  api::Options options;
  options.results = path_or_empty(results);
  if (!results.is_none() && options.results.empty()) {
    throw api::Error(
        {{"results", {}, 0, 0, "names no folder", "name one, or give None for no results"}});
  }
  options.resume = resume;
  options.from_stage = from_stage;
  constexpr double look_at_signals = 0.1;  // s
  options.progress_every = std::min(look_at_signals, progress_every_);
  options.progress = [this](const api::Progress& p) { return report(p); };
  if (warn_) {
    options.warn = [held = warn_](const std::string& text) {
      const py::gil_scoped_acquire acquire;
      if (*held) (*held)(text);
    };
  }
  records_ = !options.results.empty();
  const api::Model given = model_of(model);
  {
    const py::gil_scoped_release release;
    simulation_.emplace(given, std::move(options));
  }
  runners().insert(this);
}

// NOLINTNEXTLINE(bugprone-exception-escape)
Runner::~Runner() {
  runners().erase(this);
  const py::gil_scoped_release release;
  simulation_.reset();
}

api::Simulation& Runner::get() {
  if (busy_ && thread_ != std::this_thread::get_id()) {
    throw std::runtime_error("the simulation goes on in another thread: pause() it first");
  }
  return *simulation_;
}

std::size_t Runner::every(std::uint64_t steps, const py::object& action, py::handle self) {
  check_callable(action, "action");
  const Callback held = hold(action);
  // No reference to the simulation, which holds the callback: it would be a cycle by itself.
  const std::size_t number = get().every(steps, [held, self] {
    const py::gil_scoped_acquire acquire;
    if (*held) (*held)(self);
  });
  actions_.emplace(number, held);
  return number;
}

void Runner::forget(std::size_t number) {
  get().forget(number);
  actions_.erase(number);
}

int Runner::traverse(visitproc visit, void* arg) const {
  for (const Callback& held : {progress_, warn_}) {
    if (held) Py_VISIT(held->ptr());
  }
  for (const auto& [number, held] : actions_) Py_VISIT(held->ptr());
  return 0;
}

void Runner::let_go() {
  std::vector<py::object> dropped;  // destroyed only when none of them is referenced here any more
  const auto drop = [&](const Callback& held) {
    if (held) dropped.push_back(std::move(*held));
  };
  drop(progress_);
  drop(warn_);
  for (const auto& [number, held] : actions_) drop(held);
  actions_.clear();
}

bool Runner::report(const api::Progress& p) {
  if (ending_) return true;
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress_ || !*progress_) return true;
  const auto now = std::chrono::steady_clock::now();
  const bool last = simulation_ && simulation_->over();
  const bool due = std::chrono::duration<double>(now - reported_).count() >= progress_every_;
  if (!due && !last) return true;
  reported_ = now;
  const py::object answer = (*progress_)(p);
  if (answer.is_none()) return true;
  const int truth = PyObject_IsTrue(answer.ptr());
  if (truth < 0) throw py::error_already_set();
  return truth != 0;
}

void Runner::end() noexcept {
  // Before its first step it has written nothing.
  if (!records_ || simulation_->over() || simulation_->time_step() == 0.0) return;
  ending_ = true;
  try {
    simulation_->finish();
  } catch (...) {  // another exception is in progress, or no caller is left to receive it
  }
  ending_ = false;
}

void Runner::end_all() {
  // One reference to each: while a run ends without the GIL, other threads may release theirs.
  std::vector<py::object> held;
  for (Runner* const runner : runners()) {
    held.push_back(py::cast(runner, py::return_value_policy::reference));
  }
  for (const py::object& self : held) {
    Runner& runner = self.cast<Runner&>();
    if (runner.busy_) continue;  // running in a thread that Python does not wait for
    runner.thread_ = std::this_thread::get_id();
    runner.busy_ = true;
    const py::gil_scoped_release release;
    runner.end();
    runner.busy_ = false;
  }
}

py::class_<Runner> add_runner(py::module_& m) {
  py::class_<Runner> type(m, "Simulation", py::custom_type_setup(&take_part_in_collection),
                          "A model in motion. run(), step() and advance_to() are one run, in parts "
                          "or at once.");
  type.def(py::init<const py::object&, const py::object&, bool, std::optional<std::size_t>,
                    const py::object&, double, const py::object&>(),
           py::arg("model"), py::arg("results") = py::none(), py::arg("resume") = false,
           py::arg("from_stage") = py::none(), py::arg("progress") = py::none(),
           py::arg("progress_every") = 0.2, py::arg("warn") = py::none(),
           R"(Cuts, builds and checks; nothing is written before the first step.

model: a Model, or what edda.load() takes.
results: folder for results, as of `edda run -o`; None: none are written.
resume: continue from the checkpoint in that folder.
from_stage: continue from the checkpoint of the end of this stage (from 1).
progress: called with a Progress about every progress_every s, and at the end, when the
    run is over and can no longer be changed; False stops the run.
progress_every: s of wall time.
warn: called with a text for what does not end the run, such as a damaged checkpoint.

Raises ModelError for what cannot be computed, and for a folder that cannot be used.)")
      .def(
          "run", [](Runner& self) { return self.go([](auto& s) { return s.run(); }); },
          "To the end, through all stages, or to a pause().")
      .def(
          "step",
          [](Runner& self, std::uint64_t steps) {
            return self.go([&](auto& s) { return s.step(steps); });
          },
          py::arg("steps") = 1, "So many steps, fewer at the end; False: the run is over.")
      .def(
          "advance_to",
          [](Runner& self, double time) {
            // This must not end a run.
            if (std::isnan(time)) throw py::value_error("the time is no number");
            return self.go([&](auto& s) { return s.advance_to(time); });
          },
          py::arg("time"), "To the first step at or past a time (s); False: the run is over.")
      .def(
          "finish", [](Runner& self) { return self.go([](auto& s) { return s.finish(); }); },
          "Ends the run where it stands and writes what is due.")
      .def("pause", &Runner::pause, "From any thread: the current call returns.")
      .def("stop", &Runner::stop, "From any thread: the run ends as interrupted.")
      .def(
          "every",
          [](const py::object& self, std::uint64_t steps, const py::object& action) {
            return self.cast<Runner&>().every(steps, action, self);
          },
          py::arg("steps"), py::arg("action"),
          "Calls action(simulation) after every so many steps; returns a number for forget().")
      .def("forget", &Runner::forget, py::arg("callback"),
           "Drops what every() has returned this number for.");
  py::module_::import("atexit").attr("register")(py::cpp_function(&Runner::end_all));
  return type;
}

}  // namespace edda::python
