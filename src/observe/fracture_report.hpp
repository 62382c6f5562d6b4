// Warnings of joints with fracture energy whose strength would hang on the size of the blocks.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// The process zone of a crack in tension has about the length l_ch = E' G_I/T^2 (Irwin 1958;
/// Hillerborg, Modeer and Petersson 1976), with E' = E/(1 - nu^2), or E in plane stress. Warns
/// where faces are longer than a third of it, and where springs open by more than a tenth of w_c,
/// or slip by more than a tenth of s_c, before the strength is reached.
void warn_of_coarse_cracks(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
