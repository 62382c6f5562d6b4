// The programs of rigid limit analysis for a model: their formulation and their answers.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "limit/joint_strength.hpp"
#include "limit/limit_factor.hpp"
#include "model/model.hpp"

namespace edda {

/// The quantity that [fos] varies, in one state of the model.
class LimitCase {
 public:
  /// watch: of its programs; may be null.
  LimitCase(const Simulation& sim, const Fos& fos, bool crushing,
            const ProgramWatch* watch = nullptr, BoltForces bolts = BoltForces::to_capacity);
  /// The same with these blocks carried: they stay where they are.
  LimitCase carrying(const std::vector<Id>& blocks) const;

  /// The value at one end and the state there.
  struct Answer {
    LimitEnd end = LimitEnd::not_solved;
    double lower = 0.0, upper = 0.0;
    LimitState state;
  };
  /// Joints dilate as they slide (associated flow rule).
  Answer at_end(bool largest, StrengthOf which) const;
  /// The largest value with a non-associated flow rule (no dilation), by successive linear
  /// programs. It is not unique: the lower of two, which begin at the forces of the associated
  /// answer and at the least thrust that carries the loads before anything is varied. Empty where
  /// neither converges.
  std::optional<double> without_dilation(const Answer& associated) const;
  /// Whether joints lose any strength at failure.
  bool is_brittle() const;

  /// [joints] in the programs that gave the answer.
  std::vector<RigidStrength> strength_of(const Answer& answer) const;
  const RigidBlocks& rigid() const { return rigid_; }

 private:
  using StrengthAt = std::function<std::vector<RigidStrength>(double factor)>;
  /// near: where a factor of strength may be. thrust_cost: as in LimitProblem.
  Answer solve(bool largest, const StrengthAt& strength_at, double near = 1.0,
               double thrust_cost = 0.0) const;
  /// The factor of strength of joints whose shear strength hardly depends on their normal force, by
  /// one program: dividing it by F is as good as multiplying the loads, and all forces, by F.
  /// strength: at the factor given, which has to be near.
  Answer as_multiplier(std::vector<RigidStrength> strength, double factor,
                       double thrust_cost) const;
  /// Forces of the joints before anything is varied, with the least thrust; empty where these loads
  /// have no equilibrium.
  std::vector<RigidJointForce> least_thrust(const Answer& associated) const;
  std::optional<double> without_dilation_from(std::vector<RigidJointForce> reference,
                                              const Answer& associated, double thrust_cost) const;
  std::vector<RigidStrength> strength_at(double factor, StrengthOf which,
                                         const std::vector<RigidJointForce>& last) const;
  /// Gravity at this value of what is varied, m/s2.
  Vec2 gravity_with(double value) const;
  /// Of what is varied, if that is a load; null otherwise, and where no load acts.
  double* factor_of_varied(LoadFactors& factors) const;
  RigidForces dead_at(double angle) const;
  RigidForces turning_at(double angle) const;
  LimitProblem problem() const;
  RigidForces live() const;
  RigidForces dead_loads() const;
  bool is_spared(std::size_t law) const;

  const Simulation& sim_;
  const Fos& fos_;
  bool crushing_;
  const ProgramWatch* watch_;
  RigidBlocks rigid_;
};

}  // namespace edda
