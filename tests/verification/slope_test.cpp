// Slopes cut by joint statistics: only contacts that exist in the geometry carry forces.
// tools/study-slopes looks at two hundred larger ones.
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/cut_slope.hpp"

namespace edda::slope_test {
namespace {

void expect_sound(const CutSlope& slope, std::uint64_t steps) {
  const SlopeLook look = look_at_slope(slope, steps);
  EXPECT_TRUE(look.good()) << slope.seed << ' ' << slope.distribution << " +- " << slope.angle
                           << ": drawn overlap " << look.drawn_overlap << ", false depth "
                           << look.drawn_false_depth << ", push " << look.drawn_push << ", energy "
                           << look.drawn_energy << "; later overlap " << look.overlap
                           << ", false depth " << look.false_depth << ", unfelt " << look.unfelt
                           << ", drift " << look.error << ' ' << look.failure;
}

/// Blocks of one cut never penetrate each other, so no contact carries a force at the start,
/// however thin the wedges of the cut are.
TEST(CutSlopes, NothingPressesAsDrawnAndNothingIsMissedLater) {
  for (unsigned n = 0; n < 27; ++n) expect_sound(cut_slope(n, 15.0), 150);
}

TEST(CutSlopes, NorWhereSliversStay) {
  for (unsigned n = 0; n < 9; ++n) {
    CutSlope slope = cut_slope(2 * n, 15.0);
    slope.more = "[quality]\naction = 'report'\n";
    expect_sound(slope, 50);
  }
}

/// With an initial stress contacts carry it from the start, and nothing besides.
TEST(CutSlopes, AnInitialStressPutsNothingOnFarSides) {
  for (unsigned n = 0; n < 9; ++n) {
    CutSlope slope = cut_slope(2 * n, 15.0);
    slope.more = "[initial_stress]\nk0 = 0.8\nsurface = 'outline'\n";
    Simulation sim = scene(slope_model(slope));
    EXPECT_LT(false_depth(sim, outlines(sim.scene->blocks, sim.motion.pose)), 1e-9) << n;
    start(sim, 1.0);
    const double stored = account_energy(sim).contact + account_energy(sim).strain;
    while (sim.motion.state.steps < 100) ASSERT_FALSE(step(sim).has_value()) << n;
    EXPECT_LT(account_energy(sim).kinetic, 0.05 * stored) << n;
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-5) << n;
    EXPECT_LT(deepest_overlap(outlines(sim.scene->blocks, sim.motion.pose)), 1e-3) << n;
  }
}

/// A needle whose far side is bonded to another block, and a sharp corner that ends on its near
/// side, a centimetre from there.
TEST(CutSlopes, ASharpCornerBesideANeedleIsNotPressedByItsFarSide) {
  Simulation sim = scene(R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2600.0
young = 5e9
poisson = 0.25
[joints.j]
friction_angle = 30.0
cohesion = "1 MPa"
tensile_strength = "1 MPa"
[solver]
duration = 0.01
[domain]
outline = [[0, 0], [10, 0], [10, 4], [0, 4]]
[[trace]]
points = [[0, 2], [10, 2]]
[[trace]]
points = [[0, 2.2], [6, 2]]
[[trace]]
points = [[0, 2.32], [5.7, 2.01]]
[quality]
action = "report"
)");
  std::vector<Outline> blocks = outlines(sim.scene->blocks, sim.motion.pose);
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_LT(deepest_overlap(blocks), 1e-9);
  EXPECT_LT(false_depth(sim, blocks), 1e-9);
  start(sim, 0.01);
  EXPECT_LT(std::abs(account_energy(sim).contact), 1e-9);
  while (sim.motion.state.time < 0.01) ASSERT_FALSE(step(sim).has_value());
  EXPECT_LT(account_energy(sim).kinetic, 1e-9);
  EXPECT_LT(deepest_overlap(outlines(sim.scene->blocks, sim.motion.pose)), 1e-9);
}

}  // namespace
}  // namespace edda::slope_test
