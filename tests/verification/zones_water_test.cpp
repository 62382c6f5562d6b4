// Water in the pores of zones: effective stress, buoyancy, and the energy balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::zones_water_test {
namespace {

using testing::ran;
using testing::Ran;

constexpr double weight = 9810.0;  // N/m3, of the water

std::string soil(double density, const std::string& more) {
  return "gravity = [0, -9.81]\n[materials.soil]\ndensity = " + number(density) +
         "\nyoung = 5e7\npoisson = 0.3\n" + more + "[joints.j]\nfriction_angle = 30\n" +
         "[contact]\njoint = 'j'\n";
}

std::string held(const std::string& outline) {
  return "[domain]\nmaterial = 'soil'\noutline = " + outline +
         "\n[zones]\nsize = 1.0\n[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n"
         "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n[[stage]]\nuntil = 'equilibrium'\n";
}

const std::string column = "[[0, 0], [4, 0], [4, 10], [0, 10]]";
const std::string table = "[[water]]\ntable = [[0, 10], [4, 10]]\n";

/// Calls body(depth, total stress, pore pressure) for each zone.
template <class Body>
void each_zone(const Simulation& sim, Body body) {
  const BlockSet& b = sim.scene->blocks;
  const Zones& zones = sim.motion.zones;
  for (std::size_t z = 0; z < b.meshes.zone.size(); ++z) {
    const double y = b.centroid_y[0] + b.origin.y + centre_of_zone(b.meshes, z).y;
    body(10.0 - y, zones.stress[z], zones.pore.empty() ? 0.0 : zones.pore[z]);
  }
}

/// Saturated ground that has settled under its weight: its own part of the stress is that of its
/// buoyant weight, with nu/(1 - nu) of it across.
TEST(ZonesWater, SaturatedGroundHasTheEffectiveStressOfItsBuoyantWeight) {
  const Ran r = ran(soil(2000.0, "") + held(column) + table);
  ASSERT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
  const double heavy = 2000.0 * 9.81, most = 10.0 * heavy;
  each_zone(r.ready.sim, [&](double depth, const std::array<double, 4>& total, double pore) {
    EXPECT_NEAR(pore, weight * depth, 1e-3 * most);
    EXPECT_NEAR(total[1], -heavy * depth, 0.02 * most);
    EXPECT_NEAR(total[2] + pore, 0.3 * (total[0] + total[1] + 2.0 * pore), 1e-3 * most);
    EXPECT_NEAR(total[0] + pore, 0.3 / 0.7 * (total[1] + pore), 0.05 * most);
  });
}

/// Without pores, as undrained clay, it has that of its whole weight.
TEST(ZonesWater, RockWithoutPoresHasTotalStresses) {
  const Ran r = ran(soil(2000.0, "pore_pressure = false\n") + held(column) + table);
  ASSERT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_TRUE(r.ready.sim.motion.zones.pore.empty());
  each_zone(r.ready.sim, [&](double, const std::array<double, 4>& total, double) {
    EXPECT_NEAR(total[0], 0.3 / 0.7 * total[1], 0.05 * 2e5);
  });
}

/// An initial stress is one of total stresses: saturated ground starts in equilibrium, and yields
/// nowhere within its strength.
TEST(ZonesWater, InitialStressIncludesThePorePressure) {
  const std::string sand = "yield = { friction_angle = 30, cohesion = '1 kPa' }\n";
  Simulation sim = scene(soil(2000.0, sand) + held(column) + table +
                         "[initial_stress]\nk0 = 0.75\nsurface = 'outline'\n");
  each_zone(sim, [&](double depth, const std::array<double, 4>& total, double pore) {
    EXPECT_NEAR(pore, weight * depth, 1e-6 * 2e5);
    EXPECT_NEAR(total[1], -2000.0 * 9.81 * depth, 1e-3 * 2e5);
    EXPECT_NEAR(total[0], -0.75 * 2000.0 * 9.81 * depth, 1e-3 * 2e5);
    EXPECT_NEAR(total[2], total[0], 1e-3 * 2e5);
  });
  const Zones& zones = sim.motion.zones;
  EXPECT_EQ(std::count(zones.yielding.begin(), zones.yielding.end(), 0),
            static_cast<std::ptrdiff_t>(zones.yielding.size()));
  for (int n = 0; n < 200; ++n) EXPECT_FALSE(step(sim));
  double moved = 0.0;
  for (std::size_t v = 0; v < sim.scene->blocks.vertex_count(); ++v)
    moved = std::max(moved, std::hypot(sim.motion.pose.x[v] - sim.scene->blocks.vertex_x[v],
                                       sim.motion.pose.y[v] - sim.scene->blocks.vertex_y[v]));
  EXPECT_LT(moved, 1e-5);
}

/// Deep under a lake ground moves as dry ground does that is lighter by the water.
TEST(ZonesWater, UnderALakeGroundIsLighter) {
  const std::string slope = "[[0, 0], [24, 0], [24, 5], [18, 5], [8, 10], [0, 10]]";
  const std::string sand = "yield = { friction_angle = 30, cohesion = '4 kPa' }\n";
  const auto settled = [&](double density, const std::string& lake) {
    const Ran r = ran(soil(density, sand) + held(slope) + lake);
    EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
    const BlockSet& b = r.ready.sim.scene->blocks;
    const Pose& pose = r.ready.sim.motion.pose;
    std::vector<Vec2> moved;
    for (std::size_t v = 0; v < b.vertex_count(); ++v)
      moved.push_back({pose.x[v] - b.vertex_x[v], pose.y[v] - b.vertex_y[v]});
    return moved;
  };
  const std::vector<Vec2> wet = settled(2000.0, "[[water]]\ntable = [[0, 25], [24, 25]]\n"),
                          dry = settled(1000.0, "");
  ASSERT_EQ(wet.size(), dry.size());
  double most = 0.0, off = 0.0;
  for (std::size_t v = 0; v < wet.size(); ++v) {
    most = std::max(most, norm(dry[v]));
    off = std::max(off, norm(wet[v] - dry[v]));
  }
  EXPECT_GT(most, 1e-3);
  EXPECT_LT(off, 0.01 * most);
}

/// Water that rises and falls in ground that moves: its work is accounted for.
TEST(ZonesWater, EnergyBalancesAsTheWaterRises) {
  Simulation sim =
      scene(soil(2000.0, "yield = { friction_angle = 30, cohesion = '4 kPa' }\n") +
            "[domain]\nmaterial = 'soil'\noutline = " + column +
            "\n[zones]\nsize = 1.0\n[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n"
            "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n[solver]\nduration = 1.0\n"
            "[output]\nhistory_every = 0.01\n[[water]]\ntable = [[0, 2], [4, 2]]\n"
            "history = 'tests/verification/water_up.csv'\n");
  double drift = 0.0;
  run(sim, [&](Simulation& s) { keep_largest(drift, account_energy(s).error); });
  EXPECT_LT(drift, 2e-5);
  EXPECT_GT(std::abs(work_of_pores(sim.motion.zones)), 1.0);
}

}  // namespace
}  // namespace edda::zones_water_test
