// Linings that come into being between two steps.
#include "cutting/linings.hpp"
#include "blocks/build_blocks.hpp"
#include "step/births.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"
#include "step/step_control.hpp"

namespace edda {
namespace {

/// Where the mesh nodes of a lining are when it is put on the walls as they are now.
std::vector<Vec2> nodes_on_walls(const Simulation& sim, std::size_t i) {
  constexpr double rounding = 1e-3;  // of the thickness
  const BlockSet& b = sim.scene->blocks;
  const StripSections s = sections_of(b, i);
  const double thickness = 2.0 * b.inradius[i];
  std::vector<std::optional<Vec2>> moved;
  std::vector<Vec2> outer;
  for (std::uint32_t k = 0; k < s.count; ++k) {
    outer.push_back(b.vertex(b.vertex_begin[i] + s.outer(k)));
    moved.push_back(
        displacement_of_walls(sim, sim.motion.state.alive, outer.back(), rounding * thickness));
  }
  const std::vector<Vec2> by = completed(moved, s.closed);
  for (std::size_t k = 0; k < outer.size(); ++k) outer[k] += by[k];
  // End sections turn with the pieces that they end.
  const auto turned = [&](std::uint32_t end, std::uint32_t before) {
    const std::uint32_t v = b.vertex_begin[i];
    const Vec2 as_drawn = unit(b.vertex(v + s.outer(end)) - b.vertex(v + s.outer(before))),
               now = unit(outer[end] - outer[before]),
               section = b.vertex(v + s.inner(end)) - b.vertex(v + s.outer(end));
    return dot(section, as_drawn) * now + cross(as_drawn, section) * perp(now);
  };
  const EndSections ends =
      s.closed ? EndSections{} : EndSections{turned(0, 1), turned(s.count - 1, s.count - 2)};
  const std::vector<Vec2> inner = inner_side(outer, s.closed, thickness, ends);
  std::vector<Vec2> node(2 * outer.size());
  for (std::uint32_t k = 0; k < s.count; ++k) {
    node[s.outer(k)] = outer[k];
    node[s.inner(k)] = inner[k];
  }
  return node;
}

}  // namespace

void install_linings(Simulation& sim, const std::vector<Index>& rows) {
  const BlockSet& b = sim.scene->blocks;
  for (const Index row : rows) {
    std::vector<Id> born;
    for (Id i = 0; i < b.size(); ++i) {
      if (b.is_lining(i) && b.lining[i] == row && sim.motion.state.alive[i] == 0) born.push_back(i);
    }
    for (const Id i : born) {
      place_mesh(sim, i, nodes_on_walls(sim, i));
      begin_lining(sim.scene->zones, b, sim.motion.state, i, sim.motion.zones);
    }
    begin_blocks(sim, born);
  }
  set_limit(sim);
}

}  // namespace edda
