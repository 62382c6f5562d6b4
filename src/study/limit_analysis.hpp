// Rigid limit analysis of a model: the load, tilt or strength at which its blocks, taken as rigid,
// lose their equilibrium (docs/limit.md).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limit/limit_program.hpp"
#include "results/records.hpp"
#include "study/limit_mechanisms.hpp"

namespace edda {

/// As summary.json has it.
constexpr std::string_view limit_end_name(LimitEnd end) {
  constexpr std::string_view names[] = {"found", "unstable", "unlimited", "unsolved"};
  return names[static_cast<int>(end)];
}

struct LimitResult {
  std::string vary;     ///< as in [fos]
  std::string message;  ///< one sentence
  LimitValue largest;   ///< joints with their peak strength and an associated flow rule
  std::optional<LimitValue> smallest;      ///< at the other end; none for strength
  std::optional<double> without_dilation;  ///< largest.lower, where joints slide without dilating
  std::optional<double> residual;  ///< largest.lower of joints that have lost their bonds; none
                                   ///< where that makes no difference
  double violation = 0.0;          ///< LimitState::violation of `largest`
  /// In the order in which they begin: those that fos.least_area leaves out, the one of `largest`,
  /// and a few more.
  std::vector<LimitMechanism> mechanisms;
  std::optional<double> bolts_as_now;  ///< largest.lower with the forces that bolts have as drawn;
                                       ///< none without bolts, or where that has no limit
  std::optional<Mechanism> mechanism;  ///< at `largest`, its largest displacement a hundredth of
                                       ///< the mean size of the blocks
  std::optional<Simulation> drawn, moved;   ///< the model as drawn, and moved by the mechanism
  std::optional<LimitMotion> other_motion;  ///< at `smallest`
  bool other_governs = false;  ///< of kh, kv and tilt: `smallest` is nearer to 0 than `largest`
  bool interrupted = false;    ///< it was stopped before it was complete
  std::vector<ContactRecord> forces;  ///< of the joints that carry any, at the thrust point
  std::size_t blocks = 0, joints = 0;
  double size = 0.0;     ///< m, of the blocks: RigidBlocks::size
  double seconds = 0.0;  ///< s, wall time
  std::vector<std::string> warnings;
};

/// What is found besides `largest`.
enum class LimitExtent {
  all,
  largest_alone,  ///< no mechanism, forces or other limits: a fifth of the time
};

struct LimitOptions {
  LimitExtent extent = LimitExtent::all;
  int threads = 1;  ///< limits that are found side by side; the result does not depend on it
  const std::atomic<bool>* stop = nullptr;        ///< set from any thread: ends as interrupted
  std::function<void(const std::string&)> say{};  ///< progress, a line every second or two, from
                                                  ///< one thread at a time; may be empty
};

/// "factor of safety", "seismic coefficient kh": what [fos] varies.
std::string quantity_varied(const Fos& fos);

/// Cuts, makes the changes of all stages up to fos.stage, and solves. Faults: those of
/// prepare_run(), and of quantities that rigid limit analysis cannot vary (ground motion).
Result<LimitResult> limit_analysis(const Model& model, const LimitOptions& options = {});

/// The factor of safety at the end of the stages of the blocks as rigid ones: what
/// RunOptions::rigid_factor asks. 0: they have no equilibrium at any strength.
/// None where they have moved, at the `end` of the run, by more than a hundredth of their size from
/// where they are drawn, to which limits refer, where blocks are drawn apart or nothing moves them,
/// and for more than 600 blocks, for which it takes seconds.
std::optional<double> rigid_factor(const Model& model, const Simulation& end);

/// The warning where a model has initial stress.
extern const char* const initial_stress_left_out;

/// limit_joints.csv and summary.json.
std::string limit_joints_csv(const LimitResult& result);
std::string limit_summary(const Model& model, const LimitResult& result);

}  // namespace edda
