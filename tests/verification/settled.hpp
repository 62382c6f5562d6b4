// A model from its text, run through its stages.
#pragma once

#include "run/run_model.hpp"
#include "verification/scene.hpp"

namespace edda {

/// The run at the end of its last stage; a stage until equilibrium must find it.
inline PreparedRun settled(const std::string& toml) {
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/scene.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults().front());
  PreparedRun ready = prepare_run(std::move(model.value())).value();
  const Result<Outcome> outcome = run_model(ready, RunOptions{});
  EXPECT_TRUE(outcome.ok());
  if (outcome.ok()) {
    const Status status = outcome.value().status;
    EXPECT_TRUE(status == Status::equilibrium || status == Status::completed)
        << outcome.value().message;
  }
  return ready;
}

}  // namespace edda
