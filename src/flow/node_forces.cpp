#include "flow/node_forces.hpp"

#include <algorithm>
#include <tuple>

#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"

namespace edda {

std::vector<NodeForce> node_forces(const FlowNetwork& net, const FlowScene& s) {
  const BlockSet& b = s.blocks;
  std::vector<NodeForce> forces;
  for (const CoveredPart& part : net.covered) {
    const Id block = b.vertex_block[part.edge];
    if (!is_free(b, s.state, block)) continue;
    const FlowPipe& pipe = net.pipes[part.pipe];
    const Id other = part.from_node == pipe.from ? pipe.to : pipe.from;
    const Id end = b.next[part.edge];
    const Vec2 u = at(s.pose.x, s.pose.y, end) - at(s.pose.x, s.pose.y, part.edge);
    const Vec2 whole = -(part.to - part.from) * s.model.thickness * outward_normal(u);
    const FaceEnds follows =
        part.from_node == pipe.from ? pipe.follows : FaceEnds{pipe.follows.b, pipe.follows.a};
    const auto on_block = [&](double at_from, double at_to) {
      BlockForces on{b, block};
      const EndForces ends = on_vertices(part.from, part.to, {at_from * whole, at_to * whole});
      on.at_corner(part.edge, ends.at_from);
      on.at_corner(end, ends.at_to);
      return on.sum;
    };
    const auto add = [&](Id node, double at_from, double at_to) {
      forces.push_back({block, node, on_block(at_from, at_to),
                        on_block(follows.a * at_from, follows.b * at_to)});
    };
    add(part.from_node, 1.0 / 3.0, 1.0 / 6.0);
    add(other, 1.0 / 6.0, 1.0 / 3.0);
  }
  const auto key = [](const NodeForce& f) { return std::tuple(f.block, f.node); };
  std::stable_sort(forces.begin(), forces.end(),
                   [&](const NodeForce& f, const NodeForce& g) { return key(f) < key(g); });
  std::size_t count = 0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (count > 0 && key(forces[count - 1]) == key(forces[k])) {
      forces[count - 1].force += forces[k].force;
      forces[count - 1].opens += forces[k].opens;
    } else {
      if (count != k) forces[count] = forces[k];
      ++count;
    }
  }
  forces.erase(forces.begin() + static_cast<std::ptrdiff_t>(count), forces.end());
  return forces;
}

std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces, const FlowScene& s,
                                    const Masses& masses, double seconds_squared) {
  std::vector<Storage::Give> gives;
  const double factor = seconds_squared / s.model.thickness;
  for (std::size_t begin = 0, end = 0; begin < forces.size(); begin = end) {
    while (end < forces.size() && forces[end].block == forces[begin].block) ++end;
    for (std::size_t k = begin; k < end; ++k) {
      const BodyVector moves = accelerations(masses, s.blocks, forces[k].block, forces[k].force);
      for (std::size_t q = begin; q < end; ++q)
        gives.push_back({forces[q].node, forces[k].node, factor * dot(forces[q].opens, moves)});
    }
  }
  std::stable_sort(gives.begin(), gives.end(), [](const auto& g, const auto& f) {
    return std::tuple(g.node, g.other) < std::tuple(f.node, f.other);
  });
  return gives;
}

}  // namespace edda
