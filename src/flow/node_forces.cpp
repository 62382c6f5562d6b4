#include "flow/node_forces.hpp"

#include <algorithm>
#include <tuple>

#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"

namespace edda {
namespace {

/// Sorts rows by key(row), and adds up those with the same key.
template <class Row, class Key, class Add>
void merge(std::vector<Row>& rows, const Key& key, const Add& add) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const Row& r, const Row& q) { return key(r) < key(q); });
  std::size_t count = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (count > 0 && key(rows[count - 1]) == key(rows[k])) {
      add(rows[count - 1], rows[k]);
    } else {
      rows[count++] = rows[k];
    }
  }
  rows.resize(count);
}

}  // namespace

std::vector<NodeForce> node_forces(const FlowNetwork& net, const FlowScene& s) {
  const BlockSet& b = s.blocks;
  std::vector<NodeForce> forces;
  for (const CoveredPart& part : net.covered) {
    const Id block = b.vertex_block[part.edge];
    if (!is_free(b, s.state, block)) continue;
    const FlowPipe& pipe = net.pipes[part.pipe];
    const Id end = b.next[part.edge];
    const Vec2 u = at(s.pose.x, s.pose.y, end) - at(s.pose.x, s.pose.y, part.edge);
    const Vec2 whole = -(part.to - part.from) * s.model.thickness * outward_normal(u);
    const bool along = part.from_node == pipe.from;
    const FaceEnds follows = along ? pipe.follows : FaceEnds{pipe.follows.b, pipe.follows.a};
    const auto add = [&](Id node, FaceEnds presses, FaceEnds opens) {
      const EndForces force =
          on_vertices(part.from, part.to, {presses.a * whole, presses.b * whole});
      const EndForces open = on_vertices(
          part.from, part.to, {opens.a * follows.a * whole, opens.b * follows.b * whole});
      forces.push_back({block, part.edge, node, force.at_from, open.at_from});
      forces.push_back({block, end, node, force.at_to, open.at_to});
    };
    const FaceEnds of_to = along ? pipe.of_to : FaceEnds{pipe.of_to.b, pipe.of_to.a};
    const FaceEnds of_a{1.0 / 3.0, 1.0 / 6.0}, of_b{1.0 / 6.0, 1.0 / 3.0};
    add(pipe.to, of_to, along ? of_b : of_a);
    add(pipe.from, {0.5 - of_to.a, 0.5 - of_to.b}, along ? of_a : of_b);
  }
  merge(
      forces, [](const NodeForce& f) { return std::tuple(f.block, f.corner, f.node); },
      [](NodeForce& sum, const NodeForce& f) {
        sum.force += f.force;
        sum.opens += f.opens;
      });
  return forces;
}

std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces, const FlowScene& s,
                                    const Masses& masses, double seconds_squared) {
  std::vector<Storage::Give> gives;
  const double factor = seconds_squared / s.model.thickness;
  const auto end_of = [&](std::size_t k, auto of) {
    const std::size_t first = k;
    while (k < forces.size() && of(forces[k]) == of(forces[first])) ++k;
    return k;
  };
  const auto block_of = [](const NodeForce& f) { return f.block; };
  const auto corner_of = [](const NodeForce& f) { return f.corner; };
  for (std::size_t begin = 0, end = 0; begin < forces.size(); begin = end) {
    end = end_of(begin, block_of);
    const bool meshed = s.blocks.is_meshed(forces[begin].block);
    for (std::size_t k = begin, k_end = begin; k < end; k = k_end) {
      k_end = end_of(k, corner_of);
      for (std::size_t q = meshed ? k : begin, q_end = q; q < (meshed ? k_end : end); q = q_end) {
        q_end = end_of(q, corner_of);
        const double moves =
            factor * inverse_product(masses, s.blocks, forces[q].corner, forces[k].corner);
        for (std::size_t of = q; of < q_end; ++of) {
          for (std::size_t by = k; by < k_end; ++by)
            gives.push_back({forces[of].node, forces[by].node,
                             moves * dot(forces[of].opens, forces[by].force)});
        }
      }
    }
  }
  merge(
      gives, [](const Storage::Give& g) { return std::pair(g.node, g.other); },
      [](Storage::Give& sum, const Storage::Give& g) { sum.compliance += g.compliance; });
  return gives;
}

}  // namespace edda
