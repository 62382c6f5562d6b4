// contact.model = "points": runs with the paper's contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "observe/observe.hpp"
#include "run/prepared.hpp"
#include "run/simulation_memory.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "step/touching.hpp"

namespace edda::points_run_test {
namespace {

using testing::prepared;

std::string model(const std::string& shapes, const std::string& more = "") {
  return "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\ndamping = 0\n"
         "[contact]\nmodel = \"points\"\nnormal_stiffness = 1e9\n" +
         more + shapes + "[solver]\nduration = 1\n";
}

const std::string smooth = "[joints.j]\nfriction_angle = 0\n";

Id named(const Simulation& s, const char* name) {
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    if (s.scene->blocks.name(i) == name) return static_cast<Id>(i);
  }
  return no_id;
}

Vec2 velocity(const Simulation& s, const char* name) {
  return centroid(s.motion.state.velocity, named(s, name));
}

/// Makes steps to a time.
void go_on(Simulation& sim, double until) {
  fit_step_to(sim, until);
  while (sim.motion.state.time < until) ASSERT_FALSE(step(sim));
}

/// A block of 2 m x 1 m on a fixed ramp, both rotated by the slope.
std::string ramp(double slope, double friction) {
  const double a = -slope * std::numbers::pi / 180.0;
  const auto at = [&](double x, double y) {
    return "[" + std::to_string(x * std::cos(a) - y * std::sin(a)) + "," +
           std::to_string(x * std::sin(a) + y * std::cos(a)) + "]";
  };
  const auto box = [&](double x0, double x1, double y0, double y1) {
    return "[" + at(x0, y0) + "," + at(x1, y0) + "," + at(x1, y1) + "," + at(x0, y1) + "]";
  };
  return model("[[block]]\nfixed = true\npolygon = " + box(-4, 8, -1, 0) +
                   "\n[[block]]\nname = \"slider\"\npolygon = " + box(0, 2, 0, 1) + "\n",
               "[joints.j]\nfriction_angle = " + std::to_string(friction) + "\n");
}

/// Eq. 42.
TEST(PointRuns, SlideByCoulomb) {
  Simulation sim = prepared(ramp(45.0, 10.0)).sim;
  start(sim, 0.5);
  go_on(sim, 0.5);
  const Id i = named(sim, "slider");
  const Vec2 moved = centroid(sim.motion.state.position, i) -
                     Vec2{sim.scene->blocks.centroid_x[i], sim.scene->blocks.centroid_y[i]};
  const double a = std::numbers::pi / 4.0;
  const double exact =
      0.5 * 9.81 * (std::sin(a) - std::tan(10.0 * std::numbers::pi / 180.0) * std::cos(a)) * 0.25;
  EXPECT_NEAR(dot(moved, {std::cos(a), -std::sin(a)}) / exact, 1.0, 2e-3);
}

TEST(PointRuns, FrictionHolds) {
  Simulation sim = prepared(ramp(20.0, 40.0) + "damping = { local = 0.5 }\n").sim;
  start(sim, 0.5);
  go_on(sim, 0.5);
  const Id i = named(sim, "slider");
  const Vec2 moved = centroid(sim.motion.state.position, i) -
                     Vec2{sim.scene->blocks.centroid_x[i], sim.scene->blocks.centroid_y[i]};
  EXPECT_LT(norm(moved), 1e-3);
}

/// In equilibrium on its two corners: p_n d of each is half of the weight.
TEST(PointRuns, CarryHalfOfTheWeightAtEitherCorner) {
  Simulation sim =
      prepared(model("[[block]]\nfixed = true\npolygon = [[-2,-1],[3,-1],[3,0],[-2,0]]\n"
                     "[[block]]\nname = \"top\"\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n",
                     smooth) +
               "damping = { local = 0.8 }\n")
          .sim;
  start(sim, 0.5);
  go_on(sim, 0.5);
  const double weight = 2500.0 * 9.81;
  std::size_t closed = 0;
  for (std::size_t k = 0; k < sim.point_contacts.size(); ++k) {
    if (sim.point_contacts.closed[k] == 0.0) continue;
    ++closed;
    const double depth = gap_of(sim.point_contacts, sim.scene->blocks, sim.motion.pose, k).depth;
    EXPECT_NEAR(1e9 * depth, 0.5 * weight, 1e-6 * weight);
  }
  EXPECT_EQ(closed, 2u);
}

std::string colliding(const char* extra = "") {
  return "gravity = [0, 0]\n" +
         model(
             "[[block]]\nname = \"left\"\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
             "velocity = [1.0, 0.2]\n"
             "[[block]]\nname = \"right\"\npolygon = "
             "[[1.01,0.3],[2.01,0.3],[2.01,1.6],[1.01,1.6]]\n",
             std::string("[joints.j]\nfriction_angle = 20\n")) +
         extra;
}

TEST(PointRuns, KeepMomentum) {
  Simulation sim = prepared(colliding()).sim;
  start(sim, 0.05);
  const auto momentum = [&] {
    return 2500.0 * (velocity(sim, "left") + 1.3 * velocity(sim, "right"));
  };
  const Vec2 before = momentum();
  go_on(sim, 0.05);
  EXPECT_GT(velocity(sim, "right").x, 0.3);
  EXPECT_NEAR(norm(momentum() - before) / norm(before), 0.0, 1e-12);
}

/// The energy that plain switching creates or loses decreases with the step, and friction is in the
/// energy balance.
TEST(PointRuns, BouncesKeepEnergyAtSmallSteps) {
  double error[2];
  for (const int fine : {0, 1}) {
    Simulation sim = prepared(colliding(fine ? "safety = 0.02\n" : "safety = 0.2\n")).sim;
    start(sim, 0.05);
    const double start = account_energy(sim).balance();
    double friction = 0.0;
    fit_step_to(sim, 0.05);
    while (sim.motion.state.time < 0.05) {
      ASSERT_FALSE(step(sim));
      const EnergyBalance l = account_energy(sim);
      EXPECT_GE(l.friction, friction - 1e-9 * start);
      friction = l.friction;
    }
    EXPECT_GT(friction, 1e-4 * start);
    EXPECT_EQ(closed_points(sim.point_contacts), 0u);
    error[fine] = std::abs(account_energy(sim).balance() - start) / start;
  }
  EXPECT_LT(error[0], 0.05);
  EXPECT_LT(error[1], 0.003);
}

/// A block that slides is in contact, not falling.
TEST(PointRuns, BlocksTouchWhereTheirPointsAreClosed) {
  Simulation sim = prepared(ramp(45.0, 10.0)).sim;
  start(sim, 0.1);
  go_on(sim, 0.1);
  ASSERT_EQ(closed_points(sim.point_contacts), 2u);
  EXPECT_EQ(touching(sim), std::vector<std::uint8_t>(2, 1));
}

/// While contacts stay closed and slide, the energy balance closes up to the error of rotation.
TEST(PointRuns, EnergyBalanceClosesWhileContactsStayClosed) {
  Simulation sim = prepared(ramp(45.0, 10.0) + "damping = { local = 0.3 }\n").sim;
  start(sim, 0.3);
  go_on(sim, 0.15);
  ASSERT_EQ(closed_points(sim.point_contacts), 2u);
  const EnergyBalance before = account_energy(sim);
  go_on(sim, 0.3);
  ASSERT_EQ(closed_points(sim.point_contacts), 2u);
  const EnergyBalance after = account_energy(sim);
  EXPECT_GT(after.friction, 1.5 * before.friction);
  EXPECT_NEAR((after.balance() - before.balance()) / after.kinetic, 0.0, 1e-6);
}

TEST(PointRuns, ResumeToTheSameBits) {
  const std::string text = ramp(30.0, 15.0);
  Simulation whole = prepared(text).sim;
  start(whole, 0.2);
  go_on(whole, 0.1);
  Record record;
  remember(whole, record);
  Simulation resumed = prepared(text).sim;
  ASSERT_EQ(recall(resumed, record), "");
  go_on(whole, 0.2);
  go_on(resumed, 0.2);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(whole.motion.state.position.x[k], resumed.motion.state.position.x[k]);
    EXPECT_EQ(whole.motion.state.velocity.y[k], resumed.motion.state.velocity.y[k]);
  }
  EXPECT_EQ(whole.point_contacts.friction, resumed.point_contacts.friction);
  EXPECT_EQ(account_energy(whole).balance(), account_energy(resumed).balance());
  EXPECT_GT(resumed.point_contacts.friction, 0.0);
}

/// The bound of the step is safe: at the bound no disturbance grows, though contacts are stiffer
/// than the rock.
TEST(PointRuns, AreStableAtTheBound) {
  Simulation sim =
      prepared(model("[[block]]\nfixed = true\npolygon = [[-2,-1],[3,-1],[3,0],[-2,0]]\n"
                     "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                     "[[block]]\npolygon = [[0,1],[1,1],[1,2],[0,2]]\n"
                     "[[block]]\npolygon = [[1,0],[2,0],[2,1],[1,1]]\n"
                     "[[block]]\npolygon = [[1,1],[2,1],[2,2],[1,2]]\n",
                     smooth) +
               "safety = 1\ndamping = { mass = 20 }\n")
          .sim;
  start(sim, 1.0);
  go_on(sim, 1.0);
  double fastest = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i)
    fastest = std::max(fastest, norm(centroid(sim.motion.state.velocity, i)));
  EXPECT_LT(fastest, 1e-2);
}

/// A row of joints.csv per contact: as a face without length.
TEST(PointRuns, TablesHaveARowPerContact) {
  Simulation sim = prepared(ramp(45.0, 10.0)).sim;
  start(sim, 0.1);
  go_on(sim, 0.1);
  Instant at;
  observe(sim, at);
  const Picture picture = picture_of(sim, at);
  const Id slider = named(sim, "slider");
  double shear = 0.0, normal = 0.0;
  std::size_t sliding = 0;
  for (const ContactRecord& r : picture.contacts) {
    EXPECT_EQ(r.block_i, slider);
    EXPECT_EQ(r.joint, "j");
    EXPECT_EQ(r.length, 0.0);
    EXPECT_EQ(r.a, r.position);
    normal += r.normal_force;
    shear += r.shear_force;
    sliding += r.state == ContactState::slide;
    if (r.state == ContactState::slide) {
      EXPECT_NEAR(r.mobilised, 1.0, 1e-12);
    }
    if (r.state != ContactState::open) {
      EXPECT_NEAR(norm(r.force), std::hypot(r.normal_force, r.shear_force), 1e-6);
      EXPECT_LE(r.opening, 0.0);
      EXPECT_NEAR(std::abs(r.slip), 0.5 * 9.81 * 0.8236 * std::sqrt(0.5) * 0.01, 2e-3);
    }
  }
  EXPECT_GE(picture.contacts.size(), 2u);
  EXPECT_GE(sliding, 1u);
  EXPECT_GT(normal, 0.0);
  EXPECT_NEAR(std::abs(shear), normal * std::tan(10.0 * std::numbers::pi / 180.0), 1e-3 * normal);
}

}  // namespace
}  // namespace edda::points_run_test
