// Row 18: eight rows of eight bricks at rest on one another, without damping.
#pragma once

#include <algorithm>
#include <vector>

#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda {

/// `settle`: strong local damping to begin with, which the caller takes away.
inline Simulation brick_wall(bool settle) {
  return scene(std::string("[materials.brick]\ndensity = 2600.0\nyoung = 1e9\npoisson = 0.2\n"
                           "[joints.dry]\nfriction_angle = 30\n[[block]]\nfixed = true\npolygon = "
                           "[[-1,-0.5],[9,-0.5],[9,0],[-1,0]]\n[[brick_wall]]\ncolumns = 8\nrows = "
                           "8\nbrick = [1.0, 0.5]\n[solver]\nduration = 1e4\n") +
               (settle ? "damping = { local = 0.7 }\n" : ""));
}

struct Rest {
  double first_kinetic = 0.0;  ///< J, largest within the first second
  double later_kinetic = 0.0;  ///< J, largest after it
  double drift = 0.0;          ///< of the ledger, largest
  double trend = 0.0;          ///< mean drift of the last tenth of the steps less that of the first
  double moved = 0.0;          ///< m, largest of a brick's centroid since the start of the watch
  std::uint64_t flips = 0;     ///< of contacts with N over 1e-9 of a brick's weight, after 1 s
  std::uint64_t later_steps = 0;
};

inline void expect_rest(const Rest& rest, bool settled, const std::string& label) {
  expect_at_most({18, label, "largest drift of the ledger", ""}, rest.drift, settled ? 1e-9 : 1e-5);
  expect_at_most({18, label, "largest displacement of a brick", "m"}, rest.moved,
                 settled ? 1e-9 : 1e-3);
  if (settled) {
    // J: rounding, of a wall that stores hundreds
    expect_at_most({18, label, "kinetic energy after the first second", "J"}, rest.later_kinetic,
                   1e-12);
    expect_at_most({18, label, "flips of contacts that carry", ""}, static_cast<double>(rest.flips),
                   0.0);
  } else {
    expect_at_most({18, label, "kinetic energy after the first second over that in it", ""},
                   rest.later_kinetic / rest.first_kinetic, 1.0);
    EXPECT_LT(std::abs(rest.trend), 1e-6);
  }
}

/// Runs `steps` steps and watches them, and holds them to the row's bounds.
inline Rest watch_rest(Simulation& sim, std::uint64_t steps, bool settled) {
  const std::string label =
      std::string(settled ? "settled" : "as drawn") + ", " + std::to_string(steps) + " steps";
  Series books(18, label, {"time", "kinetic", "drift"});
  const std::uint64_t every = 16 * std::max<std::uint64_t>(steps / 16000, 1);
  Rest rest;
  const double begin = sim.state.time, weight = sim.blocks.mass[1] * 9.81;
  const std::uint64_t first = sim.state.steps;
  std::vector<Vec2> home;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i)
    home.push_back(centroid(sim.state.x, sim.state.y, i));
  std::vector<double> closed;
  double early = 0.0, late = 0.0;
  std::uint64_t early_rows = 0, late_rows = 0;
  sim.start_energy = {};
  sim.largest_energy = 0.0;
  while (sim.state.steps < first + steps) {
    const std::uint64_t rebuilds = sim.contacts.rebuilds;
    closed = sim.contacts.now.energy.values();
    const auto failure = sim.step();
    if (failure) {
      ADD_FAILURE() << failure->message;
      break;
    }
    const bool later = sim.state.time > begin + 1.0;
    const std::uint64_t n = sim.state.steps - first;
    if (later) ++rest.later_steps;
    if (later && rebuilds == sim.contacts.rebuilds) {
      for (std::size_t k = 0; k < closed.size(); ++k) {
        const FaceMemory& now = sim.contacts.now;
        const bool flipped = (closed[k] > 0.0) != (now.energy[k] > 0.0);
        const double force = normal_force(sim.contacts, k);
        if (flipped && force > 1e-9 * weight) ++rest.flips;
      }
    }
    if (n % 16 != 0) continue;
    const Ledger l = sim.ledger();
    double& kinetic = later ? rest.later_kinetic : rest.first_kinetic;
    kinetic = std::max(kinetic, l.kinetic);
    if (n % every == 0) books.add({sim.state.time - begin, l.kinetic, std::abs(l.drift)});
    rest.drift = std::max(rest.drift, std::abs(l.drift));
    if (n <= steps / 10) early += l.drift, ++early_rows;
    if (n > steps - steps / 10) late += l.drift, ++late_rows;
  }
  rest.trend = late / static_cast<double>(late_rows) - early / static_cast<double>(early_rows);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i)
    rest.moved = std::max(rest.moved, norm(centroid(sim.state.x, sim.state.y, i) - home[i]));
  expect_rest(rest, settled, label);
  record_model(18, label, sim);
  return rest;
}

}  // namespace edda
