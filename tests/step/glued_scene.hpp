// The exact critical step: a power iteration on the assembled system, all joints glued.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "model/read_model.hpp"
#include "step/contact_search.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {

/// Bonds that never open or slide, rock without damping unless `damping` is given.
/// `own`: springs and dashpots of the joint; `law`: more of its keys.
inline Simulation glued(const std::string& geometry, double damping = 0.0,
                        const std::optional<LawDashpots>& own = {}, const std::string& law = {}) {
  Result<Model> model = read_model_text(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n"
      "damping = " +
          std::to_string(damping) + "\n[joints.j]\ntype = 'glued'\n" + law +
          "[solver]\nduration = 1\n" + geometry,
      "t.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  model.value().joints[0].dashpots = own;
  Result<Simulation> sim = Simulation::create(std::move(model.value()));
  if (!sim.ok()) ADD_FAILURE() << to_string(sim.faults()[0]);
  return std::move(sim.value());
}

/// Acceleration of every node in the present state.
inline Nodes accelerate(Simulation& s, bool along_x) {
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    place_vertices(s.scene->blocks, s.motion.state.position, i, s.motion.pose.x, s.motion.pose.y);
  }
  reevaluate_at_n(s, 1.0);
  sum_face_forces(s);
  gather_forces(s.motion.forces, s.scene->blocks, s.motion.state, s.motion.pose,
                s.motion.on_contacts, s.attached.springs, {0, 0});
  Nodes a = along_x ? s.motion.forces.x : s.motion.forces.y;
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      a[k][i] = s.scene->blocks.fixed[i] ? 0.0 : a[k][i] / s.motion.masses.node[k][i];
    }
  }
  return a;
}

/// 2/omega_max of the assembled system, linear around the present state.
inline double true_critical_step(Simulation& s, int rounds = 3000) {
  const Nodes x0 = s.motion.state.position.x, y0 = s.motion.state.position.y;
  const std::size_t nb = s.scene->blocks.size();
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Nodes vx = x0, vy = y0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < nb; ++i) {
      vx[k][i] = s.scene->blocks.fixed[i] ? 0.0 : u(rng);
      vy[k][i] = s.scene->blocks.fixed[i] ? 0.0 : u(rng);
    }
  }
  const Nodes ax0 = accelerate(s, true), ay0 = accelerate(s, false);
  double lambda = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < nb; ++i) size += vx[k][i] * vx[k][i] + vy[k][i] * vy[k][i];
    }
    const double scale = 1.0 / std::sqrt(size), epsilon = 1e-7;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < nb; ++i) {
        s.motion.state.position.x[k][i] = x0[k][i] + epsilon * scale * vx[k][i];
        s.motion.state.position.y[k][i] = y0[k][i] + epsilon * scale * vy[k][i];
      }
    }
    Nodes ax = accelerate(s, true), ay = accelerate(s, false);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < nb; ++i) {
        ax[k][i] -= ax0[k][i];
        ay[k][i] -= ay0[k][i];
      }
    }
    double product = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < nb; ++i) {
        product -= scale * (vx[k][i] * ax[k][i] + vy[k][i] * ay[k][i]) / epsilon;
        vx[k][i] = -ax[k][i] / epsilon;
        vy[k][i] = -ay[k][i] / epsilon;
      }
    }
    lambda = std::max(lambda, product);
  }
  s.motion.state.position.x = x0;
  s.motion.state.position.y = y0;
  return 2.0 / std::sqrt(lambda);
}

}  // namespace edda
