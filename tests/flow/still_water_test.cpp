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

/// Rain falls on what is under the open sky: ground beside and on an overhang, not below it, nor in
/// a tunnel. Joints that can take in all of it do.
TEST(Flow, RainFallsOnGroundUnderTheSky) {
  for (const bool mirrored : {false, true}) {
    std::string outline;
    for (const Vec2 p : {Vec2{0, 0},
                         {20, 0},
                         {20, 5},
                         {12, 5},
                         {12, 7},
                         {16, 7},
                         {16, 9},
                         {10, 9},
                         {10, 5},
                         {0, 5}})
      outline += (outline.empty() ? "[[" : ", [") + number(mirrored ? -p.x : p.x) + ", " +
                 number(p.y) + "]";
    const double sign = mirrored ? -1.0 : 1.0;
    const Simulation sim = scene(
        rock + "[flow]\n[solver]\nduration = 1\n[domain]\nmaterial = 'rock'\noutline = " + outline +
        "]\n[[joint_set]]\nangle = " + number(sign * 20) +
        "\nspacing = 1.5\njoint = 'bedding'\n[[joint_set]]\nangle = " + number(-sign * 70) +
        "\nspacing = 1.5\njoint = 'bedding'\n[[opening]]\nname = 'tunnel'\nshape = { kind = "
        "'circle', "
        "at = [" +
        number(sign * 5) +
        ", 2.5], width = 3 }\n"
        "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
        "[[water]]\nlevel = 0.5\nsides = ['left', 'right']\n"
        "[[water]]\nrain = '0.36 mm/h'\n");
    const JointWater& water = sim.attached.joint_water;
    EXPECT_EQ(water.not_found, 0u);
    EXPECT_NEAR(water.inflow[1], 20.0 * 1e-7, 1e-6 * 20.0 * 1e-7) << mirrored;
    EXPECT_NEAR(water.inflow[0] + water.inflow[1] + water.inflow[2], 0.0, 1e-6 * water.inflow[1]);
  }
}

}  // namespace
}  // namespace edda::flow_test
