// Random blocks of all shapes, thrown at each other without gravity.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "contacts/random_shapes.hpp"
#include "verification/scene.hpp"

namespace edda {

inline std::string block_text(const Ring& ring, const std::string& more = {}) {
  std::string text = "[[block]]\npolygon = [";
  for (Vec2 p : ring) text += "[" + number(p.x) + "," + number(p.y) + "],";
  return text + "]\n" + more;
}

struct ThrownBlock {
  Ring ring;
  Vec2 velocity;
  double spin = 0.0;
};

/// side x side blocks of 1 m, and at the farthest corner of each three grains in a row, of 0.03 m
/// down to `decades` powers of ten less; all move to the middle at about `speed` m/s, the grains
/// into their corner.
inline std::vector<ThrownBlock> thrown_blocks(unsigned seed, int side, double decades,
                                              double speed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<ThrownBlock> heap;
  const double cell = 2.25, middle = 0.5 * cell * (side - 1);
  for (int i = 0; i < side * side; ++i) {
    const Vec2 c = cell * Vec2{1.0 * (i % side), 1.0 * (i / side)};
    const Ring ring = random_shape(rng, c, 1.0, 0.02);
    const Vec2 v = speed * ((Vec2{middle, middle} - c) / (middle + 1.0) +
                            0.3 * Vec2{u(rng) - 0.5, u(rng) - 0.5});
    heap.push_back({ring, v, speed * (2.0 * u(rng) - 1.0)});
    if (decades <= 0.0) continue;
    const Vec2 tip = *std::max_element(ring.begin(), ring.end(),
                                       [&](Vec2 p, Vec2 q) { return norm(p - c) < norm(q - c); });
    const Vec2 out = unit(tip - c);
    const double size = 0.03 * std::pow(10.0, -decades * u(rng));
    for (int g = 0; g < 3; ++g) {
      heap.push_back({random_shape(rng, tip + (1.3 + 2.2 * g) * size * out, size, 0.02),
                      v - speed * out + 0.3 * speed * Vec2{u(rng) - 0.5, u(rng) - 0.5},
                      0.1 * speed / size * (2.0 * u(rng) - 1.0)});
    }
  }
  return heap;
}

inline std::string thrown_model(const std::vector<ThrownBlock>& heap, double friction,
                                const std::string& solver) {
  std::string toml =
      "gravity = [0.0, 0.0]\n[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = " +
      number(friction) + "\n[contact]\nnormal_stiffness = 2e11\n[solver]\n" + solver;
  for (const ThrownBlock& b : heap) {
    toml += block_text(b.ring, "velocity = [" + number(b.velocity.x) + "," + number(b.velocity.y) +
                                   "]\nangular_velocity = " + number(b.spin) + "\n");
  }
  return toml;
}

}  // namespace edda
