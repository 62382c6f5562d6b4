// The scene of all benchmarks: a wall in running bond on a fixed block, under its own weight.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "model/read_model.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"

namespace edda {

/// Bricks of 1 m x 0.5 m, E 20 GPa, contact springs 200 GPa, friction 30 degrees. `solver`: more
/// lines of its [solver] table.
inline std::string wall_model(int columns, int rows, const std::string& solver = {}) {
  const std::string right = std::to_string(columns + 1);
  return R"(
[materials.brick]
density = 2600.0
young = "20 GPa"
poisson = 0.2
[joints.dry]
friction_angle = 30.0
[contact]
normal_stiffness = 2e11
shear_stiffness = 2e11
[[block]]
name = "base"
fixed = true
polygon = [[-1, -0.5], [)" +
         right + ", -0.5], [" + right + R"(, 0], [-1, 0]]
[[brick_wall]]
columns = )" +
         std::to_string(columns) + "\nrows = " + std::to_string(rows) + R"(
brick = [1.0, 0.5]
[solver]
duration = 1000.0
)" + solver;
}

/// How the blocks of scenes deform, where it is not as the model says.
inline std::optional<BlockDeformation> deformation_of_scenes;

/// Before start(); ends the program with the faults if there are any.
inline Simulation built(Result<Model> model) {
  const auto stop = [](const Faults& faults) {
    for (const Fault& fault : faults) std::fprintf(stderr, "%s\n", to_string(fault).c_str());
    std::exit(1);
  };
  if (!model) stop(model.faults());
  if (deformation_of_scenes) model.value().deformation = *deformation_of_scenes;
  Result<Simulation> sim = Simulation::create(std::move(model.value()));
  if (!sim) stop(sim.faults());
  return std::move(sim.value());
}

inline Simulation built_wall(int columns, int rows, const std::string& solver = {}) {
  return built(read_model_text(wall_model(columns, rows, solver), "wall.toml"));
}

/// Ready for step(). No event interrupts it.
inline Simulation wall(int columns, int rows, const std::string& solver = {}) {
  Simulation sim = built_wall(columns, rows, solver);
  start(sim, 1000.0);
  return sim;
}

/// So many steps; ends the program if one fails.
inline void take_steps(Simulation& sim, long steps) {
  for (long i = 0; i < steps; ++i) {
    if (const auto failure = step(sim)) {
      std::fprintf(stderr, "step %ld: %s\n", i, failure->message.c_str());
      std::exit(1);
    }
  }
}

}  // namespace edda
