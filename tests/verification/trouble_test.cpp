// What breaks such codes: thin things, fast things, large on small, corners passing corners.
#include <algorithm>

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

std::string held(const std::string& polygon) {
  return "[[block]]\nfixed = true\npolygon = " + polygon + "\n";
}

/// A thin block thrown flat, edgewise or corner first at a thin plate, ever faster: it comes back
/// or is stopped, and is never seen on the other side.
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
                             held(rectangle(-1, -plate, 1, 0)) +
                             block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
      double lowest = 1.0, drift = 0.0;
      run(
          sim, [&](Simulation& s) { keep_largest(drift, s.ledger().drift); },
          [&](Simulation& s) {
            for (Id v = 4; v < 8; ++v) lowest = std::min(lowest, s.pose.y[v] + s.blocks.origin.y);
          });
      EXPECT_GT(lowest, -0.5 * thin) << speed << ' ' << tilt;
      EXPECT_LT(drift, 1e-3) << speed << ' ' << tilt;
      // Bounced: the centroid goes up in the end.
      EXPECT_GT(centroid(sim.state.vx, sim.state.vy, 1).y, 0.0) << speed << ' ' << tilt;
    }
  }
}

/// Contacts too soft for the speed let blocks sink in: the run ends with a message then, and never
/// lets one come out on the other side.
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
                               held(rectangle(-1, -0.005, 1, 0)) +
                               block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
        sim.start(duration);
        bool failed = false;
        while (!failed && sim.state.time < duration) failed = sim.step().has_value();
        const double height = centroid(sim.state.x, sim.state.y, 1).y + sim.blocks.origin.y;
        EXPECT_GT(height, -0.005) << stiffness << ' ' << speed << ' ' << tilt;
        (failed ? stopped : bounced) += 1;
      }
    }
  }
  EXPECT_GT(stopped, 5);
  EXPECT_GE(bounced, 5);
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
                             held("[[-2,0],[2,0],[0.3,0.0008]]") +
                             block_text(ring, "velocity = [0, " + number(-speed) + "]\n"));
      double lowest = 1.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            lowest = std::min(lowest, centroid(s.state.x, s.state.y, 1).y + s.blocks.origin.y);
          });
      EXPECT_GT(lowest, 0.0) << speed << ' ' << turn;
    }
  }
}

/// A block that slides over a flat row of blocks meets forty seams: no kick, no loss, no gain.
TEST(FlatRow, FortySeamsWithoutAKick) {
  for (const bool loose : {false, true}) {
    std::string toml =
        std::string(rock) + joint(0) + "[solver]\nduration = 2.0\n[output]\nhistory_every = 0.02\n";
    for (int i = 0; i < 40; ++i) toml += held(rectangle(0.25 * i, -1, 0.25 * (i + 1), 0));
    // Loose: as far above the row as it takes to press on it by its weight and no more.
    toml += "[[block]]\npolygon = " + rectangle(0.6, 0, 1.6, 0.7) + "\nvelocity = [4, 0]\n";
    if (loose)
      toml += "[[block]]\npolygon = " + rectangle(0.9, 0.7, 1.3, 1.0) + "\nvelocity = [4, 0]\n";
    Simulation sim = scene(toml);
    const std::size_t slider = 40;
    HeapWatch watch(64);
    double drift = 0.0, worst = 0.0, highest = 0.0;
    run(
        sim,
        [&](Simulation& s) {
          keep_largest(drift, s.ledger().drift);
          worst = std::max(worst, std::abs(centroid(s.state.vx, s.state.vy, slider).x / 4.0 - 1.0));
          highest = std::max(highest, std::abs(displacement(s, slider).y));
        },
        [&](Simulation& s) { watch.look(s); });
    EXPECT_GT(displacement(sim, slider).x, 7.9);
    EXPECT_LT(worst, 1e-5) << loose;
    EXPECT_LT(highest, 1e-5) << loose;
    EXPECT_LT(drift, 1e-6) << loose;
    EXPECT_LE(watch.worst_jump, 1.5) << loose << ' ' << watch.jump_at;
    EXPECT_EQ(watch.list.missed, 0u);
  }
}

/// A block of 1 m let down on grains of a tenth of a millimetre.
TEST(LargeOnSmall, ABlockOnGrains) {
  const double grain = 1e-4;
  std::string toml = std::string(rock) + joint(30) +
                     "[solver]\nduration = 6e-4\n[output]\nhistory_every = "
                     "1e-4\n" +
                     held(rectangle(-1, -1, 1, 0));
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
  double drift = 0.0, lowest = 1.0;
  run(
      sim, [&](Simulation& s) { keep_largest(drift, s.ledger().drift); },
      [&](Simulation& s) {
        watch.look(s);
        const Id v = s.blocks.vertex_begin[13];
        lowest = std::min(lowest, s.pose.y[v] + s.blocks.origin.y);
      });
  EXPECT_GT(lowest, 0.5 * grain);  // carried by the grains, not by the ground
  EXPECT_LT(drift, 1e-4);
  EXPECT_EQ(watch.list.missed, 0u);
  EXPECT_LE(watch.worst_jump, 1.6);  // shear that turns round within a step adds to it
}

/// A U over a peg and an L in a corner: strongly non-convex blocks rest on what is inside them.
TEST(NonConvex, HangsOnAPeg) {
  Simulation sim = scene(std::string(rock) + joint(30) +
                         "[solver]\nduration = 0.4\ndamping = { contact = 0.2, local = 0.3 }\n"
                         "[output]\nhistory_every = 0.01\n" +
                         held("[[0.45,0],[0.55,0],[0.55,0.9],[0.45,0.9]]") +
                         "[[block]]\npolygon = [[0,0.2],[0.2,0.2],[0.2,0.95],[0.8,0.95],[0.8,0.2],"
                         "[1,0.2],[1,1.2],[0,1.2]]\n");
  run(sim, [](Simulation&) {});
  EXPECT_NEAR(displacement(sim, 1).y, -0.05, 1e-4);
  EXPECT_NEAR(displacement(sim, 1).x, 0.0, 1e-4);
  EXPECT_LT(sim.ledger().kinetic, 1e-2);
}

}  // namespace
}  // namespace edda::trouble_test
