// Excavation between two stages: the rock around stays in place, or moves according to the fraction
// of wall forces that is released.
#include <gtest/gtest.h>

#include <cmath>

#include "run/prepared.hpp"

namespace edda::excavation_test {
namespace {

using testing::prepared;
using testing::Ran;
using testing::ran;

/// A column on a fixed base; a stage excavates its middle.
std::string column(const std::string& stages, const std::string& solver = "") {
  return R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[joints.j]
friction_angle = 30
[contact]
normal_stiffness = 100e9
joint = "j"
[domain]
outline = [[0, 0], [1, 0], [1, 3], [0, 3]]
material = "rock"
[[trace]]
points = [[0, 1.5], [1, 1.5]]
joint = "j"
[[trace]]
points = [[0, 2.5], [1, 2.5]]
joint = "j"
[[opening]]
name = "middle"
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[fixed]]
point = [0.5, 0.5]
[[stage]]
until = "equilibrium"
ratio = 1e-6
)" + stages +
         "[solver]\n" + solver;
}

/// Mean rise of the two blocks above the opening: only external forces move their common centre.
double risen(const Simulation& sim) {
  double sum = 0.0;
  std::size_t above = 0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (sim.scene->blocks.centroid_y[i] + sim.scene->blocks.origin.y < 2.0) continue;
    sum += centroid(sim.motion.state.position, i).y - sim.scene->blocks.centroid_y[i];
    ++above;
  }
  EXPECT_EQ(above, 2u);
  return sum / 2.0;
}

/// Joints run through the rock of an opening before it is excavated, and its outline is glued.
TEST(Excavation, IsThereUntilItIsTakenOut) {
  const PreparedRun run = prepared(column("[[stage]]\nexcavate = [\"middle\"]\nduration = 1\n"));
  const Simulation& sim = run.sim;
  EXPECT_EQ(sim.scene->blocks.size(), 5u);
  std::size_t glued = 0;
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
    glued += sim.motion.contacts.glued(k);
  }
  EXPECT_EQ(glued, 2u) << "two joints";
  EXPECT_EQ(prepared(column("")).sim.scene->blocks.size(), 3u)
      << "no stage takes it out: it never was";
}

/// The rock above falls with the fraction of its weight that is released: h = part g t^2/2,
/// measured from its position in the same run without release.
TEST(Excavation, ReleasesTheGivenFraction) {
  const std::string dig = "[[stage]]\nexcavate = [\"middle\"]\nduration = 0.05\n";
  const double unreleased = risen(ran(column(dig + "relax = { middle = 0 }\n")).ready.sim);
  EXPECT_NEAR(unreleased, 0.0, 1e-4);
  for (const double part : {0.25, 0.6, 1.0}) {
    const std::string relax = "relax = { middle = " + std::to_string(part) + " }\n";
    const Ran r = ran(column(dig + relax));
    const double fallen = unreleased - risen(r.ready.sim);
    EXPECT_NEAR(fallen, 0.5 * part * 9.81 * 0.05 * 0.05, 2e-6) << part;
    EXPECT_LT(std::abs(r.outcome.largest_energy_error), 1e-8) << part;
    std::size_t gone = 0;
    for (const std::uint8_t alive : r.ready.sim.motion.state.alive) gone += alive == 0;
    EXPECT_EQ(gone, 2u);
  }
  const double all = risen(ran(column(dig)).ready.sim),
               given = risen(ran(column(dig + "relax = { middle = 1 }\n")).ready.sim);
  EXPECT_EQ(all, given) << "all is released where no relax is given";
}

/// With all wall forces acting a column does not move at all; after their release in the next stage
/// it falls.
TEST(Excavation, ReleasesTheRemainderLater) {
  const std::string dig =
      "[[stage]]\nexcavate = [\"middle\"]\nrelax = { middle = 0 }\nduration = 0.05\n";
  const double unreleased = risen(ran(column(dig)).ready.sim);
  const Ran r = ran(column(dig + "[[stage]]\nrelax = { middle = 1 }\nduration = 0.05\n"));
  EXPECT_NEAR(unreleased - risen(r.ready.sim), 0.5 * 9.81 * 0.05 * 0.05, 2e-5);
}

TEST(Excavation, WorksWithTheImplicitMethod) {
  const Ran r = ran(column("[[stage]]\nexcavate = [\"middle\"]\nduration = 0.05\n",
                           "method = \"dda\"\ntime_step = 1e-4\n"));
  EXPECT_NEAR(-risen(r.ready.sim), 0.5 * 9.81 * 0.05 * 0.05, 2e-4);
}

/// Joints that run close to the outline of an excavation leave slivers on either side: each is
/// merged into rock on its own side, so that the excavated area does not change.
TEST(Excavation, SliversAreJoinedOnTheirOwnSide) {
  const std::string model = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 25
[domain]
outline = [[0, 0], [6, 0], [6, 5], [0, 5]]
[[trace]]
points = [[0, 2], [6, 2]]
[[trace]]
points = [[3, 0], [3, 5]]
[[trace]]
points = [[3, 2.06], [3.06, 2]]
[[trace]]
points = [[1, 2], [1, 5]]
[[trace]]
points = [[1, 2.06], [1.06, 2]]
[[opening]]
name = "hole"
polygon = [[2, 1], [4, 1], [4, 2.5], [2, 2.5]]
[[stage]]
duration = 0.01
[[stage]]
duration = 0.01
excavate = ["hole"]
[quality]
min_edge = 0.1
action = ")";
  const PreparedRun joined = prepared(model + "merge\"\n"), as_cut = prepared(model + "report\"\n");
  EXPECT_EQ(joined.sim.scene->blocks.size() + 2, as_cut.sim.scene->blocks.size());
  for (const PreparedRun* run : {&joined, &as_cut}) {
    const BlockSet& b = run->sim.scene->blocks;
    double inside = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      (b.opening[i] == none ? outside : inside) += b.area[i];
    }
    EXPECT_NEAR(inside, 3.0, 1e-9);
    EXPECT_NEAR(outside, 27.0, 1e-9);
  }
  for (std::size_t i = 0; i < joined.sim.scene->blocks.size(); ++i) {
    EXPECT_GT(joined.sim.scene->blocks.area[i], 0.2);
  }
}

}  // namespace
}  // namespace edda::excavation_test
