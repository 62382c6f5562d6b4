// A model file becomes a checked, constant Model.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "model/model.hpp"

namespace edda {

/// What a model is read for. A run in time needs a duration; drawing, cutting and the search for a
/// factor of safety do not.
enum class ReadFor { run, no_run };

/// Reads the TOML file `path`, applies `overrides` ("solver.duration=0.2") in order, fills in every
/// default and checks everything that can be checked without cutting the geometry. All faults are
/// returned together, in the order of the lines, those of overrides last ("--set", line = number of
/// the override from 1); a TOML syntax error, or a file that cannot be read, is returned alone.
Result<Model> read_model(const std::string& path, const std::vector<std::string>& overrides = {},
                         ReadFor what_for = ReadFor::run);

/// As read_model(), for a text; `file_name` appears in faults and as Model::file.
Result<Model> read_model_text(std::string_view text, const std::string& file_name,
                              const std::vector<std::string>& overrides = {},
                              ReadFor what_for = ReadFor::run);

/// The fault of a model without stages and duration that is to run in time after all.
std::optional<Fault> missing_duration(const Model& model);

}  // namespace edda
