// The linear program over the forces of joints and ties, of which limit_program.hpp has the
// formulas. Its rows are the equilibrium of each body, in units of its own weight and size, so that
// a small body is in balance as exactly as a large one, and a force counts in units of the weight
// of the lighter body that it acts on.
#pragma once

#include <cstddef>
#include <vector>

#include "limit/limit_program.hpp"

namespace edda {

/// A tangent of the limit of compression at the normal force N0: N_end >= (2 N0 N - N0^2)/(2 f L).
struct CompressionTangent {
  std::size_t joint;
  double at;  ///< N0, N
};

class ForceProgram {
 public:
  enum class Asks {
    multiplier,  ///< of the live load
    tension,     ///< that joints need in addition, and shear strength where they have no friction
    neither,
  };
  /// tangents: sorted by joint.
  ForceProgram(const LimitProblem& problem, const std::vector<CompressionTangent>& tangents,
               Asks asks);

  /// The column of what is asked for, the last one: a multiplier, or the tension of each end of a
  /// joint in units of the weight of the lighter body beside it, at least -1.
  std::size_t add_asked(double worth);

  std::vector<RigidJointForce> forces(const std::vector<double>& value) const;
  std::vector<double> ties(const std::vector<double>& value) const;
  /// What the normal forces cost.
  double thrust(const std::vector<double>& value) const;
  /// Prices of the rows as velocities of the bodies.
  std::vector<RigidMotion> motion(const std::vector<double>& price, double sign) const;

  LinearProgram program;
  std::vector<double> unit;  ///< [columns] N; 1 for a multiplier, no_bound for the tension

 private:
  /// A column of a joint's forces: how much N_a, N_b and T it is.
  struct Ray {
    std::size_t column;
    double normal[2];
    double shear;
  };
  struct TangentRow {
    int row;
    double slope;
    std::size_t end;
  };
  /// The directions in which a body's supports leave it free, orthonormal: forces and moment about
  /// its centroid, over its extent. Those that are missing are 0.
  struct Free {
    double along[3][3];
  };

  void find_free_directions();
  void add_pulls(RigidForces& sums, const RigidJoint& joint, double size) const;
  void add_equilibrium_rows();
  void add_body_force(std::size_t body, const RigidForce& force, double unit);
  void add_force(Id block, Vec2 place, Vec2 force, double unit);
  void add_pair(const RigidJoint& joint, std::size_t end, Vec2 force, double unit);
  void add_rows(const CompressionTangent& tangent);
  void add_joint(std::size_t k);
  void add_shear(std::size_t k);
  void add_ray(std::size_t k, std::size_t end, double shear);
  void add_ties();
  double unit_of(Id a, Id b) const;
  double expected(const RigidJoint& joint) const;
  std::size_t end_column(double from, double to, double worth, double in_unit);

  /// A row whose sides move apart with the tension that is asked for.
  struct Widening {
    int row;
    double by;
  };

  const LimitProblem& p_;
  const RigidBlocks& rigid_;
  const Asks asks_;
  std::vector<Widening> widening_;
  std::vector<Free> free_;
  std::vector<std::vector<Ray>> rays_;
  std::vector<TangentRow> rows_;  ///< of the joint that is added
  std::size_t first_tie_ = 0;
};

inline std::size_t ends_of(const RigidJoint& joint) {
  return joint.is_corner() ? 1 : 2;
}

}  // namespace edda
