// The proof that blocks have no equilibrium: what it proves, and what it leaves to the trial.
#include "study/certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "run/prepared.hpp"
#include "run/run_model.hpp"
#include "step/tile_step.hpp"
#include "study/sliding_block.hpp"

namespace edda::certificate_test {
namespace {

using testing::exact;
using testing::found;
using testing::model_of;
using testing::ramp;
using testing::rough;

Simulation drawn(const std::string& toml) {
  Result<PreparedRun> run = prepare_run(model_of(toml));
  if (!run.ok()) ADD_FAILURE() << to_string(run.faults()[0]);
  return std::move(run.value().sim);
}

bool fails(const Simulation& sim, double factor, double allowed = 0.01, double least_area = 0.0) {
  const std::vector<double> divided_by(sim.motion.laws.rows.size(), factor);
  return without_equilibrium(sim, divided_by, allowed, least_area).has_value();
}

TEST(Certificate, IsThatOfTheFactorOnASlope) {
  const Simulation sim = drawn(ramp(rough));
  EXPECT_FALSE(fails(sim, 0.999 * exact));
  EXPECT_TRUE(fails(sim, 1.001 * exact));
  EXPECT_TRUE(fails(sim, 1.001 * exact, 0.1));
  EXPECT_TRUE(fails(sim, 1.001 * exact, 0.01, 1.9));
  EXPECT_FALSE(fails(sim, 1.001 * exact, 0.01, 2.1)) << "smaller than least_area";
}

TEST(Certificate, LeavesOutWhatHasComeLoose) {
  Simulation sim = drawn(ramp(rough));
  sim.relaxation.loose.assign(sim.scene->blocks.size(), 0);
  sim.relaxation.loose[1] = 1;
  EXPECT_FALSE(fails(sim, 2.0 * exact));
}

/// All joints are pressed, and their bonds broken.
void close_all(Simulation& sim) {
  change_faces(sim, [](FaceSet& faces, FaceStates& states) {
    for (std::size_t k = 0; k < faces.size(); ++k) faces.set_bond(BondState::unbonded, k);
    for (FaceFields& m : states.now) m.energy = 1.0;
  });
}

/// With cohesion of 4 kPa the factor is higher, until the bonds have broken.
TEST(Certificate, TakesBondsAsTheyAre) {
  Simulation sim = drawn(ramp(rough + "cohesion = 4e3\n"));
  const double weight = 2500.0 * 9.81 * 2.0;
  const double bonded = exact + 4e3 * 2.0 / (weight * 0.5);
  EXPECT_FALSE(fails(sim, 0.99 * bonded));
  EXPECT_TRUE(fails(sim, 1.01 * bonded));
  close_all(sim);
  EXPECT_FALSE(fails(sim, 0.999 * exact));
  EXPECT_TRUE(fails(sim, 1.01 * exact));
}

/// A block that would slide against a stop: 0.5 % of its size before it a trial that allows 1 % may
/// close the gap; a gap of 2 % it may not.
TEST(Certificate, CountsGapsThatMayClose) {
  const auto with_stop = [](double gap) {
    return ramp(rough, testing::on_ramp(2 + gap, 3 + gap, 0, 1, "fixed = true"));
  };
  const double size = std::sqrt(2.0);
  EXPECT_FALSE(fails(drawn(with_stop(0.005 * size)), 2.0 * exact));
  EXPECT_TRUE(fails(drawn(with_stop(0.02 * size)), 2.0 * exact));
  EXPECT_FALSE(fails(drawn(with_stop(0.02 * size)), 2.0 * exact, 0.1));
}

/// A toe at the foot of a wall that leans away from the block by eleven degrees is stopped there.
TEST(Certificate, CountsCornersAtTheEndsOfEdges) {
  const Simulation sim = drawn(
      "gravity = [8, -9.81]\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 30\n[solver]\nduration = 1\n[[block]]\nfixed = true\n"
      "polygon = [[-3, -1], [4, -1], [4, 2], [1.4, 2], [1, 0], [-3, 0]]\n[[block]]\n"
      "polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n");
  EXPECT_FALSE(fails(sim, 1.0));
}

/// Joints that are pressed together by more than a hundredth of the block's size are closed.
TEST(Certificate, CountsDeepClosures) {
  Simulation sim = drawn(ramp(rough + "kn = 1e6\nks = 1e6\n"));
  State& state = sim.motion.state;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    state.position.x[k][1] -= 0.02 * 0.5;
    state.position.y[k][1] -= 0.02 * std::sqrt(0.75);
  }
  place_vertices(sim.scene->blocks, state.position, 1, sim.motion.pose.x, sim.motion.pose.y);
  close_all(sim);
  EXPECT_FALSE(fails(sim, 0.9 * exact));
}

/// Dashpots that have taken over carry what was there; they are no reason to fail.
TEST(Certificate, LeavesBlocksOnDashpotsWhereTheyAre) {
  const std::string slabs =
      "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\npolygon = [[0, 0], [10, 0], [10, 2], [0, 2]]\n[[block]]\n"
      "polygon = [[0, 2], [10, 2], [10, 4], [0, 4]]\n[[boundary]]\nname = 'static'\n"
      "along = [[0, 0], [10, 0]]\ntype = 'fixed'\n[[boundary]]\nname = 'far'\n"
      "along = [[0, 0], [10, 0]]\ntype = 'viscous'\n[[stage]]\nuntil = 'equilibrium'\n"
      "deactivate = ['far']\n[[stage]]\nduration = 0.05\nactivate = ['far']\n"
      "deactivate = ['static']\n";
  Result<PreparedRun> run = prepare_run(model_of(slabs));
  ASSERT_TRUE(run.ok());
  ASSERT_TRUE(run_model(run.value(), {}).ok());
  ASSERT_FALSE(run.value().sim.attached.dashpots.damped.empty());
  EXPECT_FALSE(fails(run.value().sim, 1.0));
}

/// The factor is the same where each trial is followed to its end.
TEST(Certificate, GivesTheFactorOfTrialsThatAreFollowed) {
  const FosResult proven = found(ramp(rough)),
                  followed = found(ramp(rough, "[fos]\nrigid_proof = false\n"));
  ASSERT_TRUE(proven.factor && followed.factor);
  EXPECT_EQ(*proven.factor, *followed.factor);
  const auto proofs = [](const FosResult& r) {
    return std::count_if(r.trials.begin(), r.trials.end(),
                         [](const Trial& t) { return t.proof.has_value(); });
  };
  EXPECT_GT(proofs(proven), 0);
  EXPECT_EQ(proofs(followed), 0);
}

}  // namespace
}  // namespace edda::certificate_test
