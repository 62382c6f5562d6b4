#include "flow/node_forces.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
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

/// Calls f(rows) for each run of rows of the same key.
template <class Row, class Key, class F>
void for_runs(std::span<const Row> rows, const Key& key, const F& f) {
  for (std::size_t k = 0, end = 0; k < rows.size(); k = end) {
    while (end < rows.size() && key(rows[end]) == key(rows[k])) ++end;
    f(rows.subspan(k, end - k));
  }
}

/// Those with this key among rows that are sorted by it.
template <class Row, class Key>
std::span<const Row> with_key(std::span<const Row> rows, const Key& key, Id value) {
  const auto first =
      std::partition_point(rows.begin(), rows.end(), [&](const Row& r) { return key(r) < value; });
  const auto last =
      std::partition_point(first, rows.end(), [&](const Row& r) { return key(r) == value; });
  return {first, last};
}

constexpr auto block_of = [](const auto& row) { return row.block; };
constexpr auto corner_of = [](const auto& row) { return row.corner; };

/// Calls f(part, block, end, u) for the parts of edges of free blocks that water covers: the edge
/// goes to the corner `end` by u.
template <class F>
void for_walls(const FlowNetwork& net, const FlowScene& s, const F& f) {
  const BlockSet& b = s.blocks;
  for (const CoveredPart& part : net.covered) {
    const Id block = b.vertex_block[part.edge], end = b.next[part.edge];
    if (is_free(b, s.state, block))
      f(part, block, end, at(s.pose.x, s.pose.y, end) - at(s.pose.x, s.pose.y, part.edge));
  }
}

}  // namespace

std::vector<NodeForce> node_forces(const FlowNetwork& net, const FlowScene& s) {
  std::vector<NodeForce> forces;
  for_walls(net, s, [&](const CoveredPart& part, Id block, Id end, Vec2 u) {
    const FlowPipe& pipe = net.pipes[part.pipe];
    const Vec2 whole = -(part.to - part.from) * s.model.thickness * outward_normal(u);
    const auto add = [&](Id node, double at_from, double at_to) {
      const EndForces force = on_vertices(part.from, part.to, {at_from * whole, at_to * whole});
      forces.push_back({block, part.edge, node, force.at_from});
      forces.push_back({block, end, node, force.at_to});
    };
    const FaceEnds of_to =
        part.from_node == pipe.from ? pipe.of_to : FaceEnds{pipe.of_to.b, pipe.of_to.a};
    add(pipe.to, of_to.a, of_to.b);
    add(pipe.from, 0.5 - of_to.a, 0.5 - of_to.b);
  });
  merge(
      forces, [](const NodeForce& f) { return std::tuple(f.block, f.corner, f.node); },
      [](NodeForce& sum, const NodeForce& f) { sum.force += f.force; });
  return forces;
}

std::vector<EndOpening> end_openings(const FlowNetwork& net, const FlowScene& s) {
  std::vector<EndOpening> openings;
  for_walls(net, s, [&](const CoveredPart& part, Id block, Id end, Vec2 u) {
    const Vec2 inward = -1.0 / norm(u) * outward_normal(u);
    const Id first = part.from_node == net.pipes[part.pipe].from ? 0 : 1;
    const auto add = [&](Id side, double xi) {
      openings.push_back({block, part.edge, 2 * part.pipe + side, (1.0 - xi) * inward});
      openings.push_back({block, end, 2 * part.pipe + side, xi * inward});
    };
    add(first, part.from);
    add(1 - first, part.to);
  });
  std::erase_if(openings, [](const EndOpening& o) { return o.opens == Vec2{}; });
  std::stable_sort(openings.begin(), openings.end(), [](const auto& o, const auto& p) {
    return std::pair(o.block, o.corner) < std::pair(p.block, p.corner);
  });
  return openings;
}

std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces,
                                    const std::vector<EndOpening>& openings, const FlowScene& s,
                                    const Masses& masses, double seconds_squared) {
  std::vector<Storage::Give> gives, of_one;  // the latter of one block
  const auto add = [&](std::span<const EndOpening> of, std::span<const NodeForce> by) {
    const double moves =
        seconds_squared * inverse_product(masses, s.blocks, of.front().corner, by.front().corner);
    for (const EndOpening& o : of) {
      for (const NodeForce& f : by)
        of_one.push_back({o.end, f.node, moves * dot(o.opens, f.force)});
    }
  };
  const auto sum_up = [](std::vector<Storage::Give>& rows) {
    merge(
        rows, [](const Storage::Give& g) { return std::uint64_t{g.end} << 32U | g.node; },
        [](Storage::Give& sum, const Storage::Give& g) { sum.compliance += g.compliance; });
  };
  for_runs(std::span(openings), block_of, [&](std::span<const EndOpening> moved) {
    const Id block = moved.front().block;
    const std::span<const NodeForce> pressed = with_key(std::span(forces), block_of, block);
    of_one.clear();
    for_runs(moved, corner_of, [&](std::span<const EndOpening> of) {
      // The nodes of a mesh move each by its own force alone.
      const std::span<const NodeForce> by =
          s.blocks.is_meshed(block) ? with_key(pressed, corner_of, of.front().corner) : pressed;
      for_runs(by, corner_of, [&](std::span<const NodeForce> at_one) { add(of, at_one); });
    });
    sum_up(of_one);
    gives.insert(gives.end(), of_one.begin(), of_one.end());
  });
  sum_up(gives);
  return gives;
}

}  // namespace edda
