// Whether a model that was in equilibrium holds or fails under a change of its loading: in the
// trials of a factor (docs/fos.md) and in the increments of a ramp (docs/stages.md).
#pragma once

#include <optional>
#include <string>

#include "judge/judge.hpp"

namespace edda {

/// When a model fails.
struct Criterion {
  double allowed = left_its_place;     ///< part of its size by which a set of blocks may move
  std::optional<double> displacement;  ///< m, by which a corner may move as seen from the ground
  std::optional<double> velocity;      ///< m/s: where the steps are exhausted, what is faster fails
                                       ///< and what is slower holds
  double least_area = 0.0;             ///< m2: smaller sets do not count
};

/// Largest number of steps in which a model may reach equilibrium, and of a search.
constexpr double most_steps = 300000.0;

enum class Verdict {
  not_yet,
  holds,
  fails,
  undecided,  ///< neither at rest nor gone where the steps are exhausted
};

/// Follows a model from the state in equilibrium in which this is created. Displacements count from
/// there.
class Holding {
 public:
  Holding() = default;
  /// Blocks that are loose already (Relaxation::loose) do not count.
  Holding(Simulation& sim, const Criterion& criterion)
      : criterion_(criterion), judge_(sim, sim.relaxation.loose) {}

  /// Call when the change begins to be applied (begin_gradually()).
  void begin(const Simulation& sim) { judge_.begin(sim); }
  /// Call after every step. While the model does not seek equilibrium (ground motion), only a
  /// displacement that is too large is a verdict.
  Verdict look(Simulation& sim);
  /// The verdict where the steps are exhausted.
  Verdict at_end(Simulation& sim);

  const std::string& reason() const { return reason_; }  ///< of the verdict, a few words
  /// A block of the set that fails; no_id: the model holds, or there is no verdict.
  Id block() const { return block_; }
  /// All blocks that have failed, ascending.
  const std::vector<Id>& failed() const { return failed_; }
  /// Largest part of its size by which a set that counts has moved so far.
  double part() const { return part_; }
  const Criterion& criterion() const { return criterion_; }
  const Judge& judge() const { return judge_; }
  /// Names every field that a checkpoint contains, after the prefix `of`.
  template <class Archive>
  void list(Archive& a, const std::string& of);

 private:
  Verdict end(Verdict verdict, std::string reason, Id block = no_id);

  Criterion criterion_;
  Judge judge_;
  double part_ = 0.0;
  Id block_ = no_id;
  std::vector<Id> failed_;
  std::string reason_;
};

template <class Archive>
void Holding::list(Archive& a, const std::string& of) {
  a(of + "holding.allowed", criterion_.allowed);
  a(of + "holding.least_area", criterion_.least_area);
  a(of + "holding.part", part_);
  judge_.list(a, of);
}

}  // namespace edda
