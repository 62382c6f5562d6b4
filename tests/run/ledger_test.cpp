// The ledger between two steps, whatever the next one will be.
#include <gtest/gtest.h>

#include "model/read_model.hpp"
#include "run/simulation.hpp"

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

}  // namespace
}  // namespace edda::ledger_test
