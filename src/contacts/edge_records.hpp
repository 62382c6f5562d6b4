// Records of four numbers, such as both ends of an edge, read and written for eight faces at once.
#pragma once

#include <cstddef>

#include "base/vector_loop.hpp"
#include "contacts/face_tiles.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {

using Two __attribute__((vector_size(16), aligned(16))) = double;
using Eight __attribute__((vector_size(64))) = double;

EDDA_INLINE Two two_at(const double* from) {
  return *reinterpret_cast<const Two*>(from);
}
EDDA_INLINE Four four_at(const double* from) {
  return *reinterpret_cast<const Four*>(from);
}

/// Four columns of a chunk, [4][8]: the records of its lanes, transposed.
struct Records {
  alignas(64) double column[4][lanes];
};

EDDA_INLINE Eight side_by_side(Four a, Four b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
EDDA_INLINE void store(double* to, Eight v) {
  *reinterpret_cast<Eight*>(to) = v;
}

/// Reads the records of the slots of a chunk.
EDDA_INLINE void read_records(const double* from, const Id* slot, Records& to) {
  const auto pair = [&](std::size_t a, std::size_t b) __attribute__((always_inline)) {
    return side_by_side(four_at(from + 4 * std::size_t{slot[a]}),
                        four_at(from + 4 * std::size_t{slot[b]}));
  };
  const Eight a = pair(0, 4), b = pair(1, 5), c = pair(2, 6), d = pair(3, 7);
  const Eight p = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight q = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight r = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight s = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  store(to.column[0], __builtin_shufflevector(p, r, 0, 1, 8, 9, 4, 5, 12, 13));
  store(to.column[1], __builtin_shufflevector(q, s, 0, 1, 8, 9, 4, 5, 12, 13));
  store(to.column[2], __builtin_shufflevector(p, r, 2, 3, 10, 11, 6, 7, 14, 15));
  store(to.column[3], __builtin_shufflevector(q, s, 2, 3, 10, 11, 6, 7, 14, 15));
}

/// Records of eight lanes in pairs of columns: lanes 0, 2, 4, 6 and 1, 3, 5, 7.
struct PairsOfColumns {
  Eight even_12, odd_12, even_34, odd_34;
};
EDDA_INLINE PairsOfColumns in_pairs(const Records& from) {
  const auto column = [&](std::size_t i) __attribute__((always_inline)) {
    return *reinterpret_cast<const Eight*>(from.column[i]);
  };
  const Eight x1 = column(0), y1 = column(1), x2 = column(2), y2 = column(3);
  return {__builtin_shufflevector(x1, y1, 0, 8, 2, 10, 4, 12, 6, 14),
          __builtin_shufflevector(x1, y1, 1, 9, 3, 11, 5, 13, 7, 15),
          __builtin_shufflevector(x2, y2, 0, 8, 2, 10, 4, 12, 6, 14),
          __builtin_shufflevector(x2, y2, 1, 9, 3, 11, 5, 13, 7, 15)};
}
/// The records of two lanes that follow each other, from their pairs of columns.
template <int first>
EDDA_INLINE Four record_of(Eight columns_12, Eight columns_34) {
  return __builtin_shufflevector(columns_12, columns_34, first, first + 1, first + 8, first + 9);
}

/// Stores the records of the lanes of a chunk.
EDDA_INLINE void store_records(double* to, const Id* record, const Records& from) {
  const PairsOfColumns of = in_pairs(from);
  const auto put = [&](Id at, Four v) __attribute__((always_inline)) {
    *reinterpret_cast<Four*>(to + 4 * std::size_t{at}) = v;
  };
  put(record[0], record_of<0>(of.even_12, of.even_34));
  put(record[1], record_of<0>(of.odd_12, of.odd_34));
  put(record[2], record_of<2>(of.even_12, of.even_34));
  put(record[3], record_of<2>(of.odd_12, of.odd_34));
  put(record[4], record_of<4>(of.even_12, of.even_34));
  put(record[5], record_of<4>(of.odd_12, of.odd_34));
  put(record[6], record_of<6>(of.even_12, of.even_34));
  put(record[7], record_of<6>(of.odd_12, of.odd_34));
}

}  // namespace edda
