// What is read between two steps without a copy of the contacts or the blocks.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>

#include "contacts/face_reading.hpp"
#include "observe/model_warnings.hpp"
#include "observe/observe.hpp"
#include "run/prepared.hpp"
#include "step/step.hpp"

namespace edda::instant_test {
namespace {

/// Bricks on a floor, one of them much smaller than the others, hit by a block from the side.
std::string wall(const std::string& solver) {
  return R"(
[materials.rock]
density = 2500
young = 1e8
poisson = 0.2
[joints.j]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-4, -1], [8, -1], [8, 0], [-4, 0]]
[[block]]
polygon = [[-2, 0.5], [-1, 0.5], [-1, 1.5], [-2, 1.5]]
velocity = [8, 0]
[[block]]
polygon = [[5, 0], [5.1, 0], [5.1, 0.1], [5, 0.1]]
[[brick_wall]]
origin = [0, 0]
columns = 3
rows = 4
brick = [1, 0.5]
[solver]
duration = 1
)" + solver;
}

void expect_same(const Nodes& a, const Nodes& b) {
  for (std::size_t node = 0; node < a.size(); ++node) EXPECT_EQ(a[node], b[node]);
}

void expect_same(const Instant& a, const Instant& b) {
  expect_same(a.state.position.x, b.state.position.x);
  expect_same(a.state.position.y, b.state.position.y);
  expect_same(a.state.velocity.x, b.state.velocity.x);
  expect_same(a.state.velocity.y, b.state.velocity.y);
  expect_same(a.forces.x, b.forces.x);
  expect_same(a.forces.y, b.forces.y);
  EXPECT_EQ(a.state.time, b.state.time);
  EXPECT_EQ(a.state.alive, b.state.alive);
  EXPECT_EQ(a.on_dashpots, b.on_dashpots);
}

/// Also where an Instant is filled again, as from row to row.
void expect_blocks_of_the_whole(const std::string& solver) {
  PreparedRun run = testing::prepared(wall(solver));
  start(run.sim, 1.0);
  Instant kept;
  for (int row = 0; row < 4; ++row) {
    for (int n = 0; n < 30; ++n) ASSERT_FALSE(step(run.sim));
    Instant whole;
    observe(run.sim, whole);
    observe(run.sim, kept);
    expect_same(kept, whole);
    EXPECT_EQ(unbalanced_ratio(run.sim, kept), unbalanced_ratio(run.sim, whole));
    const Picture picture = picture_of(run.sim, kept);
    double normal = 0.0, recorded = 0.0;
    for (std::size_t k = 0; k < run.sim.motion.contacts.size(); ++k) {
      const FaceRow face = face_row(run.sim, k);
      if (is_closed(face)) normal += normal_force(face);
    }
    for (const ContactRecord& r : picture.contacts) recorded += r.normal_force;
    EXPECT_EQ(recorded, normal);
  }
}

TEST(ObserveBlocks, IsTheInstantOfTheExplicitMethod) {
  expect_blocks_of_the_whole("[[boundary]]\ntype = 'viscous'\nalong = [[3, 0], [3, 2]]\n");
}

TEST(ObserveBlocks, IsTheInstantOfTheImplicitMethod) {
  expect_blocks_of_the_whole("method = 'dda'\ntime_step = 1e-3\n");
}

/// The bound without the governing block is that of a copy in which this block is fixed.
TEST(GovernedBy, AsksWithoutTheGoverningBlockAndLeavesItFree) {
  PreparedRun run = testing::prepared(wall(""));
  Simulation& sim = run.sim;
  const std::vector<std::uint8_t> fixed = sim.scene->blocks.fixed;
  const StepBound bound = sim.control.bound;
  ASSERT_NE(bound.block, no_id);
  BlockSet others = sim.scene->blocks;
  others.fixed[bound.block] = 1;
  const double gain = step_bound(stiffness_inputs(sim, others)).critical_step / bound.critical_step;
  ASSERT_GT(gain, 1.02);
  const std::string expected =
      fmt::format("; the other blocks alone would allow {:.3g} times the time step", gain);
  EXPECT_TRUE(run.governed_by.ends_with(expected)) << run.governed_by;
  EXPECT_EQ(governed_by(sim), run.governed_by);
  EXPECT_EQ(sim.scene->blocks.fixed, fixed);
}

}  // namespace
}  // namespace edda::instant_test
