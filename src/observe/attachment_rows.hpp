// Forces of boundaries, bolts and linings, as rows of tables.
#pragma once

#include <string>
#include <vector>

#include "observe/observe.hpp"

namespace edda {

/// Force of each boundary on the blocks at that instant, the sum of springs, dashpots and
/// tractions, [rows of Model::boundaries] N.
std::vector<Vec2> reactions(const Simulation& sim, const Instant& at);

/// Of each boundary its name, or its number where it has none: the owners of the columns of
/// reactions.csv.
std::vector<std::string> boundary_names(const Model& model);
/// A row of reactions.csv (ResultFile::reactions).
std::string reactions_row(const Simulation& sim, const Instant& at);

/// Rows of bolts.csv (ResultFile::bolts), one per node of each bolt. Forces are those of one bolt,
/// not per metre of thickness.
std::string bolts_rows(const Simulation& sim);

/// Rows of linings.csv (ResultFile::linings), one per end of each piece.
std::string linings_rows(const Simulation& sim);

/// Rows of flow.csv (ResultFile::flow), one per water and one of the open faces.
std::string flow_rows(const Simulation& sim);

}  // namespace edda
