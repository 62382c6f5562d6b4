// Which faces act while a model runs, against contacts/acting_oracle.hpp.
#pragma once

#include "contacts/acting_oracle.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"
#include "verification/random_heap.hpp"

namespace edda {

struct Acting {
  ActingFaults faults;
  std::uint64_t steps = 0;
  std::string failure;
};

/// Compares the faces as drawn and after every step.
inline Acting acting_in(Simulation& sim, std::uint64_t steps, double time = 1.0) {
  ActingOracle oracle(1e-9);
  Acting acting;
  start(sim, time);
  const auto look = [&] {
    acting.faults.add(
        oracle.look(sim.motion.contacts, take_faces(sim), sim.scene->blocks, sim.motion.pose));
  };
  look();
  while (sim.motion.state.steps < steps && sim.motion.state.time < time && acting.failure.empty()) {
    if (const auto failure = step(sim)) acting.failure = failure->message;
    look();
  }
  acting.steps = sim.motion.state.steps;
  return acting;
}

/// Plates of 1 : 50, needles of 2 degrees, stars, Ls of two glued squares, thrown at a frame with a
/// loose block in its hole.
inline std::string odd_heap(unsigned seed, double friction) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  constexpr int side = 4;
  constexpr double cell = 2.6, middle = 0.5 * cell * (side - 1), speed = 30.0;
  std::string text =
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = " +
      number(friction) +
      "\n[joints.glue]\ntype = 'glued'\n[contact]\njoint = 'j'\nnormal_stiffness = "
      "2e11\n[solver]\nduration = 1\n[domain]\n"
      "outline = [[2.7,2.7],[5.1,2.7],[5.1,5.1],[2.7,5.1]]\n[[trace]]\njoint = 'j'\n"
      "points = [[3.2,3.2],[4.6,3.2],[4.6,4.6],[3.2,4.6],[3.2,3.2]]\n";
  for (int i = 0; i < side * side; ++i) {
    const Vec2 c = cell * Vec2{1.0 * (i % side), 1.0 * (i / side)};
    if (i % side % 3 != 0 && i / side % 3 != 0) continue;  // the frame
    const double turn = 2.0 * std::numbers::pi * u(rng), kind = u(rng);
    const Vec2 v =
        speed * ((Vec2{middle, middle} - c) / middle + 0.3 * Vec2{u(rng) - 0.5, u(rng) - 0.5});
    const std::string moves = "velocity = [" + number(v.x) + "," + number(v.y) + "]\n";
    const auto place = [&](Ring ring) {
      for (Vec2& p : ring) p = c + rotated(p, turn);
      return ring;
    };
    if (kind < 0.25) {
      text += block_text(place({{-1, -0.02}, {1, -0.02}, {1, 0.02}, {-1, 0.02}}), moves);
    } else if (kind < 0.5) {
      const double tip = std::tan(radians(1.0));
      text += block_text(place({{-1, -tip}, {1, 0}, {-1, tip}}), moves);
    } else if (kind < 0.75) {
      text += block_text(place({{-0.6, -0.6}, {0, -0.6}, {0, 0}, {-0.6, 0}}),
                         moves + "joint = 'glue'\n");
      text += block_text(place({{0, -0.6}, {0.6, -0.6}, {0.6, 0.6}, {0, 0.6}}),
                         moves + "joint = 'glue'\n");
    } else {
      text += block_text(random_shape(rng, c, 1.0, 0.02), moves);
    }
  }
  return text;
}

}  // namespace edda
