// The ledger between two steps, whatever the next one will be.
#include <gtest/gtest.h>

#include <cmath>

#include "contacts/face_reading.hpp"
#include "contacts/find_faces.hpp"
#include "run/prepared.hpp"

namespace edda::ledger_test {
namespace {

TEST(Ledger, DoesNotKnowTheNextStep) {
  Result<Model> model = read_model_text(
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\nangular_velocity = "
      "3.0\n"
      "velocity = [1.0, 2.0]\n[solver]\nduration = 1\n",
      "t.toml", {});
  ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
  Result<Simulation> made = Simulation::create(std::move(model.value()));
  ASSERT_TRUE(made.ok());
  Simulation& sim = made.value();
  sim.start(0.5);
  for (int n = 0; n < 200; ++n) ASSERT_FALSE(sim.step());
  const double step = sim.state.step;
  const Ledger before = sim.ledger();
  sim.aim_at(sim.state.time + 0.6 * step);
  ASSERT_LT(sim.state.step, 0.7 * step);
  const Ledger after = sim.ledger();
  EXPECT_EQ(after.gravity, before.gravity);
  EXPECT_EQ(after.strain, before.strain);
  EXPECT_EQ(after.drift, before.drift);
  ASSERT_FALSE(sim.step());
  EXPECT_NEAR(sim.ledger().drift, before.drift, 1e-8);
}

/// Runs for `duration` s. The largest drift of the ledger at any step.
double drift_of(Simulation& sim, double duration) {
  double most = 0.0;
  sim.start(duration);
  sim.ledger();
  while (sim.state.time < duration) {
    if (sim.step()) {
      ADD_FAILURE() << "lost";
      break;
    }
    const double drift = std::abs(sim.ledger().drift);
    if (!(drift <= most)) most = drift;
  }
  return most;
}

const std::string rock =
    "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\ndamping = 0\n[joints.j]\n"
    "friction_angle = 20\n[solver]\nduration = 1\n";

/// Corners that land, leave and slide. What their switching leaves undone is next to nothing.
TEST(Ledger, ClosesWhileEndsOpenAndClose) {
  struct Case {
    const char *friction, *drag;
    double transfer;  // of all energy: overlaps that change under friction take some
  };
  for (const Case& q : {Case{"0", "0", 1e-9}, {"25", "0", 2e-4}, {"0", "50", 1e-9}}) {
    std::string text = rock + "damping = { mass = " + q.drag +
                       " }\n[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\n"
                       "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [1, -2]\n"
                       "polygon = [[0,0.01],[1,0.06],[0.95,1.06],[-0.05,1.01]]\n[[block]]\n"
                       "velocity = [0, -3]\n"
                       "polygon = [[-0.2,1.2],[0.8,1.1],[0.9,2.1],[-0.1,2.2]]\n";
    text.replace(text.find("friction_angle = 20"), 19,
                 std::string("friction_angle = ") + q.friction);
    Simulation sim = testing::prepared(text).sim;
    EXPECT_LT(drift_of(sim, 0.2), 2e-4) << q.friction << ' ' << q.drag;
    EXPECT_GT(sim.open_close.switched, 10u);
    EXPECT_EQ(sim.open_close.unsettled, 0u);
    const Ledger l = sim.ledger();
    EXPECT_LT(std::abs(l.transfer), q.transfer * l.scale()) << q.friction << ' ' << q.drag;
  }
}

/// Two halves that pull and push each other through a bonded joint.
TEST(Ledger, ClosesWhileABondGoesToAndFro) {
  std::string text = "gravity = [0, 0]\n" + rock +
                     "[[block]]\nvelocity = [0, -0.01]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                     "[[block]]\nvelocity = [0, 0.01]\npolygon = [[0,1],[1,1],[1,2],[0,2]]\n";
  text.replace(text.find("friction_angle = 20"), 19, "type = 'glued'\nkn = 1e10");
  Simulation sim = testing::prepared(text).sim;
  EXPECT_LT(drift_of(sim, 0.02), 1e-6);
}

/// A block falls into a bolt, which yields and breaks.
TEST(Ledger, HasWhatBoltsStoreAndTake) {
  Simulation sim =
      testing::prepared(
          rock +
          "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
          "velocity = [0, -1]\npolygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\ntype = 'end'\n"
          "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\nyield_stress = 400e6\n"
          "rupture_strain = 0.01\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.06), 1e-6);
  const Ledger l = sim.ledger();
  EXPECT_GT(sim.bolts.fractured, 0.0);
  EXPECT_EQ(l.fracture, sim.bolts.fractured);
  EXPECT_EQ(l.friction, sim.bolts.slipped);
  EXPECT_GT(l.friction, 0.0);
}

/// A bolt that pulls, with ends or in grout, between a roof and a block that falls from it.
std::string falling_from_a_bolt(const std::string& type) {
  return rock +
         "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
         "velocity = [0.5, -3]\npolygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\nname = 'b'\n"
         "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\npretension = 5e4\ntype = '" +
         type + (type == "end" ? "'\n" : "'\nbond = { stiffness = 1e9, strength = 1e6 }\n");
}

TEST(Ledger, HasWhatPretensionDoesFromTheStart) {
  for (const std::string type : {"end", "grouted"}) {
    Simulation sim = testing::prepared(falling_from_a_bolt(type)).sim;
    EXPECT_LT(drift_of(sim, 0.005), 2e-6) << type;
  }
}

/// One that is put in while its block falls and the roof shakes.
TEST(Ledger, HasWhatPretensionDoesOncePutIn) {
  Simulation sim =
      testing::prepared(falling_from_a_bolt("end") +
                        "[[shaking]]\nacceleration = { amplitude = 100.0, frequency = 10.0 }\n"
                        "[[stage]]\nduration = 0.5\n[[stage]]\nduration = 0.5\n"
                        "install = ['b']\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.03), 1e-6);
  EXPECT_FALSE(sim.install({0}));
  const double before = sim.ledger().drift;
  sim.aim_at(0.032);
  while (sim.state.time < 0.032) {
    ASSERT_FALSE(sim.step());
    ASSERT_NEAR(sim.ledger().drift, before, 2e-6);
  }
}

/// Velocities that are changed while a bolt pulls are work from outside, and no more.
TEST(Ledger, KeepsItsBooksOfBoltsWhenVelocitiesChange) {
  Simulation sim = testing::prepared(
                       rock +
                       "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
                       "polygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\ntype = 'end'\n"
                       "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\npretension = 5e4\n")
                       .sim;
  EXPECT_LT(drift_of(sim, 0.01), 1e-5);
  Nodes vx = sim.state.vx, vy = sim.state.vy;
  for (std::size_t k = 0; k < 3; ++k) vy[k][1] -= 1.0;
  sim.change_velocities(vx, vy);
  sim.aim_at(0.02);
  while (sim.state.time < 0.02) {
    ASSERT_FALSE(sim.step());
    EXPECT_LT(std::abs(sim.ledger().drift), 1e-5);
  }
}

/// A pulse that leaves through the foot of a column.
TEST(Ledger, HasWhatBoundariesLetOut) {
  std::string text = "gravity = [0, 0]\n" + rock + "[contact]\nnormal_stiffness = 2e10\n";
  text.replace(text.find("friction_angle = 20"), 19, "type = 'glued'");
  for (int i = 0; i < 4; ++i) {
    const std::string low = std::to_string(i), high = std::to_string(i + 1);
    text += "[[block]]\nvelocity = [0.01, -0.03]\npolygon = [[0," + low + "],[1," + low + "],[1," +
            high + "],[0," + high + "]]\n";
  }
  Simulation sim =
      testing::prepared(text + "[[boundary]]\nsides = ['bottom']\ntype = 'viscous'\n").sim;
  EXPECT_LT(drift_of(sim, 5e-3), 1e-3);
  const Ledger l = sim.ledger();
  EXPECT_GT(l.damping, 0.5 * l.scale());
}

/// Friction drags a block along a base that shakes.
TEST(Ledger, HasTheWorkOfAGroundThatShakes) {
  Simulation sim =
      testing::prepared(
          rock +
          "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\npolygon = "
          "[[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
          "[[shaking]]\nacceleration = { amplitude = 20.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.2), 1e-5);
  const Ledger l = sim.ledger();
  EXPECT_GT(l.friction, 0.1 * l.scale());
}

/// What faces that have left the list had taken stays in its lines.
TEST(Ledger, KeepsWhatFacesHadTaken) {
  Simulation sim =
      testing::prepared(rock +
                        "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\npolygon = "
                        "[[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [3, 0]\npolygon = "
                        "[[2.2,0],[3.2,0],[3.2,1],[2.2,1]]\n")
          .sim;
  drift_of(sim, 0.01);
  FaceSet& c = sim.contacts;
  c.transfer[0] += 3.0;
  c.fracture_work[0] += 5.0;
  c.damping_work[0] += 7.0;
  const Ledger before = sim.ledger_now();
  // Far away: a new list has none of its faces.
  for (std::size_t v = sim.blocks.vertex_begin[1]; v < sim.blocks.vertex_count(); ++v) {
    sim.pose.x[v] += 50.0;
  }
  for (auto* energy : {&c.now.energy, &c.bonded}) energy->fill(0.0);
  find_faces(c, sim.blocks, sim.state, sim.pose, sim.laws, 0.01);
  ASSERT_EQ(c.size(), 0u);
  const Ledger after = sim.ledger_now();
  EXPECT_GT(before.friction, 0.0);
  EXPECT_NEAR(after.friction, before.friction, 1e-9 * before.friction);
  EXPECT_NEAR(after.transfer, before.transfer, 1e-9);
  EXPECT_NEAR(after.fracture, 5.0, 1e-9);
  EXPECT_GE(after.damping, 7.0);
}

/// One block that meets dashpots while its steps change.
TEST(Ledger, ClosesOnDashpotsWhateverTheSteps) {
  Simulation sim =
      testing::prepared("gravity = [0, 0]\n" + rock +
                        "[[block]]\nvelocity = [0.3, -1.0]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                        "[[boundary]]\nsides = ['bottom']\ntype = 'viscous'\n")
          .sim;
  sim.start(1.0);
  sim.ledger();
  const double step = sim.state.step;
  for (int n = 0; n < 30; ++n) {
    sim.aim_at(sim.state.time + (n % 2 == 0 ? 0.4 : 1.0) * step);
    ASSERT_FALSE(sim.step());
    EXPECT_LT(std::abs(sim.ledger().drift), 1e-7);
  }
  EXPECT_GT(sim.ledger().damping, 0.1 * sim.ledger().kinetic);
}

/// What is lighter than the wave is long moves with twice the velocity of what comes up.
TEST(Ledger, HasTheWorkOfWavesThatComeIn) {
  Simulation sim =
      testing::prepared(
          "gravity = [0, 0]\n" + rock +
          "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n[[boundary]]\nname = 'foot'\n"
          "sides = ['bottom']\ntype = 'viscous'\n[[shaking]]\napply = 'upgoing'\n"
          "boundary = 'foot'\n"
          "acceleration = { amplitude = 1.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.05), 1e-6);
  const double incoming = 2.0 / (2.0 * M_PI * 10.0);
  EXPECT_NEAR(centroid(sim.state.vx, sim.state.vy, 0).x, 2.0 * incoming, 0.02 * incoming);
}

/// Springs of a boundary that goes with the ground.
TEST(Ledger, HasTheWorkOfSpringsOnAGroundThatShakes) {
  Simulation sim =
      testing::prepared("gravity = [0, 0]\n" + rock +
                        "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n[[boundary]]\n"
                        "sides = ['bottom']\ntype = 'fixed'\nstiffness = 1e7\n[[shaking]]\n"
                        "acceleration = { amplitude = 20.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.1), 1e-5);
  EXPECT_GT(sim.ledger().external, 0.0);
}

/// What does not change jumps by nothing: of a block that slides, with half the friction, its
/// weight.
TEST(Jumps, AreTheChangeOfForces) {
  Simulation sim =
      testing::prepared(rock +
                        "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\n"
                        "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [3, 0]\n"
                        "polygon = [[0,0],[1,0],[1,1],[0,1]]\n")
          .sim;
  drift_of(sim, 0.02);
  sim.set_strength_factor(2.0);
  double x = 0.0, y = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    x += sim.jump.x[k].empty() ? 0.0 : sim.jump.x[k][1];
    y += sim.jump.y[k].empty() ? 0.0 : sim.jump.y[k][1];
  }
  const double normal = normal_force(sim.contacts, 0), tangent = std::tan(20.0 * M_PI / 180.0);
  EXPECT_NEAR(x, 0.5 * tangent * normal, 1e-3 * normal);
  EXPECT_NEAR(y, 0.0, 1e-3 * normal);
}

}  // namespace
}  // namespace edda::ledger_test
