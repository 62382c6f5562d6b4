// Slides over hundreds of boundaries between pieces: flush, with steps, and in a fault under normal
// stress.
#include "step/faces_now.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::long_slide_test {
namespace {

constexpr double gravity = 9.8, slope = 30.0, friction = 15.0, duration = 5.69, piece = 0.25;

/// g (sin a - tan phi cos a).
double acceleration() {
  const double a = radians(slope);
  return gravity * (std::sin(a) - std::tan(radians(friction)) * std::cos(a));
}

enum class Steps { none, up_and_down, down, up };

/// Tops of the pieces from x = -1 m on: beyond 2 m each is 1e-4 m higher or lower than the last.
std::vector<double> tops(Steps steps) {
  constexpr double step = 1e-4;
  const double end = 0.5 * acceleration() * duration * duration + 4.0;
  std::vector<double> all;
  double y = 0.0;
  for (double x = -1.0; x < end; x += piece) {
    all.push_back(y);
    if (x <= 2.0) continue;
    if (steps == Steps::up_and_down) y = all.size() % 2 == 1 ? step : 0.0;
    if (steps == Steps::down) y -= step;
    if (steps == Steps::up) y += step;
  }
  return all;
}

/// Distance that a block of 2 x 1 m slides down the slope, m.
double slid_over(Steps steps, const std::string& rock = {}) {
  std::string text =
      "gravity = [" + number(gravity * std::sin(radians(slope))) + ", " +
      number(-gravity * std::cos(radians(slope))) +
      "]\n[materials.rock]\ndensity = 2750\nyoung = 200e6\npoisson = 0.25\n" + rock +
      "[joints.j]\nfriction_angle = " + number(friction) +
      "\n[solver]\nduration = " + number(duration) +
      "\n[output]\nhistory_every = 0.0569\n[[block]]\npolygon = " + rectangle(0, 0, 2, 1) + "\n";
  double x = -1.0;
  for (const double y : tops(steps)) {
    text += "[[block]]\nfixed = true\npolygon = " + rectangle(x, y - 1.0, x + piece, y) + "\n";
    x += piece;
  }
  Simulation sim = scene(text);
  run(sim, [](Simulation&) {});
  return displacement(sim, 0).x;
}

/// Rigid: v^2/2 = a s - g cos(a) h(s), h the mean of the tops under its two ends.
double exact_way(Steps steps) {
  const std::vector<double> top = tops(steps);
  const auto under = [&](double x) { return top[static_cast<std::size_t>((x + 1.0) / piece)]; };
  constexpr double ds = 1e-4;
  double s = ds, t = std::sqrt(2.0 * ds / acceleration()), v = acceleration() * t;
  while (true) {
    const double h = 0.5 * (under(s + ds) + under(s + ds + 2.0));
    const double next =
        std::sqrt(2.0 * (acceleration() * (s + ds) - gravity * std::cos(radians(slope)) * h));
    const double dt = 2.0 * ds / (v + next);
    if (t + dt > duration) return s + ds * (duration - t) / dt;
    t += dt;
    s += ds;
    v = next;
  }
}

TEST(LongSlide, OverAHundredAndNinetyBoundaries) {
  EXPECT_EQ(tops(Steps::none).size(), 190u + 1u);
  expect_relative({61, "flush", "distance slid", "m"}, slid_over(Steps::none),
                  exact_way(Steps::none), 1e-5);
  expect_relative({61, "flush, rock without damping", "distance slid", "m"},
                  slid_over(Steps::none, "damping = 0\n"), exact_way(Steps::none), 3e-4);
}

TEST(LongSlide, OverSteps) {
  expect_relative({61, "up and down by 0.1 mm", "distance slid", "m"},
                  slid_over(Steps::up_and_down), exact_way(Steps::up_and_down), 1e-4);
  expect_relative({61, "down by 0.1 mm each", "distance slid", "m"}, slid_over(Steps::down),
                  exact_way(Steps::down), 3e-4);
  expect_relative({61, "up by 0.1 mm each", "distance slid", "m"}, slid_over(Steps::up),
                  exact_way(Steps::up), 3e-4);
}

/// A block between two rows of 32 pieces each slides at 8 m/s in a fault whose normal stress of 10
/// MPa stays constant above and below it; the friction of this stress decelerates it. Where two
/// corners pass each other the overlap is shorter by r/4, r = (da^2 + db^2)^(1/2)/3: 1.2e-4 m here,
/// twice that where both ends of the block pass boundaries at once; and as often as the block has
/// nodes within its edges where it bends. Friction acts once the block has slipped, half a step
/// late.
TEST(LongSlide, APreloadedFaultKeepsItsSqueeze) {
  constexpr double young = 20e9, speed = 8.0, time = 0.25, density = 2500.0, height = 0.5;
  for (const auto& [length, deformation] :
       {std::pair{1.1, "uniform"}, {1.0, "uniform"}, {1.1, "corners"}, {1.0, "corners"}}) {
    for (const double angle : {0.0, 0.1}) {
      const bool bends = std::string(deformation) == "corners";
      std::string text =
          "deformation = '" + std::string(deformation) +
          "'\ngravity = [0, 0]\n[materials.rock]\ndensity = " + number(density) +
          "\nyoung = " + number(young) +
          "\npoisson = 0.2\n[joints.j]\nkn = 1e10\nks = 1e10\nfriction_angle = " + number(angle) +
          "\n[initial_stress]\nstress = [0.0, -10e6, 0.0]\n[solver]\nduration = " + number(time) +
          "\n[output]\nhistory_every = 0.0025\n[[block]]\nvelocity = [" + number(speed) +
          ", 0]\npolygon = " + rectangle(0, 0, length, height) + "\n";
      for (double x = -2.0; x < 6.0; x += piece) {
        for (const double y : {-1.0, height})
          text +=
              "[[block]]\nfixed = true\npolygon = " + rectangle(x, y, x + piece, y + 1.0) + "\n";
      }
      Simulation sim = scene(text);
      const double compression = 2.0 * 10e6 * length;
      double off = 0.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            double sum = 0.0;
            for (std::size_t k = 0; k < s.motion.contacts.size(); ++k)
              sum += normal_force(face_row(s, k));
            keep_largest(off, sum / compression - 1.0);
          });
      const std::string label =
          brief(length) + " m, friction " + brief(angle) + (bends ? ", bends" : "");
      expect_at_most({61, "fault, " + label, "compression, furthest off", ""}, off,
                     bends           ? 2e-3
                     : length == 1.0 ? 4e-4
                                     : 2e-4);
      const double braked = compression * std::tan(radians(angle)) / (density * length * height);
      expect_relative({61, "fault, " + label, "distance slid", "m"}, displacement(sim, 0).x,
                      speed * time - 0.5 * braked * time * time, 1e-3);
    }
  }
}

}  // namespace
}  // namespace edda::long_slide_test
