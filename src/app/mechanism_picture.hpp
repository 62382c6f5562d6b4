// Pictures of a failure mechanism, of edda fos and edda limit.
#pragma once

#include <string>
#include <vector>

#include "report/plot.hpp"
#include "results/files.hpp"
#include "results/records.hpp"
#include "study/mechanism.hpp"

namespace edda {

/// NAME.png and .svg: the blocks as they have moved, enlarged until that shows, and
/// the joints along which they did. size: of the blocks, m.
Trouble draw_mechanism(const Model& model, const Simulation& moved, const Mechanism& mechanism,
                       double size, const std::string& subtitle, const std::string& folder,
                       const char* name = "mechanism");

/// thrust.png and thrust.svg: the blocks and the forces of their joints.
Trouble draw_thrust(const Model& model, const Simulation& drawn,
                    const std::vector<ContactRecord>& forces, const std::string& subtitle,
                    const std::string& folder);

/// FOLDER/NAME.png and .svg.
Trouble draw_in_both_forms(const Snapshot& shot, const PlotOptions& options,
                           const std::string& folder, const char* name);

}  // namespace edda
