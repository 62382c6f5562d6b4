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
  Scene& scene = sim.scene.edit();
  m.contacts = freed(sim.motion.contacts);
  m.state = freed(sim.motion.state) + freed(sim.motion.pose);
  m.blocks = freed(scene.blocks);
  m.polygons = freed(scene.polygons);
  m.model = freed(scene.model);
  m.rest = freed(sim);
  return m;
}

std::size_t peak_memory() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace edda
