#include "true_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "contacts/gaps.hpp"
#include "forces/contact_forces.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

struct Field {
  Nodes x, y;
};

template <class Body>
void for_each_node(const Simulation& s, Body body) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < s.blocks.size(); ++i) {
      if (is_free(s.blocks, s.state, i)) body(k, i);
    }
  }
}

/// Accelerations where the nodes are, contacts as they are.
Field accelerations_of(Simulation& s) {
  for (std::size_t i = 0; i < s.blocks.size(); ++i) {
    if (s.state.alive[i]) place_vertices(s.blocks, s.state.x, s.state.y, i, s.pose.x, s.pose.y);
  }
  remeasure_gaps(s.contacts, s.pose);
  evaluate_contacts(s.contacts, s.blocks, s.laws, s.state.step, 0.0);
  gather_forces(s.forces, s.blocks, s.state, s.pose, s.contacts, s.springs, s.model.gravity);
  Field a{s.forces.x, s.forces.y};
  for_each_node(s, [&](std::size_t k, std::size_t i) {
    a.x[k][i] /= s.blocks.node_mass[k][i];
    a.y[k][i] /= s.blocks.node_mass[k][i];
  });
  return a;
}

}  // namespace

double true_critical_step(const Simulation& sim, int rounds) {
  Simulation s = sim;
  s.contacts.segments.clear();
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    if (s.contacts.is(c, cs::closed)) s.contacts.set(c, cs::bonded | cs::pulls | cs::glued);
    s.contacts.tension[c] = 1e300;
  }
  s.contacts.look_everywhere();
  const Nodes x0 = s.state.x, y0 = s.state.y;
  const Field at_rest = accelerations_of(s);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Field v{x0, y0};
  for_each_node(s, [&](std::size_t k, std::size_t i) {
    v.x[k][i] = u(rng);
    v.y[k][i] = u(rng);
  });
  double largest = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double square = 0.0;
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      square += s.blocks.node_mass[k][i] * (v.x[k][i] * v.x[k][i] + v.y[k][i] * v.y[k][i]);
    });
    constexpr double amplitude = 1e-8;  // m, were it all in one node
    double heaviest = 0.0;
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      heaviest = std::max(heaviest, s.blocks.node_mass[k][i]);
    });
    const double scale = amplitude * std::sqrt(heaviest / square);
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      s.state.x[k][i] = x0[k][i] + scale * v.x[k][i];
      s.state.y[k][i] = y0[k][i] + scale * v.y[k][i];
    });
    const Field a = accelerations_of(s);
    double product = 0.0;
    for_each_node(s, [&](std::size_t k, std::size_t i) {
      const double ax = (at_rest.x[k][i] - a.x[k][i]) / scale,
                   ay = (at_rest.y[k][i] - a.y[k][i]) / scale;
      product += s.blocks.node_mass[k][i] * (v.x[k][i] * ax + v.y[k][i] * ay);
      v.x[k][i] = ax;
      v.y[k][i] = ay;
    });
    largest = std::max(largest, product / square);
  }
  return 2.0 / std::sqrt(largest);
}

}  // namespace edda
