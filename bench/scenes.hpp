// What is measured: models brought to where they are worth measuring.
#pragma once

#include <string>

#include "step/simulation.hpp"

namespace edda {

struct BenchScene {
  Simulation sim;           ///< ready for its next step; no event interrupts it
  double row_error = -1.0;  ///< of a wall at rest: see error_of_row_forces()
};

/// Empty if `name` is one of
///   wall:67x30       a wall at rest, columns x rows
///   collapse:67x30   a wall that has fallen onto sharp ridges
///   heap:2000        so many random polygons that flow down a slope
///   cavern           examples/cavern.toml, let go
///   squeezing        examples/squeezing.toml, its opening let go at once
///   ground:50        so many metres of ground by as many in zones of half a metre, at rest in its
///                    stress
///   rock:50          so many metres of rock by as many, two joint sets, at rest in its stress
///   free:2000        so many random polygons that turn, each for itself
/// and else what is wrong with it.
std::string flaw_of_scene(const std::string& name);

/// Ends the program where it cannot be built. `cache`: see settled_wall().
BenchScene make_scene(const std::string& name, const std::string& cache);

}  // namespace edda
