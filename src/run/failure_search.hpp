// Whether a model that was in equilibrium holds or fails under a change of its loading: in the
// trials of a factor (docs/fos.md) and in the increments of a ramp (docs/stages.md).
#pragma once

#include <string>

#include "run/failure_watch.hpp"

namespace edda {

/// When a model holds and when it fails. Values that are not given follow from the mean size L of
/// the free blocks and from gravity g (docs/fos.md).
struct CollapseCriterion {
  double size = 0.0;          ///< L, m: mean of the square roots of the areas
  double acceleration = 0.0;  ///< g, m/s2: without gravity the mean load over mass, and without
                              ///< loads usual_acceleration
  double displacement = 0.0;  ///< m: failure displacement of a vertex
  double far = 1.0;  ///< times that: a vertex has failed that has moved so far, though it slows
                     ///< down to equilibrium
  double velocity = 0.0;  ///< m/s: a vertex that is faster at the end, without another verdict, has
                          ///< failed
  double duration = 0.0;  ///< s, T: time within which nothing may move further in equilibrium
  double shaking = 0.0;   ///< s, duration of ground motion before that; 0 without
};

/// Whether what is varied (target: as slow_value()) displaces a support.
bool is_displaced(const Model& model, Varied varied, Index target);

/// The criterion of the present model, from its blocks, gravity and loads, and from what is varied.
CollapseCriterion collapse_criterion(const Simulation& sim, Varied varied, Index target);

/// Largest number of steps in which a model may reach equilibrium, and of a search.
constexpr double most_steps = 300000.0;

/// Parts in which a change of what is varied is applied, each held in turn: a support is displaced
/// by no more at a time than a small part of what counts as failure; of everything else one.
int parts_of_change(const Model& model, Varied varied, Index target, double from, double to,
                    const CollapseCriterion& criterion);

enum class Verdict { not_yet, holds, fails };

/// Follows a model from the state in equilibrium in which this is created. Displacements count from
/// there.
class FailureSearch {
 public:
  FailureSearch(const Simulation& sim, const CollapseCriterion& criterion)
      : criterion_(criterion), watch_(sim) {}

  /// Call when the change begins to be applied (begin_gradually()).
  void begin(const Simulation& sim) { watch_.begin(sim); }
  /// Call after every step; looks at the model at every 32nd. While the model does not seek
  /// equilibrium (ground motion), only a displacement that is too large is a verdict.
  Verdict look(Simulation& sim);
  /// The verdict where the steps are exhausted.
  Verdict at_end(Simulation& sim);

  Verdict verdict() const { return verdict_; }
  const std::string& reason() const { return reason_; }  ///< of the verdict, a few words
  /// Whether the model fails by the trend of its motion.
  bool by_trend() const { return by_trend_; }
  /// The block that fails; no_id: the model holds, or there is no verdict.
  Id block() const { return block_; }
  /// Largest mean velocity of a vertex between the last two looks, m/s.
  double velocity() const { return velocity_; }
  const CollapseCriterion& criterion() const { return criterion_; }
  const Watch& watch() const { return watch_; }
  /// Names every field that a checkpoint contains.
  template <class Archive>
  void list(Archive& a);

 private:
  Verdict end(Verdict verdict, std::string reason, Id block = no_id);
  Id goes_beyond(const Simulation& sim, double part) const;
  Verdict fail_by_trend(const Simulation& sim, double part);

  CollapseCriterion criterion_;
  Watch watch_;
  double velocity_ = 0.0;
  int found_in_sequence_ = 0;
  Verdict verdict_ = Verdict::not_yet;
  bool by_trend_ = false;
  Id block_ = no_id;
  std::string reason_;
};

template <class Archive>
void FailureSearch::list(Archive& a) {
  a("failure.velocity", velocity_);
  a("failure.found_in_sequence", found_in_sequence_);
  a("failure.size", criterion_.size);
  a("failure.acceleration", criterion_.acceleration);
  a("failure.displacement", criterion_.displacement);
  a("failure.least_velocity", criterion_.velocity);
  a("failure.duration", criterion_.duration);
  a("failure.far", criterion_.far);
  watch_.list(a);
}

}  // namespace edda
