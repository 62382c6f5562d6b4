// Laws of joints that change in time: gradually from one to another (stage.change), and by losing
// strength (joints.decay_time). Theory, section 5.10.
#pragma once

#include <cstddef>

#include "contacts/laws.hpp"

namespace edda {

struct Simulation;

/// Where the laws are to be at present.
LawProgress progress_now(const Simulation& sim);

/// At the start of a stage (row of Model::stages): its changes begin, those before it stay where
/// they are.
void begin_law_changes(Simulation& sim, std::size_t stage);

/// Puts in force what the laws have become in a stage with a duration; after each step.
void update_laws(Simulation& sim);

}  // namespace edda
