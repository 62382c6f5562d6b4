// Fill beside other parts of a model: walls that have moved, momentum, excavation, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"

namespace edda::fills_test {
namespace {

using testing::prepared;
using testing::ran;
using testing::Ran;

/// Indices of the fills of this name, of all lifts.
std::vector<std::size_t> parts_of(const Simulation& sim, const std::string& name) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.is_fill(i) && sim.scene->model.fills[static_cast<std::size_t>(b.fill[i])].name == name)
      parts.push_back(i);
  }
  return parts;
}
Vec2 momentum(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  Vec2 sum;
  for (std::size_t i = 0; i < b.size(); ++i)
    sum += b.mass[i] * centroid(sim.motion.state.velocity, i);
  return sum;
}

const std::string two_sliders = R"(gravity = [0, 0]
[materials.rock]
density = 2500
young = 1e8
poisson = 0.2
zone_size = 1
[joints.j]
friction_angle = 30
[[block]]
velocity = [0.3, 0.02]
polygon = [[0, 0], [2, 0], [2, 2], [0, 2]]
[[block]]
velocity = [-0.1, -0.03]
polygon = [[4, 0], [6, 0], [6, 2], [4, 2]]
[[fill]]
name = "paste"
polygon = [[2, 0.5], [4, 0.5], [4, 1.8], [2, 1.8]]
[[stage]]
duration = 0.02
[[stage]]
duration = 0.1
fill = ["paste"]
)";

/// Walls that move press on fill from its first step on, and not before.
TEST(Fills, KeepMomentumAndEnergy) {
  const Ran r = ran(two_sliders);
  const Simulation& sim = r.ready.sim;
  const double mass = sim.scene->blocks.mass[0];
  EXPECT_NEAR(momentum(sim).x, 0.2 * mass, 1e-9 * mass);
  EXPECT_NEAR(momentum(sim).y, -0.01 * mass, 1e-9 * mass);
  const EnergyBalance energy = energy_balance(sim);
  EXPECT_LT(std::abs(energy.error), 1e-9 * energy.kinetic);
  EXPECT_NEAR(energy.external, 0.0, 1e-9 * energy.kinetic);
  const std::size_t paste = parts_of(sim, "paste").front();
  EXPECT_GT(norm(centroid(sim.motion.state.velocity, paste)), 0.01);
}

/// It fits between walls that have moved and turned, without stress and without force on them.
TEST(Fills, BeginWithoutStressBetweenWallsAsTheyAre) {
  std::string text = two_sliders;
  text.replace(text.find("duration = 0.1\n"), 15, "duration = 1e-9\n");
  text.replace(text.find("velocity"), 8, "angular_velocity = 0.5\nvelocity");
  const Ran r = ran(text);
  const Simulation& sim = r.ready.sim;
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  const std::size_t paste = parts_of(sim, "paste").front();
  for (const double s : mean_stress(b, sim.scene->zones, sim.motion.zones, paste))
    EXPECT_LT(std::abs(s), 1.0);
  // Corner to corner: the walls have come nearer by 8 mm, and turned.
  for (Id v = b.vertex_begin[paste]; v < b.vertex_begin[paste + 1]; ++v) {
    const std::size_t wall = b.vertex(v).x + b.origin.x < 3.0 ? 0 : 1;
    const bool on_wall = std::abs(b.vertex(v).x) > 0.99;
    if (!on_wall) continue;
    const Vec2 moved = weighted(weights_at(b, wall, b.vertex(v)), sim.motion.state.position, wall);
    EXPECT_NEAR(pose.x[v], moved.x, 1e-6);
    EXPECT_NEAR(pose.y[v], moved.y, 1e-6);
  }
}

/// A stope between two stiff pillars on a floor; a roof slab rests on the pillars and, later, on
/// the fill.
std::string stope(const std::string& more) {
  return R"([materials.rock]
density = 2500
young = 1e9
poisson = 0.2
[materials.paste]
density = 2000
young = 1e8
poisson = 0.3
zone_size = 2
[joints.j]
friction_angle = 30
cohesion = 1e6
tensile_strength = 1e6
[joints.wall]
friction_angle = 30
[contact]
joint = "j"
[[boundary]]
sides = ["left", "right", "bottom"]
type = "roller"
[domain]
outline = [[0, 0], [12, 0], [12, 9], [0, 9]]
material = "rock"
[[joint_set]]
angle = 90
spacing = 3
[[joint_set]]
angle = 0
spacing = 3
[[opening]]
name = "stope"
polygon = [[3, 3], [6, 3], [6, 6], [3, 6]]
[[opening]]
name = "next"
polygon = [[6, 3], [9, 3], [9, 6], [6, 6]]
[[fill]]
name = "paste"
opening = "stope"
material = "paste"
joint = "wall"
lift = 1.5
)" + more;
}
const std::string rest = "[[stage]]\nuntil = 'equilibrium'\n";

/// Before anything comes after it fill has the stress of its weight alone; rock that is excavated
/// beside it takes away what it leans on.
TEST(Fills, HaveTheirOwnWeightUntilRockBesideThemGoes) {
  const Ran placed =
      ran(stope(rest + rest + "excavate = ['stope']\n" + rest + "fill = ['paste']\n"));
  ASSERT_EQ(placed.outcome.status, Status::equilibrium) << placed.outcome.message;
  const Simulation& sim = placed.ready.sim;
  const std::vector<std::size_t> parts = parts_of(sim, "paste");
  ASSERT_EQ(parts.size(), 2u);
  const auto vertical = [&](const Simulation& s, std::size_t i) {
    return -mean_stress(s.scene->blocks, s.scene->zones, s.motion.zones, i)[1];
  };
  // Of 3 m of fill, without the friction at the walls.
  EXPECT_GT(vertical(sim, parts[1]), 0.3 * 0.75 * 2000 * 9.81);
  EXPECT_LT(vertical(sim, parts[1]), 1.01 * 0.75 * 2000 * 9.81);
  EXPECT_LT(vertical(sim, parts[0]), 1.01 * 2.25 * 2000 * 9.81);
  const Ran mined = ran(stope(rest + rest + "excavate = ['stope']\n" + rest + "fill = ['paste']\n" +
                              rest + "excavate = ['next']\n"));
  ASSERT_EQ(mined.outcome.status, Status::equilibrium) << mined.outcome.message;
  EXPECT_GT(vertical(mined.ready.sim, parts[1]), 1.5 * vertical(sim, parts[1]));
}

/// What is excavated of fill is gone, and what it carried is released.
TEST(Fills, MayBeExcavatedAgain) {
  const Ran r = ran(stope(rest + rest + "excavate = ['stope']\n" + rest + "fill = ['paste']\n" +
                          rest + "excavate = ['paste']\n"));
  ASSERT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& sim = r.ready.sim;
  for (const std::size_t i : parts_of(sim, "paste")) EXPECT_EQ(sim.motion.state.alive[i], 0);
}

/// In the mirror image of a model fill is placed where its mirror image is.
TEST(Fills, ArePlacedAlikeInTheMirror) {
  const std::string stages =
      "[[stage]]\nduration = 0.02\n[[stage]]\nduration = 0.1\nexcavate = "
      "['stope']\n[[stage]]\nduration = 1e-9\nfill = ['paste']\n";
  const std::string right = stope(stages);
  std::string left = right;
  const std::string here = "[[3, 3], [6, 3], [6, 6], [3, 6]]",
                    there = "[[6, 3], [9, 3], [9, 6], [6, 6]]";
  const std::size_t first = left.find(here), second = left.find(there);
  left.replace(first, here.size(), there).replace(second, there.size(), here);
  const Ran a = ran(right), b = ran(left);
  const BlockSet& one = a.ready.sim.scene->blocks;
  const BlockSet& other = b.ready.sim.scene->blocks;
  std::size_t pairs = 0;
  for (Id v = 0; v < one.vertex_count(); ++v) {
    if (!one.is_fill(one.vertex_block[v])) continue;
    const Vec2 p = one.vertex(v), to = corner_at(one, a.ready.sim.motion.state.reference, v) - p;
    for (Id w = 0; w < other.vertex_count(); ++w) {
      const Vec2 q = other.vertex(w);
      if (other.name(other.vertex_block[w]) != one.name(one.vertex_block[v]) ||
          norm(q - Vec2{-p.x, p.y}) > 1e-9)
        continue;
      const Vec2 moved = corner_at(other, b.ready.sim.motion.state.reference, w) - q;
      EXPECT_GT(norm(to), 1e-6);
      EXPECT_NEAR(to.x, -moved.x, 1e-9);
      EXPECT_NEAR(to.y, moved.y, 1e-9);
      ++pairs;
    }
  }
  EXPECT_GE(pairs, 8u);
}

std::string first_fault(const std::string& text) {
  Result<Model> model = read_model_text(text, "m.toml", {});
  if (!model.ok()) return to_string(model.faults()[0]);
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  return run.ok() ? std::string() : to_string(run.faults()[0]);
}

TEST(Fills, AreRefusedWhereTheyCannotBe) {
  const std::string dig = rest + "excavate = ['stope']\n", place = rest + "fill = ['paste']\n";
  EXPECT_EQ(first_fault(stope(dig + place)), "");
  const auto drawn = [&](const std::string& polygon, const std::string& more = "") {
    return first_fault(stope("[[fill]]\nname = 'other'\nmaterial = 'paste'\npolygon = " + polygon +
                             "\n" + dig + rest + "fill = ['paste', 'other']\n" + more));
  };
  EXPECT_NE(drawn("[[0, 8], [3, 8], [3, 9.5], [0, 9.5]]").find("overlaps a block that is there"),
            std::string::npos);
  EXPECT_NE(drawn("[[7, 4], [8, 4], [8, 5], [7, 5]]", rest + "excavate = ['next']\n")
                .find("overlaps \"next\", which has not been excavated by then"),
            std::string::npos);
  EXPECT_NE(drawn("[[3, 3], [4, 3], [4, 4], [3, 4]]").find("overlaps \"other\""), std::string::npos)
      << drawn("[[3, 3], [4, 3], [4, 4], [3, 4]]");
  EXPECT_NE(drawn("[[0, 10], [3, 10], [3, 11]]").find("touches no block"), std::string::npos);
  EXPECT_EQ(drawn("[[0, 9], [3, 9], [3, 10]]"), "");
  EXPECT_NE(first_fault("plane = 'stress'\n" + stope(dig + place)).find("plane strain"),
            std::string::npos);
  const std::string water = "[[water]]\ntable = [[-1, 8], [13, 8]]\n";
  EXPECT_EQ(first_fault(stope(water + dig + place)), "");
  EXPECT_NE(first_fault(stope(water + "flooded = ['stope']\n" + dig + place))
                .find("no water acts on fill"),
            std::string::npos);
}

/// A block that has fallen into the room of the fill.
TEST(Fills, AreRefusedWhereABlockHasFallen) {
  std::string weak = stope(
      "[[trace]]\npoints = [[4, 6], [4.2, 9]]\njoint = 'wall'\n[[trace]]\n"
      "points = [[5, 6], [4.8, 9]]\njoint = 'wall'\n[[stage]]\nduration = 0.001\n"
      "[[stage]]\nduration = 0.75\nexcavate = ['stope']\n"
      "[[stage]]\nduration = 0.01\nfill = ['paste']\n");
  const Ran r = ran(weak);
  EXPECT_EQ(r.outcome.status, Status::failed);
  EXPECT_NE(r.outcome.message.find("there is no room for \"paste\""), std::string::npos)
      << r.outcome.message;
}

}  // namespace
}  // namespace edda::fills_test
