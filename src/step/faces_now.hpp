// What faces carry at the end of the last step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"
#include "contacts/face_reading.hpp"

namespace edda {

struct Simulation;

/// Face k at the end of the last step.
FaceRow face_row(const Simulation& sim, std::size_t k);

/// Whether it has opened after having been closed.
bool has_opened(const Simulation& sim, std::size_t k);

/// Work of face k accumulated until step n - 1, and the second half of the work of its dashpot
/// forces at n - 1, which is not yet in `damping`, J.
struct FaceWork {
  double friction, damping, fracture, transfer, damping_due;
};

/// What a row of history.csv needs of all faces, [nf] each.
struct FaceMeasures {
  std::vector<double> normal;  ///< N, as normal_force_now()
  std::vector<double> energy;  ///< stored between steps n - 1 and n, J
  std::vector<FaceWork> work;
};
FaceMeasures measure_faces(const Simulation& sim);

/// As is_closed() of contacts/face_reading.hpp, by what the tiles remember.
bool is_closed_now(const Simulation& sim, std::size_t k);

/// Normal force of face k, N, positive in compression, that of its dashpots included; 0 where it is
/// not closed.
double normal_force_now(const Simulation& sim, std::size_t k);
std::vector<double> normal_forces_now(const Simulation& sim);  ///< [nf]

/// Across a face; 0 where it is not closed.
struct NormalNow {
  double force = 0.0;   ///< N, as normal_force_now()
  double spring = 0.0;  ///< N/m, its stiffness w W k L
};
/// Of the faces of the blocks of which this is 1, [nb]; 0 for all others, [nf].
std::vector<NormalNow> normals_now(const Simulation& sim, const std::vector<std::uint8_t>& of);

/// Where blocks overlap most: the face with the largest ratio of closure to the inscribed radius of
/// the narrower block, of those at which they overlap (overlap_where_pressed()).
struct DeepestNow {
  std::size_t face = 0;
  double ratio = 0.0;  ///< 0: none is above the limit
  double depth = 0.0;  ///< m, the larger drawn closure of its ends
  Vec2 place;          ///< m, the corner that bounds the overlap at that end, local coordinates
};
/// That of all faces whose ratio is larger than `above`.
DeepestNow deepest_now(const Simulation& sim, double above);

}  // namespace edda
