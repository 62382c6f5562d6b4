#include "implicit/newmark.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/gaps.hpp"
#include "forces/contact_forces.hpp"
#include "forces/elastic.hpp"
#include "implicit/assemble.hpp"

namespace edda {
namespace {

constexpr int most_rounds = 6;
constexpr double linear_tolerance = 1e-9;

bool is_free(const BlockSet& b, const State& s, std::size_t i) {
  return b.fixed[i] == 0 && s.alive[i] != 0;
}

double strain_energy_of(const BlockSet& b, const State& s, std::size_t i) {
  const Deformation f = deformation(b, s.x, s.y, i);
  const Tensor e = corotated_strain(f, rotation(f));
  return strain_energy(e, e, b.volume[i], b.lame_lambda[i], b.lame_mu[i]);
}

void place_all(const BlockSet& b, const State& s, Pose& pose) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (is_free(b, s, i)) place_vertices(b, s.x, s.y, i, pose.x, pose.y);
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
           ContactSet& c) {
  const BlockSet& b = scene.blocks;
  stand_still(c);
  s.contacts_before = c;
  s.start_x = state.x;
  s.start_y = state.y;
  for (std::size_t k = 0; k < 3; ++k) {
    s.dx[k].assign(b.size(), 0.0);
    s.dy[k].assign(b.size(), 0.0);
  }
  pose.x1 = pose.x;
  pose.y1 = pose.y;
  begin_springs(s.springs, c);
  if (s.pattern_of != c.rebuilds) set_pattern(s, scene, state, c);
  s.pattern_of = c.rebuilds;
  s.energy.resize(b.size());
  parallel_for(b.size(), [&](std::size_t i) {
    s.energy[i] = is_free(b, state, i) ? strain_energy_of(b, state, i) : 0.0;
  });
  s.rounds = 0;
  s.switched = 0;
  s.last_displacement = 0.0;
}

/// D += correction, and everything that follows from where the blocks then are.
void move(ImplicitSolver& s, const ImplicitScene& scene, State& state, Pose& pose, ContactSet& c) {
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(6 * row + 2 * k);
      s.dx[k][i] += s.correction[at];
      s.dy[k][i] += s.correction[at + 1];
      state.x[k][i] = s.start_x[k][i] + s.dx[k][i];
      state.y[k][i] = s.start_y[k][i] + s.dy[k][i];
    }
  });
  place_all(scene.blocks, state, pose);
  s.last_displacement = largest_move(pose);
  remeasure_gaps(c, pose);
  s.switched += close_in_step(c, scene.blocks, pose, scene.laws, s.transitions);
}

void go_back(const ImplicitSolver& s, State& state, Pose& pose, ContactSet& c) {
  state.x = s.start_x;
  state.y = s.start_y;
  pose.x = pose.x1;
  pose.y = pose.y1;
  c = s.contacts_before;
}

/// One solve: K^ correction = residual (Eq. 10).
bool solve(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
           const State& state, const ContactSet& c) {
  if (!assemble(s, scene, settings, state, c)) {
    set_pattern(s, scene, state, c);
    assemble(s, scene, settings, state, c);
  }
  s.correction = Eigen::VectorXd::Zero(s.residual.size());
  return s.linear.solve(s.matrix, s.residual, linear_tolerance, s.correction);
}

/// Work that the step dissipated in block i other than at its contacts: by the implicit scheme in
/// its strain and its boundary springs (-f(x_{n+1}).D less the change of the stored energy), by
/// mass damping, and, without dynamics, all of its motion.
double dissipated(const ImplicitSolver& s, const ImplicitScene& scene,
                  const ImplicitSettings& settings, const State& state, const Pose& pose,
                  std::size_t i) {
  const BlockSet& b = scene.blocks;
  const Deformation f = deformation(b, state.x, state.y, i);
  const PiolaStress p = piola(f, rotation(f), b.lame_lambda[i], b.lame_mu[i]);
  double sum = s.energy[i] - strain_energy_of(b, state, i);
  Vector6 step, velocity;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 d{s.dx[k][i], s.dy[k][i]};
    sum -= dot(elastic_force(p, b.volume[i], b.grad_x[k][i], b.grad_y[k][i]), d);
    step.segment<2>(static_cast<Eigen::Index>(2 * k)) << d.x, d.y;
    velocity.segment<2>(static_cast<Eigen::Index>(2 * k)) << state.vx[k][i], state.vy[k][i];
  }
  const BoundarySprings& springs = scene.springs;
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q) {
    const Id v = springs.vertex[q];
    const double ux = pose.x[v] - pose.x1[v], uy = pose.y[v] - pose.y1[v];
    sum += 0.5 * (ux * (springs.kxx[q] * ux + springs.kxy[q] * uy) +
                  uy * (springs.kxy[q] * ux + springs.kyy[q] * uy));
  }
  const double h = settings.step;
  const Vector6 after = 2.0 / h * step - (settings.dynamic ? velocity : Vector6::Zero());
  sum += settings.mass_damping * step.dot(s.mass[i] * after);
  if (!settings.dynamic)
    sum += 0.5 * after.dot(s.mass[i] * after) + 0.5 * velocity.dot(s.mass[i] * velocity);
  return sum;
}

/// Eqs. 7 and 8: v_{n+1} = 2 D/h - v_n; without dynamics every step starts and ends at rest.
void finish(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
            State& state, const Pose& pose, ContactSet& c, const std::vector<Id>& broken,
            std::vector<double>& damping_work) {
  const double h = settings.step;
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    damping_work[i] += dissipated(s, scene, settings, state, pose, i);
    for (std::size_t k = 0; k < 3; ++k) {
      state.vx[k][i] = settings.dynamic ? 2.0 * s.dx[k][i] / h - state.vx[k][i] : 0.0;
      state.vy[k][i] = settings.dynamic ? 2.0 * s.dy[k][i] / h - state.vy[k][i] : 0.0;
    }
  });
  book_springs(s.springs, c, pose, broken);
}

}  // namespace

Attempt newmark_step(ImplicitSolver& s, const ImplicitScene& scene,
                     const ImplicitSettings& settings, State& state, Pose& pose, ContactSet& c,
                     NodalForces& forces, std::vector<double>& damping_work) {
  begin(s, scene, state, pose, c);
  std::vector<Id> broken;
  auto balance = [&] {
    const std::size_t changed = evaluate_springs(s.springs, c, scene.blocks, settings.step,
                                                 settings.contact_damping, s.rounds == 0);
    if (s.rounds > 0) s.switched += changed;
    gather_forces(forces, scene.blocks, state, pose, c, scene.springs, scene.gravity);
    return measure_residual(s, scene, settings, state, c, forces);
  };
  auto given_up = [&](Attempt why) {
    go_back(s, state, pose, c);
    return why;
  };
  int rounds_allowed = most_rounds;
  while (true) {
    double error = balance();
    if (std::isnan(error)) return given_up(Attempt::no_solution);
    if (s.rounds > 0 && error <= 1.0) {
      const std::vector<Id> now = break_overloaded(c, scene.blocks, scene.laws);
      if (now.empty()) break;
      // Bonds have broken: a new problem, with rounds of its own.
      broken.insert(broken.end(), now.begin(), now.end());
      rounds_allowed = s.rounds + most_rounds;
      error = balance();
    }
    if (s.rounds == rounds_allowed) return given_up(Attempt::unsettled);
    if (!solve(s, scene, settings, state, c)) return given_up(Attempt::no_solution);
    ++s.rounds;
    move(s, scene, state, pose, c);
    // Far beyond the limit the gaps mean nothing.
    if (!(s.last_displacement <= 4.0 * settings.displacement_limit)) {
      return given_up(Attempt::too_far);
    }
  }
  if (s.last_displacement > settings.displacement_limit) return given_up(Attempt::too_far);
  std::sort(broken.begin(), broken.end());
  finish(s, scene, settings, state, pose, c, broken, damping_work);
  return Attempt::accepted;
}

}  // namespace edda
