// One frame of the replay page, packed: six numbers per block for its motion, nine for its
// velocity, rotation and stress, the nodes and stresses of zones, and the contacts by edge.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "results/grid.hpp"
#include "view/mesh.hpp"

namespace edda {

/// Of contacts, in models in which water flows through joints.
inline constexpr std::array water_fields{"water_pressure", "head", "discharge", "aperture"};

/// How numbers are stored. single: as they are, to seven digits. whole16: as whole numbers of
/// steps, so that displacements of blocks are right to 1/65534 of the largest in the frame and
/// those of their corners to 1/10000, velocities, rotations and stresses to 1/4094, forces,
/// stresses, openings and slips of contacts to 1/254.
enum class ViewPrecision : std::uint32_t { whole16 = 16, single = 32 };

/// Displacements count from where the blocks were at a datum: the start, or a reset.
struct ViewDatum {
  std::vector<BlockMotion> motion;  ///< [nb] since the first frame
  std::vector<Vec2> moved;          ///< [nv] likewise, of the vertices of zoned blocks; else empty
};

/// Blocks of a frame.
struct ViewBlocks {
  std::vector<std::size_t> row;  ///< of the mesh, rising
  std::vector<std::size_t>
      cell;                      ///< the first of each, which has all values of a block of one cell
  std::vector<std::size_t> end;  ///< after its last one
};

/// The cells that have values of their own: all of zoned blocks, the first of others.
std::vector<std::size_t> valued_cells(const ViewMesh& mesh, const ViewBlocks& in);

/// Faults: a block that the first frame does not have, or other vertices.
Result<ViewBlocks> blocks_in(const ViewMesh& mesh, const Grid& blocks);

/// The datum of a frame, where it differs from the previous one (null: none yet).
bool find_datum(const ViewMesh& mesh, const Grid& blocks, const ViewBlocks& in,
                const ViewDatum* before, ViewDatum& found);

/// Six f32 columns d.x d.y A.xx A.xy A.yx A.yy, as in a frame, then two of the vertices of zoned
/// blocks.
std::string datum_bytes(const ViewMesh& mesh, const ViewDatum& datum);

/// `datum`: number of the current one. `contacts` may be null.
std::string frame_bytes(const ViewMesh& mesh, const ViewBlocks& in, const Grid& blocks,
                        const Grid* contacts, ViewPrecision precision, std::size_t datum);

}  // namespace edda
