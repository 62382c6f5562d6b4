// Blocks that slide from block to block, and off the last: no block boundary may stop them or
// change their height.
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "verification/scene.hpp"

namespace edda {
namespace {

/// A fixed floor cut at `boundaries`, from the first to the last.
std::string floor_in_pieces(const std::vector<double>& boundaries) {
  std::string toml;
  for (std::size_t q = 0; q + 1 < boundaries.size(); ++q) {
    const std::string a = number(boundaries[q]), b = number(boundaries[q + 1]);
    toml += "[[block]]\nfixed = true\npolygon = [[" + a + ",-1], [" + b + ",-1], [" + b + ",0], [" +
            a + ",0]]\n";
  }
  return toml;
}

std::vector<double> every(double from, double to, double length) {
  std::vector<double> boundaries;
  for (double x = from; x < to + 0.5 * length; x += length) boundaries.push_back(x);
  return boundaries;
}

std::string slider(double width, double height, double speed) {
  const std::string w = number(width), h = number(height);
  return "[[block]]\npolygon = [[0,0], [" + w + ",0], [" + w + "," + h + "], [0," + h +
         "]]\nvelocity = [" + number(speed) + ", 0]\n";
}

std::string joint(const std::string& more) {
  return "[joints.j]\nfriction_angle = 0\n" + more;
}

std::string rock(double young) {
  return "[materials.rock]\ndensity = 2500\nyoung = " + number(young) + "\npoisson = 0.2\n";
}

/// Without friction the speed is constant; at the end the block penetrates no deeper than in
/// equilibrium on one piece.
void expect_passes(const std::string& toml, double speed, double deepest, const char* which) {
  SCOPED_TRACE(which);
  Simulation sim = scene(toml);
  run(sim, [](Simulation&) {});
  const Vec2 u = displacement(sim, 0);
  const double far = speed * sim.scene->model.solver.duration;
  EXPECT_NEAR(u.x, far, 1e-4 * far);
  EXPECT_LE(u.y, 0.0);
  EXPECT_GE(u.y, -deepest);
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-6);
  // At a block boundary the next contacts take over the load of those before.
  EXPECT_LT(std::abs(account_energy(sim).friction), 1e-4 * sim.accounts.largest_energy);
}

/// In equilibrium on kn A the block would penetrate by W/(kn A) = 3.07e-5 m; its front passes 8
/// block boundaries. With penalty springs it is W/2p.
TEST(SeamCrossing, ALongSlideGoesOnAsOnOnePiece) {
  const std::string solver =
      "[solver]\nduration = 1.0\ndamping = { contact = 0.1 }\n[output]\nhistory_every = 0.1\n";
  const double weight = 2500.0 * 9.81 * 1.3 * 0.5;
  const std::string by_area = joint("kn = 4e8\nks = 4e8\n");
  expect_passes(rock(2e10) + by_area + slider(1.3, 0.5, 4.0) +
                    floor_in_pieces(every(-1.0, 7.0, 0.5)) + solver,
                4.0, 1.1 * weight / (4e8 * 1.3), "kn");
  expect_passes(rock(2e8) + joint("") + slider(1.3, 0.5, 4.0) +
                    floor_in_pieces(every(-1.0, 7.0, 0.2)) + solver +
                    "[contact]\nnormal_stiffness = 2e9\n",
                4.0, 1.2 * weight / 4e9 + 1e-5, "p");
}

/// Also in long steps, in which a corner moves further than its penetration.
TEST(SeamCrossing, AnImplicitSlideMeetsNoWall) {
  for (const char* step : {"", "time_step = 1e-3\n", "time_step = 1e-4\n"}) {
    expect_passes(rock(2e10) + joint("") + slider(2.0, 1.0, 4.0) +
                      floor_in_pieces({-1.0, 2.5, 20.0}) + "[solver]\nmethod = \"dda\"\n" + step +
                      "duration = 0.5\n[output]\nhistory_every = 0.005\n",
                  4.0, 1e-6, step);
    expect_passes(rock(2e10) + joint("kn = 4e8\nks = 4e8\n") + slider(1.3, 0.5, 4.0) +
                      floor_in_pieces(every(-1.0, 7.0, 0.5)) + "[solver]\nmethod = \"dda\"\n" +
                      step + "duration = 0.5\n[output]\nhistory_every = 0.005\n",
                  4.0, 8e-5, step);
  }
}

/// Halfway over a block boundary the two pieces carry half of the weight each.
TEST(SeamCrossing, TheLoadIsSharedByWhatOverlaps) {
  for (const char* law : {"kn = 1e9\nks = 1e9\n", ""}) {
    SCOPED_TRACE(law);
    Simulation sim =
        scene(rock(1e10) + joint(law) + slider(2.0, 1.0, 1.0) + floor_in_pieces({-1.0, 2.3, 6.0}) +
              "[solver]\nduration = 1.3\ndamping = { contact = 0.2 }\n"
              "[output]\nhistory_every = 0.1\n");
    run(sim, [](Simulation&) {});
    const double half = 2500.0 * 9.81 * 2.0 / 2.0;
    std::size_t carrying = 0;
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
      if (!is_closed(face_row(sim, k))) continue;
      ++carrying;
      EXPECT_NEAR(normal_force(face_row(sim, k)), half, 1e-3 * half);
    }
    EXPECT_EQ(carrying, 2u);
  }
}

/// Over the edge of a floor, against the cohesion c of the remaining overlap: m x'' = -c (L - x),
/// so x = L - L cosh(w t) + (v/w) sinh(w t) with w^2 = c/m while it slides.
TEST(SeamCrossing, CohesionIsThatOfWhatStillOverlaps) {
  const double w = std::sqrt(2000.0 / (2500.0 * 0.4)), t = 0.5, length = 2.0;
  const double exact = length - length * std::cosh(w * t) + 2.2 / w * std::sinh(w * t);
  // Shear begins half a step late at 2.2 m/s, and the step is longer with the softer contacts.
  for (const auto& [contact, bound] :
       {std::pair{"", 2e-4},
        {"[contact]\nnormal_stiffness = 2e9\n[solver]\ndamping = { contact = 0.1 }\n", 4e-4}}) {
    Simulation sim = scene(
        rock(2e9) + joint("cohesion = 2000\nresidual = { friction_angle = 0, cohesion = 2000 }\n") +
        "[[block]]\npolygon = [[-2,0], [0,0], [0,0.2], [-2,0.2]]\nvelocity = [2.2, 0]\n" +
        floor_in_pieces({-5.0, 0.0}) + "[output]\nhistory_every = 0.1\n" +
        (*contact != 0 ? contact : "[solver]\n") + "duration = 0.5\n");
    run(sim, [](Simulation&) {});
    EXPECT_NEAR(displacement(sim, 0).x, exact, bound * exact) << contact;
  }
}

/// Compressed by an initial stress, and slipping on one piece: the compression stays, with either
/// method.
TEST(SeamCrossing, WhatIsPreloadedKeepsItsLoad) {
  const auto squeezed = [](const std::string& solver, double friction) {
    return "gravity = [0, 0]\n" + rock(2e10) + "[joints.j]\nfriction_angle = " + number(friction) +
           "\nkn = 1e10\nks = 1e10\n[initial_stress]\nstress = [-1e6, -10e6, 0.0]\n" +
           slider(1.0, 0.5, 8.0) + floor_in_pieces({-2.0, 6.0}) +
           "[[block]]\nfixed = true\npolygon = [[-2,0.5], [6,0.5], [6,1.5], [-2,1.5]]\n"
           "[output]\nhistory_every = 0.01\n[solver]\ndamping = { contact = 0.1 }\n" +
           solver;
  };
  Simulation slips = scene(squeezed("duration = 0.1\n", 0.1));
  const double stored = 2.0 * 2.0 * 0.5 * 1e10 * 0.5 * 1e-3 * 1e-3;  // N^2/2p of four contacts
  run(slips, [](Simulation&) {});
  EXPECT_GT(displacement(slips, 0).x, 0.4);
  EXPECT_NEAR(account_energy(slips).contact, stored, 0.02 * stored);
  Simulation sticks =
      scene(squeezed("duration = 0.02\ntime_step = 1e-5\nmethod = \"dda\"\n", 89.0));
  run(sticks, [](Simulation&) {});
  EXPECT_EQ(account_energy(sticks).friction, 0.0);
}

/// Nothing acts: rounding must not create energy.
TEST(SeamCrossing, BlocksThatTouchWithoutLoadStayQuiet) {
  for (const char* method : {"edda", "dda"}) {
    Simulation sim = scene("gravity = [0, 0]\n" + rock(2e10) + joint("") +
                           "[[block]]\npolygon = [[0,0], [1,0], [1,1], [0,1]]\n" +
                           floor_in_pieces({0.0, 1.0}) + "[solver]\nmethod = \"" + method +
                           "\"\nduration = 0.02\n[output]\nhistory_every = 1e-4\n");
    run(sim, [](Simulation& s) { EXPECT_LT(std::abs(account_energy(s).error), 1e-3); });
    EXPECT_LT(norm(displacement(sim, 0)), 1e-12);
  }
}

/// The limit of friction comes from the normal forces before a step. Before the first step there
/// are none, so it is short.
TEST(SeamCrossing, AnImplicitBlockDoesNotSlipBeforeItsWeightActs) {
  const double a = radians(30.0);
  Simulation sim =
      scene("gravity = [" + number(9.81 * std::sin(a)) + ", " + number(-9.81 * std::cos(a)) +
            "]\n" + rock(2e10) + "[joints.j]\nfriction_angle = 40\n" + slider(2.0, 1.0, 0.0) +
            floor_in_pieces({-1.0, 10.0}) + "[contact]\nnormal_stiffness = 2e11\n" +
            "[solver]\nmethod = \"dda\"\ndynamic = false\nduration = 0.5\n"
            "[output]\nhistory_every = 0.05\n");
  run(sim, [](Simulation&) {});
  // 4.4e-7 m of springs and rock; a whole step without friction would be 1.5e-3 m.
  EXPECT_LT(displacement(sim, 0).x, 1e-6);
}

}  // namespace
}  // namespace edda
