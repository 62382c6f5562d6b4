// The implementation classes of edda.hpp.
#pragma once

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cutting/polygon_set.hpp"
#include "library/edda.hpp"
#include "model/model.hpp"
#include "run/driver.hpp"
#include "run/run_model.hpp"

namespace edda::api {

struct Model::Impl {
  explicit Impl(edda::Model given) : model(std::move(given)) {}
  edda::Model model;
  // Computed when they are first needed.
  mutable std::mutex asking;
  mutable std::optional<std::vector<std::string>> warnings;
};

[[noreturn]] void raise(const Faults& faults);
/// One fault of a call: `key` names the function or its argument.
[[noreturn]] void raise(std::string key, std::string problem, std::string remedy);

/// Raises an Error where the blocks do not fit into memory.
void check_memory(const edda::Model& model);

/// Sets the number of threads of the calling thread's loops to that of set_threads().
void use_threads();

/// The value, or an Error.
template <class T>
T value_or_raise(Result<T> result) {
  if (!result.ok()) raise(result.faults());
  return std::move(result.value());
}

struct Simulation::Impl {
  Impl(const Model& given, Options&& wanted);
  ~Impl();

  edda::Simulation& sim() { return prepared.sim; }
  const edda::Simulation& sim() const { return prepared.sim; }

  /// Writes the first row, if the run has not begun.
  void enter();
  /// Steps until step `to_step` or the time `to_time` (s), the end or a pause.
  void go(std::uint64_t to_step, double to_time);
  void finish();
  /// Sets velocities; before the first step those with which the run begins.
  void change_velocities(const BodyVectors& velocity);
  /// Ends the caller's access: velocities that it wrote are adopted. Raises an Error where they are
  /// not finite, and restores those from before.
  void take_back();
  /// Prepares the simulation for a change, or refuses it in the name of `function`.
  void begin_change(const char* function);
  void end_change();
  /// The state at step n, for queries that change nothing.
  const Instant& look();

  Model model;
  Options options;
  PreparedRun prepared;
  RunOptions run_options;
  std::optional<Driver> driver;
  Outcome outcome;
  std::size_t last_stage = 0;  ///< of a finished run, whose driver is gone
  bool begun = false, finished = false;
  bool changed = false;  ///< by the caller: it is no longer what the model says
  std::atomic<bool> stop{false}, pause{false};

  struct Repeated {
    std::size_t number;
    std::uint64_t steps;
    std::function<void()> action;
  };
  std::vector<Repeated> callbacks;
  std::size_t next_callback = 0;

  /// Gives the caller write access to the velocities.
  void lend_velocities();

 private:
  bool after_step();
  bool run_callbacks();
  void report(const edda::Progress& progress);
  void warn(const std::string& text);
  /// Lets the caller act between two steps of a run in progress, with queries and changes. An
  /// exception that it throws is kept.
  template <class Action>
  void between_steps(Action action);
  /// An exception that `part` throws, the first of several, is kept until control returns to the
  /// caller.
  template <class Part>
  void keep_thrown(Part part);
  void throw_kept();
  /// Returns access to the caller, with the velocities where its views refer to.
  void hand_over();
  void refuse_within_step(const char* function) const;

  std::uint64_t pause_step_ = 0;
  double pause_time_ = 0.0;
  bool stepping_ = false;
  std::exception_ptr thrown_;
  const double* velocities_ = nullptr;  ///< where views of them point to
  bool lent_ = false;
  edda::Nodes lent_vx_, lent_vy_;  ///< the velocities when access was given
  std::optional<Instant> instant_;
};

}  // namespace edda::api
