// A model from its text, ready to run, and run to its end.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "model/read_model.hpp"
#include "run/run_model.hpp"

namespace edda::testing {

inline PreparedRun prepared(const std::string& toml) {
  Result<Model> model = read_model_text(toml, "m.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  Result<PreparedRun> run = prepare_run(std::move(model.value()));
  if (!run.ok()) ADD_FAILURE() << to_string(run.faults()[0]);
  return std::move(run.value());
}

struct Ran {
  PreparedRun ready;
  Outcome outcome;

  /// How far the block of that name has moved, m.
  Vec2 moved(const char* name) const {
    const Simulation& s = ready.sim;
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      if (s.scene->blocks.name(i) != name) continue;
      return centroid(s.motion.state.position, i) -
             Vec2{s.scene->blocks.centroid_x[i], s.scene->blocks.centroid_y[i]};
    }
    ADD_FAILURE() << "no block is called " << name;
    return {};
  }
};

inline Ran ran(const std::string& toml) {
  Ran r{prepared(toml), {}};
  const Result<Outcome> outcome = run_model(r.ready, RunOptions{});
  EXPECT_TRUE(outcome.ok());
  if (outcome.ok()) r.outcome = outcome.value();
  return r;
}

}  // namespace edda::testing
