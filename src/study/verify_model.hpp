// Error estimate of a run by repeating it: with half the step, with contact springs three times as
// stiff, and with its blocks numbered in reverse.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "run/run_model.hpp"

namespace edda {

/// A monitor's displacement at the end, and its difference in the other runs, m.
struct MonitorBar {
  std::string name;
  Vec2 displacement;
  double step = 0.0, stiffness = 0.0, order = 0.0;
};

struct Verification {
  std::vector<MonitorBar> monitors;
  double time = 0.0;                  ///< s, simulated time
  double largest_energy_error = 0.0;  ///< largest energy balance error of all runs
  bool own_stiffness = false;         ///< every joint has its own kn, which was not changed
  std::string failed;                 ///< which run did not reach its end, and why; empty: none
};

struct VerifyOptions {
  int threads = 1;  ///< runs that are made side by side, as far as memory has room for them; the
                    ///< result does not depend on it
  /// Called in the order in which one thread makes the runs, also where they are made side by side:
  /// a run that has begun early is reported once those before it have ended. `progress` may be
  /// called in another thread, but never beside itself or `starts`. Both may be empty.
  std::function<void(const std::string& run)> starts{};
  std::function<void(const Progress&)> progress{};  ///< of the run that `starts` has named last
  const std::atomic<bool>* stop = nullptr;          ///< set from any thread: all runs end
};

/// Runs the model four times, side by side, without results folders. Penalty stiffnesses are
/// tripled (contact.normal_stiffness, shear_stiffness and boundaries); kn and ks of joints are
/// properties of the rock and stay. Faults: those of prepare_run(), and a model without monitors.
Result<Verification> verify_model(const Model& model, const VerifyOptions& options);

/// What it has found, as JSON.
std::string verification_summary(const Model& model, const Verification& verification);

}  // namespace edda
