// The step of the deviations of mesh nodes (blocks/meshes.hpp): each moves as a node of its mass
// does (leapfrog.hpp). Local damping acts on what of its force is not affine.
#pragma once

#include "integrate/leapfrog.hpp"

namespace edda {

/// v_{n+1/2} of the mesh nodes of the blocks [begin, end) and their positions at n + 1.
void advance_meshes(State& state, const Leap& leap, std::size_t begin, std::size_t end);

/// Changes v_{n+1/2} of the mesh of block i by what additional forces on it in the step do.
void push_mesh(State& state, const Leap& leap, const Kick& kick, const BodyVector& force,
               std::size_t i);

/// Adds to joules, [nb], what all damping of the meshes of the blocks [begin, end) has dissipated
/// in the step just made, over (x_{n+1} - x_{n-1})/2.
void account_meshes(const State& state, const Leap& leap, double* joules, std::size_t begin,
                    std::size_t end);

}  // namespace edda
