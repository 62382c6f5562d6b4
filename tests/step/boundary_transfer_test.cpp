// Boundaries that a stage activates carry the forces of those that it deactivates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "observe/attachment_rows.hpp"
#include "run/prepared.hpp"
#include "step/lone_block.hpp"

namespace edda::boundary_transfer_test {
namespace {

using testing::lone;
using testing::ran;
using testing::Ran;

/// A column in equilibrium on springs that dashpots replace: it stays in equilibrium, and they
/// carry its weight. Without them it falls.
TEST(Activation, ABoundaryThatTakesOverCarriesWhatTheOtherCarried) {
  const std::string stands = R"(
[[boundary]]
name = "static"
along = [[0, 0], [1, 0]]
type = "fixed"
[[boundary]]
name = "far"
along = [[0, 0], [1, 0]]
type = "viscous"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.2
reset_displacements = true
deactivate = ["static"]
)";
  const Ran r = ran(lone(stands + "activate = [\"far\"]\n", "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.motion.state.velocity, 0)), 1e-7);
  Instant now;
  observe(s, now);
  const std::vector<Vec2> reaction = reactions(s, now);
  EXPECT_EQ(reaction[0], Vec2{});
  EXPECT_NEAR(reaction[1].y / (2500.0 * 9.81), 1.0, 1e-6);
  const Ran falls = ran(lone(stands + R"(
[[stage]]
duration = 0.01
activate = ["far"]
)",
                             "[0, -9.81]"));
  const Simulation& f = falls.ready.sim;
  // There are no forces to take over: it sinks with the terminal velocity of the dashpots, m g/(rho
  // c_p A).
  const double speed = std::sqrt(10e9 * 0.8 / (1.2 * 0.6) / 2500.0);
  EXPECT_NEAR(centroid(f.motion.state.velocity, 0).y / (-9.81 / speed), 1.0, 0.01);
}

/// Where two boundaries meet, the forces are taken over once.
TEST(Activation, BoundariesThatTakeOverTogetherCarryTheForcesOnce) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "box"
sides = ["left", "right", "bottom"]
type = "fixed"
[[boundary]]
name = "base"
sides = ["bottom"]
type = "viscous"
[[boundary]]
name = "flanks"
sides = ["left", "right"]
type = "free-field"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.2
deactivate = ["box"]
activate = ["base", "flanks"]
)",
                         "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.motion.state.velocity, 0)), 1e-7);
  Instant now;
  observe(s, now);
  const std::vector<Vec2> reaction = reactions(s, now);
  EXPECT_NEAR((reaction[1] + reaction[2]).y / (2500.0 * 9.81), 1.0, 1e-6);
}

/// Springs that replace others start at the position of the block, and carry what those carried.
TEST(Activation, SpringsTakeOverToo) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "static"
along = [[0, 0], [1, 0]]
type = "roller"
[[boundary]]
name = "stiff"
along = [[0, 0], [1, 0]]
type = "fixed"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.05
deactivate = ["static"]
activate = ["stiff"]
)",
                         "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.motion.state.velocity, 0)), 1e-7);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
}

/// Dashpots that replace a traction cause no jump of the velocity.
TEST(Activation, ATractionIsTakenOverFromWithoutAJolt) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "stressed"
sides = ["left", "right", "bottom", "top"]
type = "stress"
traction = [0, 0]
[[load]]
name = "left"
along = [[0, 0], [0, 1]]
pressure = 1e7
[[load]]
name = "right"
along = [[1, 0], [1, 1]]
pressure = 1e7
[[boundary]]
name = "squeeze"
along = [[0, 1], [1, 1]]
type = "stress"
traction = [0, -1e7]
[[boundary]]
name = "below"
along = [[0, 0], [1, 0]]
type = "stress"
traction = [0, 1e7]
[[boundary]]
name = "far"
sides = ["bottom", "top"]
type = "viscous"
[[stage]]
until = "equilibrium"
ratio = 1e-7
[[stage]]
duration = 0.01
deactivate = ["squeeze", "below"]
activate = ["far"]
)"));
  const Simulation& s = r.ready.sim;
  double fastest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    fastest = std::max({fastest, std::abs(s.motion.state.velocity.x[k][0]),
                        std::abs(s.motion.state.velocity.y[k][0])});
  }
  EXPECT_LT(fastest, 1e-5);
}

}  // namespace
}  // namespace edda::boundary_transfer_test
