// Problems in equilibrium: validation.md rows 9, 11, 13, 20.
#include <algorithm>
#include <map>

#include "observe/observe.hpp"
#include "step/faces_now.hpp"
#include "verification/models.hpp"
#include "verification/settled.hpp"

namespace edda::statics_test {
namespace {

/// Row 9: a column of ten blocks under its own weight.
TEST(Column, StressAndSettlement) {
  Simulation sim = scene(column("duration = 3.0\ndamping = { mass = 20.0 }\n"));
  run(sim, [](Simulation&) {});
  expect_at_rest(sim, "explicit");
}

/// Row 11: L/(c0 sqrt(3 (1 + kappa))) of a column of unit blocks.
double critical_step(double kappa) {
  return 1.0 / (std::sqrt(1e10 / 2500.0) * std::sqrt(3.0 * (1.0 + kappa)));
}

TEST(Column, CriticalStep) {
  Series steps(11, "critical step", {"kappa", "exact", "computed"});
  Series formula(11, "formula", {"kappa", "exact"});
  for (int i = 0; i <= 60; ++i) {
    const double kappa = std::pow(10.0, -2.0 + 5.0 * i / 60.0);
    formula.add({kappa, critical_step(kappa)});
  }
  for (const double p : {1e8, 1e9, 1e10, 1e11, 1e12}) {
    std::string toml =
        "plane = 'stress'\n[materials.rock]\ndensity = 2500.0\nyoung = 1e10\ndamping = 0\n"
        "poisson = 0.0\n[joints.j]\nfriction_angle = 30\n[contact]\n"
        "normal_stiffness = " +
        number(p) + "\n[solver]\nduration = 1.0\n";
    for (int i = 0; i < 200; ++i)
      toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
    const Simulation sim = scene(toml);
    const double kappa = 2.0 * p * 1.0 / (1e10 * 1.0), exact = critical_step(kappa);
    steps.add({kappa, exact, sim.control.bound.critical_step});
    expect_relative({11, "kappa = " + brief(kappa), "bound of the step", "s"},
                    sim.control.bound.critical_step, exact, -0.3, 1e-9);
    if (p == 1e10) record_model(11, "kappa = " + brief(kappa), sim);
  }
}

TEST(Arch, OfSofterStoneStandsWhenItsWeightComesSlowly) {
  const PreparedRun r = settled(arch(0.1085, "", 20e9) + "[[stage]]\nuntil = 'equilibrium'\n");
  for (std::size_t i = 2; i < r.sim.scene->blocks.size(); ++i)
    EXPECT_LT(norm(displacement(r.sim, i)), 0.01) << i;
}

/// Row 13: the limit of a semicircular arch of 16 voussoirs is t/R = 0.1072. Its gravity acts at
/// once: voussoirs of softer stone bend in the jolt, and the hinges that open are too many.
TEST(Arch, StandsAndFalls) {
  for (const auto& [ratio, stands] : {std::pair{0.1085, true}, std::pair{0.107, false}}) {
    Simulation sim = scene(arch(ratio, "duration = 4.0\ndamping = { mass = 0.5 }\n", 200e9));
    expect_arch(ratio, stands, sim, "");
  }
}

/// Four unit squares that meet at a point in a fixed box, which is 2 dx narrower and 2 dy lower
/// than the squares are.
std::string four_blocks_in_a_box(double dx, double dy) {
  std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 0.0
[solver]
duration = 0.2
damping = { mass = 500.0 }
[output]
history_every = 0.001
)";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, -1.5, -1 + dx, 1.5) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(1 - dx, -1.5, 1.5, 1.5) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, -1.5, 1.5, -1 + dy) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, 1 - dy, 1.5, 1.5) + "\n";
  for (const auto& [x, y] :
       {std::pair{-1, -1}, std::pair{0, -1}, std::pair{-1, 0}, std::pair{0, 0}}) {
    toml += "[[block]]\npolygon = " + rectangle(x, y, x + 1, y + 1) + "\n";
  }
  return toml;
}

/// Row 20: four blocks that meet at a point, compressed in a fixed box.
TEST(LoadPath, FourBlocksInABox) {
  const double dx = 0.5e-4, dy = 0.3e-4, young = 20e9, nu = 0.2, p = 2e11;
  Simulation sim = scene(four_blocks_in_a_box(dx, dy));
  // Along x: two blocks and three interfaces of 2 p share the closure 2 dx; plane strain couples x
  // and y.
  const double c11 = (1 - nu * nu) / young, c12 = -nu * (1 + nu) / young, spring = 3.0 / (2.0 * p);
  const double a = 2 * c11 + spring, b = 2 * c12;
  const double sx = -(a * 2 * dx - b * 2 * dy) / (a * a - b * b);
  const double sy = -(a * 2 * dy - b * 2 * dx) / (a * a - b * b);
  Series series(20, "stress", {"time", "exact xx", "exact yy", "xx", "yy"});
  run(sim, [&](Simulation& s) {
    series.add({s.motion.state.time, sx, sy, stress_of(s, 4).xx, stress_of(s, 4).yy});
  });
  FurthestOff along, across;
  double shear = 0.0;
  for (std::size_t i = 4; i < 8; ++i) {
    const Tensor s = stress_of(sim, i);
    along.see(s.xx, sx);
    across.see(s.yy, sy);
    shear = std::max(shear, std::abs(s.xy / sx));
  }
  along.expect({20, "", "stress xx, block furthest off", "Pa"}, 1e-4);
  across.expect({20, "", "stress yy, block furthest off", "Pa"}, 1e-4);
  expect_at_most({20, "", "stress xy over xx, block furthest off", ""}, shear, 1e-6);
  double diagonal = 0.0;
  std::map<std::pair<Id, Id>, int> carrying;
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
    const Id i = std::min(block_of_edge(sim.scene->blocks, sim.motion.contacts, k),
                          block_of_facing(sim.scene->blocks, sim.motion.contacts, k));
    const Id j = std::max(block_of_edge(sim.scene->blocks, sim.motion.contacts, k),
                          block_of_facing(sim.scene->blocks, sim.motion.contacts, k));
    const double force = normal_force(face_row(sim, k));
    if ((i == 4 && j == 7) || (i == 5 && j == 6)) diagonal = std::max(diagonal, std::abs(force));
    if (i >= 4 && force > 0.0) ++carrying[{i, j}];
  }
  expect_at_most({20, "", "force across a diagonal over that on a side", ""},
                 diagonal / std::abs(sx), 1e-5);
  // One face each.
  for (const auto& [i, j] : {std::pair{4, 5}, std::pair{4, 6}, std::pair{5, 7}, std::pair{6, 7}}) {
    EXPECT_EQ((carrying[{static_cast<Id>(i), static_cast<Id>(j)}]), 1) << i << ' ' << j;
  }
  record_model(20, "", sim);
}

/// A block on a joint without tensile strength, loaded with the eccentricity e. Stresses are
/// linear: P/L (1 +- 6 e/L) while all of it is closed, e < L/6; else P over the closed part 3 (L/2
/// - e), where they rise from 0 to 2 P over the closed length.
TEST(EccentricLoad, StressesOfAJoint) {
  const double load = 1e3, length = 2.0;
  for (const double part : {0.0, 0.05, 0.15, 0.2, 0.3, 0.4, 0.45}) {
    const double e = part * length;
    PreparedRun ready = settled(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 2e10\npoisson = 0.2\n"
        "[joints.j]\nfriction_angle = 30\nkn = 1e9\nks = 1e9\n[[block]]\nfixed = true\n"
        "polygon = " +
        rectangle(-3, -1, 3, 0) + "\n[[block]]\npolygon = " + rectangle(-1, 0, 1, 0.5) +
        "\n[[load]]\npoint = [" + number(e) + ", 0.01]\nforce = [0, " + number(-load) +
        "]\n[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n");
    Instant at;
    observe(ready.sim, at);
    const Picture picture = picture_of(ready.sim, at);
    const auto pressed = std::find_if(picture.contacts.begin(), picture.contacts.end(),
                                      [](const ContactRecord& c) { return c.normal_force > 0.0; });
    ASSERT_NE(pressed, picture.contacts.end());
    const ContactRecord& c = *pressed;
    const double mean = load / length;
    const bool whole = part < 1.0 / 6.0;
    const double closed = whole ? length : 3.0 * (0.5 * length - e);
    const double most = whole ? mean * (1.0 + 6.0 * part) : 2.0 * load / closed;
    const double least = whole ? mean * (1.0 - 6.0 * part) : 0.0;
    const bool a_deeper = c.normal_stress_a > c.normal_stress_b;
    if (part > 0.0) {
      EXPECT_NEAR((a_deeper ? c.a : c.b).x, 1.0, 1e-3) << "the load is on this side";
    }
    EXPECT_NEAR(c.length, length, 1e-4);
    EXPECT_NEAR(c.closed_length, closed, 2e-4 * length) << part;
    EXPECT_NEAR(c.normal_stress, mean, 1e-6 * mean);
    EXPECT_NEAR(std::max(c.normal_stress_a, c.normal_stress_b), most, 2e-4 * most) << part;
    EXPECT_NEAR(std::min(c.normal_stress_a, c.normal_stress_b), least, 2e-4 * most) << part;
  }
}

}  // namespace
}  // namespace edda::statics_test
