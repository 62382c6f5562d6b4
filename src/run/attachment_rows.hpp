// What boundaries and bolts do, as rows of tables.
#pragma once

#include <string>
#include <vector>

#include "run/observe.hpp"

namespace edda {

/// Force of each boundary on the blocks at that instant, springs, dashpots and tractions together,
/// [rows of Model::boundaries] N.
std::vector<Vec2> reactions(const Simulation& sim, const Instant& at);

/// reactions.csv: time, then NAME.fx NAME.fy of each boundary; its number where it has no name.
std::string reactions_header(const Model& model);
std::string reactions_row(const Simulation& sim, const Instant& at);

/// bolts.csv: a row per node of each bolt. Forces are those of one bolt, not of a metre of
/// thickness: axial_force (N, tension positive; at a joint that of the steel across it), bond_force
/// (N/m, positive where the rock holds back a bolt that slips away from its head), dowel_force (N).
/// utilisation: of the axial force against yield, the bond against its strength or the dowel
/// against its own, whichever is most.
std::string bolts_header();
std::string bolts_rows(const Simulation& sim);

}  // namespace edda
