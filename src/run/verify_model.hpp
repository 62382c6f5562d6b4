// How far a run's answer can be trusted, by running it again: at half the step, with contact
// springs three times as stiff, and with its blocks numbered the other way round.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "run/run_model.hpp"

namespace edda {

/// A monitor's displacement at the end, and how far the other runs end from it, m.
struct MonitorBar {
  std::string name;
  Vec2 displacement;
  double step = 0.0, stiffness = 0.0, order = 0.0;
};

struct Verification {
  std::vector<MonitorBar> monitors;
  double time = 0.0;           ///< s, of the model
  double largest_drift = 0.0;  ///< of the energy, over all runs
  bool own_stiffness = false;  ///< every joint names its own stiffness: that was left as it is
  std::string failed;          ///< which run did not reach its end, and why; empty: none
};

struct VerifyOptions {
  std::function<void(const std::string& run)> starts;  ///< may be empty
  std::function<void(const Progress&)> progress;       ///< may be empty
  const std::atomic<bool>* stop = nullptr;
};

/// Runs the model four times, without results folders. Penalty stiffnesses are tripled
/// (contact.normal_stiffness, shear_stiffness and boundaries); kn and ks of joints are the rock's
/// and stay. Faults: those of prepare_run(), and a model without monitors.
Result<Verification> verify_model(const Model& model, const VerifyOptions& options);

}  // namespace edda
