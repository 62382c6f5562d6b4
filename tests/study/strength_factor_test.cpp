// The factor that divides the strength of joints: of a stage, and in a checkpoint.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "checkpoint/record.hpp"
#include "run/prepared.hpp"
#include "run/simulation_memory.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"
#include "study/sliding_block.hpp"

namespace edda::strength_factor_test {
namespace {

using testing::exact;
using testing::number;
using testing::prepared;
using testing::ramp;
using testing::rough;

/// Factor of a stage: a block that sticks at a factor below its limit slides at one above it, with
/// both methods.
TEST(StrengthFactor, ActsFromTheStartOfItsStage) {
  for (const std::string method : {"edda", "dda"}) {
    for (const auto& [factor, status] :
         {std::pair{0.95 * exact, Status::equilibrium}, {1.05 * exact, Status::completed}}) {
      std::string text = ramp(rough);
      text.replace(text.find("duration = 0.5\n"), 15, "method = '" + method + "'\n");
      PreparedRun run =
          prepared(text +
                   "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\nduration = "
                   "0.5\nratio = 1e-4\nstrength_factor = " +
                   number(factor) + "\n");
      const Result<Outcome> o = run_model(run, {});
      ASSERT_TRUE(o.ok());
      EXPECT_EQ(o.value().status, status) << method << ' ' << factor << o.value().message;
      EXPECT_EQ(run.sim.motion.laws.divided_by[0], std::stod(number(factor)));
    }
  }
}

/// Cohesion and tensile strength are divided, too, and are restored when the factor returns to 1.
TEST(StrengthFactor, DividesAllStrength) {
  PreparedRun run =
      prepared(ramp("friction_angle = 40\ncohesion = 1e5\ntensile_strength = 2e4\nresidual = { "
                    "friction_angle = 30 }\n"));
  Simulation& sim = run.sim;
  const FaceSet before = sim.motion.contacts;
  const Law law = sim.motion.laws.rows[0];
  set_strength_factor(sim, 2.0);
  EXPECT_EQ(sim.motion.laws.rows[0].peak_friction, law.peak_friction / 2.0);
  EXPECT_EQ(sim.motion.laws.rows[0].residual_friction, law.residual_friction / 2.0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(sim.motion.contacts.friction[k], before.friction[k] / 2.0);
    EXPECT_EQ(sim.motion.contacts.cohesion[k], before.cohesion[k] / 2.0);
    EXPECT_EQ(sim.motion.contacts.tension[k], before.tension[k] / 2.0);
  }
  set_strength_factor(sim, 1.0);
  EXPECT_EQ(sim.motion.contacts.friction.values(), before.friction.values());
  EXPECT_EQ(sim.motion.laws.rows[0].peak_tension, law.peak_tension);
}

/// The factor in force, and the accumulated slip of joint laws.
TEST(StrengthFactor, LivesInACheckpoint) {
  for (const std::string law :
       {"friction_angle = 45\n", "friction_angle = 45\ndilation_angle = 3\n",
        "type = 'slip-weakening'\nfriction_angle = 45\nresidual = { friction_angle = 30 }\n"
        "slip_distance = 0.05\n",
        "type = 'barton-bandis'\njrc = 5\njcs = 1e7\nresidual_angle = 25\n"}) {
    const std::string text = ramp(law);
    PreparedRun run = prepared(text), other = prepared(text);
    Simulation &a = run.sim, &b = other.sim;
    start(a, 0.5);
    set_strength_factor(a, 1.8);
    for (int k = 0; k < 300; ++k) ASSERT_FALSE(step(a));
    Record record;
    remember(a, record);
    start(b, 0.5);
    ASSERT_EQ(recall(b, record), "");
    EXPECT_EQ(b.motion.laws.rows[0].residual_friction, a.motion.laws.rows[0].residual_friction);
    EXPECT_EQ(b.motion.contacts.slip_so_far.values(), a.motion.contacts.slip_so_far.values());
    for (int k = 0; k < 300; ++k) ASSERT_FALSE(step(a) || step(b));
    EXPECT_EQ(a.motion.state.position.x, b.motion.state.position.x) << law;
    EXPECT_EQ(a.motion.state.velocity.y, b.motion.state.velocity.y) << law;
  }
}

}  // namespace
}  // namespace edda::strength_factor_test
