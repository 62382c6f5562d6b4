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
  double error = 0.0, fracture = 0.0, friction = 0.0;
  std::uint64_t tension = 0, shear = 0;
};

Seen follow(Simulation& sim) {
  Seen seen;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    keep_largest(seen.error, l.error);
    EXPECT_GE(l.fracture, seen.fracture - 1e-9 * g1 * height);
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

}  // namespace
}  // namespace edda::fracture_test
