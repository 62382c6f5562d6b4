// The data of a Python Simulation: one of the library, and the callables given to it.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "python/bindings.hpp"

namespace edda::python {

/// A callable, or None once Python has released it. May be copied and destroyed without the GIL.
using Callback = std::shared_ptr<py::object>;

/// The class Simulation. During a run the GIL is free: callbacks acquire it, and so does a check
/// for signals ten times a second, so that Ctrl-C ends a run properly.
class Runner {
 public:
  /// Raises TypeError where an argument is not callable.
  Runner(const py::object& model, const py::object& results, bool resume,
         std::optional<std::size_t> from_stage, const py::object& progress, double progress_every,
         const py::object& warn);
  // Pointers compare without throwing. NOLINTNEXTLINE(bugprone-exception-escape)
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// The simulation, for the thread that may have it.
  api::Simulation& get();

  /// Runs without the GIL. An exception ends a run that writes results in the same way as Ctrl-C in
  /// the program, so that nothing is lost; a run without results is paused.
  template <class Action>
  auto go(Action action) {
    api::Simulation& simulation = get();
    const bool within = busy_;  // called by a callback: refused there
    thread_ = std::this_thread::get_id();
    busy_ = true;
    const py::gil_scoped_release release;
    try {
      auto result = action(simulation);
      busy_ = within;
      return result;
    } catch (...) {
      if (!within) end();
      busy_ = within;
      throw;
    }
  }

  /// As api::Simulation; `self` is the Simulation of Python.
  std::size_t every(std::uint64_t steps, const py::object& action, py::handle self);
  void forget(std::size_t number);

  bool is_busy() const { return busy_; }
  const api::Simulation& at_rest() const { return *simulation_; }

  void pause() { simulation_->pause(); }
  void stop() { simulation_->stop(); }

  // For Python's garbage collector.
  int traverse(visitproc visit, void* arg) const;
  void let_go();

  /// Ends all runs in progress that write results, as the destructor of each would. For the exit of
  /// Python, which does not destroy objects in reference cycles or held by objects of C.
  static void end_all();

 private:
  bool report(const api::Progress& progress);
  /// Without the GIL.
  void end() noexcept;

  std::optional<api::Simulation> simulation_;
  Callback progress_, warn_;
  std::map<std::size_t, Callback> actions_;
  double progress_every_;
  bool records_;
  bool ending_ = false;
  std::atomic<bool> busy_{false};
  std::atomic<std::thread::id> thread_{};
  std::chrono::steady_clock::time_point reported_{};
};

/// Binds the functions of Simulation that run it, and its lifetime: constructor, run(), step(),
/// every() and so on.
py::class_<Runner> add_runner(py::module_& module);

}  // namespace edda::python
