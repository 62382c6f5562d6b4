// Water that flows through joints: still water, networks with known answers, and its forces on
// blocks.
#include <algorithm>
#include <cmath>

#include "attachments/loads.hpp"
#include "step/changes.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::flow_test {
namespace {

const std::string rock =
    "[materials.rock]\ndensity = 2700\nyoung = 20e9\npoisson = 0.25\n"
    "[joints.bedding]\nfriction_angle = 35\naperture = 3e-4\nkn = 20e9\n";

/// Ground with thin wedges under a lake.
std::string under_lake() {
  return rock + "[solver]\nduration = 1\n" +
         "[domain]\noutline = [[-60,-10],[0,-10],[0,0],[-60,0]]\nmaterial = 'rock'\n"
         "[[joint_set]]\nangle = -8\nspacing = 5\njoint = 'bedding'\n"
         "[[joint_set]]\nangle = 75\nspacing = 6\njoint = 'bedding'\n"
         "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
         "[[water]]\ntable = [[-60, 27], [0, 27]]\n";
}

/// Force of the water of one simulation on the nodes of block i, where another has its blocks.
NodeVectors water_on_block(const Simulation& of, const Simulation& at, Id i) {
  const LoadsNow now = loads_at(of.scene->model, of.attached.loads, 0.0);
  BlockForces f{of.scene->blocks, i};
  add_loads(f, now, at.motion.pose.x, at.motion.pose.y);
  return f.sum.nodes;
}

/// Still water is that of a table, as drawn and while the blocks settle.
TEST(Flow, StillWaterPressesAsATable) {
  const Simulation table = scene(under_lake());
  Simulation flow = scene(under_lake() + "[flow]\n");
  const BlockSet& b = table.scene->blocks;
  std::vector<std::uint8_t> supported(b.size(), 0);
  for (const auto& edges : flow.attached.joint_water.ground.along) {
    for (const Id edge : edges) supported[b.vertex_block[edge]] = 1;
  }
  std::vector<Id> inside;
  for (Id i = 0; i < b.size(); ++i) {
    if (supported[i] == 0) inside.push_back(i);
  }
  ASSERT_GE(inside.size(), 10u);
  start(flow, 1.0);
  for (int look = 0; look < 100; ++look) {
    for (const Id i : inside) {
      const NodeVectors t = water_on_block(table, flow, i), f = water_on_block(flow, flow, i);
      for (std::size_t k = 0; k < nodes_per_block; ++k) {
        EXPECT_LE(norm(t[k] - f[k]), (look == 0 ? 1e-9 : 1e-6) * (norm(t[k]) + 1e5))
            << "block " << i << " after " << flow.motion.state.steps << " steps";
      }
    }
    for (std::uint64_t n = 0; n < steps_between_flows; ++n) ASSERT_FALSE(step(flow));
  }
}

/// A slope of two joint sets with slivers, groundwater on its right, as its joints close under its
/// weight: the discharge falls, and leaves above the toe alone.
TEST(Flow, NothingDrainsIntoTheRock) {
  Simulation sim =
      scene(rock +
            "[flow]\n[solver]\nduration = 1\ndamping = { local = 0.8 }\n[slope]\ntoe = [0, 0]\n"
            "height = 40\nface_angle = 60\nbase_y = -20\nextent = [-40, 80]\n[domain]\n"
            "material = 'rock'\n[[joint_set]]\nangle = 20\nspacing = 5\njoint = 'bedding'\n"
            "[[joint_set]]\nangle = -70\nspacing = 5\njoint = 'bedding'\n"
            "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
            "[[water]]\nlevel = 30\nsides = ['right']\n");
  const JointWater& water = sim.attached.joint_water;
  const double at_first = water.inflow[0];
  EXPECT_GT(at_first, 0.0);
  start(sim, 10.0);
  for (int look = 0; look < 60; ++look) {
    for (std::uint64_t n = 0; n < steps_between_flows; ++n) ASSERT_FALSE(step(sim));
    if (look >= 30) {
      EXPECT_LT(water.inflow[0], at_first) << sim.motion.state.steps;
    }
    EXPECT_NEAR(water.inflow[0], -water.inflow[1], 1e-6 * at_first);
    EXPECT_EQ(water.not_found, 0u);
  }
  EXPECT_LT(water.inflow[0], 0.9 * at_first);
  // Ground below the toe is full.
  const BlockSet& b = sim.scene->blocks;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    if (water.filled[v] == 0.0 || b.vertex(v).y + b.origin.y > -0.5) continue;
    EXPECT_GT(water.pressure[v], 9810.0 * -(b.vertex(v).y + b.origin.y) - 2000.0);
  }
}

/// What joints take in of rain on ground 5 m above a base of 20 m, of 1e-7 m/s.
double rain_taken(std::vector<Vec2> ground, bool mirrored) {
  std::string outline = "[[0, 0]";
  ground.insert(ground.begin(), {20, 0});
  for (const Vec2 p : ground)
    outline += ", [" + number(mirrored ? -p.x : p.x) + ", " + number(p.y) + "]";
  const double sign = mirrored ? -1.0 : 1.0;
  const Simulation sim = scene(
      rock + "[flow]\n[solver]\nduration = 1\n[domain]\nmaterial = 'rock'\noutline = " + outline +
      "]\n[[joint_set]]\nangle = " + number(sign * 20) +
      "\nspacing = 1.5\njoint = 'bedding'\n[[joint_set]]\nangle = " + number(-sign * 70) +
      "\nspacing = 1.5\njoint = 'bedding'\n[[opening]]\nname = 'tunnel'\nshape = { kind = "
      "'circle', at = [" +
      number(sign * 5) + ", 2.5], width = 3 }\n" +
      "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
      "[[water]]\nlevel = 0.5\nsides = ['left', 'right']\n[[water]]\nrain = '0.36 mm/h'\n");
  const JointWater& water = sim.attached.joint_water;
  EXPECT_EQ(water.not_found, 0u);
  EXPECT_NEAR(water.inflow[0] + water.inflow[1] + water.inflow[2], 0.0, 1e-6 * water.inflow[1]);
  return water.inflow[1];
}

/// All of the rain, on level ground and on ground with many bends between its joints.
TEST(Flow, RainFallsOnTheGround) {
  const std::vector<Vec2> level{{20, 5}, {0, 5}},
      bent{{20, 5},   {18, 5},    {17.5, 5.1}, {16.9, 5.15}, {16.4, 5},  {15.9, 5.1},
           {15.3, 5}, {14, 5},    {13.6, 5.2}, {12, 5},      {10, 5},    {9.5, 5.2},
           {9, 5.3},  {8.5, 5.2}, {8, 5.1},    {7.5, 5},     {7.2, 5.1}, {0, 5}};
  for (const bool mirrored : {false, true}) {
    EXPECT_NEAR(rain_taken(level, mirrored) / (20.0 * 1e-7), 1.0, 1e-6) << mirrored;
    EXPECT_NEAR(rain_taken(bent, mirrored) / (20.0 * 1e-7), 1.0, 1e-6) << mirrored;
  }
}

/// On an overhang and not below it, where 4 m more would catch it. A part runs off its edge.
TEST(Flow, NoRainFallsUnderAnOverhang) {
  const std::vector<Vec2> ground{{20, 5}, {12, 5}, {12, 7}, {16, 7},
                                 {16, 9}, {10, 9}, {10, 5}, {0, 5}};
  const double part = rain_taken(ground, false) / (20.0 * 1e-7);
  EXPECT_GT(part, 0.95);
  EXPECT_LT(part, 1.0 + 1e-6);
  EXPECT_NEAR(rain_taken(ground, true) / (20.0 * 1e-7), part, 1e-6);
}

}  // namespace
}  // namespace edda::flow_test
