// Cohesion, tension and glued joints: validation.md row 4 and the strength of a bond (theory,
// sections 5.2 and 5.3).
#include <algorithm>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::bond_test {
namespace {

std::string rock = R"(
[materials.rock]
density = 2750.0
young = 20e9
poisson = 0.25
)";

std::string slope_box(double alpha, double u0, double u1, double v0, double v1) {
  return "[" + on_slope(alpha, u0, v0) + "," + on_slope(alpha, u1, v0) + "," +
         on_slope(alpha, u1, v1) + "," + on_slope(alpha, u0, v1) + "]";
}

/// Row 4: (30, 15), g 9.8; c_crit = (W sin a - W cos a tan phi)/L = 7221.2 Pa for L = 2 m.
const double critical_cohesion =
    0.5 * 2.0 * 2750.0 * 9.8 *
    (std::sin(radians(30)) - std::tan(radians(15)) * std::cos(radians(30)));

/// Overdamped at first, so that it is loaded without overshoot. `factor`: cohesion over the
/// critical one.
Simulation cohesive_ramp(double factor, double duration, double damping, const std::string& law) {
  return scene(
      "gravity = [0.0, -9.8]\n" + rock + "[joints.ramp]\nfriction_angle = 15.0\ncohesion = " +
      number(critical_cohesion * factor) + "\n" + law + "[solver]\nduration = " + number(duration) +
      "\ndamping = { mass = " + number(damping) +
      " }\n[output]\nhistory_every = 0.005\n[[block]]\nfixed = true\npolygon = " +
      slope_box(30.0, -1, 4, -1, 0) + "\n[[block]]\npolygon = " + slope_box(30.0, 0, 2, 0, 1) +
      "\n");
}

double slip_so_far(const Simulation& sim) {
  const Vec2 u = displacement(sim, 1);
  return u.x * std::cos(radians(30)) - u.y * std::sin(radians(30));
}

/// Below the critical cohesion: breaks, and then, without damping, slides as row 1 does.
void expect_goes(double factor, const std::string& law, const std::string& stiffness) {
  Simulation sim = cohesive_ramp(factor, 0.15, 2e4, law);
  Series way(4, brief(factor) + ", " + stiffness, {"time", "exact", "computed"});
  const double a =
      critical_cohesion / 2750.0;  // L c_crit is the weight along the slope less its friction
  start(sim, 0.15);
  double broken_at = -1.0, start = 0.0;
  while (sim.motion.state.time < 0.15) {
    ASSERT_FALSE(step(sim).has_value());
    if (broken_at < 0.0 && bonded_faces(sim) == 0) {
      broken_at = sim.motion.state.time;
      start = slip_so_far(sim);
      sim.motion.damping.mass = 0.0;
    }
    const double t = sim.motion.state.time - broken_at;
    if (broken_at >= 0.0)
      way.add({sim.motion.state.time, 0.5 * a * t * t, slip_so_far(sim) - start});
  }
  ASSERT_GT(broken_at, 0.0);
  const double t = sim.motion.state.time - broken_at;
  expect_relative({4, brief(factor) + " of the critical cohesion, " + stiffness,
                   "distance slid after the break", "m"},
                  slip_so_far(sim) - start, 0.5 * a * t * t, 2e-3);
  record_model(4, brief(factor), sim);
}

TEST(CohesiveRamp, HoldsAboveAndGoesBelowTheCriticalCohesion) {
  for (const std::string law : {"", "kn = 2e11\nks = 2e11\n"}) {
    const std::string stiffness = law.empty() ? "springs per contact" : "springs per length";
    Simulation holds = cohesive_ramp(1.01, 0.05, 2e4, law);
    Series held(4, "1.01, " + stiffness, {"time", "computed"});
    run(holds, [&](Simulation& s) { held.add({s.motion.state.time, slip_so_far(s)}); });
    EXPECT_EQ(bonded_faces(holds), 1u);
    expect_at_most({4, "1.01 of the critical cohesion, " + stiffness, "displacement", "m"},
                   slip_so_far(holds), 1e-5);
    expect_goes(0.99, law, stiffness);

    double low = 0.93, high = 1.11;
    while (high - low > 1e-4) {
      const double middle = 0.5 * (low + high);
      Simulation sim = cohesive_ramp(middle, 0.05, 2e4, law);
      run(sim, [](Simulation&) {});
      (bonded_faces(sim) == 0 ? low : high) = middle;
    }
    expect_relative({4, stiffness, "critical cohesion, by bisection", "Pa"},
                    0.5 * (low + high) * critical_cohesion, critical_cohesion, 1e-2);
  }
}

/// Coordinates as typed leave gaps and overlaps: here of 0.3 mm all along, or at one end.
TEST(CohesiveRamp, HoldsHoweverCoordinatesAreRounded) {
  for (const Vec2 off : {Vec2{3e-4, 3e-4}, {-3e-4, -3e-4}, {3e-4, 0.0}, {0.0, -3e-4}}) {
    for (const double factor : {1.05, 0.95}) {
      Simulation sim =
          scene("gravity = [0.0, -9.8]\n" + rock + "[joints.ramp]\nfriction_angle = 15.0\n" +
                "cohesion = " + number(critical_cohesion * factor) +
                "\n[solver]\nduration = 0.05\ndamping = { mass = 2e4 }\n[[block]]\nfixed = true\n" +
                "polygon = " + slope_box(30.0, -1, 4, -1, 0) + "\n[[block]]\npolygon = [" +
                on_slope(30.0, 0, off.x) + "," + on_slope(30.0, 2, off.y) + "," +
                on_slope(30.0, 2, 1) + "," + on_slope(30.0, 0, 1) + "]\n");
      run(sim, [](Simulation&) {});
      EXPECT_EQ(bonded_faces(sim), factor > 1.0 ? 1u : 0u) << off.x << " " << off.y;
      if (factor > 1.0) {
        EXPECT_LT(norm(displacement(sim, 1)), 1e-5) << off.x << " " << off.y;
      }
    }
  }
}

/// The same with the friction of rough joints and default damping: a stage until equilibrium
/// applies the weight gradually.
TEST(CohesiveRamp, TheCriticalCohesionIsThatOfRoughJointsToo) {
  for (const auto& [alpha, phi] :
       {std::pair{30.0, 20.0}, {30.0, 25.0}, {45.0, 30.0}, {45.0, 40.0}}) {
    const double a = radians(alpha),
                 critical = 2750.0 * 9.81 * (std::sin(a) - std::tan(radians(phi)) * std::cos(a));
    for (const double factor : {1.01, 0.99}) {
      const testing::Ran r = testing::ran(
          rock + "[joints.ramp]\nfriction_angle = " + number(phi) +
          "\ncohesion = " + number(factor * critical) +
          "\n[[stage]]\nuntil = 'equilibrium'\nduration = 1\n[[stage]]\nduration = 0.2\n"
          "[[block]]\nfixed = true\npolygon = " +
          slope_box(alpha, -1, 9, -1, 0) +
          "\n[[block]]\nname = 'slider'\npolygon = " + slope_box(alpha, 0, 2, 0, 1) + "\n");
      const Vec2 u = r.moved("slider");
      const double way = u.x * std::cos(a) - u.y * std::sin(a);
      const std::string which =
          brief(alpha) + "/" + brief(phi) + ", " + brief(factor) + " of the critical cohesion";
      if (factor > 1.0) {
        EXPECT_EQ(r.outcome.status, Status::completed) << which << ": " << r.outcome.message;
        expect_at_most({4, which, "displacement", "m"}, way, 1e-5);
      } else {
        EXPECT_EQ(bonded_faces(r.ready.sim), 0u) << which;
        // The damping of a stage until equilibrium slows what slides.
        expect_at_least({4, which, "displacement", "m"}, way, 5e-3);
      }
    }
  }
}

TEST(CohesiveRamp, OnceBrokenSlidesWithFrictionAlone) {
  Simulation sim = cohesive_ramp(0.1, 0.1, 0.0, "");
  double error = 0.0, fracture = -1.0;
  bool falls = false;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    keep_largest(error, l.error);
    falls = falls || l.fracture < fracture - 1e-9;
    fracture = l.fracture;
  });
  const double exact =
      0.5 * 9.8 * 0.01 * (std::sin(radians(30)) - std::tan(radians(15)) * std::cos(radians(30)));
  EXPECT_NEAR(slip_so_far(sim) / exact, 1.0, 5e-3);
  EXPECT_GT(fracture, 0.0);
  EXPECT_FALSE(falls);
  EXPECT_LT(error, 1e-5);
}

TEST(CohesiveRamp, ResidualStrengthCarries) {
  // The peak cohesion is too small to carry the block, the residual cohesion is not.
  Simulation sim = cohesive_ramp(0.5, 0.05, 2e4, "residual = { cohesion = 8000.0 }\n");
  run(sim, [](Simulation&) {});
  EXPECT_EQ(bonded_faces(sim), 0u);
  EXPECT_LT(slip_so_far(sim), 1e-5);
}

/// A block that hangs from a fixed one by the tensile strength of its joint, or by a glued joint.
Simulation hanging(const std::string& law, double duration = 0.05) {
  return scene("gravity = [0.0, -10.0]\n" + rock + "[joints.j]\n" + law +
               "[solver]\nduration = " + number(duration) +
               "\ndamping = { mass = 2e4 }\n[output]\nhistory_every = 0.005\n"
               "[[block]]\nfixed = true\npolygon = [[-1,1],[2,1],[2,2],[-1,2]]\n"
               "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n");
}

TEST(Hanging, TensileStrengthDecides) {
  // Weight 27.5 kN on 1 m: 27.5 kPa.
  Simulation holds = hanging("friction_angle = 30\ntensile_strength = 28e3\ncohesion = 1e5\n");
  run(holds, [](Simulation&) {});
  EXPECT_EQ(bonded_faces(holds), 1u);
  double pull = 0.0;
  for (std::size_t k = 0; k < holds.motion.contacts.size(); ++k) {
    pull += normal_force(face_row(holds, k));
  }
  EXPECT_NEAR(pull, -27.5e3, 30.0);
  Simulation falls = hanging("friction_angle = 30\ntensile_strength = 27e3\ncohesion = 1e5\n");
  run(falls, [](Simulation&) {});
  EXPECT_EQ(bonded_faces(falls), 0u);
}

TEST(Hanging, GlueNeverOpensNorSlides) {
  Simulation sim = hanging("type = 'glued'\n");
  run(sim, [](Simulation&) {});
  EXPECT_EQ(bonded_faces(sim), 1u);
  EXPECT_LT(norm(displacement(sim, 1)), 1e-5);
}

/// A block whose edges are glued, a little above a slope: it slides or sticks according to
/// contact.joint.
TEST(Glue, EdgesThatMeetLaterRubAsOthers) {
  for (const double phi : {15.0, 40.0}) {
    Simulation sim = scene(
        "gravity = [0.0, -9.8]\n" + rock + "[joints.rough]\nfriction_angle = " + number(phi) +
        "\n[joints.one]\ntype = 'glued'\n[contact]\njoint = 'rough'\n[solver]\nduration = 0.5\n"
        "damping = { contact = 0.1 }\n[output]\nhistory_every = 0.1\n[[block]]\nfixed = true\n"
        "polygon = " +
        slope_box(30.0, -1, 6, -1, 0) +
        "\n[[block]]\njoint = 'one'\npolygon = " + slope_box(30.0, 0, 2, 2e-3, 1.002) + "\n");
    run(sim, [](Simulation&) {});
    const double exact = phi > 30.0 ? 0.0 : sliding(30.0, phi, 0.5);
    EXPECT_NEAR(slip_so_far(sim), exact, 5e-3 + 1e-2 * exact) << phi;
  }
}

TEST(Hanging, BreaksInTensionAndTheEnergyBalanceCloses) {
  Simulation sim =
      scene("gravity = [0.0, -10.0]\n" + rock +
            "[joints.j]\nfriction_angle = 30\ntensile_strength = 20e3\n"
            "cohesion = 1e5\n[solver]\nduration = 0.2\n[output]\nhistory_every = 0.005\n"
            "[[block]]\nfixed = true\npolygon = [[-1,1],[2,1],[2,2],[-1,2]]\n"
            "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n");
  double error = 0.0;
  run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
  EXPECT_LT(error, 1e-5);
  EXPECT_GT(account_energy(sim).fracture, 0.0);
  EXPECT_NEAR(displacement(sim, 1).y / (-0.5 * 10.0 * 0.04), 1.0, 1e-2);
}

/// kn times the tributary length of a contact: a joint of 2 m under 1 MN closes by N/(kn L).
TEST(JointStiffness, FollowsTheLengthOfTheJoint) {
  Simulation sim = scene(
      "gravity = [0.0, -10.0]\n[materials.rock]\ndensity = 2500.0\nyoung = 1e14\n"
      "poisson = 0.0\n[joints.j]\nfriction_angle = 30\nkn = 1e9\n[solver]\n"
      "duration = 0.1\ndamping = { mass = 1000 }\n[output]\nhistory_every = 0.01\n"
      "[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
      "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n");
  sim.scene.edit().blocks.lame_mu.assign(2, 1e11);  // stiff, but not so stiff as to govern the step
  run(sim, [](Simulation&) {});
  EXPECT_NEAR(displacement(sim, 1).y / (-2.0 * 2500.0 * 10.0 / (1e9 * 2.0)), 1.0, 1e-2);
}

/// A key block carried by cohesion between two fixed ones, its joints without normal load: rounding
/// must not break the bond, for any rotation or shift of the model.
TEST(KeyBlock, CohesionAloneHoldsItHoweverTheModelLies) {
  for (const double turn : {0.0, 17.0, 63.0}) {
    for (const double shift : {0.0, 0.1, 1e5}) {
      auto box = [&](double x0, double y0, double x1, double y1) {
        std::string text = "[";
        for (Vec2 p : {Vec2{x0, y0}, Vec2{x1, y0}, Vec2{x1, y1}, Vec2{x0, y1}}) {
          const Vec2 q = rotated(p, radians(turn)) + Vec2{shift, shift};
          text += "[" + number(q.x) + "," + number(q.y) + "],";
        }
        return text + "]\n";
      };
      const Vec2 g = rotated({0.0, -9.81}, radians(turn));
      Simulation sim =
          scene("gravity = [" + number(g.x) + "," + number(g.y) + "]\n" + rock +
                "[joints.j]\nfriction_angle = 20\ncohesion = 1e6\n[solver]\nduration = 0.1\n"
                "[output]\nhistory_every = 0.01\n[[block]]\nfixed = true\npolygon = " +
                box(-1, 0, 0, 1) + "[[block]]\nfixed = true\npolygon = " + box(1, 0, 2, 1) +
                "[[block]]\npolygon = " + box(0, 0, 1, 1));
      run(sim, [](Simulation&) {});
      EXPECT_EQ(bonded_faces(sim), 2u) << turn << ' ' << shift;
      EXPECT_LT(norm(displacement(sim, 2)), 1e-5) << turn << ' ' << shift;
    }
  }
}

/// Peak friction carries a block that residual friction would not, until the bond fails.
TEST(PeakFriction, HoldsUntilItFails) {
  for (const double peak : {30.0, 24.0}) {
    Simulation sim =
        scene("gravity = [0.0, -9.8]\n" + rock + "[joints.j]\nfriction_angle = " + number(peak) +
              "\nresidual = { friction_angle = 20.0 }\n[solver]\n"
              "duration = 0.05\ndamping = { mass = 2e4 }\n[output]\nhistory_every = 0.005\n"
              "[[block]]\nfixed = true\npolygon = " +
              slope_box(25.0, -1, 4, -1, 0) +
              "\n[[block]]\npolygon = " + slope_box(25.0, 0, 2, 0, 1) + "\n");
    run(sim, [](Simulation&) {});
    EXPECT_EQ(bonded_faces(sim), peak > 25.0 ? 1u : 0u);
  }
}

TEST(ResidualTension, CarriesAfterFailureInShear) {
  // The joint slips at once (no peak strength in shear) but its residual tension carries the
  // weight.
  Simulation sim =
      scene("gravity = [0.0, -10.0]\n" + rock +
            "[joints.j]\nfriction_angle = 0\ncohesion = 1.0\ntensile_strength = 1e5\n"
            "residual = { tensile_strength = 5e4 }\n[solver]\nduration = 0.05\n"
            "damping = { mass = 2e4 }\n[output]\nhistory_every = 0.005\n[[block]]\nfixed = true\n"
            "polygon = [[-1,1],[2,1],[2,2],[-1,2]]\n[[block]]\n"
            "polygon = [[0,0],[1,0],[1,1],[0,1]]\n");
  sim.scene.edit().model.gravity = {1.0, -10.0};
  run(sim, [](Simulation&) {});
  EXPECT_EQ(bonded_faces(sim), 0u);
  EXPECT_LT(std::abs(displacement(sim, 1).y), 1e-5);
}

/// With kn, a block that slides from one fixed block to the next is carried by both in proportion
/// to the length on each.
TEST(JointStiffness, GoesOnOverASeam) {
  Simulation sim = scene(
      "[materials.rock]\ndensity = 2500\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 0\nkn = 1e9\n[solver]\nduration = 4.0\n"
      "damping = { contact = 0.3 }\n[output]\nhistory_every = 0.1\n"
      "[[block]]\nfixed = true\npolygon = [[0,-1],[6,-1],[6,0],[0,0]]\n"
      "[[block]]\nfixed = true\npolygon = [[6,-1],[20,-1],[20,0],[6,0]]\n"
      "[[block]]\npolygon = [[3.75,0],[5.75,0],[5.75,0.5],[3.75,0.5]]\n"
      "velocity = [1.0, 0.0]\n");
  run(sim, [](Simulation&) {});
  EXPECT_NEAR(displacement(sim, 2).x, 4.0, 1e-2);
  const double static_closure = 2.0 * 0.5 * 2500.0 * 9.81 / (1e9 * 2.0);
  for (Id v = sim.scene->blocks.vertex_begin[2]; v < sim.scene->blocks.vertex_begin[2] + 2; ++v) {
    EXPECT_GT(sim.motion.pose.y[v] + sim.scene->blocks.origin.y, -4.0 * static_closure);
  }
}

/// A bond so soft that opposite corners pass each other while it is intact: the spring stays one
/// whichever face has it, and energy is conserved.
TEST(SoftBond, KeepsItsEnergyWhenCornersSlidePastEachOther) {
  for (const double velocity : {0.2, -0.2}) {
    Simulation sim = scene(
        "gravity = [0.0, 0.0]\n" + rock +
        "damping = 0\n[joints.j]\nfriction_angle = 0\ncohesion = 1e9\ntensile_strength = 1e9\nkn = "
        "4e6\nks = 1e6\n"
        "[solver]\nduration = 2.0\n[output]\nhistory_every = 0.05\n"
        "[[block]]\nfixed = true\npolygon = [[0,-1],[1,-1],[1,0],[0,0]]\n"
        "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\nvelocity = [" +
        number(velocity) + ", 0.0]\n[[block]]\npolygon = [[0,1],[1,1],[1,2],[0,2]]\n");
    double error = 0.0, furthest = 0.0;
    run(sim, [&](Simulation& now) {
      keep_largest(error, account_energy(now).error);
      keep_largest(furthest, displacement(now, 1).x);
    });
    EXPECT_GT(furthest, 5e-3) << "corners should pass by more than what they share";
    EXPECT_LT(error, 1e-6) << velocity;
    EXPECT_GT(bonded_faces(sim), 0u);
  }
}

}  // namespace
}  // namespace edda::bond_test
