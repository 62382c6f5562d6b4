// Ramps: the exact collapse load of a block, whatever its stiffness; displaced supports; body
// forces; how a ramp ends; and that it resumes to the same bits.
#include "run/ramp.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "results/files.hpp"
#include "results/read_table.hpp"
#include "run/prepared.hpp"
#include "scratch_folder.hpp"

namespace edda::ramp_test {
namespace {

using testing::prepared;
using testing::Ran;
using testing::ran;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double density = 2500.0, g = 9.81, friction = 30.0;
constexpr double weight = density * g * 1.0 * 0.5;

/// A block of 1 x 0.5 m on a floor that slopes down to the right.
std::string block_on_floor(const std::string& more, double slope = 0.0, double young = 1e9) {
  const double c = std::cos(slope * degree), s = std::sin(slope * degree);
  const auto p = [&](double u, double v) {
    return fmt::format("[{:.17g}, {:.17g}]", u * c + v * s, v * c - u * s);
  };
  return fmt::format(
             "[materials.stone]\ndensity = {}\nyoung = {}\npoisson = 0.2\n[joints.dry]\n"
             "friction_angle = {}\n[[block]]\nfixed = true\npolygon = [{}, {}, {}, {}]\n"
             "[[block]]\nname = 'block'\npolygon = [{}, {}, {}, {}]\n",
             density, young, friction, p(-2, -1), p(3, -1), p(3, 0), p(-2, 0), p(0, 0), p(1, 0),
             p(1, 0.5), p(0, 0.5)) +
         more;
}

std::string stages_with(const std::string& ramp, const std::string& until = "collapse") {
  return "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nname = 'ramp'\nuntil = '" + until +
         "'\nramp = { " + ramp + " }\n";
}

struct Known {
  const char* what;
  const char* ramp;
  double increment, exact;
  double slope = 0.0;
  const char* more = "";
};

class CollapseOfABlock : public ::testing::TestWithParam<Known> {};

/// The increment that fails is the first beyond the exact value, in blocks of any stiffness, and
/// the energy balance closes.
TEST_P(CollapseOfABlock, IsFoundToTheIncrement) {
  const Known& k = GetParam();
  for (const double young : {1e10, 1e9, 1e8}) {
    const Ran r = ran(block_on_floor(k.more + stages_with(k.ramp), k.slope, young));
    ASSERT_EQ(r.outcome.ramps.size(), 1u);
    const RampOutcome& found = r.outcome.ramps[0];
    EXPECT_EQ(r.outcome.status, Status::completed) << r.outcome.message;
    ASSERT_TRUE(found.holds && found.fails) << r.outcome.message;
    EXPECT_NEAR(*found.fails - *found.holds, k.increment, 1e-12);
    EXPECT_LT(*found.holds / k.exact, 1.0 + 1e-3) << k.what << young;
    EXPECT_GT(*found.fails / k.exact, 1.0 - 1e-3) << k.what << young;
    EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ramp, CollapseOfABlock,
    ::testing::Values(
        Known{"tilt", "tilt = [0, 40], steps = 80", 0.5, 30.0},
        Known{"to the left", "kh = [0, -0.8], steps = 80", -0.01, -std::tan(friction* degree)},
        Known{"kh", "kh = [0, 0.8], steps = 80", 0.01, std::tan(friction* degree)},
        Known{"kv", "kv = [0.5, 1.5], steps = 100", 0.01, 1.0},
        Known{"strength", "strength = [1, 3], steps = 100", 0.02,
              std::tan(friction* degree) / std::tan(20.0 * degree), 20.0},
        Known{"push", "'load:push' = [0, 2], steps = 100", 0.02,
              weight* std::tan(friction* degree) / 1e4, 0.0,
              "[[load]]\nname = 'push'\npoint = [0.1, 0.1]\nforce = [1e4, 0]\n"},
        Known{"body force", "'load:wind' = [0, 2], steps = 100", 0.02,
              weight* std::tan(friction* degree) / (0.5 * 2e4), 0.0,
              "[[load]]\nname = 'wind'\nwithin = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
              "body_force = [2e4, 0]\n"},
        Known{"uplift", "'water:flood' = [0, 4], steps = 100", 0.04, weight / (9810.0 * 0.5), 0.0,
              "[[water]]\nname = 'flood'\ntable = [[-3, 0.5], [4, 0.5]]\n"}),
    [](const auto& test) {
      std::string name = test.param.what;
      std::erase(name, ' ');
      return name;
    });

/// A bar of 1 x 2 m between a fixed support and one that is displaced: its stiffness in series with
/// those of the springs at its ends.
TEST(Ramp, DisplacedSupportStretchesABar) {
  constexpr double young = 1e9, spring = 4e9, displaced = 2e-3;
  const std::string bar = fmt::format(
      "gravity = [0, 0]\n[materials.stone]\ndensity = 2500\nyoung = {}\npoisson = 0\n[joints.dry]\n"
      "friction_angle = 30\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 2], [0, 2]]\n[[boundary]]\n"
      "sides = ['bottom']\nstiffness = {}\n[[boundary]]\nname = 'top'\nsides = ['top']\n"
      "type = 'displacement'\ndisplacement = [0, {}]\nstiffness = {}\n[[monitor]]\nname = 'end'\n"
      "point = [0.5, 2]\n",
      young, spring, displaced, spring);
  const double stiffness = 1.0 / (2.0 / young + 2.0 / (2.0 * spring));
  const ScratchFolder folder;
  RunOptions options;
  options.folder = folder.path().string();
  PreparedRun run =
      prepared(bar + "[[stage]]\nname = 'pull'\nramp = { 'boundary:top' = [0, 1], steps = 4 }\n");
  const Result<Outcome> outcome = run_model(run, options);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().status, Status::equilibrium) << outcome.value().message;
  EXPECT_LT(outcome.value().largest_energy_error, 2e-6);
  const Result<Table> curve = read_table(options.folder + "/curve.csv");
  ASSERT_TRUE(curve.ok());
  ASSERT_EQ(curve.value().rows(), 5u);
  for (std::size_t r = 0; r < 5; ++r) {
    const double value = 0.25 * static_cast<double>(r);
    const auto at = [&](const char* name) { return curve.value().column(name)->values[r]; };
    EXPECT_EQ(at("value"), value);
    EXPECT_EQ(at("holds"), 1.0);
    const double force = stiffness * displaced * value;
    EXPECT_NEAR(at("fy"), force, 1e-3 * stiffness * displaced);
    EXPECT_NEAR(at("end.uy"), displaced * value - force / (2.0 * spring), 1e-3 * displaced);
  }
  // Without a ramp the whole displacement is applied in the first stage.
  const Ran whole = ran(bar + "[[stage]]\nuntil = 'equilibrium'\n");
  EXPECT_NEAR(whole.moved("").y, 0.5 * displaced, 1e-3 * displaced);
}

/// With a body force of density times gravity a block rests as under its weight.
TEST(Ramp, BodyForceIsLikeWeight) {
  const std::string rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n";
  const Ran heavy = ran(block_on_floor(rest));
  const Ran pressed =
      ran("gravity = [0, 0]\n" +
          block_on_floor(fmt::format("[[load]]\nwithin = [[0, 0], [0, 1], [1, 1], [1, 0]]\n"
                                     "body_force = [0, {}]\n",
                                     -density * g) +
                         rest));
  const Vec2 under_weight = heavy.moved("block"), under_force = pressed.moved("block");
  EXPECT_LT(under_weight.y, 0.0);
  EXPECT_NEAR(under_force.y, under_weight.y, 1e-4 * std::abs(under_weight.y));
}

/// What a ramp has reached remains in later stages; before it, a load has the multiplier with which
/// its ramp begins.
TEST(Ramp, ValueRemains) {
  const std::string after = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-6\n";
  const auto shear = [](const Ran& r) {
    const Simulation& s = r.ready.sim;
    const LoadsNow now = loads_at(s.scene->model, s.attached.loads, s.motion.state.time);
    Vec2 sum;
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      if (!is_free(s.scene->blocks, s.motion.state, i)) continue;
      sum += load_on(s.scene->blocks, now, s.motion.pose, i) -
             s.scene->blocks.mass[i] * now.gravity_reduction();
    }
    return sum.x;
  };
  const Ran kh =
      ran(block_on_floor(stages_with("kh = [0, 0.2], steps = 2", "equilibrium") + after));
  EXPECT_EQ(kh.outcome.status, Status::equilibrium) << kh.outcome.message;
  EXPECT_NEAR(shear(kh), 0.2 * weight, 1e-9 * weight);
  const std::string push = "[[load]]\nname = 'push'\npoint = [0.1, 0.1]\nforce = [1e3, 0]\n";
  const Ran pushed = ran(block_on_floor(
      push + stages_with("'load:push' = [0.5, 2], steps = 2", "equilibrium") + after));
  EXPECT_NEAR(shear(pushed), 2e3, 1e-6);
  PreparedRun before = prepared(
      block_on_floor(push + stages_with("'load:push' = [0.5, 2], steps = 2", "equilibrium")));
  RunOptions first;
  first.last_stage = 0;
  ASSERT_TRUE(run_model(before, first).ok());
  EXPECT_NEAR(shear({std::move(before), {}}), 0.5e3, 1e-6);
}

/// A block that loses its contacts has failed, whatever stays in equilibrium beside it.
TEST(Ramp, ABlockThatIsLiftedHasFailed) {
  const std::string beside = "[[block]]\npolygon = [[1.5, 0], [2.5, 0], [2.5, 0.5], [1.5, 0.5]]\n";
  const Ran r =
      ran(block_on_floor(beside + "[[load]]\nname = 'up'\npoint = [0.5, 0.5]\nforce = [0, 1e4]\n" +
                         stages_with("'load:up' = [0, 3], steps = 100")));
  ASSERT_TRUE(r.outcome.ramps[0].fails) << r.outcome.message;
  EXPECT_NEAR(*r.outcome.ramps[0].fails, weight / 1e4, 0.031);
  EXPECT_LE(*r.outcome.ramps[0].holds, weight / 1e4);
  EXPECT_NE(r.outcome.message.find("(block)"), std::string::npos) << r.outcome.message;
}

/// Blocks ride on a support that is displaced as a whole, however far and in however few
/// increments.
TEST(Ramp, AWallRidesOnItsSupport) {
  const auto wall = [](const char* displacement, const char* steps) {
    return std::string(
               "[materials.brick]\ndensity = 2000\nyoung = 1e9\npoisson = 0.2\n[joints.dry]\n"
               "friction_angle = 35\n[[block]]\nname = 'base'\n"
               "polygon = [[-0.4, -0.2], [1.6, -0.2], [1.6, 0], [-0.4, 0]]\n[[brick_wall]]\n"
               "columns = 3\nrows = 3\nbrick = [0.4, 0.2]\n[[boundary]]\nname = 'support'\n"
               "along = [[-0.4, -0.2], [1.6, -0.2]]\ntype = 'displacement'\ndisplacement = ") +
           displacement +
           "\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\n"
           "ramp = { 'boundary:support' = [0, 1], steps = " +
           steps + " }\n";
  };
  for (const char* displacement : {"[0, -0.005]", "[0, 0.005]", "[0.005, 0]"}) {
    for (const char* steps : {"1", "40"}) {
      const Ran r = ran(wall(displacement, steps));
      EXPECT_EQ(r.outcome.status, Status::equilibrium) << displacement << r.outcome.message;
      EXPECT_TRUE(r.outcome.failed_checks.empty()) << r.outcome.failed_checks.front();
      EXPECT_NEAR(norm(r.moved("base")), 0.005, 3e-5);
      const Simulation& s = r.ready.sim;
      for (std::size_t i = 0; i < s.scene->blocks.size(); ++i)
        EXPECT_NEAR(norm(displacement_of(s.motion.state, i, centroid_weights)), 0.005, 5e-5) << i;
    }
  }
}

/// A support that is displaced where another gives way, and one in stressed ground, moves
/// gradually.
TEST(Ramp, DisplacementsBeginGradually) {
  const std::string ground =
      "[materials.stone]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.dry]\n"
      "friction_angle = 30\n[[block]]\nname = 'b'\npolygon = [[0, 0], [1, 0], [1, 2], [0, 2]]\n";
  const std::string moves =
      "[[boundary]]\nname = 'moves'\nalong = [[0, 0], [1, 0]]\ntype = 'displacement'\n"
      "displacement = [0, -0.01]\n";
  const std::string taken_over =
      ground + moves +
      "[[boundary]]\nname = 'first'\nalong = [[0, 0], [1, 0]]\n[[stage]]\n"
      "until = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\ndeactivate = ['first']\n"
      "activate = ['moves']\n";
  const std::string stressed = ground + moves +
                               "[initial_stress]\nk0 = 0.3\nsurface_y = 2\n[[stage]]\n"
                               "until = 'equilibrium'\n";
  for (const std::string& text : {taken_over, stressed}) {
    PreparedRun run = prepared(text);
    double most = 0.0;
    RunOptions options;
    options.after_step = [&] {
      const BoundarySprings& s = run.sim.attached.springs;
      Vec2 sum;
      for (std::size_t q = 0; q < s.size(); ++q)
        sum += spring_force(s, q, run.sim.motion.pose.x, run.sim.motion.pose.y);
      most = std::max(most, norm(sum));
      return false;
    };
    const Result<Outcome> outcome = run_model(run, options);
    ASSERT_TRUE(outcome.ok());
    EXPECT_EQ(outcome.value().status, Status::equilibrium) << outcome.value().message;
    EXPECT_LT(most, 2.5 * density * g * 2.0);
    EXPECT_NEAR(centroid(run.sim.motion.state.position, 0).y - run.sim.scene->blocks.centroid_y[0],
                -0.01, 2e-4);
  }
}

/// What a failed increment has reached acts in the next stage, and no more.
TEST(Ramp, AFailureOnTheWayKeepsWhatActs) {
  std::string soft =
      block_on_floor(stages_with("kv = [0, 30], steps = 1") + "[[stage]]\nduration = 0.01\n");
  const std::string friction_of_joint = fmt::format("friction_angle = {}\n", friction);
  soft.insert(soft.find(friction_of_joint), "kn = 1e6\nks = 1e6\n");
  const Ran r = ran(soft);
  const SlowLoading& slow = r.ready.sim.attached.loads.slow;
  EXPECT_TRUE(gradual_change_complete(r.ready.sim));
  EXPECT_GT(slow.kv.value, 1.0);
  EXPECT_LT(slow.kv.value, 29.0);
}

/// Blocks that are loose at the first value are named, or end the run.
TEST(Ramp, LooseBlocksAreNamedOrEndTheRun) {
  const std::string loose =
      "[joints.smooth]\nfriction_angle = 2\n[contact]\njoint = 'dry'\n[[block]]\n"
      "name = 'loose'\njoint = 'smooth'\n"
      "polygon = [[1.5, 0], [2.5, 0], [2.5, 0.5], [1.5, 0.5]]\n";
  const Ran named = ran(block_on_floor(loose + stages_with("kh = [0.1, 0.9], steps = 8")));
  EXPECT_NE(named.outcome.message.find("fails at kh = 0.6"), std::string::npos)
      << named.outcome.message;
  EXPECT_NE(named.outcome.message.find("come loose"), std::string::npos) << named.outcome.message;
  const Ran stopped = ran(
      block_on_floor(loose + stages_with("kh = [0.1, 0.9], steps = 8") + "otherwise = 'stop'\n"));
  EXPECT_EQ(stopped.outcome.status, Status::collapsed);
  EXPECT_NE(stopped.outcome.message.find("otherwise"), std::string::npos)
      << stopped.outcome.message;
}

/// A ramp that is added behind a stage begins as if it had been there.
TEST(Ramp, BeginsWhereItDoesAfterAStageOfAnotherModel) {
  const std::string first = block_on_floor(
      "[[load]]\nname = 'push'\npoint = [0.1, 0.1]\nforce = [5e3, 0]\n"
      "[[stage]]\nuntil = 'equilibrium'\n");
  const ScratchFolder folder;
  RunOptions options;
  options.folder = folder.path().string();
  PreparedRun before = prepared(first);
  ASSERT_TRUE(run_model(before, options).ok());
  PreparedRun after =
      prepared(first +
               "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\n"
               "ramp = { 'load:push' = [0, 1], steps = 2 }\n");
  options.from_stage = 0;
  options.last_stage = 1;
  const Result<Outcome> outcome = run_model(after, options);
  ASSERT_TRUE(outcome.ok()) << to_string(outcome.faults()[0]);
  EXPECT_EQ(after.sim.attached.loads.slow.loads[0].value, 0.0);
}

TEST(Ramp, HowItEnds) {
  const Ran held = ran(block_on_floor(stages_with("kh = [0, 0.3], steps = 3", "equilibrium")));
  EXPECT_EQ(held.outcome.status, Status::equilibrium);
  EXPECT_TRUE(held.outcome.failed_checks.empty());
  EXPECT_EQ(held.outcome.ramps[0].holds, 0.3);
  EXPECT_FALSE(held.outcome.ramps[0].fails);
  const Ran failed = ran(block_on_floor(stages_with("kh = [0, 0.9], steps = 3", "equilibrium")));
  EXPECT_EQ(failed.outcome.status, Status::collapsed);
  EXPECT_NE(failed.outcome.message.find("holds at kh = 0.3 and fails at kh = 0.6"),
            std::string::npos)
      << failed.outcome.message;
  const Ran no_collapse = ran(block_on_floor(stages_with("kh = [0, 0.3], steps = 3")));
  EXPECT_EQ(no_collapse.outcome.status, Status::equilibrium);
  EXPECT_NE(no_collapse.outcome.message.find("does not collapse"), std::string::npos);
  EXPECT_EQ(no_collapse.outcome.failed_checks.size(), 1u);
}

/// So do stages where there was none; the check fails.
TEST(Ramp, StagesGoOnWithoutACollapse) {
  const Ran r =
      ran(block_on_floor(stages_with("kh = [0, 0.3], steps = 3") + "[[stage]]\nduration = 0.01\n"));
  EXPECT_EQ(r.outcome.status, Status::completed) << r.outcome.message;
  EXPECT_EQ(r.outcome.failed_checks.size(), 1u);
}

/// After a collapse the next stage shows where the blocks go.
TEST(Ramp, StagesGoOnAfterACollapse) {
  const Ran r =
      ran(block_on_floor(stages_with("kh = [0, 0.9], steps = 3") + "[[stage]]\nduration = 0.3\n"));
  EXPECT_EQ(r.outcome.status, Status::completed) << r.outcome.message;
  // kh 0.6 less friction 0.577, over half of 0.3 s squared
  const double slides = 0.5 * (0.6 - std::tan(friction * degree)) * g * 0.09;
  EXPECT_GT(r.moved("block").x, 0.5 * slides);
}

void expect_same_bits(const std::string& model) {
  const ScratchFolder whole, broken;
  RunOptions options;
  options.folder = whole.path().string();
  PreparedRun first = prepared(model);
  const Result<Outcome> outcome = run_model(first, options);
  ASSERT_TRUE(outcome.ok());
  const std::uint64_t steps = outcome.value().steps;
  // In an early increment, and in the one that fails.
  for (const std::uint64_t at :
       {std::min(std::uint64_t{1500}, steps / 4), steps / 2, steps - 100}) {
    options = {};
    options.folder = broken.path().string();
    std::filesystem::remove_all(broken.path());
    std::atomic<bool> stop{false};
    PreparedRun halted = prepared(model);
    options.stop = &stop;
    options.after_step = [&] {
      if (halted.sim.motion.state.steps >= at) stop = true;
      return false;
    };
    const Result<Outcome> half = run_model(halted, options);
    ASSERT_TRUE(half.ok());
    ASSERT_EQ(half.value().status, Status::interrupted);
    options.stop = nullptr;
    options.after_step = nullptr;
    options.resume = true;
    PreparedRun again = prepared(model);
    const Result<Outcome> resumed = run_model(again, options);
    ASSERT_TRUE(resumed.ok()) << to_string(resumed.faults()[0]);
    EXPECT_EQ(resumed.value().steps, steps);
    EXPECT_EQ(resumed.value().message, outcome.value().message);
    for (const char* file : {"/curve.csv", "/history.csv", "/blocks.csv", "/stages.csv"}) {
      const auto text = [&](const ScratchFolder& folder) {
        return read_file(folder.path().string() + file).value();
      };
      EXPECT_EQ(text(whole), text(broken)) << file << at;
    }
  }
}

const std::string top = "[[monitor]]\nname = 'top'\npoint = [0.5, 0.4]\n";

TEST(Ramp, ResumesToTheSameBits) {
  expect_same_bits(block_on_floor(top + stages_with("tilt = [10, 40], steps = 30")));
}

/// Laws that change with the ramp, strength and stiffness, and that lose strength with time.
const std::string
    worn = "kn = 1e9\nks = 4e8\ndecay_time = '10 d'\nresidual = { friction_angle = 5 }\n",
    change = "change = [{ joints = 'dry', to = 'worn' }]\n";
std::string of_laws(const std::string& stages) {
  std::string model =
      block_on_floor("[[monitor]]\nname = 'low'\npoint = [0.5, 0.1]\n" + stages, 20.0);
  model.insert(model.find("[[block]]"),
               worn + "[joints.worn]\nfriction_angle = 25\n" + worn + "[contact]\njoint = 'dry'\n");
  model.replace(model.rfind("kn = 1e9"), 8, "kn = 3e8");
  return model;
}

TEST(Ramp, OfLawsResumesToTheSameBits) {
  expect_same_bits(of_laws(stages_with("time = ['0 d', '8 d'], steps = 16")));
  expect_same_bits(of_laws("[[stage]]\nuntil = 'equilibrium'\n[[stage]]\n" + change +
                           "ramp = { change = [0, 1], steps = 10 }\n[[stage]]\nduration = 0.05\n"));
}

/// From the end of a stage, with other changes to come.
TEST(Ramp, StagesAfterOneMayChangeOtherJoints) {
  const std::string first =
                        "[[stage]]\nname = 'rest'\nuntil = 'equilibrium'\n[[stage]]\nname = "
                        "'age'\n" +
                        change + "ramp = { change = [0, 0.5], steps = 2 }\n",
                    none = "[[stage]]\nduration = 0.01\n",
                    more =
                        "[[stage]]\nchange = [{ joints = 'worn', to = 'dry' }]\nramp = { change = "
                        "[0, 1], steps = 2 }\n" +
                        none;
  for (const bool adds : {true, false}) {
    const ScratchFolder folder;
    RunOptions options;
    options.folder = folder.path().string();
    PreparedRun before = prepared(of_laws(first + (adds ? none : more)));
    ASSERT_TRUE(run_model(before, options).ok());
    PreparedRun after = prepared(of_laws(first + (adds ? more : none)));
    options.from_stage = 1;
    const Result<Outcome> went_on = run_model(after, options);
    ASSERT_TRUE(went_on.ok()) << to_string(went_on.faults()[0]);
    const Ran at_once = ran(of_laws(first + (adds ? more : none)));
    const auto law_of = [](const Simulation& sim) {
      return sim.motion.laws.rows[sim.motion.contacts.law[0]];
    };
    const Law one = law_of(after.sim), other = law_of(at_once.ready.sim);
    EXPECT_NEAR(one.peak_friction / other.peak_friction, 1.0, 1e-7) << adds;
    EXPECT_EQ(one.kn, other.kn) << adds;
    EXPECT_EQ(one.kn, adds ? 1e9 : std::lerp(1e9, 3e8, 0.5));
    const Vec2 apart = centroid(after.sim.motion.state.position, 1) -
                       centroid(at_once.ready.sim.motion.state.position, 1);
    EXPECT_LT(norm(apart), 1e-8) << adds;
  }
}

}  // namespace
}  // namespace edda::ramp_test
