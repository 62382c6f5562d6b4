// The mechanisms of rigid limit analysis, one after the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/limit_case.hpp"
#include "study/mechanism.hpp"

namespace edda {

/// One end of the values of what is varied that have an equilibrium.
struct LimitValue {
  LimitEnd status = LimitEnd::not_solved;
  double lower = 0.0;  ///< static theorem: at this value there is an equilibrium
  double upper = 0.0;  ///< kinematic theorem: at this value there is none
};

/// A mechanism in the order in which they begin: the blocks of those before it are carried, so that
/// they stay where they are.
struct LimitMechanism {
  LimitValue value;
  std::vector<Id> blocks;  ///< that move, ascending
  double area = 0.0;       ///< m2, of these
  std::string text;        ///< one sentence, as Mechanism::text
  bool left_out = false;   ///< smaller than fos.least_area
};

/// How the blocks move at a limit, enlarged until the fastest moves by a hundredth of their size.
struct LimitMotion {
  Mechanism mechanism;
  Simulation moved;
};
/// None where nothing moves.
std::optional<LimitMotion> limit_motion(const Simulation& drawn, const RigidBlocks& rigid,
                                        const LimitState& state);

/// Finds them one by one.
class LimitMechanisms {
 public:
  /// least_area: m2 of those that are not left out.
  LimitMechanisms(const Simulation& drawn, LimitCase first, double least_area);

  /// The next one at the largest value, or what there is in its place; the last one has no blocks.
  /// False after that.
  bool find_next();

  const LimitCase& at() const { return *case_; }  ///< with those before it carried
  const LimitCase::Answer& answer() const { return answer_; }
  std::optional<LimitMotion> motion;  ///< of the one found last
  std::vector<LimitMechanism> found;

 private:
  const Simulation& drawn_;
  double least_area_;
  std::optional<LimitCase> case_;
  LimitCase::Answer answer_;
  bool ended_ = false;
};

}  // namespace edda
