// Runs that must stop and report where and why.
#include <gtest/gtest.h>

#include "model/read_model.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"

namespace edda::divergence_test {
namespace {

std::optional<Failure> run_until_failure(const std::string& toml, double duration) {
  Result<Model> model = read_model_text(toml, "t.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  Result<Simulation> made = Simulation::create(std::move(model.value()));
  if (!made.ok()) ADD_FAILURE() << to_string(made.faults()[0]);
  Simulation& sim = made.value();
  start(sim, duration);
  fit_step_to(sim, duration);
  while (sim.motion.state.time < duration) {
    if (auto failure = step(sim)) return failure;
  }
  return std::nullopt;
}

const std::string base =
    "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\nfriction_angle = "
    "30\n"
    "[[block]]\nname = 'base'\nfixed = true\npolygon = [[-3,-1],[4,-1],[4,0],[-3,0]]\n"
    "[[block]]\nname = 'stone'\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n";

TEST(Divergence, LostShapeIsNamed) {
  const std::string soft =
      "[materials.mud]\ndensity = 2600\nyoung = 1e3\npoisson = 0.2\n[joints.j]\nfriction_angle = "
      "30\n"
      "[[block]]\nfixed = true\npolygon = [[-3,-1],[4,-1],[4,0],[-3,0]]\n"
      "[[block]]\nname = 'pudding'\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n"
      "[contact]\nnormal_stiffness = 1e7\n[solver]\nduration = 5\n";
  const auto failure = run_until_failure(soft, 5);
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->message.find("block 1 (pudding) has lost its shape"), std::string::npos)
      << failure->message;
  EXPECT_EQ(failure->block, 1u);
  EXPECT_GT(failure->time, 0.0);
}

TEST(Divergence, SoftContactsLetBlocksThrough) {
  const auto failure = run_until_failure(
      base + "velocity = [0, -20]\n[contact]\nnormal_stiffness = 1e5\n[solver]\nduration = 2\n", 2);
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->message.find("block 1 (stone) is"), std::string::npos) << failure->message;
  EXPECT_NE(failure->message.find("too soft"), std::string::npos);
  EXPECT_NEAR(failure->place.y, -0.5, 0.2);
}

TEST(Divergence, SoundRunsAreLeftAlone) {
  EXPECT_FALSE(run_until_failure(base + "[solver]\nduration = 0.2\n", 0.2).has_value());
}

}  // namespace
}  // namespace edda::divergence_test
