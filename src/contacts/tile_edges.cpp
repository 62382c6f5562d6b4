#include "contacts/tile_edges.hpp"

#include "blocks/edge_forces.hpp"
#include "contacts/edge_records.hpp"

namespace edda {

EDDA_VECTOR void place_edges(const Corners& c, const Id* blocks, std::size_t count, const Id* halo,
                             std::size_t halo_count, const double* x, const double* y, double* to) {
  const auto corner = [&](Id v) __attribute__((always_inline)) {
    return Two{x[v], y[v]};
  };
  std::size_t base = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const Id i = blocks[n], first = c.vertex_begin[i], last = c.vertex_begin[i + 1];
    for (Id v = first; v < last; ++v) {
      const Two p = corner(v);
      *reinterpret_cast<Two*>(to + 4 * (base + (v - first))) = p;
      *reinterpret_cast<Two*>(to + 4 * (base + (c.previous[v] - first)) + 2) = p;
    }
    base += last - first;
  }
  for (std::size_t n = 0; n < halo_count; ++n) {
    const Id v = halo[n];
    *reinterpret_cast<Two*>(to + 4 * (base + n)) = corner(v);
    *reinterpret_cast<Two*>(to + 4 * (base + n) + 2) = corner(c.next[v]);
  }
}

EDDA_VECTOR void gather_blocks(const Corners& c, const Id* blocks, std::size_t count,
                               const std::uint8_t* wanted, const Id* record_begin,
                               const double* records, NodeValues fx, NodeValues fy,
                               ModeForces modes) {
  const ConstNodeValues weight = c.weight;  // copies that no store can change
  const Id* const next = c.next;
  Id begin = *record_begin;  // of the records of an edge, which follow those of the edge before
  for (std::size_t n = 0; n < count; ++n) {
    const Id i = blocks[n], first = c.vertex_begin[i], last = c.vertex_begin[i + 1];
    if (wanted != nullptr && wanted[i] == 0) {
      record_begin += last - first;
      begin = *record_begin;
      continue;
    }
    const double* record = records + 4 * std::size_t{begin};
    const bool bends = modes.bending != nullptr && modes.bending->modes_of(i) > 0;
    Four sums[most_corners_that_bend];
    EdgeForces on;
    for (Id e = first; e < last; ++e) {
      const Id end = *++record_begin;
      if (bends) sums[e - first] = Four{};
      if (begin == end) continue;
      Four sum{};
      for (; begin != end; ++begin, record += 4) sum += four_at(record);
      on.add(weight, e, next[e], sum);
      if (bends) sums[e - first] = sum;
    }
    store(on.on_nodes(), fx, fy, i);
    if (bends)
      gather_modes(modes_of(*modes.bending, i, last - first), next + first, first, sums, modes.x,
                   modes.y);
  }
}

}  // namespace edda
