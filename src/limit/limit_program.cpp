#include "limit/limit_program.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

constexpr int rows_per_block = 3;

/// A column of a joint's forces: how much N_a, N_b and T it is.
struct Ray {
  std::size_t column;
  double normal[2];
  double shear;
};

/// A tangent of the limit of compression at the normal force N0: N_end >= (2 N0 N - N0^2)/(2 f L).
struct Tangent {
  std::size_t joint;
  double at;  ///< N0, N
};

std::size_t ends_of(const RigidJoint& joint) {
  return joint.is_corner() ? 1 : 2;
}

/// The program of a problem. Forces are counted in RigidBlocks::force, lengths in its size.
class Builder {
 public:
  Builder(const LimitProblem& problem, const std::vector<Tangent>& tangents)
      : p_(problem), rigid_(*problem.rigid) {
    add_equilibrium_rows();
    rays_.resize(rigid_.joints.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
      rows_.clear();
      for (; next < tangents.size() && tangents[next].joint == k; ++next) add_rows(tangents[next]);
      add_joint(k);
    }
    for (const RigidSupport& support : rigid_.supports) {
      add_force(support.block, support.place, support.direction);
      program.add_column(-no_bound, no_bound);
    }
    add_ties();
  }

  /// A multiplier of the live load; returns its column.
  std::size_t add_multiplier(double worth) {
    for (std::size_t r = 0; r < p_.live.size(); ++r) {
      const int row = rows_per_block * static_cast<int>(r);
      program.add_entry(row, p_.live[r].force.x / rigid_.force);
      program.add_entry(row + 1, p_.live[r].force.y / rigid_.force);
      program.add_entry(row + 2, p_.live[r].moment / (rigid_.force * rigid_.size));
    }
    return program.add_column(-no_bound, no_bound, worth);
  }

  /// Forces from outside on every block, either way, each of which costs 1.
  void add_help() {
    for (int row = 0; row < rows_per_block * static_cast<int>(rigid_.bodies()); ++row) {
      for (const double way : {1.0, -1.0}) {
        program.add_entry(row, way);
        program.add_column(0.0, no_bound, -1.0);
      }
    }
  }

  RigidJointForce force(std::size_t k, const std::vector<double>& value) const {
    RigidJointForce f;
    for (std::size_t end = 0; end < ends_of(rigid_.joints[k]); ++end)
      f.normal[end] = -p_.strength[k].tension;
    for (const Ray& ray : rays_[k]) {
      const double size = rigid_.force * value[ray.column];
      for (std::size_t end = 0; end < 2; ++end) f.normal[end] += ray.normal[end] * size;
      f.shear += ray.shear * size;
    }
    return f;
  }
  /// What the normal forces cost.
  double thrust(const std::vector<double>& value) const {
    double sum = 0.0;
    for (const std::vector<Ray>& rays : rays_) {
      for (const Ray& ray : rays) sum += (ray.normal[0] + ray.normal[1]) * value[ray.column];
    }
    return p_.thrust_cost * sum;
  }
  std::vector<double> ties(const std::vector<double>& value) const {
    std::vector<double> all;
    for (std::size_t q = 0; q < rigid_.ties.size(); ++q)
      all.push_back(rigid_.force * value[first_tie_ + q]);
    return all;
  }

  LinearProgram program;

 private:
  /// Equilibrium of each block: the forces of joints and loads are minus the dead ones, among which
  /// is the tension from which all joints are counted.
  void add_equilibrium_rows() {
    RigidForces dead = p_.dead;
    const auto add = [&](Id block, Vec2 place, Vec2 force) {
      const Id r = rigid_.body[block];
      if (r == no_id) return;
      dead[r].force += force;
      dead[r].moment += cross(place - rigid_.centroid[r], force);
    };
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
      const RigidJoint& joint = rigid_.joints[k];
      for (std::size_t end = 0; end < ends_of(joint); ++end) {
        const Vec2 pull = -p_.strength[k].tension * joint.n;
        add(joint.block_b, joint.ends[end], pull);
        add(joint.block_a, joint.ends[end], -pull);
      }
    }
    const double unit = rigid_.force, arm = rigid_.size;
    for (const RigidForce& f : dead) {
      for (const double value : {f.force.x / unit, f.force.y / unit, f.moment / (unit * arm)})
        program.add_row(-value, -value);
    }
  }

  /// The two rows of a tangent: N_end - (N0/fL) N >= -N0^2/(2 fL), without the constant tension.
  void add_rows(const Tangent& tangent) {
    const RigidStrength& s = p_.strength[tangent.joint];
    const double slope = tangent.at / s.compression, pull = s.tension;
    const double least = -0.5 * slope * tangent.at + pull - 2.0 * slope * pull;
    for (std::size_t end = 0; end < 2; ++end)
      rows_.push_back({program.add_row(least / rigid_.force, no_bound), slope, end});
  }
  struct TangentRow {
    int row;
    double slope;
    std::size_t end;
  };

  void add_force(Id block, Vec2 place, Vec2 force) {
    const Id r = rigid_.body[block];
    if (r == no_id) return;
    const int row = rows_per_block * static_cast<int>(r);
    program.add_entry(row, force.x);
    program.add_entry(row + 1, force.y);
    program.add_entry(row + 2, cross(place - rigid_.centroid[r], force) / rigid_.size);
  }
  void add_pair(const RigidJoint& joint, std::size_t end, Vec2 force) {
    add_force(joint.block_b, joint.ends[end], force);
    add_force(joint.block_a, joint.ends[end], -force);
  }

  void add_joint(std::size_t k) {
    const RigidJoint& joint = rigid_.joints[k];
    const RigidStrength& s = p_.strength[k];
    for (std::size_t end = 0; end < ends_of(joint); ++end) {
      add_ray(k, end, s.friction);
      if (s.friction > 0.0) add_ray(k, end, -s.friction);
    }
    // What does not depend on the normal force; the constant tension takes its part of it.
    const double ends = static_cast<double>(ends_of(joint));
    const double most = (s.shear - ends * s.friction * s.tension) / rigid_.force;
    if (!(most > 0.0)) return;
    add_pair(joint, 0, joint.t);
    rays_[k].push_back({program.add_column(-most, most), {0.0, 0.0}, 1.0});
  }

  void add_ray(std::size_t k, std::size_t end, double shear) {
    const RigidJoint& joint = rigid_.joints[k];
    add_pair(joint, end, joint.n + shear * joint.t);
    for (const TangentRow& r : rows_)
      program.add_entry(r.row, (r.end == end ? 1.0 : 0.0) - r.slope);
    rays_[k].push_back({program.add_column(0.0, no_bound, -p_.thrust_cost),
                        {end == 0 ? 1.0 : 0.0, end == 1 ? 1.0 : 0.0},
                        shear});
  }

  void add_ties() {
    const auto scaled = [&](double force) {
      return std::abs(force) < no_bound ? force / rigid_.force : force;
    };
    // Rows of the bonds before and behind each tie.
    constexpr int no_row = -1;
    std::vector<int> behind(rigid_.ties.size(), no_row), ahead(rigid_.ties.size(), no_row);
    for (const RigidGrout& g : rigid_.grout) {
      const int row = program.add_row(-scaled(g.strength), scaled(g.strength));
      if (g.after != RigidGrout::no_tie) behind[g.after] = row;
      if (g.before != RigidGrout::no_tie) ahead[g.before] = row;
    }
    first_tie_ = program.columns();
    for (std::size_t q = 0; q < rigid_.ties.size(); ++q) {
      const RigidTie& tie = rigid_.ties[q];
      add_force(tie.block_a, tie.place_a, tie.direction);
      add_force(tie.block_b, tie.place_b, -tie.direction);
      if (behind[q] != no_row) program.add_entry(behind[q], 1.0);
      if (ahead[q] != no_row) program.add_entry(ahead[q], -1.0);
      program.add_column(scaled(tie.least), scaled(tie.most));
    }
  }

  const LimitProblem& p_;
  const RigidBlocks& rigid_;
  std::vector<std::vector<Ray>> rays_;
  std::vector<TangentRow> rows_;  ///< of the joint that is added
  std::size_t first_tie_ = 0;
};

/// Largest velocity of an end of a joint or of a centroid.
double fastest(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion) {
  double most = 0.0;
  for (const RigidJoint& joint : rigid.joints) {
    for (const Vec2 end : joint.ends) {
      for (const Id block : {joint.block_a, joint.block_b})
        most = std::max(most, norm(velocity_of(rigid, motion, block, end)));
    }
  }
  for (const RigidMotion& m : motion) most = std::max(most, norm(m.velocity));
  return most;
}

std::vector<RigidMotion> motion_of(const RigidBlocks& rigid, const std::vector<double>& price,
                                   double sign) {
  std::vector<RigidMotion> motion(rigid.bodies());
  for (std::size_t r = 0; r < motion.size(); ++r) {
    const double* const y = &price[rows_per_block * r];
    motion[r] = {{sign * y[0], sign * y[1]}, sign * y[2] / rigid.size};
  }
  return motion;
}

/// As motion_of(), with the velocity 1 of the fastest point; empty where nothing moves.
std::vector<RigidMotion> unit_motion(const RigidBlocks& rigid, const std::vector<double>& price,
                                     double sign) {
  std::vector<RigidMotion> motion = motion_of(rigid, price, sign);
  const double most = fastest(rigid, motion);
  if (!(most > 0.0)) return {};
  for (RigidMotion& m : motion) m = {(1.0 / most) * m.velocity, m.spin / most};
  return motion;
}

double work_of(const RigidForces& forces, const std::vector<RigidMotion>& motion) {
  double work = 0.0;
  for (std::size_t r = 0; r < forces.size(); ++r)
    work += dot(forces[r].force, motion[r].velocity) + forces[r].moment * motion[r].spin;
  return work;
}

/// The kinematic theorem: prices of the rows, scaled so that the live load does the work 1, are a
/// mechanism, and no multiplier is larger than the one at which its loads do the work that its
/// joints dissipate.
void judge_mechanism(const LimitProblem& p, const LinearProgram& program, bool largest,
                     const std::vector<double>& price, LimitState& state) {
  const std::vector<RigidMotion> motion = motion_of(*p.rigid, price, 1.0);
  const double work = work_of(p.live, motion) / p.rigid->force;
  if (work == 0.0) return;
  std::vector<double> scaled = price;
  for (double& y : scaled) y *= (largest ? 1.0 : -1.0) / work;
  const DualBound bound = dual_bound(program, scaled);
  state.kinematic = largest ? bound.value : -bound.value;
  state.violation = bound.violation * std::abs(work) / fastest(*p.rigid, motion);
  state.motion = unit_motion(*p.rigid, price, (largest ? 1.0 : -1.0) * work > 0.0 ? 1.0 : -1.0);
}

/// Where the limit of compression is exceeded: a tangent there. Keeps the list sorted by joint.
bool add_tangents(const LimitProblem& p, const std::vector<RigidJointForce>& forces,
                  std::vector<Tangent>& tangents) {
  constexpr double exceeded = 1e-7;  // of f L
  const std::size_t before = tangents.size();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const double most = p.strength[k].compression, whole = forces[k].whole();
    if (most == 0.0) continue;
    const double least = std::min(forces[k].normal[0], forces[k].normal[1]);
    if (whole > 0.0 && 0.5 * whole * whole / most - least > exceeded * most)
      tangents.push_back({k, std::min(whole, most)});
  }
  std::stable_sort(tangents.begin(), tangents.end(),
                   [](const Tangent& a, const Tangent& b) { return a.joint < b.joint; });
  return tangents.size() > before;
}

std::vector<RigidJointForce> forces_of(const Builder& builder, const RigidBlocks& rigid,
                                       const std::vector<double>& value) {
  std::vector<RigidJointForce> all;
  for (std::size_t k = 0; k < rigid.joints.size(); ++k) all.push_back(builder.force(k, value));
  return all;
}

/// Solves the program that `complete` has made whole, with as many tangents as it takes; ended is
/// called with the last one.
template <class Complete, class Ended>
void solve_with_tangents(const LimitProblem& p, Complete complete, Ended ended) {
  std::vector<Tangent> tangents;
  constexpr int most_rounds = 50;
  for (int round = 0;; ++round) {
    Builder builder(p, tangents);
    complete(builder);
    const LinearAnswer answer = solve(builder.program);
    std::vector<RigidJointForce> forces;
    if (answer.end == LinearEnd::optimal) forces = forces_of(builder, *p.rigid, answer.value);
    // Without a limit no strength was reached, or there are tangents yet to come.
    if (answer.end == LinearEnd::unbounded && tangents.empty()) {
      for (std::size_t k = 0; k < p.strength.size(); ++k) {
        const double most = p.strength[k].compression;
        if (most > 0.0) tangents.push_back({k, most});
      }
      if (!tangents.empty()) continue;
    }
    if (round < most_rounds && !forces.empty() && add_tangents(p, forces, tangents)) continue;
    return ended(builder, answer, std::move(forces));
  }
}

/// Strength that a mechanism mobilises: shear of slipping joints and tension of opening ones, those
/// of `divided` joints.
double mobilised(const LimitProblem& p, const std::vector<char>& divided,
                 const std::vector<RigidJointForce>& forces,
                 const std::vector<RigidMotion>& motion) {
  double work = 0.0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const RigidJoint& joint = p.rigid->joints[k];
    if (divided[k] == 0) continue;
    const auto apart = [&](std::size_t end) {
      return velocity_of(*p.rigid, motion, joint.block_b, joint.ends[end]) -
             velocity_of(*p.rigid, motion, joint.block_a, joint.ends[end]);
    };
    work += std::abs(forces[k].shear * dot(apart(0), joint.t));
    for (std::size_t end = 0; end < ends_of(joint); ++end)
      work += p.strength[k].tension * positive_part(dot(apart(end), joint.n));
  }
  return work;
}

}  // namespace

Vec2 velocity_of(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion, Id block,
                 Vec2 place) {
  const Id r = rigid.body[block];
  return r == no_id ? Vec2{} : velocity_at(motion[r], rigid.centroid[r], place);
}

LimitState limit_state(const LimitProblem& p, bool largest) {
  LimitState state;
  std::size_t multiplier = 0;
  const auto complete = [&](Builder& builder) {
    multiplier = builder.add_multiplier(largest ? 1.0 : -1.0);
  };
  solve_with_tangents(
      p, complete,
      [&](const Builder& builder, const LinearAnswer& answer, std::vector<RigidJointForce> forces) {
        switch (answer.end) {
          case LinearEnd::optimal:
            state.end = LimitEnd::found;
            state.multiplier = answer.value[multiplier];
            state.forces = std::move(forces);
            state.ties = builder.ties(answer.value);
            judge_mechanism(p, builder.program, largest, answer.price, state);
            return;
          case LinearEnd::infeasible: {
            const std::vector<RigidMotion> motion = motion_of(*p.rigid, answer.price, 1.0);
            state.end = LimitEnd::no_equilibrium;
            state.motion =
                unit_motion(*p.rigid, answer.price, work_of(p.dead, motion) > 0.0 ? 1.0 : -1.0);
            return;
          }
          case LinearEnd::unbounded:
            state.end = LimitEnd::no_limit;
            return;
          case LinearEnd::failed:
            state.end = LimitEnd::not_solved;
            return;
        }
      });
  return state;
}

Shortfall shortfall(const LimitProblem& p, const std::vector<char>& divided) {
  Shortfall s;
  const auto complete = [](Builder& builder) { builder.add_help(); };
  solve_with_tangents(
      p, complete,
      [&](const Builder& builder, const LinearAnswer& answer, std::vector<RigidJointForce> forces) {
        s.solved = answer.end == LinearEnd::optimal;
        if (!s.solved) return;
        s.force = -answer.objective - builder.thrust(answer.value);
        s.state.end = LimitEnd::found;
        s.state.ties = builder.ties(answer.value);
        std::vector<RigidMotion> motion = motion_of(*p.rigid, answer.price, 1.0);
        const double sign = work_of(p.dead, motion) > 0.0 ? 1.0 : -1.0;
        s.strength = mobilised(p, divided, forces, motion) / p.rigid->force;
        s.state.motion = unit_motion(*p.rigid, answer.price, sign);
        s.state.forces = std::move(forces);
      });
  return s;
}

}  // namespace edda
