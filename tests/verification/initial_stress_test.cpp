// Rock that starts stressed stays as it is: validation.md row 37.
#include <algorithm>

#include "observe/attachment_rows.hpp"
#include "observe/initial_stress_report.hpp"
#include "observe/observe.hpp"
#include "step/contact_resultant.hpp"
#include "step/energy_balance.hpp"
#include "verification/models.hpp"

namespace edda::initial_stress_test {
namespace {

constexpr double density = 2700.0, gravity = 9.81, young = 20e9;

const std::string rock =
    "[materials.rock]\ndensity = 2700.0\nyoung = 20e9\npoisson = 0.25\n"
    "[domain]\noutline = [[-10, 980], [10, 980], [10, 1000], [-10, 1000]]\nmaterial = 'rock'\n"
    "[output]\nhistory_every = 0.0005\n";
const std::string strong =
    "[joints.j]\nfriction_angle = 40.0\ncohesion = 30e6\ntensile_strength = 5e6\n";
const std::string rough = "[joints.j]\nfriction_angle = 40.0\n";
const std::string two_sets =
    "[[joint_set]]\nangle = 23.0\nspacing = 2.1\norigin = [0.3, 980.7]\n"
    "[[joint_set]]\nangle = 101.0\nspacing = 2.6\norigin = [0.1, 981.3]\n";
/// Traces that end in the rock and on each other, so that corners lie at the middle of edges.
const std::string short_traces =
    "[[joint_set]]\nangle = 12.0\nspacing = 1.7\norigin = [0.3, 980.7]\ntrace_length = 6.0\ngap = "
    "0.8\n"
    "[[joint_set]]\nangle = 78.0\nspacing = 1.9\norigin = [0.3, 980.7]\ntrace_length = 5.0\ngap = "
    "0.3\n"
    "deviation = { angle = 5.0, spacing = 0.3 }\n"
    "[[joint_set]]\nangle = 130.0\nspacing = 3.1\norigin = [0.0, 981.7]\n";
const std::string voronoi = "[voronoi]\nsize = 1.8\nsmoothing = 0\nseed = 5\n";

/// The stress at the depth of a mine, with shear in the plane.
const std::string tensor =
    "[initial_stress]\nstress = [-31e6, -24e6, 4e6]\nat_y = 990.0\ngradient = [1.9e4, " +
    number(density * gravity) + ", 0.0]\n";
std::string from_weight(const std::string& surface) {
  return "[initial_stress]\nk0 = 1.4\nk0_out = 0.8\n" + surface + "\n";
}

std::string boundary(const std::string& sides, const std::string& type) {
  return "[[boundary]]\nsides = [" + sides + "]\ntype = '" + type + "'\n";
}
const std::string all_fixed = boundary("'left', 'right', 'bottom', 'top'", "fixed");
const std::string on_rollers = boundary("'bottom', 'left', 'right'", "roller");

/// All requirements on undisturbed ground.
struct Watched {
  double unbalanced = 0.0;  ///< largest
  double moved = 0.0;       ///< largest displacement of a vertex over sigma L/E
  double stress = 0.0;      ///< largest change since the start over the largest stress
  double in_slivers =
      0.0;                 ///< the same of slivers that stay: a gap is a larger part of their width
  double reactions = 0.0;  ///< with weight, water and loads, over the weight
  double error = 0.0, slip_so_far = 0.0;
};

Watched watch(Simulation& sim) {
  Watched w;
  double largest = 0.0, size = 0.0;
  const BlockSet& b = sim.scene->blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    largest = std::max({largest, std::abs(b.initial_xx[i]), std::abs(b.initial_yy[i])});
    size = std::max(size, b.radius[i]);
  }
  Vec2 sum;
  double weight = 0.0;
  run(sim, [&](Simulation& s) {
    Instant at;
    observe(s, at);
    keep_largest(w.unbalanced, unbalanced_ratio(s, at));
    keep_largest(w.error, account_energy(s).error);
    sum = Vec2{};
    weight = 0.0;
    const LoadsNow now = acting(s);
    for (const Vec2 f : reactions(s, at)) sum += f;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const BlockStress t = block_stress(s, at.state, i);
      const Tensor start = initial_stress(b, i);
      for (const double off :
           {t.xx - start.xx, t.yy - start.yy, t.xy - start.xy, t.zz - b.initial_zz[i]}) {
        keep_largest(s.scene->polygons.blocks[i].slow ? w.in_slivers : w.stress, off / largest);
      }
      if (b.fixed[i]) {
        sum -= contact_resultant(s, i);
        continue;
      }
      weight += b.mass[i] * gravity;
      sum += b.mass[i] * s.scene->model.gravity;
      // Dead loads of boundaries are among the reactions already.
      for (Id q = 0; now.loads != nullptr && q < now.loads->wet.size(); ++q) {
        const Id edge = now.loads->wet[q].edge;
        if (b.vertex_block[edge] != i || (q > 0 && now.loads->wet[q - 1].edge == edge)) continue;
        const EndForces on = water_on(b, now, s.motion.pose.x, s.motion.pose.y, edge, 0.0, 1.0);
        sum += on.at_from + on.at_to;
      }
    }
    for (std::size_t v = 0; v < b.vertex_count(); ++v) {
      const double ux = s.motion.pose.x[v] - b.vertex_x[v], uy = s.motion.pose.y[v] - b.vertex_y[v];
      keep_largest(w.moved, std::hypot(ux, uy) / (largest / young * size));
    }
  });
  w.reactions = norm(sum) / weight;
  w.slip_so_far = account_energy(sim).friction;
  return w;
}

void expect_stays(const std::string& label, const std::string& toml) {
  constexpr double bound = 1e-4;  // of the unbalanced ratio and of the change of stress
  SCOPED_TRACE(label);
  Simulation sim = scene(toml);
  ASSERT_GT(sim.scene->blocks.size(), 20U);
  const Watched w = watch(sim);
  expect_at_most({37, label, "largest unbalanced ratio", ""}, w.unbalanced, bound);
  expect_at_most({37, label, "largest displacement over sigma L/E", ""}, w.moved, 1e-2);
  expect_at_most({37, label, "change of stress in a block over the largest", ""}, w.stress, bound);
  EXPECT_LT(w.in_slivers, 10.0 * bound);
  expect_at_most({37, label, "reactions with weight, over the weight", ""}, w.reactions,
                 10.0 * bound);
  EXPECT_LT(w.error, 1e-8);
  EXPECT_LT(sim.accounts.initial->unbalanced, 3e-6);
  EXPECT_EQ(sim.accounts.steps.redone, 0U);
  record_model(37, label, sim);
}

const std::string explicit_run = "[solver]\nduration = 0.004\n";

TEST(InitialStress, ObliqueJointsKeepATensor) {
  expect_stays("two sets, tensor, fixed",
               rock + strong + two_sets + tensor + all_fixed + explicit_run);
  expect_stays(
      "two sets, tensor, rollers and stress",
      rock + strong + two_sets + tensor + on_rollers + boundary("'top'", "stress") + explicit_run);
  expect_stays("two sets, tensor, viscous",
               rock + strong + two_sets + tensor + boundary("'top'", "stress") +
                   boundary("'left', 'right', 'bottom'", "viscous") + explicit_run);
}

/// A joint's own stiffness: it is closed by a millimetre.
TEST(InitialStress, SoftJointsAreStrainedForIt) {
  const std::string held =
      boundary("'left', 'right', 'bottom', 'top'", "fixed") + "stiffness = 2e11\n";
  expect_stays("two sets, tensor, soft joints", rock + strong +
                                                    "kn = '10 GPa/m'\nks = '4 GPa/m'\n" + two_sets +
                                                    tensor + held + explicit_run);
  expect_stays("glued, tensor", rock + "[joints.j]\ntype = 'glued'\nkn = '10 GPa/m'\n" + voronoi +
                                    tensor + held + explicit_run);
}

/// Two joints that cross at a few degrees: between the sides of the acute corners there is rock,
/// and where these faces meet at the crossing they must carry none of the stress.
TEST(InitialStress, JointsThatCrossAtAFewDegrees) {
  for (const double angle : {3.0, 6.0, 9.0}) {
    const double y = 5.0 * std::tan(radians(0.5 * angle));
    const auto trace = [](double left, double right) {
      return "[[trace]]\npoints = [[-5, " + number(left) + "], [5, " + number(right) + "]]\n";
    };
    Simulation sim = scene(
        "[materials.rock]\ndensity = 2500\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 35\n[domain]\njoint = 'j'\noutline = " +
        rectangle(-5.0, -5.0, 5.0, 5.0) + "\n" + trace(-y, y) + trace(y, -y) +
        "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n[[boundary]]\n"
        "sides = ['top']\ntype = 'stress'\n[initial_stress]\nk0 = 0.5\nsurface_y = 50\n" +
        explicit_run);
    EXPECT_LT(sim.accounts.initial->unbalanced, 1e-7) << angle;
  }
}

/// Where two sets cross four corners meet, and rounding alone makes those overlap that lie across.
TEST(InitialStress, NothingOpensWhereJointSetsCross) {
  const std::string sets =
      "[[joint_set]]\nangle = 0.0\nspacing = 1.0\norigin = [0, 980]\n"
      "[[joint_set]]\nangle = 90.0\nspacing = 1.0\norigin = [0, 980]\n";
  Simulation sim =
      scene(rock + rough + sets + from_weight("surface = 'outline'") + on_rollers + explicit_run);
  ASSERT_GT(sim.scene->blocks.size(), 300U);
  run(sim, [](Simulation&) {});
  EXPECT_EQ(sim.accounts.open_close.switched, 0U);
}

TEST(InitialStress, OddBlocksKeepATensor) {
  expect_stays("Voronoi, tensor, fixed",
               rock + strong + voronoi + tensor + all_fixed + explicit_run);
  expect_stays("short traces, tensor, fixed",
               rock + strong + short_traces + tensor + all_fixed + explicit_run);
}

TEST(InitialStress, WeightOfTheRockAbove) {
  expect_stays(
      "two sets, k0, free top",
      rock + rough + two_sets + from_weight("surface = 'outline'") + on_rollers + explicit_run);
  expect_stays("Voronoi, k0, free top", rock + rough + voronoi + from_weight("surface_y = 1000.0") +
                                            on_rollers + explicit_run);
  expect_stays("Voronoi, k0, 200 m deep", rock + rough + voronoi +
                                              from_weight("surface_y = 1200.0") + on_rollers +
                                              boundary("'top'", "stress") + explicit_run);
}

TEST(InitialStress, LayersOfOtherRock) {
  expect_stays("layers, k0", "[materials.clay]\ndensity = 1900.0\nyoung = 20e9\npoisson = 0.25\n" +
                                 rock + rough +
                                 "[[joint_set]]\nangle = 0.0\nspacing = 2.0\norigin = [0, 980]\n"
                                 "[[joint_set]]\nangle = 80.0\nspacing = 2.3\norigin = [0, 980]\n"
                                 "[[region]]\nmaterial = 'clay'\njoint = 'j'\n"
                                 "polygon = [[-10, 986], [10, 986], [10, 992], [-10, 992]]\n" +
                                 from_weight("surface_y = 1000.0") + on_rollers + explicit_run);
}

TEST(InitialStress, WaterBearsItsShare) {
  const std::string wet = "[[water]]\ntable = [[-10, 994.5], [10, 994.5]]\n";
  expect_stays("two sets, k0, water", rock + rough + two_sets + wet +
                                          from_weight("surface_y = 1000.0") + on_rollers +
                                          explicit_run);
  expect_stays("Voronoi, tensor, water, stress on top",
               rock + strong + voronoi + "[[water]]\ntable = [[-10, 1010], [10, 1030]]\n" + tensor +
                   on_rollers + boundary("'top'", "stress") + explicit_run);
}

TEST(InitialStress, OtherMassesAndTheImplicitMethod) {
  const std::string ground = rock + strong + two_sets + tensor + all_fixed;
  for (const char* mass : {"covering", "consistent"}) {
    expect_stays(mass, ground + explicit_run + "mass = '" + mass + "'\n");
  }
  expect_stays("implicit", ground + explicit_run + "method = 'dda'\ntime_step = 1e-4\n");
  expect_stays("held blocks", rock + rough + voronoi + from_weight("surface_y = 1000.0") +
                                  boundary("'left', 'right', 'bottom'", "roller") +
                                  "[[fixed]]\npoint = [0, 982]\n" + explicit_run);
}

/// Without the initial forces of contacts, or with a wrong gradient, the same ground moves: the
/// test can fail.
TEST(InitialStress, WhatDoesNotMatchMoves) {
  Simulation steep = scene(rock + strong + two_sets +
                           "[initial_stress]\nstress = [-31e6, -24e6, 4e6]\n"
                           "at_y = 990.0\ngradient = [1.9e4, 2e4, 0.0]\n" +
                           all_fixed + explicit_run);
  judge_initial_stress(steep);
  EXPECT_NEAR(steep.accounts.initial->gradient, 1.0 - 2e4 / (density * gravity), 1e-12);
  EXPECT_GT(watch(steep).unbalanced, 5e-4);
  Simulation loose = scene(rock + strong + two_sets + tensor + on_rollers + explicit_run);
  judge_initial_stress(loose);
  EXPECT_GT(loose.accounts.initial->unbalanced, 1e-2);
}

/// A bonded joint that is drawn with a gap of 0.3 mm is pressed as one without.
TEST(InitialStress, PressesBondedJointsHoweverTheyAreDrawn) {
  for (const double gap : {0.0, 3e-4, -3e-4}) {
    Simulation sim = scene(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = 0.0\n"
        "[joints.j]\nfriction_angle = 30\ncohesion = 1e5\n[initial_stress]\n"
        "stress = [0.0, -1e6, 0.0]\n[solver]\nduration = 0.02\n[[block]]\nfixed = true\n"
        "polygon = [[-1, -1], [3, -1], [3, 0], [-1, 0]]\n[[block]]\nfixed = true\n"
        "polygon = [[-1, 1], [3, 1], [3, 2], [-1, 2]]\n[[block]]\npolygon = [[0, " +
        number(gap) + "], [2, " + number(gap) + "], [2, 1], [0, 1]]\n");
    run(sim, [](Simulation&) {});
    EXPECT_LT(norm(displacement(sim, 2)), 1e-8) << gap;
  }
}

}  // namespace
}  // namespace edda::initial_stress_test
