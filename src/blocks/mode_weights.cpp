#include "blocks/mode_weights.hpp"

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

std::vector<double> mode_weights(const BlockSet& b, std::size_t i, Vec2 point) {
  const BlockModes modes = b.modes(i);
  std::vector<double> weights(modes.count, 0.0);
  if (modes.count == 0) return weights;
  const std::vector<double> lambda = mean_value_coordinates(b, i, point);
  for (std::size_t a = 0; a < modes.count; ++a) {
    for (std::size_t at = 0; at < lambda.size(); ++at) weights[a] += lambda[at] * modes.of(a, at);
  }
  return weights;
}

Vec2 weighted_modes(const BlockSet& b, std::size_t i, const std::vector<double>& weights,
                    const ModeVectors& v) {
  const BlockModes modes = b.modes(i);
  Vec2 sum;
  for (std::size_t a = 0; a < weights.size(); ++a) sum += weights[a] * v[modes[a]];
  return sum;
}

}  // namespace edda
