// solver.mass_scaling: a few small blocks no longer govern the step.
#include <gtest/gtest.h>

#include <cmath>

#include "contacts/face_reading.hpp"
#include "forces/mass_scaling.hpp"
#include "model/read_model.hpp"
#include "step/changes.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"

namespace edda::mass_scaling_test {
namespace {

/// A cube on a floor, and a pebble on the cube, `height` above it.
Simulation pebble(const std::string& solver, double height = 0.0) {
  const std::string low = std::to_string(1.0 + height), high = std::to_string(1.05 + height);
  Result<Model> model = read_model_text(
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\nfixed = true\npolygon = [[-1,-1],[2,-1],[2,0],[-1,0]]\n"
      "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
      "[[block]]\npolygon = [[0.4," +
          low + "],[0.45," + low + "],[0.45," + high + "],[0.4," + high +
          "]]\n[solver]\nduration = 1\n" + solver,
      "t.toml", {});
  EXPECT_TRUE(model.ok()) << to_string(model.faults()[0]);
  Result<Simulation> made = Simulation::create(std::move(model.value()));
  EXPECT_TRUE(made.ok());
  return std::move(made.value());
}

std::string scaled_to(double step) {
  return "mass_scaling = " + std::to_string(1e6 * step) + "e-6\n";
}

double free_step() {
  return pebble("").control.limit;
}

TEST(MassScaling, ReachesTheStepWithThePebbleAlone) {
  const double step = 5.0 * free_step();
  for (const char* mass : {"", "mass = 'covering'\n", "mass = 'consistent'\n"}) {
    const Simulation sim = pebble(scaled_to(step) + mass);
    EXPECT_GE(sim.control.limit, step * (1.0 - 1e-6)) << mass;
    ASSERT_EQ(sim.motion.masses.raised.size(), 3u);
    EXPECT_EQ(sim.motion.masses.raised[1], 1.0);
    EXPECT_GT(sim.motion.masses.raised[2], 5.0);
    EXPECT_NEAR(added_mass(sim.scene->blocks, sim.motion.masses.raised),
                (sim.motion.masses.raised[2] - 1.0) * sim.scene->blocks.mass[2],
                1e-9 * sim.scene->blocks.mass[2]);
    EXPECT_NEAR(sim.scene->blocks.mass[2], 2600 * 0.05 * 0.05, 1e-9) << "its weight stays";
  }
  EXPECT_TRUE(pebble("").motion.masses.raised.empty());
  EXPECT_TRUE(pebble(scaled_to(0.5 * free_step())).motion.masses.raised.empty());
}

/// A block of middle size that stands on pebbles alone, its contacts damped.
Simulation on_pebbles(const std::string& solver) {
  std::string text =
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\nfixed = true\npolygon = [[-1,-1],[2,-1],[2,0],[-1,0]]\n"
      "[[block]]\npolygon = [[0,0.02],[0.2,0.02],[0.2,0.22],[0,0.22]]\n";
  for (const char* x : {"0.02", "0.16"}) {
    const double from = std::stod(x);
    text += "[[block]]\npolygon = [[" + std::to_string(from) + ",0],[" +
            std::to_string(from + 0.02) + ",0],[" + std::to_string(from + 0.02) + ",0.02],[" +
            std::to_string(from) + ",0.02]]\n";
  }
  Result<Model> model = read_model_text(
      text + "[solver]\nduration = 1\ndamping = { contact = 0.3 }\n" + solver, "t.toml", {});
  EXPECT_TRUE(model.ok()) << to_string(model.faults()[0]);
  Result<Simulation> made = Simulation::create(std::move(model.value()));
  EXPECT_TRUE(made.ok());
  return std::move(made.value());
}

TEST(MassScaling, HeavierPebblesSlowTheContactsOfWhatStandsOnThem) {
  const double step = 10.0 * on_pebbles("").control.limit;
  const Simulation sim = on_pebbles(scaled_to(step));
  EXPECT_GE(sim.control.limit, step * (1.0 - 1e-6));
  ASSERT_EQ(sim.motion.masses.raised.size(), 4u);
  EXPECT_GT(sim.motion.masses.raised[2], 50.0);
  EXPECT_GT(sim.motion.masses.raised[1], 1.0);
}

TEST(MassScaling, LeavesTheEquilibriumAsItIs) {
  const double step = 5.0 * free_step();

  for (const std::string& solver : {std::string(), scaled_to(step)}) {
    Simulation sim = pebble(solver + "damping = { local = 0.8 }\n");
    start(sim, 0.03);
    while (sim.motion.state.time < 0.03) ASSERT_FALSE(edda::step(sim));
    double on_floor = 0.0, on_cube = 0.0;
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
      const double n = normal_force(face_row(sim, k));
      const Id low = std::min(block_of_edge(sim.scene->blocks, sim.motion.contacts, k),
                              block_of_facing(sim.scene->blocks, sim.motion.contacts, k));
      (low == 0 ? on_floor : on_cube) += n;
    }
    EXPECT_NEAR(on_cube, 2600 * 0.05 * 0.05 * 9.81, 1e-3 * on_cube) << solver;
    EXPECT_NEAR(on_floor, 2600 * (1.0 + 0.05 * 0.05) * 9.81, 1e-3 * on_floor) << solver;
  }
}

TEST(MassScaling, InMotionKeepsMomentumAndTheEnergyBalance) {
  Simulation sim = pebble("", 0.3);
  start(sim, 1.0);
  const double before_start = account_energy(sim).error;
  for (int n = 0; n < 3000; ++n) ASSERT_FALSE(step(sim));
  auto momentum = [&] {
    Vec2 sum;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += sim.motion.masses.node[k][2] *
             Vec2{sim.motion.state.velocity.x[k][2], sim.motion.state.velocity.y[k][2]};
    }
    return sum;
  };
  const Vec2 p = momentum();
  ASSERT_LT(p.y, 0.0);
  const double error = account_energy(sim).error, kinetic = account_energy(sim).kinetic;
  sim.scene.edit().model.solver.mass_scaling = 5.0 * free_step();
  change_damping(sim, sim.motion.damping, true);
  ASSERT_EQ(sim.motion.masses.raised.size(), 3u);
  EXPECT_GT(sim.motion.masses.raised[2], 20.0);
  EXPECT_NEAR(norm(momentum() - p), 0.0, 1e-12 * norm(p));
  EXPECT_LT(account_energy(sim).kinetic, 0.2 * kinetic);
  EXPECT_NEAR(account_energy(sim).error, error, 1e-10);
  fit_step_to(sim, 1.0);
  while (sim.motion.state.time < 1.0) ASSERT_FALSE(step(sim));
  EXPECT_NEAR(account_energy(sim).error, before_start, 1e-5);
}

}  // namespace
}  // namespace edda::mass_scaling_test
