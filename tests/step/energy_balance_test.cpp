// The energy balance between two steps, independent of the next one.
#include <gtest/gtest.h>

#include <cmath>

#include "contacts/face_reading.hpp"
#include "run/prepared.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda::ledger_test {
namespace {

TEST(EnergyBalance, DoesNotKnowTheNextStep) {
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
  start(sim, 0.5);
  for (int n = 0; n < 200; ++n) ASSERT_FALSE(step(sim));
  const double step = sim.motion.state.step;
  const EnergyBalance before = account_energy(sim);
  fit_step_to(sim, sim.motion.state.time + 0.6 * step);
  ASSERT_LT(sim.motion.state.step, 0.7 * step);
  const EnergyBalance after = account_energy(sim);
  EXPECT_EQ(after.gravity, before.gravity);
  EXPECT_EQ(after.strain, before.strain);
  EXPECT_EQ(after.error, before.error);
  ASSERT_FALSE(edda::step(sim));
  EXPECT_NEAR(account_energy(sim).error, before.error, 1e-8);
}

/// Runs for `duration` s. Returns the largest energy balance error at any step.
double drift_of(Simulation& sim, double duration) {
  double most = 0.0;
  start(sim, duration);
  account_energy(sim);
  while (sim.motion.state.time < duration) {
    if (step(sim)) {
      ADD_FAILURE() << "lost";
      break;
    }
    const double error = std::abs(account_energy(sim).error);
    if (!(error <= most)) most = error;
  }
  return most;
}

const std::string rock =
    "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\ndamping = 0\n[joints.j]\n"
    "friction_angle = 20\n[solver]\nduration = 1\n";

/// Corners that land, leave and slide. The error of their activation is negligible.
TEST(EnergyBalance, ClosesWhileEndsOpenAndClose) {
  struct Case {
    const char *friction, *mass_damping;
    double transfer;  // fraction of all energy: overlaps that change under friction take some
  };
  for (const Case& q : {Case{"0", "0", 1e-9}, {"25", "0", 2.5e-4}, {"0", "50", 1e-9}}) {
    std::string text = rock + "damping = { mass = " + q.mass_damping +
                       " }\n[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\n"
                       "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [1, -2]\n"
                       "polygon = [[0,0.01],[1,0.06],[0.95,1.06],[-0.05,1.01]]\n[[block]]\n"
                       "velocity = [0, -3]\n"
                       "polygon = [[-0.2,1.2],[0.8,1.1],[0.9,2.1],[-0.1,2.2]]\n";
    text.replace(text.find("friction_angle = 20"), 19,
                 std::string("friction_angle = ") + q.friction);
    Simulation sim = testing::prepared(text).sim;
    EXPECT_LT(drift_of(sim, 0.2), 2e-4) << q.friction << ' ' << q.mass_damping;
    EXPECT_GT(sim.accounts.open_close.switched, 10u);
    EXPECT_EQ(sim.accounts.open_close.not_converged, 0u);
    const EnergyBalance l = account_energy(sim);
    EXPECT_LT(std::abs(l.transfer), q.transfer * l.scale()) << q.friction << ' ' << q.mass_damping;
  }
}

/// Two halves that pull and push each other through a bonded joint.
TEST(EnergyBalance, ClosesWhileABondGoesToAndFro) {
  std::string text = "gravity = [0, 0]\n" + rock +
                     "[[block]]\nvelocity = [0, -0.01]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                     "[[block]]\nvelocity = [0, 0.01]\npolygon = [[0,1],[1,1],[1,2],[0,2]]\n";
  text.replace(text.find("friction_angle = 20"), 19, "type = 'glued'\nkn = 1e10");
  Simulation sim = testing::prepared(text).sim;
  EXPECT_LT(drift_of(sim, 0.02), 1e-6);
}

/// A block falls into a bolt, which yields and breaks.
TEST(EnergyBalance, HasWhatBoltsStoreAndTake) {
  Simulation sim =
      testing::prepared(
          rock +
          "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
          "velocity = [0, -1]\npolygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\ntype = 'end'\n"
          "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\nyield_stress = 400e6\n"
          "rupture_strain = 0.01\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.06), 1e-6);
  const EnergyBalance l = account_energy(sim);
  EXPECT_GT(sim.attached.bolts.fractured, 0.0);
  EXPECT_EQ(l.fracture, sim.attached.bolts.fractured);
  EXPECT_EQ(l.friction, sim.attached.bolts.slipped);
  EXPECT_GT(l.friction, 0.0);
}

/// A bolt in tension, end-anchored or grouted, between a roof and a block that falls from it.
std::string falling_from_a_bolt(const std::string& type) {
  return rock +
         "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
         "velocity = [0.5, -3]\npolygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\nname = 'b'\n"
         "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\npretension = 5e4\ntype = '" +
         type + (type == "end" ? "'\n" : "'\nbond = { stiffness = 1e9, strength = 1e6 }\n");
}

TEST(EnergyBalance, HasWhatPretensionDoesFromTheStart) {
  for (const std::string type : {"end", "grouted"}) {
    Simulation sim = testing::prepared(falling_from_a_bolt(type)).sim;
    EXPECT_LT(drift_of(sim, 0.005), 2e-6) << type;
  }
}

/// A bolt that is installed while its block falls and the roof moves with the ground.
TEST(EnergyBalance, HasWhatPretensionDoesOncePutIn) {
  Simulation sim =
      testing::prepared(falling_from_a_bolt("end") +
                        "[[shaking]]\nacceleration = { amplitude = 100.0, frequency = 10.0 }\n"
                        "[[stage]]\nduration = 0.5\n[[stage]]\nduration = 0.5\n"
                        "install = ['b']\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.03), 1e-6);
  EXPECT_FALSE(install(sim, {0}));
  const double before = account_energy(sim).error;
  fit_step_to(sim, 0.032);
  while (sim.motion.state.time < 0.032) {
    ASSERT_FALSE(step(sim));
    ASSERT_NEAR(account_energy(sim).error, before, 2e-6);
  }
}

/// Velocities that are changed while a bolt is in tension count as external work and as nothing
/// else.
TEST(EnergyBalance, ClosesWithBoltsWhenVelocitiesChange) {
  Simulation sim = testing::prepared(
                       rock +
                       "[[block]]\nfixed = true\npolygon = [[-1,3],[1,3],[1,4],[-1,4]]\n[[block]]\n"
                       "polygon = [[-1,0],[1,0],[1,2],[-1,2]]\n[[bolt]]\ntype = 'end'\n"
                       "from = [0, 0.5]\nto = [0, 3.5]\ndiameter = 0.02\npretension = 5e4\n")
                       .sim;
  EXPECT_LT(drift_of(sim, 0.01), 1e-5);
  BodyVectors velocity = sim.motion.state.velocity;
  for (std::size_t k = 0; k < 3; ++k) velocity.y[k][1] -= 1.0;
  change_velocities(sim, velocity);
  fit_step_to(sim, 0.02);
  while (sim.motion.state.time < 0.02) {
    ASSERT_FALSE(step(sim));
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
  }
}

/// A pulse that leaves through the base of a column.
TEST(EnergyBalance, HasWhatBoundariesLetOut) {
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
  const EnergyBalance l = account_energy(sim);
  EXPECT_GT(l.damping, 0.5 * l.scale());
}

/// Friction drags a block along a base under ground motion.
TEST(EnergyBalance, HasTheWorkOfGroundMotion) {
  Simulation sim =
      testing::prepared(
          rock +
          "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\npolygon = "
          "[[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
          "[[shaking]]\nacceleration = { amplitude = 20.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.2), 1e-5);
  const EnergyBalance l = account_energy(sim);
  EXPECT_GT(l.friction, 0.1 * l.scale());
}

/// The dissipation of faces that have left the list remains in the energy balance.
TEST(EnergyBalance, KeepsTheDissipationOfRemovedFaces) {
  Simulation sim =
      testing::prepared(rock +
                        "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\npolygon = "
                        "[[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [3, 0]\npolygon = "
                        "[[2.2,0],[3.2,0],[3.2,1],[2.2,1]]\n")
          .sim;
  drift_of(sim, 0.01);
  const FaceSet& faces = sim.motion.contacts;
  change_faces(sim, [](FaceSet& c, FaceStates&) {
    c.transfer[0] += 3.0;
    c.fracture_work[0] += 5.0;
    c.damping_work[0] += 7.0;
  });
  const EnergyBalance before = energy_balance(sim);
  // Far away: a new list contains none of its faces.
  for (std::size_t v = sim.scene->blocks.vertex_begin[1]; v < sim.scene->blocks.vertex_count();
       ++v) {
    sim.motion.pose.x[v] += 50.0;
  }
  change_faces(sim, [](FaceSet& c, FaceStates& states) {
    for (FaceFields& m : states.now) m.energy = 0.0;
    for (std::size_t k = 0; k < c.size(); ++k) c.set_bond(BondState::unbonded, k);
  });
  search(sim, {0.01});
  ASSERT_EQ(faces.size(), 0u);
  const EnergyBalance after = energy_balance(sim);
  EXPECT_GT(before.friction, 0.0);
  EXPECT_NEAR(after.friction, before.friction, 1e-9 * before.friction);
  EXPECT_NEAR(after.transfer, before.transfer, 1e-9);
  EXPECT_NEAR(after.fracture, 5.0, 1e-9);
  EXPECT_GE(after.damping, 7.0);
}

/// Makes so many steps of changing length, after each of which the balance has to close.
void expect_closing_whatever_the_steps(Simulation& sim, int steps) {
  start(sim, 1.0);
  account_energy(sim);
  const double step = sim.motion.state.step;
  for (int n = 0; n < steps; ++n) {
    fit_step_to(sim, sim.motion.state.time + (n % 2 == 0 ? 0.4 : 1.0) * step);
    ASSERT_FALSE(edda::step(sim));
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-7);
  }
}

TEST(EnergyBalance, ClosesOnDashpotsWhateverTheSteps) {
  Simulation sim =
      testing::prepared("gravity = [0, 0]\n" + rock +
                        "[[block]]\nvelocity = [0.3, -1.0]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                        "[[boundary]]\nsides = ['bottom']\ntype = 'viscous'\n")
          .sim;
  expect_closing_whatever_the_steps(sim, 30);
  EXPECT_GT(account_energy(sim).damping, 0.1 * account_energy(sim).kinetic);
}

/// The same of a meshed block, of which the waves leave.
TEST(EnergyBalance, ClosesOnDashpotsOfAMeshWhateverTheSteps) {
  Simulation sim =
      testing::prepared("gravity = [0, 0]\n" + rock +
                        "[[block]]\nvelocity = [3e-3, -1e-2]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
                        "[[boundary]]\nsides = ['bottom', 'left']\ntype = 'viscous'\n[zones]\n"
                        "size = 0.2\n")
          .sim;
  expect_closing_whatever_the_steps(sim, 300);
  EXPECT_GT(account_energy(sim).damping, 10.0 * account_energy(sim).kinetic);
}

/// A block that is small compared with the wavelength moves with twice the velocity of the upgoing
/// wave.
TEST(EnergyBalance, HasTheWorkOfWavesThatComeIn) {
  Simulation sim =
      testing::prepared(
          "gravity = [0, 0]\n" + rock +
          "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n[[boundary]]\nname = 'below'\n"
          "sides = ['bottom']\ntype = 'viscous'\n[[shaking]]\napply = 'upgoing'\n"
          "boundary = 'below'\n"
          "acceleration = { amplitude = 1.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.05), 1e-6);
  const double incoming = 2.0 / (2.0 * M_PI * 10.0);
  EXPECT_NEAR(centroid(sim.motion.state.velocity, 0).x, 2.0 * incoming, 0.02 * incoming);
}

/// Springs of a boundary that moves with the ground.
TEST(EnergyBalance, HasTheWorkOfSpringsOnMovingGround) {
  Simulation sim =
      testing::prepared("gravity = [0, 0]\n" + rock +
                        "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n[[boundary]]\n"
                        "sides = ['bottom']\ntype = 'fixed'\nstiffness = 1e7\n[[shaking]]\n"
                        "acceleration = { amplitude = 20.0, frequency = 10.0 }\n")
          .sim;
  EXPECT_LT(drift_of(sim, 0.1), 1e-5);
  EXPECT_GT(account_energy(sim).external, 0.0);
}

/// Forces that do not change make no jump: for a sliding block whose friction is halved this is its
/// weight.
TEST(Jumps, AreTheChangeOfForces) {
  Simulation sim =
      testing::prepared(rock +
                        "[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\n"
                        "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [3, 0]\n"
                        "polygon = [[0,0],[1,0],[1,1],[0,1]]\n")
          .sim;
  drift_of(sim, 0.02);
  set_strength_factor(sim, 2.0);
  double x = 0.0, y = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    x += sim.motion.jump.x[k].empty() ? 0.0 : sim.motion.jump.x[k][1];
    y += sim.motion.jump.y[k].empty() ? 0.0 : sim.motion.jump.y[k][1];
  }
  const double normal = normal_force_now(sim, 0), tangent = std::tan(20.0 * M_PI / 180.0);
  EXPECT_NEAR(x, 0.5 * tangent * normal, 1e-3 * normal);
  EXPECT_NEAR(y, 0.0, 1e-3 * normal);
}

}  // namespace
}  // namespace edda::ledger_test
