// A model that must be good.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "model/read_model.hpp"

namespace edda::testing {

/// The model of a text whose files lie in the source's folder; an empty one, and failures of the
/// test, where the text has faults.
inline Model read_or_fail(const std::string& text) {
  const Result<Model> result = read_model_text(text, EDDA_SOURCE_DIR "/m.toml", {});
  if (!result) {
    for (const Fault& fault : result.faults()) ADD_FAILURE() << to_string(fault) << "\n" << text;
    return {};
  }
  return result.value();
}

}  // namespace edda::testing
