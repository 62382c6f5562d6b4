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
  std::function<void(const std::string& run)> starts;  ///< may be empty
  std::function<void(const Progress&)> progress;       ///< may be empty
  const std::atomic<bool>* stop = nullptr;
};

/// Runs the model four times, without results folders. Penalty stiffnesses are tripled
/// (contact.normal_stiffness, shear_stiffness and boundaries); kn and ks of joints are properties
/// of the rock and stay. Faults: those of prepare_run(), and a model without monitors.
Result<Verification> verify_model(const Model& model, const VerifyOptions& options);

}  // namespace edda
