// What stands behind the classes of edda.hpp.
#pragma once

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "library/edda.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"
#include "run/driver.hpp"
#include "run/run_model.hpp"

namespace edda::api {

struct Model::Impl {
  explicit Impl(edda::Model given) : model(std::move(given)) {}
  edda::Model model;
  // Found out when they are first asked for.
  mutable std::mutex asking;
  mutable std::optional<std::vector<std::string>> warnings;
};

[[noreturn]] void raise(const Faults& faults);
/// One fault of a call: `key` names the function or its argument.
[[noreturn]] void raise(std::string key, std::string problem, std::string remedy);

/// An Error where the blocks cannot fit into this machine's memory.
void check_memory(const edda::Model& model);

/// The calling thread shares its loops among as many threads as set_threads() has said.
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

  /// The first row, if nothing has begun yet.
  void enter();
  /// Steps until step `to_step` or the time `to_time` (s), the end or a pause.
  void go(std::uint64_t to_step, double to_time);
  void finish();
  /// Other velocities; before the first step those that the run begins with.
  void change_velocities(const edda::Nodes& vx, const edda::Nodes& vy);
  /// Takes the simulation back from the caller: what was written to the velocities is taken up. An
  /// Error where that is no number, with the velocities as handed over.
  void take_back();
  /// Makes the simulation fit for a change, or refuses it on behalf of `function`.
  void begin_change(const char* function);
  void end_change();
  /// What is known of step n and does not disturb it.
  const Instant& look();

  Model model;
  Options options;
  PreparedRun prepared;
  RunOptions run_options;
  std::optional<Driver> driver;
  Outcome outcome;
  std::size_t last_stage = 0;  ///< of a finished run, whose driver is gone
  bool begun = false, finished = false;
  std::atomic<bool> stop{false}, pause{false};

  struct Repeated {
    std::size_t number;
    std::uint64_t steps;
    std::function<void()> action;
  };
  std::vector<Repeated> callbacks;
  std::size_t next_callback = 0;

  /// Gives out the velocities for writing.
  void lend_velocities();

 private:
  bool after_step();
  bool run_callbacks();
  void report(const edda::Progress& progress);
  void warn(const std::string& text);
  /// Lets the caller act between two steps of a run that goes on: it may look and change. What it
  /// throws is kept.
  template <class Action>
  void between_steps(Action action);
  /// What `part` throws is kept, the first of several, until control is back with the caller.
  template <class Part>
  void keep_thrown(Part part);
  void throw_kept();
  /// The caller gets the simulation back: velocities where the views of them show.
  void hand_over();
  void refuse_within_step(const char* function) const;

  std::uint64_t pause_step_ = 0;
  double pause_time_ = 0.0;
  bool stepping_ = false;
  std::exception_ptr thrown_;
  const double* velocities_ = nullptr;  ///< where views of them point to
  bool lent_ = false;
  edda::Nodes lent_vx_, lent_vy_;  ///< as handed over
  std::optional<Instant> instant_;
};

}  // namespace edda::api
