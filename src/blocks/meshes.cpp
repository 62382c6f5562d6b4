#include "blocks/meshes.hpp"

#include <algorithm>
#include <limits>

#include "blocks/cover.hpp"

namespace edda {
namespace {

/// Makes way for the next block.
void begin_block(Meshes& m) {
  if (m.begin.empty()) {
    m.begin.push_back(0);
    m.zone_begin.push_back(0);
  }
  m.inverse.push_back({});
}

void end_block(Meshes& m) {
  m.begin.push_back(static_cast<std::uint32_t>(m.share.size()));
  m.zone_begin.push_back(static_cast<std::uint32_t>(m.zone.size()));
}

}  // namespace

double Meshes::inverse_product(std::size_t i, std::size_t j, std::size_t k) const {
  const AffinePart unit = solve(i, {{1.0, 0.0}, {arm_x[k], 0.0}, {arm_y[k], 0.0}});
  return (j == k ? 1.0 / share[j] : 0.0) - at(unit, j).x;
}

std::array<Vec2, corners_of_zone> area_gradients(Vec2 a, Vec2 b, Vec2 c) {
  const double per = 1.0 / cross(b - a, c - a);
  const auto gradient = [per](Vec2 from, Vec2 to) {
    return Vec2{per * (from.y - to.y), per * (to.x - from.x)};
  };
  return {gradient(b, c), gradient(c, a), gradient(a, b)};
}

InZone in_its_zone(const Meshes& m, std::size_t i, std::span<const Vec2> node, Vec2 p) {
  InZone best;
  double largest = -std::numeric_limits<double>::infinity();
  const auto place = [&](std::uint32_t j) { return node[j - m.begin[i]]; };
  for (std::size_t z = m.zone_begin[i]; z < m.zone_begin[i + 1]; ++z) {
    const auto [a, b, c] = m.zone[z];
    const Vec2 u = place(b) - place(a), v = place(c) - place(a), w = p - place(a);
    const double twice = cross(u, v), of_b = cross(w, v) / twice, of_c = cross(u, w) / twice;
    const double least = std::min({1.0 - of_b - of_c, of_b, of_c});
    if (!(least > largest)) continue;
    largest = least;
    best = {z, {1.0 - of_b - of_c, of_b, of_c}};
  }
  return best;
}

std::vector<Vec2> arms_of(const Meshes& m, std::size_t i) {
  std::vector<Vec2> arms;
  for (std::uint32_t j = m.begin[i]; j < m.begin[i + 1]; ++j)
    arms.push_back({m.arm_x[j], m.arm_y[j]});
  return arms;
}

void add_mesh(Meshes& m, const BlockMesh& mesh) {
  begin_block(m);
  const std::size_t first = m.share.size();
  m.share.resize(first + mesh.node.size(), 0.0);
  double area = 0.0;
  for (std::size_t j = 0; j < mesh.area.size(); ++j) m.share[first + j] = mesh.area[j];
  for (const std::array<std::uint32_t, 3>& t : mesh.triangle) {
    const Vec2 a = mesh.node[t[0]], b = mesh.node[t[1]], c = mesh.node[t[2]];
    const double twice = cross(b - a, c - a);
    area += 0.5 * twice;
    std::array<std::uint32_t, 3> zone;
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.area.empty()) m.share[first + t[k]] += twice / 6.0;
      zone[k] = static_cast<std::uint32_t>(first) + t[k];
    }
    m.zone.push_back(zone);
  }
  std::array<double, 6> g{};
  for (std::size_t j = 0; j < mesh.node.size(); ++j) {
    const Vec2 arm = mesh.node[j];
    m.arm_x.push_back(arm.x);
    m.arm_y.push_back(arm.y);
    const double share = m.share[first + j] /= area;
    g[0] += share;
    g[1] += share * arm.x;
    g[2] += share * arm.y;
    g[3] += share * arm.x * arm.x;
    g[4] += share * arm.x * arm.y;
    g[5] += share * arm.y * arm.y;
  }
  m.inverse.back() = inverse_symmetric(g);
  end_block(m);
}

void add_no_mesh(Meshes& m) {
  begin_block(m);
  end_block(m);
}

}  // namespace edda
