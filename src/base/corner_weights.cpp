#include "base/corner_weights.hpp"

#include <algorithm>
#include <numeric>

namespace edda {

std::vector<double> corner_weights(const std::vector<Vec2>& corner,
                                   const std::vector<double>& tributary) {
  const std::size_t n = corner.size();
  const double all = std::accumulate(tributary.begin(), tributary.end(), 0.0);
  std::vector<double> weight(n);
  Vec2 centre;
  for (std::size_t v = 0; v < n; ++v) {
    weight[v] = tributary[v] / all;
    centre += weight[v] * corner[v];
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;  // moments about their centre
  for (std::size_t v = 0; v < n; ++v) {
    const Vec2 r = corner[v] - centre;
    xx += weight[v] * r.x * r.x;
    xy += weight[v] * r.x * r.y;
    yy += weight[v] * r.y * r.y;
  }
  const double det = xx * yy - xy * xy;
  if (!(det > 0.0)) return weight;
  // Sum w (1 + g . r) r = moments g from their centre, which is to be -centre.
  const Vec2 g{(xy * centre.y - yy * centre.x) / det, (xy * centre.x - xx * centre.y) / det};
  double least = 0.0;
  for (const Vec2 p : corner) least = std::min(least, dot(g, p - centre));
  constexpr double most = 0.75;
  const double part = std::min(1.0, most / std::max(-least, most));
  double sum = 0.0;
  for (std::size_t v = 0; v < n; ++v) {
    weight[v] *= 1.0 + part * dot(g, corner[v] - centre);
    sum += weight[v];
  }
  for (double& w : weight) w /= sum;
  return weight;
}

}  // namespace edda
