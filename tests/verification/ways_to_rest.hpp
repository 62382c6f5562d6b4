// Models that come to rest with all defaults.
#pragma once

#include "run/observe.hpp"
#include "run/run_model.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::ways_to_rest {

struct Rested {
  PreparedRun run;
  Outcome outcome;
};

inline Rested at_rest(const std::string& toml) {
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/rest.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults().front());
  Rested rested{std::move(prepare_run(std::move(model.value())).value()), {}};
  rested.outcome = run_model(rested.run, {}).value();
  EXPECT_EQ(rested.outcome.status, Status::equilibrium) << rested.outcome.message;
  return rested;
}

inline std::string wall(int columns, int rows) {
  return "[materials.brick]\ndensity = 2000.0\nyoung = 1e9\npoisson = 0.2\n[joints.dry]\n"
         "friction_angle = 35.0\n[contact]\njoint = 'dry'\n[[block]]\nfixed = true\npolygon = " +
         rectangle(-1.0, -0.5, 0.5 * columns + 1.0, 0.0) +
         "\n[[brick_wall]]\ncolumns = " + std::to_string(columns) +
         "\nrows = " + std::to_string(rows) + "\nbrick = [0.5, 0.25]\n";
}

inline constexpr const char* until_rest = "[[stage]]\nuntil = 'equilibrium'\n";

/// Base under the wall bears its weight.
inline void expect_borne(const Rested& rested, double bound) {
  const Simulation& sim = rested.run.sim;
  Instant at;
  observe(sim, at);
  double weight = 0.0, borne = 0.0;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (sim.blocks.fixed[i] == 0) weight += 9.81 * sim.blocks.mass[i];
  }
  for (std::size_t k = 0; k < at.contacts.size(); ++k) {
    const Id i = block_of_facing(sim.blocks, at.contacts, k),
             j = block_of_edge(sim.blocks, at.contacts, k);
    if (sim.blocks.fixed[i] == sim.blocks.fixed[j]) continue;
    borne += (sim.blocks.fixed[j] != 0 ? 1.0 : -1.0) * force_on_facing(at.contacts, k).y;
  }
  EXPECT_NEAR(borne / weight, 1.0, bound);
}

}  // namespace edda::ways_to_rest
