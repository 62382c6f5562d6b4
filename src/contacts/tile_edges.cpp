#include "contacts/tile_edges.hpp"

#include "contacts/edge_records.hpp"

namespace edda {

EDDA_VECTOR void place_edges(const VertexLinks& c, const Id* blocks, std::size_t count,
                             const Id* halo, std::size_t halo_count, const double* x,
                             const double* y, double* to) {
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

EDDA_VECTOR void gather_blocks(const EdgeForcesView& on, const Id* blocks, std::size_t count,
                               const std::uint8_t* wanted, const Id* record_begin,
                               const double* records) {
  const EdgeForcesView to = on;  // a copy that no store can change
  Id begin = *record_begin;      // of the records of an edge, which follow those of the edge before
  for (std::size_t n = 0; n < count; ++n) {
    const Id i = blocks[n], first = to.vertex_begin[i], last = to.vertex_begin[i + 1];
    if (wanted != nullptr && wanted[i] == 0) {
      record_begin += last - first;
      begin = *record_begin;
      continue;
    }
    const double* record = records + 4 * std::size_t{begin};
    EdgeForces of_block(to, i);
    for (Id e = first; e < last; ++e) {
      const Id end = *++record_begin;
      if (begin == end) {
        of_block.set_none(e);
        continue;
      }
      Four sum{};
      for (; begin != end; ++begin, record += 4) sum += four_at(record);
      of_block.set(e, sum);
    }
    of_block.store();
  }
}

}  // namespace edda
