// Joints with fracture energy in bodies that move (theory, section 5.9): a plate that is pulled
// apart, and one whose halves are sheared.
#include <cmath>
#include <functional>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::fracture_test {
namespace {

constexpr double tension = 2e6, cohesion = 6e6, g1 = 60.0, g2 = 900.0, height = 0.1;

/// A plate of 0.4 x 0.1 m cut by a joint in its middle; its ends have these boundaries.
std::string plate(const std::string& left, const std::string& right, double duration,
                  const std::string& more = {}) {
  return "gravity = [0, 0]\n" + more +
         "[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = 0\n"
         "[joints.j]\nfriction_angle = 30\ncohesion = 6e6\ntensile_strength = 2e6\n"
         "fracture_energy = 60\nshear_fracture_energy = 900\n[contact]\njoint = 'j'\n"
         "[[block]]\npolygon = " +
         rectangle(0, 0, 0.2, height) + "\n[[block]]\npolygon = " + rectangle(0.2, 0, 0.4, height) +
         "\n[[boundary]]\nsides = ['left']\n" + left + "\n[[boundary]]\nsides = ['right']\n" +
         right + "\n[solver]\nduration = " + number(duration) +
         "\n[output]\nhistory_every = " + number(duration / 50.0) + "\n";
}

struct Seen {
  double error = 0.0, transfer = 0.0, scale = 0.0, fracture = 0.0, friction = 0.0;
  std::uint64_t tension = 0, shear = 0;
};

Seen follow(Simulation& sim) {
  Seen seen;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    keep_largest(seen.error, l.error);
    EXPECT_GE(l.fracture, seen.fracture - 1e-9 * g1 * height);
    keep_largest(seen.transfer, std::abs(l.transfer));
    keep_largest(seen.scale, l.scale());
    seen.fracture = l.fracture;
    seen.friction = l.friction;
    seen.tension = s.motion.contacts.cracks_tension;
    seen.shear = s.motion.contacts.cracks_shear;
  });
  return seen;
}

/// The right end moves away: the joint breaks in tension, and takes G_I for each area.
TEST(Fracture, PlatePulledApart) {
  for (const std::string more : {"", "deformation = 'zones'\n[zones]\nsize = 0.05\n"}) {
    Simulation sim =
        scene(plate("type = 'fixed'", "type = 'velocity'\nvelocity = [0.02, 0]", 0.02, more));
    const Seen seen = follow(sim);
    EXPECT_LT(seen.error, 1e-6);
    EXPECT_GE(seen.tension, 1u);
    EXPECT_EQ(seen.shear, 0u);
    expect_relative(
        {78, more.empty() ? "pulled apart" : "pulled apart, in zones", "energy of the crack", "J"},
        seen.fracture, g1 * height, 2e-3);
  }
}

/// The right end moves upwards, and the halves press each other no more than that makes them.
TEST(Fracture, PlateSheared) {
  Simulation sim = scene(plate("type = 'fixed'", "type = 'velocity'\nvelocity = [0, 0.4]", 0.02));
  const Seen seen = follow(sim);
  EXPECT_LT(seen.error, 1e-6);
  EXPECT_EQ(seen.tension, 0u);
  EXPECT_EQ(seen.shear, 1u);
  expect_relative({78, "sheared", "energy of the crack", "J"}, seen.fracture, g2 * height, 0.05);
}

/// A sample of few grains, some of which the sides cut to shards, is crushed between platens under
/// 5 MPa on its sides. Sharp ends of very short edges would pierce other grains.
TEST(Fracture, GrainsUnderHighStressKeepTheirEnergy) {
  const std::string sides = "type = 'stress'\nhistory = 'tests/verification/sides_press.csv'\n";
  Simulation sim = scene(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 30e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 30\ncohesion = 6e6\ntensile_strength = 3e6\n"
      "fracture_energy = 5.76\nshear_fracture_energy = 57.6\n[contact]\njoint = 'j'\n"
      "[domain]\noutline = " +
      rectangle(-0.025, 0, 0.025, 0.1) +
      "\n[voronoi]\nsize = 0.01\nseed = 22\n[quality]\nmin_edge = 8e-4\n"
      "[[boundary]]\nsides = ['bottom']\ntype = 'roller'\n[[boundary]]\nsides = ['top']\n"
      "type = 'velocity'\nvelocity = [0, -0.4]\nfrictionless = true\n"
      "[[boundary]]\nsides = ['left']\ntraction = [5e6, 0]\n" +
      sides + "[[boundary]]\nsides = ['right']\ntraction = [-5e6, 0]\n" + sides +
      "[solver]\nduration = 0.003\ndamping = { mass = 2000 }\nmass_scaling = 8e-8\n"
      "[output]\nhistory_every = 1.5e-5\n");
  const Seen seen = follow(sim);
  EXPECT_GT(seen.tension + seen.shear, 20u);
  EXPECT_LT(seen.error, 2e-6);
  EXPECT_LT(seen.transfer, 5e-4 * seen.scale);
}

}  // namespace
}  // namespace edda::fracture_test
