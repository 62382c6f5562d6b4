// What makes such codes fail: thin blocks, fast blocks, large blocks on small ones, corners that
// pass corners.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/heap_watch.hpp"
#include "verification/random_heap.hpp"

namespace edda::trouble_test {
namespace {

constexpr const char* rock = R"(
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
)";

std::string joint(double friction) {
  return "[joints.j]\nfriction_angle = " + number(friction) + "\n";
}

std::string fixed_block(const std::string& polygon) {
  return "[[block]]\nfixed = true\npolygon = " + polygon + "\n";
}

/// A thin block thrown flat, edgewise or corner first at a thin plate, with increasing speed: it
/// rebounds or is stopped, and never passes to the other side.
TEST(ThinPlate, IsNotPassed) {
  const double thin = 0.002, plate = 0.005;
  for (const double speed : {8.0, 50.0}) {
    for (const double tilt : {0.0, 3.0, 45.0, 87.0, 90.0}) {
      Ring ring;
      const double a = radians(tilt);
      for (Vec2 p : {Vec2{-0.1, -thin}, Vec2{0.1, -thin}, Vec2{0.1, thin}, Vec2{-0.1, thin}})
        ring.push_back(rotated(p, a) + Vec2{0.03, 0.2});
      Simulation sim = scene("gravity = [0, 0]\n" + std::string(rock) + joint(20) +
                             "[solver]\nduration = " + number(0.4 / speed) +
                             "\n[output]\nhistory_every = " + number(0.02 / speed) + "\n" +
                             fixed_block(rectangle(-1, -plate, 1, 0)) +
                             block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
      double lowest = 1.0, error = 0.0;
      run(
          sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); },
          [&](Simulation& s) {
            for (Id v = 4; v < 8; ++v)
              lowest = std::min(lowest, s.motion.pose.y[v] + s.scene->blocks.origin.y);
          });
      EXPECT_GT(lowest, -0.5 * thin) << speed << ' ' << tilt;
      EXPECT_LT(error, 1e-3) << speed << ' ' << tilt;
      // Bounced: the centroid goes up in the end.
      EXPECT_GT(centroid(sim.motion.state.velocity, 1).y, 0.0) << speed << ' ' << tilt;
    }
  }
}

/// With contacts too soft for the speed blocks penetrate deeply: the run then ends with a message,
/// and no block comes out on the other side.
TEST(ThinPlate, IsNotPassedWithSoftContactsEither) {
  int stopped = 0, bounced = 0;
  for (const double stiffness : {1e6, 1e7, 1e8}) {
    for (const double speed : {5.0, 50.0, 200.0}) {
      for (const double tilt : {0.0, 3.0, 45.0, 90.0}) {
        Ring ring;
        for (Vec2 p : {Vec2{-0.1, 0}, Vec2{0.1, 0}, Vec2{0.02, 0.002}})
          ring.push_back(rotated(p, radians(tilt)) + Vec2{0.03, 0.2});
        const double duration = 0.6 / speed;
        Simulation sim = scene("gravity = [0, 0]\n" + std::string(rock) + "damping = 0\n" +
                               joint(20) + "[contact]\nnormal_stiffness = " + number(stiffness) +
                               "\n[solver]\nduration = " + number(duration) + "\n" +
                               fixed_block(rectangle(-1, -0.005, 1, 0)) +
                               block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
        start(sim, duration);
        bool failed = false;
        while (!failed && sim.motion.state.time < duration)
          failed = step(sim).has_value() || !sim.accounts.set_aside.empty();
        const double height = centroid(sim.motion.state.position, 1).y + sim.scene->blocks.origin.y;
        EXPECT_GT(height, -0.005) << stiffness << ' ' << speed << ' ' << tilt;
        (failed ? stopped : bounced) += 1;
      }
    }
  }
  EXPECT_GT(stopped, 5);
  EXPECT_GE(bounced, 4);
}

/// Slivers whose edges are long and whose width is not: the width must bound the step's motion.
TEST(ThinPlate, IsNotPassedBySlivers) {
  for (const double speed : {5.0, 20.0}) {
    for (const double turn : {0.0, 90.0, 180.0}) {
      Ring ring;
      for (Vec2 p : {Vec2{-0.5, 0}, Vec2{0.5, 0}, Vec2{0.1, 0.001}})
        ring.push_back(rotated(p, radians(turn)) + Vec2{0.0, 0.6});
      Simulation sim = scene("gravity = [0, 0]\n" + std::string(rock) + joint(20) +
                             "[solver]\nduration = " + number(1.4 / speed) +
                             "\n[output]\nhistory_every = " + number(0.1 / speed) + "\n" +
                             fixed_block("[[-2,0],[2,0],[0.3,0.0008]]") +
                             block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
      double lowest = 1.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            lowest =
                std::min(lowest, centroid(s.motion.state.position, 1).y + s.scene->blocks.origin.y);
          });
      EXPECT_GT(lowest, 0.0) << speed << ' ' << turn;
    }
  }
}

/// A block that slides over a flat row of blocks passes forty block boundaries: without a jump of
/// force, a loss or a gain of energy.
TEST(FlatRow, FortySeamsWithoutAKick) {
  for (const bool loose : {false, true}) {
    std::string toml =
        std::string(rock) + joint(0) + "[solver]\nduration = 2.0\n[output]\nhistory_every = 0.02\n";
    for (int i = 0; i < 40; ++i) toml += fixed_block(rectangle(0.25 * i, -1, 0.25 * (i + 1), 0));
    // Loose: with a second, smaller block on the sliding one.
    toml += "[[block]]\npolygon = " + rectangle(0.6, 0, 1.6, 0.7) + "\nvelocity = [4, 0]\n";
    if (loose)
      toml += "[[block]]\npolygon = " + rectangle(0.9, 0.7, 1.3, 1.0) + "\nvelocity = [4, 0]\n";
    Simulation sim = scene(toml);
    const std::size_t slider = 40;
    HeapWatch watch(64);
    double error = 0.0, worst = 0.0, highest = 0.0;
    run(
        sim,
        [&](Simulation& s) {
          keep_largest(error, account_energy(s).error);
          worst =
              std::max(worst, std::abs(centroid(s.motion.state.velocity, slider).x / 4.0 - 1.0));
          highest = std::max(highest, std::abs(displacement(s, slider).y));
        },
        [&](Simulation& s) { watch.look(s); });
    EXPECT_GT(displacement(sim, slider).x, 7.9);
    EXPECT_LT(worst, 1e-5) << loose;
    EXPECT_LT(highest, 1e-5) << loose;
    EXPECT_LT(error, 1e-6) << loose;
    EXPECT_LE(watch.worst_jump, 1.5) << loose << ' ' << watch.jump_at;
    EXPECT_EQ(watch.list.missed, 0u);
  }
}

/// A block of 1 m lowered onto grains of a tenth of a millimetre.
TEST(LargeOnSmall, ABlockOnGrains) {
  const double grain = 1e-4;
  std::string toml = std::string(rock) + joint(30) +
                     "[solver]\nduration = 6e-4\n[output]\nhistory_every = "
                     "1e-4\n" +
                     fixed_block(rectangle(-1, -1, 1, 0));
  for (int i = 0; i < 12; ++i) {
    const double x = -0.45 + 0.9 * i / 11;
    Ring ring;
    for (int k = 0; k < 5 + i % 3; ++k) {
      const double a = 2.0 * std::numbers::pi * k / (5 + i % 3) + 0.3 * i;
      ring.push_back(Vec2{x, 0.55 * grain} + 0.5 * grain * Vec2{std::cos(a), std::sin(a)});
    }
    toml += block_text(ring);
  }
  toml +=
      "[[block]]\npolygon = " + rectangle(-0.5, 1.1 * grain, 0.5, 1.0) + "\nvelocity = [0, -0.1]\n";
  Simulation sim = scene(toml);
  HeapWatch watch(50);
  double error = 0.0, lowest = 1.0;
  run(
      sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); },
      [&](Simulation& s) {
        watch.look(s);
        const Id v = s.scene->blocks.vertex_begin[13];
        lowest = std::min(lowest, s.motion.pose.y[v] + s.scene->blocks.origin.y);
      });
  EXPECT_GT(lowest, 0.5 * grain);  // carried by the grains, not by the ground
  EXPECT_LT(error, 1e-4);
  EXPECT_EQ(watch.list.missed, 0u);
  EXPECT_LE(watch.worst_jump, 1.6);  // shear that reverses within a step adds to it
}

/// A U over a peg: a strongly non-convex block is carried by a block inside it.
TEST(NonConvex, HangsOnAPeg) {
  Simulation sim = scene(std::string(rock) + joint(30) +
                         "[solver]\nduration = 0.4\ndamping = { contact = 0.2, local = 0.3 }\n"
                         "[output]\nhistory_every = 0.01\n" +
                         fixed_block("[[0.45,0],[0.55,0],[0.55,0.9],[0.45,0.9]]") +
                         "[[block]]\npolygon = [[0,0.2],[0.2,0.2],[0.2,0.95],[0.8,0.95],[0.8,0.2],"
                         "[1,0.2],[1,1.2],[0,1.2]]\n");
  run(sim, [](Simulation&) {});
  EXPECT_NEAR(displacement(sim, 1).y, -0.05, 1e-4);
  EXPECT_NEAR(displacement(sim, 1).x, 0.0, 1e-4);
  EXPECT_LT(account_energy(sim).kinetic, 1e-2);
}

}  // namespace
}  // namespace edda::trouble_test
