// Faces change places within a tile (contacts/face_tiles.hpp).
#pragma once

#include "contacts/face_tiles.hpp"

namespace edda {

/// Kernel class of a face that carries load.
constexpr face_kind::Kind kind_of_loaded(bool short_formulas, bool dissipates) {
  if (short_formulas) return dissipates ? face_kind::short_work : face_kind::short_stick;
  return dissipates ? face_kind::long_work : face_kind::long_stick;
}

/// Lets the faces at two places of a tile change places, with all that they remember and have
/// found. The marks and the constants of their chunks, and the records, are left to the caller.
void swap_faces(FaceTiles& tiles, std::size_t place, std::size_t other);

}  // namespace edda
