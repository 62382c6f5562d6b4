// What the tests of the library share: two small models, a folder each, what was thrown.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "library/edda.hpp"
#include "scratch_folder.hpp"

namespace edda::api {

inline const std::string examples = EDDA_SOURCE_DIR "/examples/";

/// A block that falls, alone.
inline constexpr const char* falling = R"(
gravity = [0.0, -10.0]
[materials.rock]
density = 2000.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[contact]
normal_stiffness = 1e8
joint = "j"
[[block]]
name = "stone"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
material = "rock"
[[block]]
name = "far below"
polygon = [[-9, -90], [9, -90], [9, -89], [-9, -89]]
material = "rock"
fixed = true
[solver]
duration = 0.2
[output]
every = 0.1
history_every = 0.01
)";

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<double> positions(const Simulation& simulation) {
  std::vector<double> all;
  for (const Nodes& nodes : {simulation.node_x(), simulation.node_y()}) {
    for (const auto& row : nodes) all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

class Library : public testing::Test {
 protected:
  std::string in_folder(const char* name) const { return folder_.at(name); }

 private:
  ScratchFolder folder_;
};

inline Model ramp() {
  return Model::read(examples + "ramp.toml", {"solver.duration=0.05"});
}

inline std::vector<Fault> faults_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.faults();
  }
  return {};
}

}  // namespace edda::api
