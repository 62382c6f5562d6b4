// Single numbers and bits of faces in tiles (contacts/face_tiles.hpp): columns of eight lanes.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <utility>

#include "base/vector_loop.hpp"
#include "contacts/face_states.hpp"
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
Fields get(const double* chunk, std::size_t lane) {
  std::array<double, columns_in<Fields>> numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = chunk[i * lanes + lane];
  return std::bit_cast<Fields>(numbers);
}
template <class Fields>
Fields get(const AlignedNumbers& table, std::size_t place) {
  return get<Fields>(table.data() + place / lanes * columns_in<Fields> * lanes, place % lanes);
}

/// The tables of TileNumbers, by the columns that they have.
template <class Fields>
inline constexpr AlignedNumbers (TileNumbers::*table_of)[2] = nullptr;
template <>
inline constexpr auto table_of<FaceMemoryColumns<double>> = &TileNumbers::memory;
template <>
inline constexpr auto table_of<DashpotMemoryColumns<double>> = &TileNumbers::dashpots;
template <>
inline constexpr auto table_of<PressureColumns<double>> = &TileNumbers::pressures;
template <>
inline constexpr auto table_of<FaceWorkColumns<double>> = &TileNumbers::work;

/// Calls visit.operator()<Fields>() for the tables of what faces remember.
template <class Visit>
void for_memory(const FaceTiles& t, Visit visit) {
  visit.template operator()<FaceMemoryColumns<double>>();
  if (t.dashpots) visit.template operator()<DashpotMemoryColumns<double>>();
  if (t.slip_laws) visit.template operator()<PressureColumns<double>>();
}

/// A column that holds a member of FaceFields.
template <class Fields>
struct KeptField {
  double FaceFields::*state;
  double Fields::*column;
};
/// Those of a table; but for the corners, which are no part of a state, all of its columns.
template <class Fields>
inline constexpr std::nullptr_t kept_fields = nullptr;
template <>
inline constexpr auto kept_fields<FaceMemoryColumns<double>> =
    std::to_array<KeptField<FaceMemoryColumns<double>>>(
        {{&FaceFields::slip_a, &FaceMemoryColumns<double>::slip_a},
         {&FaceFields::slip_b, &FaceMemoryColumns<double>::slip_b},
         {&FaceFields::overlap, &FaceMemoryColumns<double>::overlap},
         {&FaceFields::spring, &FaceMemoryColumns<double>::spring}});
template <>
inline constexpr auto kept_fields<DashpotMemoryColumns<double>> =
    std::to_array<KeptField<DashpotMemoryColumns<double>>>(
        {{&FaceFields::damping_a, &DashpotMemoryColumns<double>::damping_a},
         {&FaceFields::damping_b, &DashpotMemoryColumns<double>::damping_b},
         {&FaceFields::shear_damping_a, &DashpotMemoryColumns<double>::shear_damping_a},
         {&FaceFields::shear_damping_b, &DashpotMemoryColumns<double>::shear_damping_b},
         {&FaceFields::strike_a, &DashpotMemoryColumns<double>::strike_a},
         {&FaceFields::strike_b, &DashpotMemoryColumns<double>::strike_b}});
template <>
inline constexpr auto kept_fields<PressureColumns<double>> =
    std::to_array<KeptField<PressureColumns<double>>>(
        {{&FaceFields::normal_a, &PressureColumns<double>::normal_a},
         {&FaceFields::normal_b, &PressureColumns<double>::normal_b},
         {&FaceFields::length, &PressureColumns<double>::length},
         {&FaceFields::cohesive, &PressureColumns<double>::cohesive}});
template <>
inline constexpr auto kept_fields<FaceWorkColumns<double>> =
    std::to_array<KeptField<FaceWorkColumns<double>>>(
        {{&FaceFields::friction_work, &FaceWorkColumns<double>::friction_work},
         {&FaceFields::transfer, &FaceWorkColumns<double>::transfer},
         {&FaceFields::trial_a, &FaceWorkColumns<double>::trial_a},
         {&FaceFields::trial_b, &FaceWorkColumns<double>::trial_b},
         {&FaceFields::shear_a, &FaceWorkColumns<double>::shear_a},
         {&FaceFields::shear_b, &FaceWorkColumns<double>::shear_b},
         {&FaceFields::damping_work, &FaceWorkColumns<double>::damping_work},
         {&FaceFields::damping_due, &FaceWorkColumns<double>::damping_due}});
inline constexpr std::size_t corner_columns = 5;
static_assert(kept_fields<FaceMemoryColumns<double>>.size() + corner_columns == memory_columns &&
                  kept_fields<DashpotMemoryColumns<double>>.size() == dashpot_memory_columns &&
                  kept_fields<PressureColumns<double>>.size() == pressure_columns &&
                  kept_fields<FaceWorkColumns<double>>.size() == work_columns,
              "a column is not listed");

/// What a table holds of the state of a face.
template <class Fields>
Fields columns_of_state(const FaceFields& m) {
  Fields columns{};
  for (const KeptField<Fields>& kept : kept_fields<Fields>) columns.*kept.column = m.*kept.state;
  return columns;
}
template <class Fields>
void take_columns(FaceFields& m, const Fields& columns) {
  for (const KeptField<Fields>& kept : kept_fields<Fields>) m.*kept.state = columns.*kept.column;
}

/// The numbers of a chunk in one of these, of step n (which = FaceTiles::now) or n - 1. The tile
/// must hold it.
template <class Fields>
double* chunk_of(TileNumbers& of, int which, std::size_t chunk) {
  assert(of.holds(chunk));
  return (of.*table_of<Fields>)[which].data() +
         (chunk - of.first_chunk) * columns_in<Fields> * lanes;
}
template <class Fields>
double* chunk_of(FaceTiles& t, int which, std::size_t chunk) {
  return chunk_of<Fields>(t.numbers[t.tile_of_chunk[chunk]], which, chunk);
}
template <class Fields>
void put(FaceTiles& t, int which, std::size_t place, const Fields& values) {
  put(chunk_of<Fields>(t, which, place / lanes), place % lanes, values);
}
/// 0 where the tile does not hold the chunk.
template <class Fields>
Fields get(const TileNumbers& of, int which, std::size_t place) {
  const std::size_t chunk = place / lanes;
  if (!of.holds(chunk)) return {};
  return get<Fields>((of.*table_of<Fields>)[which], place - of.first_chunk * lanes);
}
template <class Fields>
Fields get(const FaceTiles& t, int which, std::size_t place) {
  return get<Fields>(t.numbers[t.tile_of_chunk[place / lanes]], which, place);
}

/// The number of one face in a column of these.
template <class Fields>
double& number_at(FaceTiles& t, int which, std::size_t place, double Fields::*column) {
  Fields count{};
  const auto at = static_cast<std::size_t>(&(count.*column) - reinterpret_cast<double*>(&count));
  return chunk_of<Fields>(t, which, place / lanes)[at * lanes + place % lanes];
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
  for (std::size_t place = chunk * lanes; place < (chunk + 1) * lanes; ++place)
    put(t, which, place, no_work(get<FaceMemoryColumns<double>>(t, which, place)));
}

inline void set_bit(LaneBits& bits, unsigned of, std::size_t lane, bool is) {
  const LaneBits bit = LaneBits{1} << (of + lane);
  bits = is ? bits | bit : bits & ~bit;
}

}  // namespace edda
