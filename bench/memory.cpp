#include "memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <utility>

namespace edda {
namespace {

std::size_t in_use() {
  const struct mallinfo2 m = mallinfo2();
  return m.uordblks + m.hblkhd;
}

/// Bytes that go with what `part` holds.
template <class Part>
std::size_t freed(Part& part) {
  const std::size_t before = in_use();
  { const Part gone = std::exchange(part, Part{}); }
  const std::size_t after = in_use();
  return before > after ? before - after : 0;
}

}  // namespace

MemoryInUse take_apart(Simulation sim) {
  MemoryInUse m;
  m.contacts = freed(sim.contacts);
  m.state = freed(sim.state) + freed(sim.pose);
  m.blocks = freed(sim.blocks);
  m.polygons = freed(sim.polygons);
  m.model = freed(sim.model);
  m.rest = freed(sim);
  return m;
}

std::size_t peak_memory() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace edda
