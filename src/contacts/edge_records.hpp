// Records of four numbers, such as both ends of an edge, read and written for eight faces at once.
#pragma once

#include <cstddef>

#include "base/vector_loop.hpp"
#include "contacts/face_tiles.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {

EDDA_INLINE Four four_at(const double* from) {
  return *reinterpret_cast<const Four*>(from);
}

/// Four columns of a chunk, [4][8]: the records of its lanes, transposed.
struct Records {
  alignas(64) double column[4][lanes];
};

/// Four records of four numbers by columns, or four columns by records. In vectors of 32 bytes,
/// since g++ takes longer ones apart, through memory, where the processor has no such registers.
struct FourByFour {
  Four v[4];
};
EDDA_INLINE FourByFour transposed(Four a, Four b, Four c, Four d) {
  const Four ab_02 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four ab_13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_02 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four cd_13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {{__builtin_shufflevector(ab_02, cd_02, 0, 1, 4, 5),
           __builtin_shufflevector(ab_13, cd_13, 0, 1, 4, 5),
           __builtin_shufflevector(ab_02, cd_02, 2, 3, 6, 7),
           __builtin_shufflevector(ab_13, cd_13, 2, 3, 6, 7)}};
}

/// Reads the records of a chunk; record(which[k]): that of lane k.
template <class Record>
EDDA_INLINE void read_records(Record record, const Id* which, Records& to) {
  for (std::size_t k = 0; k < lanes; k += 4) {
    const FourByFour columns = transposed(record(which[k]), record(which[k + 1]),
                                          record(which[k + 2]), record(which[k + 3]));
    for (std::size_t i = 0; i < 4; ++i) *reinterpret_cast<Four*>(&to.column[i][k]) = columns.v[i];
  }
}

/// Stores the records of the lanes of a chunk.
EDDA_INLINE void store_records(double* to, const Id* record, const Records& from) {
  for (std::size_t k = 0; k < lanes; k += 4) {
    const FourByFour records = transposed(four_at(&from.column[0][k]), four_at(&from.column[1][k]),
                                          four_at(&from.column[2][k]), four_at(&from.column[3][k]));
    for (std::size_t i = 0; i < 4; ++i)
      *reinterpret_cast<Four*>(to + 4 * std::size_t{record[k + i]}) = records.v[i];
  }
}

}  // namespace edda
