// The strength of a disc pressed along its diameter (Brazilian test), by the size of its grains,
// whose joints have fracture energy (theory, section 5.9).
#include <algorithm>
#include <cmath>

#include "observe/attachment_rows.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::fracture_long_test {
namespace {

constexpr double diameter = 0.05, tension = 3e6, young = 30e9, poisson = 0.2;

/// So many grains across; pressed over an arc of 2 x 7.5 degrees at the top. l_ch is 0.4 diameters.
std::string disc(double grains) {
  const double energy = 0.4 * diameter * tension * tension * (1.0 - poisson * poisson) / young;
  constexpr int corners = 120, arc = 3;
  const double time = 5e-4, closure = 9.0 * tension / young * diameter;
  std::string outline, top, base;
  for (int n = 0; n < corners; ++n) {
    const double at = 2.0 * 3.141592653589793 * (n + 0.5) / corners;
    const double x = 0.5 * diameter * std::cos(at), y = 0.5 * diameter * std::sin(at);
    const auto add = [&](std::string& to, double height) {
      to += (to.empty() ? "[" : ", [") + number(x) + ", " + number(height) + "]";
    };
    add(outline, y);
    if (std::abs(n + 0.5 - corners / 4) > arc) continue;
    add(top, y);
    add(base, -y);
  }
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 30e9\npoisson = 0.2\n"
         "[joints.j]\nfriction_angle = 30\ncohesion = 6e6\ntensile_strength = 3e6\n"
         "fracture_energy = " +
         number(energy) + "\nshear_fracture_energy = " + number(10.0 * energy) +
         "\n[contact]\njoint = 'j'\n[domain]\noutline = [" + outline +
         "]\n[voronoi]\nsize = " + number(diameter / grains) +
         "\n[quality]\nmin_edge = " + number(0.08 * diameter / grains) +
         "\n[[boundary]]\nname = 'base'\nalong = [" + base +
         "]\n[[boundary]]\nname = 'load'\ntype = 'velocity'\nvelocity = [0, " +
         number(-closure / time) + "]\nalong = [" + top +
         "]\n[solver]\nduration = " + number(time) +
         "\nmass_scaling = 2e-8\ndamping = { mass = 16000 }\n[output]\nhistory_every = " +
         number(time / 200.0) + "\n";
}

struct Strength {
  double of_tension = 0.0, error = 0.0;  ///< 2 P/(pi D T)
  std::uint64_t cracks = 0;
};
Strength strength_of_disc(double grains) {
  Simulation sim = scene(disc(grains));
  Strength found;
  Instant at;
  run(sim, [&](Simulation& s) {
    keep_largest(found.error, account_energy(s).error);
    observe(s, at);
    const double force = reactions(s, at)[0].y;
    keep_largest(found.of_tension, 2.0 * force / 3.141592653589793 / diameter / tension);
    found.cracks = s.motion.contacts.cracks_tension;
  });
  return found;
}

/// Half as large grains: the same strength, of crack paths as rough as the grains make them.
TEST(FractureOfDiscs, StrengthDoesNotDependOnGrains) {
  const Strength coarse = strength_of_disc(10), fine = strength_of_disc(16);
  for (const Strength& s : {coarse, fine}) {
    EXPECT_LT(s.error, 1e-5);
    EXPECT_GT(s.cracks, 5u);
  }
  expect_relative({78, "discs", "strength with 10 grains across, of that with 16", ""},
                  coarse.of_tension / fine.of_tension, 1.0, 0.1);
  EXPECT_NEAR(fine.of_tension, 1.5, 0.15);
}

}  // namespace
}  // namespace edda::fracture_long_test
