// What a Simulation of Python holds: one of the library, and the callables given to it.
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

/// A callable, or None once Python has let it go. May be copied and dropped without the GIL.
using Callback = std::shared_ptr<py::object>;

/// The class Simulation. While one goes on the GIL is free: callbacks take it, and so does a look
/// at the signals ten times a second, so that Ctrl-C ends a run in good order.
class Runner {
 public:
  /// TypeError where a callable is none.
  Runner(const py::object& model, const py::object& results, bool resume,
         std::optional<std::size_t> from_stage, const py::object& progress, double progress_every,
         const py::object& warn);
  // Pointers compare without throwing. NOLINTNEXTLINE(bugprone-exception-escape)
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// The simulation, for the thread that may have it.
  api::Simulation& get();

  /// Goes on without the GIL. An exception ends a run that writes results as Ctrl-C in the program
  /// would, so that nothing is lost; without results it is paused.
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

  // For Python's collector of cycles.
  int traverse(visitproc visit, void* arg) const;
  void let_go();

  /// Ends all runs that write results and are under way, as the end of each object would: for the
  /// end of Python, which destroys no object that a cycle or another one of C holds.
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

/// What of Simulation goes on and is let go: constructor, run(), step(), every() and so on.
py::class_<Runner> add_runner(py::module_& module);

}  // namespace edda::python
