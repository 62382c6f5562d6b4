// Single numbers and bits of faces in tiles (contacts/face_tiles.hpp): columns of eight lanes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "base/vector_loop.hpp"
#include "contacts/face_tiles.hpp"

namespace edda {

template <class Fields>
inline constexpr std::size_t columns_in = sizeof(Fields) / sizeof(double);

/// The numbers of a chunk in a table with the columns of Fields, [columns][8].
template <class Fields>
double* chunk_of(AlignedNumbers& table, std::size_t chunk) {
  return table.data() + chunk * columns_in<Fields> * lanes;
}

/// The columns of a chunk, whose numbers begin here; for loops over lanes.
template <class Fields, class Number>
EDDA_INLINE Fields columns_from(Number* first) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
    return Fields{(first + i * lanes)...};
  }
  (std::make_index_sequence<columns_in<Fields>>{});
}

/// Writes the numbers of one face to its lane of a chunk.
template <class Fields>
void put(double* chunk, std::size_t lane, const Fields& values) {
  const auto numbers = std::bit_cast<std::array<double, columns_in<Fields>>>(values);
  for (std::size_t i = 0; i < numbers.size(); ++i) chunk[i * lanes + lane] = numbers[i];
}
template <class Fields>
void put(AlignedNumbers& table, std::size_t place, const Fields& values) {
  put(chunk_of<Fields>(table, place / lanes), place % lanes, values);
}

/// Reads the numbers of one face from its lane of a chunk.
template <class Fields>
Fields get(const AlignedNumbers& table, std::size_t place) {
  std::array<double, columns_in<Fields>> numbers;
  const double* const from =
      table.data() + place / lanes * columns_in<Fields> * lanes + place % lanes;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = from[i * lanes];
  return std::bit_cast<Fields>(numbers);
}

/// The number of one face in a column of a table with the columns of Fields.
template <class Fields>
double& number_at(AlignedNumbers& table, std::size_t place, double Fields::*column) {
  Fields count{};
  const auto at = static_cast<std::size_t>(&(count.*column) - reinterpret_cast<double*>(&count));
  return table[(place / lanes * columns_in<Fields> + at) * lanes + place % lanes];
}

/// The work of a face that sticks and does none, from its memory of that step.
inline FaceWorkColumns<double> no_work(const FaceMemoryColumns<double>& m) {
  FaceWorkColumns<double> work{};
  work.trial_a = m.slip_a;
  work.trial_b = m.slip_b;
  work.shear_a = -m.spring * m.slip_a;
  work.shear_b = -m.spring * m.slip_b;
  return work;
}

/// Gives a chunk of which no work is kept that of faces which stick and do none.
inline void begin_work(FaceTiles& t, int which, std::size_t chunk) {
  if (t.fresh[which][chunk] != 0) return;
  t.fresh[which][chunk] = 1;
  for (std::size_t place = chunk * lanes; place < (chunk + 1) * lanes; ++place) {
    put(t.work[which], place, no_work(get<FaceMemoryColumns<double>>(t.memory[which], place)));
  }
}

inline void set_bit(LaneBits& bits, unsigned of, std::size_t lane, bool is) {
  const LaneBits bit = LaneBits{1} << (of + lane);
  bits = is ? bits | bit : bits & ~bit;
}

}  // namespace edda
