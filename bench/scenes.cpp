#include "scenes.hpp"
#include "step/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "settled_wall.hpp"
#include "wall.hpp"

namespace edda {
namespace {

constexpr std::string_view soft_rock = R"(
[materials.rock]
density = 2600.0
young = "1 GPa"
poisson = 0.2
[contact]
normal_stiffness = "4 GPa"
[solver]
duration = 1000.0
)";

struct Named {
  std::string kind;
  int first = 0, second = 0;
};

/// KIND, KIND:N or KIND:NxM.
Named taken_apart(const std::string& name) {
  Named n;
  const std::size_t colon = name.find(':');
  n.kind = name.substr(0, colon);
  if (colon == std::string::npos) return n;
  int read = 0;
  const std::string size = name.substr(colon + 1);
  if (std::sscanf(size.c_str(), "%d%nx%d%n", &n.first, &read, &n.second, &read) < 1 ||
      read != static_cast<int>(size.size())) {
    n.first = n.second = -1;
  }
  return n;
}

/// NAME of NAME, NAME/corners or NAME/uniform, after which scenes are built with such blocks.
std::string without_deformation(const std::string& scene) {
  deformation_of_scenes = {};
  const std::size_t slash = scene.find('/');
  if (slash == std::string::npos) return scene;
  if (scene.substr(slash) == "/corners") deformation_of_scenes = BlockDeformation::corners;
  if (scene.substr(slash) == "/uniform") deformation_of_scenes = BlockDeformation::uniform;
  return deformation_of_scenes ? scene.substr(0, slash) : scene;
}

void take_time(Simulation& sim, double seconds) {
  const double end = sim.motion.state.time + seconds;
  while (sim.motion.state.time < end) take_steps(sim, 1);
}

/// A convex polygon about the unit circle, drawn `size` times as large.
std::string polygon_text(std::mt19937& rng, Vec2 centre, double size) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const int corners = 5 + static_cast<int>(4.0 * u(rng));
  const double turn = 2.0 * std::numbers::pi * u(rng);
  std::string text = "polygon = [";
  for (int k = 0; k < corners; ++k) {
    const double a = turn + 2.0 * std::numbers::pi * (k + 0.5 * u(rng)) / corners;
    text += fmt::format("[{}, {}], ", centre.x + size * std::cos(a), centre.y + size * std::sin(a));
  }
  return text + "]\n";
}

std::string held_text(double left, double low, double right, double high) {
  return fmt::format(
      "[[block]]\nfixed = true\npolygon = [[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}]]\n", left,
      low, right, high);
}

/// A wall whose base is gone: it stands on the edges of ridges and comes down between
/// them, already on its way.
Simulation collapsing_wall(int columns, int rows) {
  std::string toml =
      std::string(soft_rock) + "damping = { contact = 0.2 }\n[joints.dry]\nfriction_angle = 30.0\n";
  toml +=
      fmt::format("[[brick_wall]]\ncolumns = {}\nrows = {}\nbrick = [1.0, 0.5]\n", columns, rows);
  const double width = 8.0, high = 4.0;
  for (double left = -4.0 * width - 0.3; left < columns + 4.0 * width; left += width) {
    toml += fmt::format("[[block]]\nfixed = true\npolygon = [[{}, {}], [{}, {}], [{}, 0.0]]\n",
                        left, -high, left + width, -high, left + 0.5 * width);
  }
  Simulation sim = built(read_model_text(toml, "collapse.toml"));
  constexpr double fallen = 1.5;  // m/s
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (sim.scene->blocks.fixed[i]) continue;
    for (auto& vy : sim.motion.state.velocity.y) vy[i] = -fallen;
  }
  start(sim, 1000.0);
  take_time(sim, 0.25);
  return sim;
}

/// Random polygons that fit together at first, on a slope, the upper ones ahead of the lower.
Simulation flowing_heap(int count) {
  const double slope = 35.0 * std::numbers::pi / 180.0;
  const int columns = std::max(2, static_cast<int>(std::sqrt(3.0 * count)));
  const int rows = std::max(1, count / columns);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-0.22, 0.22);
  std::vector<Vec2> corners;  // of a net, those at its foot in a line
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) corners.push_back({i + u(rng), j == 0 ? 0.0 : j + u(rng)});
  }
  std::string toml =
      fmt::format("gravity = [{}, {}]\n", 9.81 * std::sin(slope), -9.81 * std::cos(slope));
  toml +=
      std::string(soft_rock) + "damping = { contact = 0.2 }\n[joints.dry]\nfriction_angle = 20.0\n";
  toml += held_text(-10.0, -2.0, columns + 60.0, 0.0);
  for (int k = 0; k < columns * rows; ++k) {
    const int row = k / columns, first = row * (columns + 1) + k % columns;
    toml += "[[block]]\npolygon = [";
    for (const int c : {first, first + 1, first + columns + 2, first + columns + 1}) {
      const Vec2 p = corners[static_cast<std::size_t>(c)];
      toml += fmt::format("[{}, {}], ", p.x, p.y);
    }
    toml += fmt::format("]\nvelocity = [{}, 0.0]\n", 0.3 * (1 + row));
  }
  Simulation sim = built(read_model_text(toml, "heap.toml"));
  start(sim, 1000.0);
  take_time(sim, 0.3);
  return sim;
}

/// After so many steps.
Simulation begun(Result<Model> model, long steps) {
  Simulation sim = built(std::move(model));
  start(sim, 1000.0);
  take_steps(sim, steps);
  return sim;
}

Simulation free_blocks(int count) {
  const int columns = std::max(1, static_cast<int>(std::sqrt(count)));
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::string toml =
      "gravity = [0.0, 0.0]\n" + std::string(soft_rock) + "[joints.dry]\nfriction_angle = 30.0\n";
  for (int i = 0; i < count; ++i) {
    const int row = i / columns, column = i % columns;
    toml += "[[block]]\n" + polygon_text(rng, {1.25 * column, 1.25 * row}, 0.5);
    toml += fmt::format("angular_velocity = {}\n", u(rng));
  }
  return begun(read_model_text(toml, "free.toml"), 100);
}

Simulation example(const std::string& name) {
  return begun(read_model(std::string(EDDA_SOURCE_DIR) + "/examples/" + name + ".toml"), 2000);
}

/// A square of ground in zones, of the stress that its weight gives it; all of it may yield.
Simulation ground_at_rest(int side) {
  const std::string toml = fmt::format(R"(
[materials.rock]
density = 2600.0
young = "10 GPa"
poisson = 0.25
yield = {{ friction_angle = 35, cohesion = "1 MPa", tensile_strength = "0.2 MPa" }}
[joints.none]
friction_angle = 35.0
[domain]
outline = [[0, 0], [{0}, 0], [{0}, {0}], [0, {0}]]
material = "rock"
[contact]
joint = "none"
[[boundary]]
sides = ["left", "right", "bottom"]
type = "roller"
[initial_stress]
k0 = 0.5
surface = "outline"
[zones]
size = 0.5
[solver]
duration = 1000.0
)",
                                       side);
  return begun(read_model_text(toml, "ground.toml"), 200);
}

/// A square of rock cut by two joint sets that cross, of the stress that its weight gives it.
Simulation rock_at_rest(int side) {
  const std::string toml = fmt::format(R"(
[materials.rock]
density = 2600.0
young = "10 GPa"
poisson = 0.25
[joints.set]
friction_angle = 35.0
[domain]
outline = [[0, 0], [{0}, 0], [{0}, {0}], [0, {0}]]
material = "rock"
joint = "set"
[[joint_set]]
angle = 20.0
spacing = 1.0
deviation = {{ spacing = 0.2 }}
[[joint_set]]
angle = 100.0
spacing = 1.0
deviation = {{ spacing = 0.2 }}
[[boundary]]
sides = ["left", "right", "bottom"]
type = "roller"
[initial_stress]
k0 = 0.5
surface = "outline"
[solver]
duration = 1000.0
)",
                                       side);
  return begun(read_model_text(toml, "rock.toml"), 200);
}

}  // namespace

std::string flaw_of_scene(const std::string& scene) {
  const std::string name = without_deformation(scene);
  const Named n = taken_apart(name);
  constexpr int most = 100'000'000;
  const bool one = n.first > 0 && n.first <= most && n.second == 0;
  const bool two = n.first > 0 && n.second > 0 && n.first <= most / n.second;
  if (n.kind == "wall" || n.kind == "collapse") return two ? "" : name + ": needs COLUMNSxROWS";
  if (n.kind == "heap" || n.kind == "free") return one ? "" : name + ": needs a number of blocks";
  if (n.kind == "rock" || n.kind == "ground")
    return one ? "" : name + ": needs the length of a side, m";
  if (name == "cavern" || name == "squeezing") return "";
  return name + ": no such scene";
}

BenchScene make_scene(const std::string& scene_name, const std::string& cache) {
  const std::string name = without_deformation(scene_name);
  const Named n = taken_apart(name);
  if (n.kind == "collapse") return {collapsing_wall(n.first, n.second)};
  if (n.kind == "heap") return {flowing_heap(n.first)};
  if (n.kind == "free") return {free_blocks(n.first)};
  if (n.kind == "rock") return {rock_at_rest(n.first)};
  if (n.kind == "ground") return {ground_at_rest(n.first)};
  if (n.kind == "cavern" || n.kind == "squeezing") return {example(name)};
  BenchScene scene{settled_wall(n.first, n.second, cache)};
  scene.row_error = error_of_row_forces(scene.sim);
  return scene;
}

}  // namespace edda
