// Slopes as joint statistics cut them: what their contacts carry is what their geometry shows.
// tools/study-slopes looks at two hundred larger ones.
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
                           << ", drift " << look.drift << ' ' << look.failure;
}

/// Blocks of one cut never overlap, so nothing is pushed about at the start, however thin the
/// wedges that the cut makes.
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

/// With a stress in the ground contacts carry it from the start, and no more than it.
TEST(CutSlopes, AnInitialStressPutsNothingOnFarSides) {
  for (unsigned n = 0; n < 9; ++n) {
    CutSlope slope = cut_slope(2 * n, 15.0);
    slope.more = "[initial_stress]\nk0 = 0.8\nsurface = 'outline'\n";
    Simulation sim = scene(slope_model(slope));
    EXPECT_LT(false_depth(sim, outlines(sim.blocks, sim.pose)), 1e-9) << n;
    sim.start(1.0);
    const double stored = sim.ledger().contact + sim.ledger().strain;
    while (sim.state.steps < 100) ASSERT_FALSE(sim.step().has_value()) << n;
    EXPECT_LT(sim.ledger().kinetic, 0.05 * stored) << n;
    EXPECT_LT(std::abs(sim.ledger().drift), 1e-5) << n;
    EXPECT_LT(deepest_overlap(outlines(sim.blocks, sim.pose)), 1e-3) << n;
  }
}

/// A needle whose far side is bonded to a block of its own, and a sharp corner that ends on its
/// near side, a centimetre from there.
TEST(CutSlopes, ASharpCornerBesideANeedleIsNotHeldAgainstTheFarSideOfIt) {
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
  std::vector<Outline> blocks = outlines(sim.blocks, sim.pose);
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_LT(deepest_overlap(blocks), 1e-9);
  EXPECT_LT(false_depth(sim, blocks), 1e-9);
  sim.start(0.01);
  EXPECT_LT(std::abs(sim.ledger().contact), 1e-9);
  while (sim.state.time < 0.01) ASSERT_FALSE(sim.step().has_value());
  EXPECT_LT(sim.ledger().kinetic, 1e-9);
  EXPECT_LT(deepest_overlap(outlines(sim.blocks, sim.pose)), 1e-9);
}

}  // namespace
}  // namespace edda::slope_test
