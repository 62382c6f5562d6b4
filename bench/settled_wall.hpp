// A wall at rest. Left to itself a wall rings for very long, and the longer the higher it is; so a
// short wall of as many rows is damped until it rests, and lends a long one its state: its two ends
// to the ends, its middle column to all between.
#pragma once

#include <string>

#include "step/simulation.hpp"

namespace edda {

/// wall(columns, rows) of wall.hpp at rest, without damping, before its next step. What the short
/// wall has come to is kept in the folder `cache`, if one is given.
Simulation settled_wall(int columns, int rows, const std::string& cache);

/// How far the sums of the normal forces of the bed joints are from the weight above them: the
/// largest difference of any row, over the weight of the wall.
double error_of_row_forces(const Simulation& wall);

}  // namespace edda
