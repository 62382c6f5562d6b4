// A model file becomes a checked, constant Model.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "model/model.hpp"

namespace edda {

/// What a model is read for. One that runs in time needs its duration; one that is drawn, cut into
/// blocks or searched for a factor of safety does without.
enum class ReadFor { run, no_run };

/// Reads the TOML file `path`, applies `overrides` ("solver.duration=0.2") in order, fills in every
/// default and checks all that needs no geometry to be cut. All faults come together, in the order
/// of the lines, those of overrides last ("--set", line = number of the override from 1); a TOML
/// syntax error, or a file that cannot be read, stands alone.
Result<Model> read_model(const std::string& path, const std::vector<std::string>& overrides = {},
                         ReadFor what_for = ReadFor::run);

/// As read_model(), for a text at hand; `file_name` is what faults and Model::file say.
Result<Model> read_model_text(std::string_view text, const std::string& file_name,
                              const std::vector<std::string>& overrides = {},
                              ReadFor what_for = ReadFor::run);

/// What keeps a model that was read for no run from running in time: neither stages nor a duration.
std::optional<Fault> missing_duration(const Model& model);

}  // namespace edda
