// Rigid limit analysis as a linear program over the forces of the joints (Livesley 1978; static
// theorem). Its dual is the kinematic one: the prices of the equilibrium of a block are its
// velocities in the mechanism.
//
// A joint has the normal forces N_a, N_b of its two ends and one shear force T, with
//
//   N_a, N_b >= -p,     |T| <= s + tan(phi) (N_a + N_b),     p = t L/2, s = c L.
//
// These forces are the sum of a constant one (-p), a bounded T and rays: each end presses with the
// friction angle to either side. So a program has three rows for each block, its equilibrium, and a
// variable for each ray. Compressive strength f (per m of joint) limits the eccentricity,
// N_a, N_b >= N^2/(2 f L): a convex set, to which tangents are added where it is exceeded until it
// is not (docs/limit.md).
#pragma once

#include "limit/linear_program.hpp"
#include "limit/rigid_blocks.hpp"

namespace edda {

/// Strength of a joint in a program.
struct RigidStrength {
  double friction = 0.0;     ///< tan(phi)
  double shear = 0.0;        ///< s, N
  double tension = 0.0;      ///< p of each end, N; at most s/(2 tan(phi))
  double compression = 0.0;  ///< f L, N; 0: not limited
};

/// Forces of a joint on its block b.
struct RigidJointForce {
  double normal[2] = {0.0, 0.0};  ///< N, of its ends
  double shear = 0.0;             ///< N
  double whole() const { return normal[0] + normal[1]; }
};

/// Velocity of a body's centroid and its spin, counter-clockwise.
struct RigidMotion {
  Vec2 velocity;
  double spin = 0.0;
};
inline Vec2 velocity_at(const RigidMotion& m, Vec2 centroid, Vec2 place) {
  return m.velocity + m.spin * perp(place - centroid);
}

/// Velocity of a point of a block, [nb] number; 0 where that is fixed.
Vec2 velocity_of(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion, Id block,
                 Vec2 place);

struct LimitProblem {
  const RigidBlocks* rigid = nullptr;
  std::vector<RigidStrength> strength;  ///< [joints]
  RigidForces dead, live;               ///< [bodies]
  /// What a normal force of the mean weight costs beside a multiplier, or a shortfall, of 1: where
  /// it is small, the state with the least sum of them is found of those with the same multiplier
  /// or shortfall.
  double thrust_cost = 0.0;
  const ProgramWatch* watch = nullptr;  ///< may be null
};

enum class LimitEnd {
  found,
  no_equilibrium,  ///< under any multiple of the load
  no_limit,        ///< there is an equilibrium under any multiple, however large
  not_solved,      ///< the numbers of the program are too far apart for the solver
};

struct LimitState {
  LimitEnd end = LimitEnd::not_solved;
  double multiplier = 0.0;              ///< static theorem
  double kinematic = 0.0;               ///< kinematic theorem, from `motion`
  double violation = 0.0;               ///< by how much `motion` violates the flow rule, as
                                        ///< a part of its fastest velocity
  std::vector<RigidJointForce> forces;  ///< [joints]
  std::vector<double> ties;             ///< [ties] N, tension positive
  std::vector<RigidMotion> motion;      ///< [bodies] the mechanism, its fastest point with
                                        ///< velocity 1; also where there is no equilibrium
};

/// The largest multiplier m (or the smallest) for which dead + m live can be in equilibrium.
LimitState limit_state(const LimitProblem& problem, bool largest);

/// How far the dead loads are from an equilibrium.
///
/// It is measured by the tension that each end of each joint has to be given besides its strength,
/// in units of the weight of the lighter body beside it, and the friction of that tension: above 0
/// no forces within the strength balance the loads, and `state.motion` shows it, a mechanism that
/// joints allow (up to state.violation) and on which the loads do more work than joints dissipate;
/// below 0 `state.forces` balance them, with all ends pressed by so much. Each body is balanced to
/// about 1e-9 of its own weight, however heavy others are.
struct Shortfall {
  bool solved = false;
  double tension = 0.0;   ///< at least -1
  bool hopeless = false;  ///< no tension helps: there is no equilibrium at any strength
  double strength = 0.0;  ///< by how much less tension were needed if all strengths grew in
                          ///< proportion, by part
  /// Work of the loads less what joints dissipate, in the mechanism, over the sum of weights times
  /// velocities: the part of gravity by which it is accelerated, about. 0 where nothing moves.
  double excess = 0.0;
  LimitState state;

  static constexpr double nothing = 1e-8;  ///< tension and excess by which nothing fails
  bool holds() const { return solved && !hopeless && tension <= nothing; }
};
/// divided: [joints] 1: its strength is among those that grow.
/// It takes 0.3 ms for 10 bodies, 5 ms for 100 and 0.1 to 0.25 s for 1,000 (walls of bricks, one
/// core).
Shortfall shortfall(const LimitProblem& problem, const std::vector<char>& divided);

/// Forces that balance the dead loads, those of the least thrust where this costs something; none
/// where there are none.
std::vector<RigidJointForce> forces_in_balance(const LimitProblem& problem);

}  // namespace edda
