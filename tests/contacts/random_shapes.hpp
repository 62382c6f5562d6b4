// Random blocks for the tests of contacts: compact, strongly non-convex, needles and slivers.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "base/polygon.hpp"
#include "base/vec2.hpp"

namespace edda {

/// A simple polygon of about the given size (m) around `centre`, corners counter-clockwise; needles
/// and slivers of thickness over length from 0.1 down to `thinnest`.
inline Ring random_shape(std::mt19937& rng, Vec2 centre, double size, double thinnest = 1e-3) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Ring ring;
  const double turn = 2.0 * std::numbers::pi * u(rng);
  auto add = [&](Vec2 p) { ring.push_back(centre + rotated(size * p, turn)); };
  auto round = [&](int corners, double least) {
    for (int k = 0; k < corners; ++k) {
      const double a = 2.0 * std::numbers::pi * (k + 0.4 * u(rng)) / corners;
      add((least + (1.0 - least) * u(rng)) * Vec2{std::cos(a), std::sin(a)});
    }
  };
  const double kind = u(rng), thin = 0.1 * std::pow(10.0 * thinnest, u(rng));
  if (kind < 0.4) {  // compact
    round(3 + static_cast<int>(6.0 * u(rng)), 0.7);
  } else if (kind < 0.6) {  // a star: every other corner reentrant
    const int tips = 3 + static_cast<int>(4.0 * u(rng));
    for (int k = 0; k < 2 * tips; ++k) {
      const double a = std::numbers::pi * (k + 0.3 * u(rng)) / tips;
      add((k % 2 == 0 ? 0.8 + 0.2 * u(rng) : 0.2 + 0.2 * u(rng)) * Vec2{std::cos(a), std::sin(a)});
    }
  } else if (kind < 0.7) {  // an L
    const double arm = 0.2 + 0.6 * u(rng);
    for (const Vec2 p : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, arm - 1}, Vec2{arm - 1, arm - 1},
                         Vec2{arm - 1, 1}, Vec2{-1, 1}}) {
      add(0.7 * p);
    }
  } else if (kind < 0.85) {  // a needle
    for (const Vec2 p : {Vec2{-1, -thin}, Vec2{1, -thin}, Vec2{1, thin}, Vec2{-1, thin}}) add(p);
  } else {  // a sliver
    for (const Vec2 p : {Vec2{-1, 0}, Vec2{1, 0}, Vec2{2.0 * u(rng) - 1.0, thin}}) add(p);
  }
  return ring;
}

}  // namespace edda
