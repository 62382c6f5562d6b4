// A model of one block.
#pragma once

#include <string>

namespace edda::testing {

/// A single block of one square metre and 2500 kg.
inline std::string lone(const std::string& more, const std::string& gravity = "[0, 0]") {
  return "gravity = " + gravity + R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[[block]]
name = "b"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
)" + more;
}

}  // namespace edda::testing
