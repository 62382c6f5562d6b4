// Row 18: eight rows of eight bricks standing on one another, without damping.
#pragma once

#include <algorithm>
#include <vector>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda {

/// `damped`: strong local damping at the beginning, which the caller removes.
inline Simulation brick_wall(bool damped) {
  return scene(std::string("[materials.brick]\ndensity = 2600.0\nyoung = 1e9\npoisson = 0.2\n"
                           "[joints.dry]\nfriction_angle = 30\n[[block]]\nfixed = true\npolygon = "
                           "[[-1,-0.5],[9,-0.5],[9,0],[-1,0]]\n[[brick_wall]]\ncolumns = 8\nrows = "
                           "8\nbrick = [1.0, 0.5]\n[solver]\nduration = 1e4\n") +
               (damped ? "damping = { local = 0.7 }\n" : ""));
}

struct Equilibrium {
  double first_kinetic = 0.0;  ///< J, largest within the first second
  double later_kinetic = 0.0;  ///< J, largest after it
  double error = 0.0;          ///< of the energy balance, largest
  double trend =
      0.0;  ///< mean energy balance error of the last tenth of the steps less that of the first
  double moved =
      0.0;  ///< m, largest displacement of a brick's centroid since the start of the watch
  std::uint64_t flips =
      0;  ///< openings and closings of contacts with N over 1e-9 of a brick's weight, after 1 s
  std::uint64_t later_steps = 0;
};

inline void expect_rest(const Equilibrium& found, bool in_equilibrium, const std::string& label) {
  expect_at_most({18, label, "largest energy balance error", ""}, found.error,
                 in_equilibrium ? 1e-9 : 1e-5);
  expect_at_most({18, label, "largest displacement of a brick", "m"}, found.moved,
                 in_equilibrium ? 1e-9 : 1e-3);
  if (in_equilibrium) {
    // J: rounding, of a wall that stores hundreds
    expect_at_most({18, label, "kinetic energy after the first second", "J"}, found.later_kinetic,
                   1e-12);
    expect_at_most({18, label, "openings and closings of contacts that carry force", ""},
                   static_cast<double>(found.flips), 0.0);
  } else {
    expect_at_most({18, label, "kinetic energy after the first second over that in it", ""},
                   found.later_kinetic / found.first_kinetic, 1.0);
    EXPECT_LT(std::abs(found.trend), 1e-6);
  }
}

/// Runs and watches `steps` steps, and compares them with the bounds of the row.
inline Equilibrium watch_rest(Simulation& sim, std::uint64_t steps, bool in_equilibrium) {
  const std::string label = std::string(in_equilibrium ? "settled" : "as drawn") + ", " +
                            std::to_string(steps) + " steps";
  Series series(18, label, {"time", "kinetic", "drift"});
  const std::uint64_t every = 16 * std::max<std::uint64_t>(steps / 16000, 1);
  Equilibrium found;
  const double begin = sim.motion.state.time, weight = sim.scene->blocks.mass[1] * 9.81;
  const std::uint64_t first = sim.motion.state.steps;
  std::vector<Vec2> first_at;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i)
    first_at.push_back(centroid(sim.motion.state.position, i));
  std::vector<double> closed;
  double early = 0.0, late = 0.0;
  std::uint64_t early_rows = 0, late_rows = 0;
  sim.accounts.start_energy = {};
  sim.accounts.largest_energy = 0.0;
  while (sim.motion.state.steps < first + steps) {
    const std::uint64_t rebuilds = sim.motion.contacts.rebuilds;
    closed.clear();
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k)
      closed.push_back(face_row(sim, k).state.energy);
    const auto failure = step(sim);
    if (failure) {
      ADD_FAILURE() << failure->message;
      break;
    }
    const bool later = sim.motion.state.time > begin + 1.0;
    const std::uint64_t n = sim.motion.state.steps - first;
    if (later) ++found.later_steps;
    if (later && rebuilds == sim.motion.contacts.rebuilds) {
      for (std::size_t k = 0; k < closed.size(); ++k) {
        const FaceRow now = face_row(sim, k);
        const bool flipped = (closed[k] > 0.0) != (now.state.energy > 0.0);
        const double force = normal_force(now);
        if (flipped && force > 1e-9 * weight) ++found.flips;
      }
    }
    if (n % 16 != 0) continue;
    const EnergyBalance l = account_energy(sim);
    double& kinetic = later ? found.later_kinetic : found.first_kinetic;
    kinetic = std::max(kinetic, l.kinetic);
    if (n % every == 0) series.add({sim.motion.state.time - begin, l.kinetic, std::abs(l.error)});
    found.error = std::max(found.error, std::abs(l.error));
    if (n <= steps / 10) early += l.error, ++early_rows;
    if (n > steps - steps / 10) late += l.error, ++late_rows;
  }
  found.trend = late / static_cast<double>(late_rows) - early / static_cast<double>(early_rows);
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i)
    found.moved = std::max(found.moved, norm(centroid(sim.motion.state.position, i) - first_at[i]));
  expect_rest(found, in_equilibrium, label);
  record_model(18, label, sim);
  return found;
}

}  // namespace edda
