#include "contacts/tile_packing.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "contacts/tile_columns.hpp"

namespace edda {
namespace {

void swap_numbers(AlignedNumbers& table, std::size_t columns, std::size_t a, std::size_t b) {
  double* const p = table.data() + a / lanes * columns * lanes + a % lanes;
  double* const q = table.data() + b / lanes * columns * lanes + b % lanes;
  for (std::size_t i = 0; i < columns; ++i) std::swap(p[i * lanes], q[i * lanes]);
}

/// The same in a table of TileNumbers; what a tile does not hold is 0.
template <class Fields>
void swap_numbers(TileNumbers& of, int which, std::size_t a, std::size_t b) {
  const auto of_a = get<Fields>(of, which, a), of_b = get<Fields>(of, which, b);
  if (of.holds(a / lanes)) put(chunk_of<Fields>(of, which, a / lanes), a % lanes, of_b);
  if (of.holds(b / lanes)) put(chunk_of<Fields>(of, which, b / lanes), b % lanes, of_a);
}

/// Exchanges the bits of two lanes in every field.
template <class Bits>
void swap_bits(std::vector<Bits>& bits, Bits every, std::size_t a, std::size_t b) {
  const auto lane_of = [&](std::size_t place) {
    return static_cast<Bits>(bits[place / lanes] >> (place % lanes) & every);
  };
  const auto set = [&](std::size_t place, Bits to) {
    Bits& in = bits[place / lanes];
    const auto lane = place % lanes;
    in =
        static_cast<Bits>((in & ~static_cast<Bits>(every << lane)) | static_cast<Bits>(to << lane));
  };
  const Bits of_a = lane_of(a), of_b = lane_of(b);
  set(a, of_b);
  set(b, of_a);
}

}  // namespace

void swap_faces(FaceTiles& t, std::size_t a, std::size_t b) {
  const std::size_t p = a / lanes, q = b / lanes;
  std::swap(t.face[a], t.face[b]);
  std::swap(t.slot_e[a], t.slot_e[b]);
  std::swap(t.slot_f[a], t.slot_f[b]);
  swap_bits(t.owned, std::uint8_t{1}, a, b);
  swap_numbers(t.sums, sum_columns, a, b);
  constexpr LaneBits every = 0x0101010101010101;
  swap_bits(t.ever, every, a, b);
  TileNumbers& numbers = t.numbers[t.tile_of_chunk[p]];
  for (const int which : {0, 1}) {
    if (t.fresh[which][p] != 0 || t.fresh[which][q] != 0) {
      for (const std::size_t chunk : {p, q}) {
        if (numbers.holds(chunk)) begin_work(t, which, chunk);
      }
      swap_numbers<FaceWorkColumns<double>>(numbers, which, a, b);
    }
    for_memory(t, [&]<class Fields>() { swap_numbers<Fields>(numbers, which, a, b); });
    swap_bits(t.bits[which], every, a, b);
    swap_bits(t.found[which], every, a, b);
  }
  for (const std::size_t place : {a, b}) {
    if (t.face[place] == no_id) continue;
    const bool owns = (t.owned[place / lanes] >> (place % lanes) & 1u) != 0;
    // The other copy of the face may be looked for in another tile just now (order_records()).
    std::atomic_ref<Id>(t.place[t.face[place]][owns ? 0 : 1])
        .store(static_cast<Id>(place), std::memory_order_relaxed);
  }
}

}  // namespace edda
