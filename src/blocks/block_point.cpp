#include "blocks/block_point.hpp"

#include <cmath>

namespace edda {
namespace {

/// lambda_v of the corners of block i at p.
std::vector<double> mean_value_coordinates(const BlockSet& b, std::size_t i, Vec2 p) {
  constexpr double on_edge = 1e-9;
  const Id first = b.vertex_begin[i], last = b.vertex_begin[i + 1];
  std::vector<double> lambda(last - first, 0.0);
  double sum = 0.0;
  for (Id v = first; v < last; ++v) {
    const Vec2 from = b.vertex(v) - p, to = b.vertex(b.next[v]) - p;
    const double near = norm(from), far = norm(to), product = dot(from, to),
                 area = cross(from, to);  // twice
    const double least = on_edge * b.edge_length[v] * b.edge_length[v];
    if (product <= least && std::abs(area) <= least) {
      // The point lies on this edge.
      lambda.assign(last - first, 0.0);
      const double part = near + far > 0.0 ? near / (near + far) : 0.0;
      lambda[v - first] = 1.0 - part;
      lambda[b.next[v] - first] = part;
      return lambda;
    }
    // Its tangent, written so that nothing cancels.
    const double half_angle =
        product < 0.0 ? (near * far - product) / area : area / (near * far + product);
    lambda[v - first] += half_angle / near;
    lambda[b.next[v] - first] += half_angle / far;
    sum += half_angle * (1.0 / near + 1.0 / far);
  }
  for (double& l : lambda) l /= sum;
  return lambda;
}

}  // namespace

BlockPoint block_point(const BlockSet& b, std::size_t i, Vec2 point) {
  const BlockModes modes = b.modes(i);
  BlockPoint p{i, weights_at(b, i, point)};
  if (modes.of_mesh()) {
    const Vec2 arm = point - Vec2{b.centroid_x[i], b.centroid_y[i]};
    const InZone in = in_its_zone(b.meshes, i, arms_of(b.meshes, i), arm);
    for (std::size_t k = 0; k < corners_of_zone; ++k)
      p.modes.push_back({b.meshes.zone[in.zone][k] - b.meshes.begin[i], in.weight[k]});
    return p;
  }
  if (modes.count == 0) return p;
  const std::vector<double> lambda = mean_value_coordinates(b, i, point);
  for (std::size_t a = 0; a < modes.count; ++a) {
    double part = 0.0;
    for (std::size_t at = 0; at < lambda.size(); ++at) part += lambda[at] * modes.of(a, at);
    p.modes.push_back({a, part});
  }
  return p;
}

BlockPoint corner_point(const BlockSet& b, Id v) {
  const std::size_t i = b.vertex_block[v], corner = v - b.vertex_begin[i];
  const BlockModes modes = b.modes(i);
  BlockPoint p{i, weights_of(b.weight, v)};
  if (modes.of_mesh()) {
    p.modes.push_back({corner, 1.0});
    return p;
  }
  for (std::size_t a = 0; a < modes.count; ++a) p.modes.push_back({a, modes.of(a, corner)});
  return p;
}

void push(BlockForces& on, const BlockPoint& p, Vec2 force, double factor) {
  spread(on.sum.nodes, p.nodes, force, factor);
  for (const auto& [mode, part] : p.modes)
    on.sum.modes.set(mode, on.sum.modes[mode] + part * (factor * force));
}

Vec2 at_point(const BodyVector& u, const BlockPoint& p) {
  Vec2 bent;
  for (const auto& [mode, part] : p.modes) bent += part * u.modes[mode];
  return weighted(p.nodes, u.nodes) + bent;
}

Vec2 at_point(const BlockSet& b, const BodyVectors& u, const BlockPoint& p) {
  const BlockModes modes = b.modes(p.block);
  Vec2 bent;
  for (const auto& [mode, part] : p.modes) bent += part * u.modes[modes[mode]];
  return weighted(p.nodes, vectors_of(u, p.block)) + bent;
}

}  // namespace edda
