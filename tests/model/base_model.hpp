// A small valid model with one object of every section, for tests that break it in one place.
#pragma once

#include <string>

namespace edda::testing {

// Line numbers are part of the tests.
inline const std::string base_model = R"(title = "base"
gravity = [0.0, -9.81]
[materials.rock]
density = 2700.0
young = 20e9
poisson = 0.25
[joints.rough]
friction_angle = 30.0
[[block]]
name = "floor"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
fixed = true
[[block]]
polygon = [[1, 1], [2, 1], [2, 2], [1, 2]]
[domain]
outline = [[10, 0], [20, 0], [20, 10], [10, 10]]
[[joint_set]]
name = "bedding"
angle = 45.0
spacing = 2.0
[[trace]]
points = [[11, 1], [12, 5]]
[[opening]]
name = "hole"
polygon = [[14, 4], [16, 4], [16, 6], [14, 6]]
[[fixed]]
point = [15, 1]
[[brick_wall]]
columns = 4
rows = 3
brick = [1.0, 0.5]
[[boundary]]
name = "base"
sides = ["bottom"]
[[monitor]]
name = "P1"
point = [15, 9]
[solver]
duration = 0.1
[output]
every = 0.01
)";

/// base_model with the first `from` replaced by `to`.
inline std::string base_with(const std::string& from, const std::string& to) {
  std::string text = base_model;
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "base_with: not found: " + from
                                 : text.replace(at, from.size(), to);
}

}  // namespace edda::testing
