// The picture of a ramp, from the results folder of a run.
#pragma once

#include <string>

#include "results/files.hpp"

namespace edda {

/// Whether the folder holds the curve of a ramp of which more than one increment holds.
bool has_curve(const std::string& folder);

/// Draws the curve of the last ramp in `folder` into `path`; `title`: in place of the model's.
Trouble draw_curve(const std::string& folder, const std::string& path, const std::string& title);

}  // namespace edda
