#include "implicit/newmark.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "forces/bending_forces.hpp"
#include "implicit/assemble.hpp"
#include "implicit/body_forces.hpp"

namespace edda {
namespace {

constexpr int most_iterations = 6;
// Tolerances of the global solve: its residual is to be a small part of that of an iteration.
constexpr double tightest = 1e-9, loosest = 1e-2, margin = 0.03;

void place_all(const BlockSet& b, const State& s, Pose& pose) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (is_free(b, s, i)) place_vertices(b, s.position, i, pose.x, pose.y);
  });
}

double largest_move(const Pose& pose) {
  double most = 0.0;
  for (std::size_t v = 0; v < pose.x.size(); ++v) {
    const double dx = pose.x[v] - pose.x1[v], dy = pose.y[v] - pose.y1[v];
    const double d2 = dx * dx + dy * dy;
    if (!(d2 <= most)) most = std::isfinite(d2) ? d2 : 1e300;
  }
  return std::sqrt(most);
}

void begin(ImplicitSolver& s, const ImplicitScene& scene, const State& state, Pose& pose,
           const TrialFaces& of) {
  const BlockSet& b = scene.blocks;
  s.start = state.position;
  pose.x1 = pose.x;
  pose.y1 = pose.y;
  begin_springs(s.springs, of, scene.faces(pose));
  // Of blocks that have none, none are summed.
  if (is_empty(s.on_faces) || s.pattern_of != of.faces.rebuilds) s.on_faces = zero_vectors(b);
  if (s.pattern_of != of.faces.rebuilds) set_pattern(s, scene, state, pose, of);
  s.pattern_of = of.faces.rebuilds;
  s.moved = Eigen::VectorXd::Zero(s.matrix.lines());
  if (is_empty(s.mean_velocity)) s.mean_velocity = state.velocity;
  s.energy.resize(b.size());
  parallel_for(b.size(), [&](std::size_t i) {
    s.energy[i] = is_free(b, state, i) ? stored_energy(b, state, {&scene.locked}, 0.0, i) : 0.0;
  });
  s.iterations = 0;
  s.switched = 0;
  s.last_displacement = 0.0;
}

/// Sets D = base + part correction, and the positions of nodes and vertices that follow.
void move(ImplicitSolver& s, const ImplicitScene& scene, double part, State& state, Pose& pose) {
  s.moved = s.base + part * s.correction;
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    const BodyColumn at = column_of(scene.blocks, s.start, i) + s.matrix.part(s.moved, row);
    store(at, scene.blocks, state.position, i);
  });
  place_all(scene.blocks, state, pose);
  s.last_displacement = largest_move(pose);
}

void go_back(ImplicitSolver& s, const BlockSet& b, State& state, Pose& pose, const TrialFaces& of) {
  state.position = s.start;
  pose.x = pose.x1;
  pose.y = pose.y1;
  go_back(s.springs, of, b);
}

/// One global solve: K^ correction = residual (Eq. 10).
bool solve(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
           double error, const State& state, const Pose& pose, const TrialFaces& of) {
  if (!assemble(s, scene, settings, state, pose, of.faces)) {
    set_pattern(s, scene, state, pose, of);
    assemble(s, scene, settings, state, pose, of.faces);
  }
  s.correction = Eigen::VectorXd::Zero(s.residual.size());
  return s.linear.solve(s.matrix, s.residual, std::clamp(margin / error, tightest, loosest),
                        s.correction);
}

/// Dissipation of the step in block i other than at its contacts: by the implicit scheme in its
/// strain and its boundary springs (-f(x_{n+1}).D less the change of the stored energy), by mass
/// damping and viscosity, and in a static analysis all of its kinetic energy.
double dissipated(const ImplicitSolver& s, const ImplicitScene& scene,
                  const ImplicitSettings& settings, const State& state, const Pose& pose, Id row) {
  const Id i = s.block_of[row];
  double sum = s.energy[i] - stored_energy(scene.blocks, state, {&scene.locked}, 0.0, i);
  const BodyColumn step = s.matrix.part(s.moved, row),
                   velocity = column_of(scene.blocks, state.velocity, i);
  sum -= elastic_force(scene, state, i).dot(step);
  sum -= viscous_force(s, scene, settings, state, row).dot(step);
  const BoundarySprings& springs = scene.springs;
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q) {
    const Id v = springs.vertex[q];
    const double ux = pose.x[v] - pose.x1[v], uy = pose.y[v] - pose.y1[v];
    sum += 0.5 * (ux * (springs.kxx[q] * ux + springs.kxy[q] * uy) +
                  uy * (springs.kxy[q] * ux + springs.kyy[q] * uy));
  }
  const double h = settings.step;
  const BodyColumn after = 2.0 / h * step - (settings.dynamic ? 1.0 : 0.0) * velocity;
  sum += settings.mass_damping(scene.masses, i) * step.dot(s.mass[i] * after);
  if (!settings.dynamic)
    sum += 0.5 * after.dot(s.mass[i] * after) + 0.5 * velocity.dot(s.mass[i] * velocity);
  return sum;
}

/// Returns the angular momentum that the scheme takes from a rotating block. Forces and their
/// moments, x_{n+1} x f, act at the end of the step, but the momentum is that of v_n at x_n. The
/// loss about the centre of mass, -sum D x M v_n, is returned as a rotation of the whole block; for
/// a free block it is all that would slow its spin. Returns the energy added, J.
double restore_angular_momentum(const ImplicitSolver& s, const BlockSet& b,
                                const BodyColumn& before, State& state, Id row) {
  const Id i = s.block_of[row];
  const BodyMass& mass = s.mass[i];
  const BodyColumn x = column_of(b, state.position, i), v = column_of(b, state.velocity, i),
                   step = s.matrix.part(s.moved, row);
  const auto sum = [](const BodyColumn& of) {
    return resultant(vectors_of(of.head<degrees_of_freedom>()));
  };
  const auto moment = [](const BodyColumn& arm, const BodyColumn& of) {
    double whole = 0.0;
    for (Eigen::Index k = 0; k < arm.size(); k += 2) {
      whole = whole + arm[k] * of[k + 1] - arm[k + 1] * of[k];
    }
    return whole;
  };
  BodyColumn shift = BodyColumn::Zero(x.size());
  shift.head<degrees_of_freedom>() = nodal(at_every_node({1.0, 0.0}));
  const double total = shift.dot(mass * shift);
  const Vec2 centre = 1.0 / total * sum(mass * x), moved = 1.0 / total * sum(mass * step);
  const BodyColumn momentum = mass * before;
  const double missing = cross(moved, sum(momentum)) - moment(step, momentum);
  BodyColumn spin(x.size());
  for (Eigen::Index k = 0; k < x.size(); k += 2) {
    const Vec2 of_node = k < row_of_node(nodes_per_block) ? centre : Vec2{};
    spin.segment<2>(k) << of_node.y - x[k + 1], x[k] - of_node.x;
  }
  const double inertia = spin.dot(mass * spin), rate = missing / inertia;
  store(BodyColumn(v + rate * spin), b, state.velocity, i);
  return rate * spin.dot(mass * v) + 0.5 * rate * rate * inertia;
}

/// Eqs. 7 and 8: v_{n+1} = 2 D/h - v_n, and the lost angular momentum; in a static analysis
/// velocities are zero at the beginning and end of every step.
void finish(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
            State& state, const Pose& pose, const TrialFaces& of, const std::vector<Id>& broken,
            std::vector<double>& damping_work) {
  const double h = settings.step;
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    damping_work[i] += dissipated(s, scene, settings, state, pose, static_cast<Id>(row));
    const BlockSet& b = scene.blocks;
    const BodyColumn before = column_of(b, state.velocity, i), step = s.matrix.part(s.moved, row);
    store(BodyColumn(step / h), b, s.mean_velocity, i);
    const double goes_on = settings.dynamic ? 1.0 : 0.0;
    store(BodyColumn(goes_on * (2.0 / h * step - before)), b, state.velocity, i);
    if (settings.dynamic) {
      damping_work[i] -= restore_angular_momentum(s, b, before, state, static_cast<Id>(row));
    }
  });
  account_springs(s.springs, of, scene.faces(pose), broken);
}

/// One attempt at a step, by iteration of the functions above.
class Rounds {
 public:
  Rounds(ImplicitSolver& solver, const ImplicitScene& scene, const ImplicitSettings& settings,
         State& state, Pose& pose, const TrialFaces& contacts, BodyVectors& forces)
      : s_(solver),
        scene_(scene),
        settings_(settings),
        state_(state),
        pose_(pose),
        c_(contacts),
        forces_(forces) {}

  /// Iterates until forces and contact states agree. `broken`: bonds that broke on the way,
  /// ascending.
  Attempt run(std::vector<Id>& broken) {
    begin(s_, scene_, state_, pose_, c_);
    guess();
    double error = balance();
    int most = most_iterations;
    while (s_.iterations == 0 || !(error <= 1.0) || !bonds_stay(broken, most, error)) {
      if (std::isnan(error)) return Attempt::no_solution;
      if (s_.iterations == most) return Attempt::not_converged;
      if (!solve(s_, scene_, settings_, error, state_, pose_, c_)) return Attempt::no_solution;
      ++s_.iterations;
      error = search();
      if (far()) return Attempt::too_far;
    }
    std::sort(broken.begin(), broken.end());
    return s_.last_displacement > settings_.displacement_limit ? Attempt::too_far
                                                               : Attempt::accepted;
  }

 private:
  /// Beyond this displacement the closures are meaningless.
  bool far() const { return !(s_.last_displacement <= 4.0 * settings_.displacement_limit); }

  double balance() {
    const bool first = s_.iterations == 0;
    const std::size_t changed =
        evaluate_springs(s_.springs, c_, scene_.faces(pose_), settings_.step, first, s_.on_faces);
    if (!first) s_.switched += changed;
    gather_forces(forces_, scene_.blocks, state_, pose_, s_.on_faces, scene_.springs,
                  scene_.gravity, scene_.loads, {&scene_.locked});
    return measure_residual(s_, scene_, settings_, state_, c_.tiled, forces_);
  }

  /// First guess of a dynamic step: the displacement of the last step once more. (Not h v_n: the
  /// scheme makes velocities of stiff springs change their sign from step to step.)
  void guess() {
    if (!settings_.dynamic) return;
    s_.base = s_.moved;
    s_.correction.resize(s_.moved.size());
    parallel_for(s_.block_of.size(), [&](std::size_t row) {
      const Id i = s_.block_of[row];
      s_.matrix.part(s_.correction, row) =
          settings_.step * column_of(scene_.blocks, s_.mean_velocity, i);
    });
    move(s_, scene_, 1.0, state_, pose_);
  }

  /// Whether all bonds carry their present load. Those that do not break, and the count of
  /// iterations begins again.
  bool bonds_stay(std::vector<Id>& broken, int& most, double& error) {
    const std::vector<Id> now = break_overloaded(s_.springs, c_, scene_.faces(pose_));
    if (now.empty()) return true;
    broken.insert(broken.end(), now.begin(), now.end());
    most = s_.iterations + most_iterations;
    error = balance();
    return false;
  }

  double slope_at(double part, double& error) {
    move(s_, scene_, part, state_, pose_);
    error = balance();
    return s_.residual.dot(s_.correction);
  }

  /// Line search along the correction. With given limits of friction all springs together have a
  /// piecewise quadratic potential, with a break where a contact opens, closes or slides. The whole
  /// correction may therefore be far too long; where the slope (residual . correction) has changed
  /// its sign, its zero is searched. Returns the error there.
  double search() {
    constexpr int most_looks = 8;
    constexpr double flat = 0.1;  // of the slope at the start
    s_.base = s_.moved;
    double error = 0.0;
    const double start = s_.residual.dot(s_.correction);
    double low = 0.0, high = 1.0, at_low = start, at_high = slope_at(1.0, error);
    while (far() && high > 1e-3) {
      high *= 0.25;
      at_high = slope_at(high, error);
    }
    if (at_high > 0.0 && high < 1.0) {  // the zero lies beyond meaningful closures
      s_.last_displacement = 1e300;
      return error;
    }
    double slope = at_high;
    for (int look = 0; look < most_looks && !far(); ++look) {
      if (at_high >= 0.0 || std::abs(slope) <= flat * start) break;
      const double width = high - low;
      const double part = std::clamp(low + width * at_low / (at_low - at_high), low + 0.1 * width,
                                     high - 0.1 * width);
      slope = slope_at(part, error);
      (slope > 0.0 ? low : high) = part;
      (slope > 0.0 ? at_low : at_high) = slope;
    }
    return error;
  }

  ImplicitSolver& s_;
  const ImplicitScene& scene_;
  const ImplicitSettings& settings_;
  State& state_;
  Pose& pose_;
  const TrialFaces& c_;
  BodyVectors& forces_;
};

}  // namespace

Attempt newmark_step(ImplicitSolver& s, const ImplicitScene& scene,
                     const ImplicitSettings& settings, State& state, Pose& pose,
                     const TrialFaces& c, BodyVectors& forces, std::vector<double>& damping_work) {
  std::vector<Id> broken;
  const Attempt attempt = Rounds(s, scene, settings, state, pose, c, forces).run(broken);
  if (attempt == Attempt::accepted) {
    finish(s, scene, settings, state, pose, c, broken, damping_work);
  } else {
    go_back(s, scene.blocks, state, pose, c);
  }
  return attempt;
}

}  // namespace edda
