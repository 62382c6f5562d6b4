// The factor of safety of a model that a test has as text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "model/read_model.hpp"
#include "study/fos.hpp"

namespace edda {

/// Empty, and a failure of the test, where the model or the search has a fault. fos: keys of [fos].
inline FosResult find_factor_of(const std::string& toml, const std::string& fos = {}) {
  const Result<Model> model =
      read_model_text(toml + "[fos]\n" + fos, EDDA_SOURCE_DIR "/scene.toml", {});
  if (!model.ok()) {
    ADD_FAILURE() << to_string(model.faults().front());
    return {};
  }
  Result<FosResult> found = find_factor(model.value(), {});
  if (!found.ok()) {
    ADD_FAILURE() << to_string(found.faults().front());
    return {};
  }
  return std::move(found.value());
}

}  // namespace edda
