#include "true_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "contacts/face_bonds.hpp"
#include "contacts/face_reading.hpp"
#include "step/contact_search.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

struct Field {
  Nodes x, y;
};

template <class Body>
void for_each_node(const Simulation& s, Body body) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      if (is_free(s.scene->blocks, s.motion.state, i)) body(k, i);
    }
  }
}

/// Accelerations where the nodes are, contacts as they are.
Field accelerations_of(Simulation& s) {
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    if (s.motion.state.alive[i])
      place_vertices(s.scene->blocks, s.motion.state.position, i, s.motion.pose.x, s.motion.pose.y);
  }
  reevaluate_at_n(s, s.motion.state.step);
  sum_face_forces(s);
  gather_forces(s.motion.forces, s.scene->blocks, s.motion.state, s.motion.pose,
                s.motion.on_contacts, s.attached.springs, s.scene->model.gravity);
  Field a{s.motion.forces.x, s.motion.forces.y};
  for_each_node(s, [&](std::size_t k, std::size_t i) {
    a.x[k][i] /= s.motion.masses.node[k][i];
    a.y[k][i] /= s.motion.masses.node[k][i];
  });
  return a;
}

/// Part of the most that any face stores below which one is open: corners that touch by a rounding.
constexpr double nothing = 1e-12;

/// Brings a face that is open to where it just touches: all along where its edges lie along each
/// other, else with the corner that would come first.
void let_touch(FaceSet& c, const FaceFields& m, std::size_t k) {
  constexpr double just = 1e-6;  // m, more than what the iteration moves anything by
  const double da = m.closure_a, db = m.closure_b;
  const bool along = m.cohesive > 0.0;
  c.locked_closure_a[k] += std::max(just - (along ? da : std::max(da, db)), 0.0);
  c.locked_closure_b[k] += std::max(just - (along ? db : std::max(da, db)), 0.0);
}

/// Springs that neither open nor slide. An end that is open stays so, or it would pull by all that
/// it is apart.
void hold_contacts(FaceSet& c, const FaceStates& states, Carrying which) {
  constexpr double enough = 1e300;  // N
  double most = 0.0;
  for (const FaceFields& m : states.now) most = std::max(most, m.energy);
  for (std::size_t k = 0; k < c.size(); ++k) {
    const FaceFields& m = states.now[k];
    const bool closed = m.energy > 0.0 || (c.bonded(k) && m.gate > 0.0);
    const bool carries = closed && (c.carries_tension(k) || m.energy > nothing * most);
    const bool aside = !c.acts(k) || m.gate == 0.0;
    if (!carries && (which == Carrying::now || aside)) {
      c.stiffness[k] = c.shear_stiffness[k] = 0.0;
      continue;
    }
    const double before_a = c.locked_closure_a[k], before_b = c.locked_closure_b[k];
    if (which == Carrying::may && !c.carries_tension(k)) let_touch(c, m, k);
    const double da = m.closure_a + c.locked_closure_a[k] - before_a;
    const double db = m.closure_b + c.locked_closure_b[k] - before_b;
    if (std::min(da, db) > 0.0) c.set(FaceFlag::carries_tension, k);
    c.set_bond(BondState::intact, k);
    c.set(FaceFlag::glued, k);
    c.tension[k] = enough;
  }
}

}  // namespace

double true_critical_step(const Simulation& sim, Carrying which, int rounds) {
  Simulation s = sim;
  change_faces(
      s, [&](FaceSet& faces, const FaceStates& states) { hold_contacts(faces, states, which); });
  const Nodes x0 = s.motion.state.position.x, y0 = s.motion.state.position.y;
  const Field at_rest = accelerations_of(s);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Field v{x0, y0};
  for_each_node(s, [&](std::size_t k, std::size_t i) {
    v.x[k][i] = u(rng);
    v.y[k][i] = u(rng);
  });
  const double heaviest =
      *std::max_element(s.scene->blocks.mass.begin(), s.scene->blocks.mass.end());
  constexpr double amplitude = 1e-8;  // m, were it all in the heaviest block
  double largest = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double square = 0.0;
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      square += s.motion.masses.node[k][i] * (v.x[k][i] * v.x[k][i] + v.y[k][i] * v.y[k][i]);
    });
    const double scale = amplitude * std::sqrt(heaviest / square);
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      v.x[k][i] *= scale;
      v.y[k][i] *= scale;
      s.motion.state.position.x[k][i] = x0[k][i] + v.x[k][i];
      s.motion.state.position.y[k][i] = y0[k][i] + v.y[k][i];
    });
    const Field a = accelerations_of(s);
    double product = 0.0;
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      const Vec2 pulled{at_rest.x[k][i] - a.x[k][i], at_rest.y[k][i] - a.y[k][i]};
      product += s.motion.masses.node[k][i] * (v.x[k][i] * pulled.x + v.y[k][i] * pulled.y);
      v.x[k][i] = pulled.x;
      v.y[k][i] = pulled.y;
    });
    largest = std::max(largest, product / (amplitude * amplitude * heaviest));
  }
  return 2.0 / std::sqrt(largest);
}

}  // namespace edda
