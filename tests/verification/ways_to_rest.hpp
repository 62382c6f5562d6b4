// Models that reach equilibrium with all defaults.
#pragma once

#include "observe/observe.hpp"
#include "run/run_model.hpp"
#include "step/faces_now.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::ways_to_rest {

struct EquilibriumRun {
  PreparedRun run;
  Outcome outcome;
};

inline EquilibriumRun run_to_equilibrium(const std::string& toml) {
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/rest.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults().front());
  EquilibriumRun found{std::move(prepare_run(std::move(model.value())).value()), {}};
  found.outcome = run_model(found.run, {}).value();
  EXPECT_EQ(found.outcome.status, Status::equilibrium) << found.outcome.message;
  return found;
}

inline std::string wall(int columns, int rows) {
  return "[materials.brick]\ndensity = 2000.0\nyoung = 1e9\npoisson = 0.2\n[joints.dry]\n"
         "friction_angle = 35.0\n[contact]\njoint = 'dry'\n[[block]]\nfixed = true\npolygon = " +
         rectangle(-1.0, -0.5, 0.5 * columns + 1.0, 0.0) +
         "\n[[brick_wall]]\ncolumns = " + std::to_string(columns) +
         "\nrows = " + std::to_string(rows) + "\nbrick = [0.5, 0.25]\n";
}

inline constexpr const char* until_equilibrium = "[[stage]]\nuntil = 'equilibrium'\n";

/// Expects that the base carries the weight of the wall.
inline void expect_weight_carried(const EquilibriumRun& found, double bound) {
  const Simulation& sim = found.run.sim;
  const FaceSet& faces = sim.motion.contacts;
  double weight = 0.0, wall_forces = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (sim.scene->blocks.fixed[i] == 0) weight += 9.81 * sim.scene->blocks.mass[i];
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Id i = block_of_facing(sim.scene->blocks, faces, k),
             j = block_of_edge(sim.scene->blocks, faces, k);
    if (sim.scene->blocks.fixed[i] == sim.scene->blocks.fixed[j]) continue;
    wall_forces +=
        (sim.scene->blocks.fixed[j] != 0 ? 1.0 : -1.0) * force_on_facing(face_row(sim, k)).y;
  }
  EXPECT_NEAR(wall_forces / weight, 1.0, bound);
}

}  // namespace edda::ways_to_rest
