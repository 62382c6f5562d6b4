// The search for a factor of safety: what it finds, and that threads and interruptions change
// nothing else.
#include "run/fos.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checkpoint/record.hpp"
#include "model/read_model.hpp"
#include "run/prepared.hpp"
#include "run/simulation_memory.hpp"

namespace edda::fos_test {
namespace {

using testing::prepared;

std::string number(double v) {
  return std::to_string(v);
}

/// A block from u0 to u1 down a slope of 30 degrees and from v0 to v1 out of it, m.
std::string on_ramp(double u0, double u1, double v0, double v1, const std::string& keys) {
  const double c = std::cos(std::numbers::pi / 6.0), s = std::sin(std::numbers::pi / 6.0);
  const auto p = [&](double u, double v) {
    return "[" + number(u * c + v * s) + "," + number(v * c - u * s) + "]";
  };
  return "[[block]]\n" + keys + "\npolygon = [" + p(u0, v0) + "," + p(u1, v0) + "," + p(u1, v1) +
         "," + p(u0, v1) + "]\n";
}

/// A block of 2 x 1 m on a slope of 30 degrees, its joint with `law`.
std::string ramp(const std::string& law, const std::string& more = {},
                 const std::string& solver = "[solver]\nduration = 0.5\n") {
  return "[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.2\n[joints.j]\n" + law +
         solver + on_ramp(-4, 6, -1, 0, "fixed = true") + on_ramp(0, 2, 0, 1, "name = 'slider'") +
         more;
}

Model model_of(const std::string& toml) {
  Result<Model> model = read_model_text(toml, "m.toml", {}, ReadFor::no_run);
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  return model.value();
}

FosResult found(const std::string& toml, int threads = 1,
                std::vector<std::string>* said = nullptr) {
  FosOptions options;
  options.threads = threads;
  if (said != nullptr) options.say = [=](const std::string& line) { said->push_back(line); };
  Result<FosResult> r = find_factor(model_of(toml), options);
  if (!r.ok()) ADD_FAILURE() << to_string(r.faults()[0]);
  return std::move(r.value());
}

const double exact = std::tan(std::numbers::pi / 4.0) / std::tan(std::numbers::pi / 6.0);
const std::string rough = "friction_angle = 45\n", coarse = "[fos]\ntolerance = 0.05\n";

TEST(Fos, DoesNotDependOnThreads) {
  const FosResult one = found(ramp(rough, coarse));
  EXPECT_EQ(one.status, FosStatus::found);
  EXPECT_NEAR(*one.factor, exact, 0.05);
  const FosResult three = found(ramp(rough, coarse), 3);
  EXPECT_EQ(fos_csv(one.trials), fos_csv(three.trials));
  EXPECT_EQ(one.failed->state.x, three.failed->state.x);
  EXPECT_EQ(mechanism_csv(*one.failed, *one.mechanism),
            mechanism_csv(*three.failed, *three.mechanism));
}

/// What is said while it goes on is what counts in the end, in its order.
TEST(Fos, SaysTheTrialsThatCount) {
  for (const int threads : {1, 3}) {
    std::vector<std::string> said;
    FosOptions options;
    options.threads = threads;
    options.say = [&](const std::string& line) { said.push_back(line); };
    const Result<FosResult> r = find_factor(model_of(ramp(rough, coarse)), options);
    ASSERT_TRUE(r.ok());
    const std::vector<Trial>& trials = r.value().trials;
    ASSERT_EQ(said.size(), trials.size()) << threads;
    for (std::size_t k = 0; k < said.size(); ++k)
      EXPECT_TRUE(said[k].starts_with(fmt::format("factor {:.6g} ", trials[k].factor))) << said[k];
  }
}

/// Between the strength at which cohesion breaks and that at which friction gives way.
TEST(Fos, TellsOfCohesionThatWasLostBefore) {
  const std::string law = "friction_angle = 40\ncohesion = 100\n";
  const FosResult brittle = found(ramp(law + "residual = { friction_angle = 45 }\n", coarse));
  EXPECT_NEAR(*brittle.factor, exact, 0.05);
  ASSERT_TRUE(brittle.mechanism);
  EXPECT_NEAR(brittle.mechanism->brittle_length, 2.0, 0.01);
  EXPECT_NEAR(brittle.mechanism->cohesion_lost_length, 2.0, 0.01);
  EXPECT_NE(
      brittle.mechanism->text.find("; 2 m of its 2 m had lost their cohesion before it moved"),
      std::string::npos)
      << brittle.mechanism->text;
  EXPECT_NE(lost_cohesion_text(*brittle.mechanism)
                .find("2 m of 2 m of the mechanism's joints had no "
                      "cohesion before it moved (it was lost, or "
                      "they opened and closed again;"),
            std::string::npos);
  EXPECT_NE(fos_summary(model_of(ramp(law)), brittle, 1).find("\"cohesion_lost_length\""),
            std::string::npos);
  // Cohesion that is there until it fails, and cohesion that stays.
  const FosResult whole = found(ramp("friction_angle = 45\ncohesion = 3000\n", coarse));
  EXPECT_NEAR(whole.mechanism->brittle_length, 2.0, 0.01);
  EXPECT_EQ(whole.mechanism->cohesion_lost_length, 0.0);
  EXPECT_EQ(lost_cohesion_text(*whole.mechanism), "");
  const FosResult kept =
      found(ramp(law + "residual = { friction_angle = 45, cohesion = 100 }\n", coarse));
  EXPECT_EQ(kept.mechanism->brittle_length, 0.0);
}

/// The corner that moves most lies at the toe of the slope, where nothing lies along its edge: the
/// plane is found all the same.
TEST(Fos, TheMechanismHasTheWholePlane) {
  const FosResult r = found(
      "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n"
      "[joints.plane]\nfriction_angle = 30\nkn = 1e10\nks = 4e9\n[joints.crack]\n"
      "friction_angle = 30\n[domain]\njoint = 'crack'\n"
      "outline = [[-20, -10], [60, -10], [60, 20], [7.2794, 20], [0, 0]]\n"
      "[[trace]]\npoints = [[0, 0], [20, 11]]\njoint = 'plane'\n"
      "[[trace]]\npoints = [[20, 11], [20, 20]]\njoint = 'crack'\n[[held]]\npoint = [30, -5]\n"
      "[solver]\nduration = 1\n[fos]\nbracket = [1, 1.5]\ntolerance = 0.5\n");
  ASSERT_TRUE(r.mechanism) << r.message;
  const auto plane = std::find_if(r.mechanism->joints.begin(), r.mechanism->joints.end(),
                                  [](const MovingJoint& j) { return j.joint == "plane"; });
  ASSERT_NE(plane, r.mechanism->joints.end());
  double length = 0.0;
  for (const Stretch& s : plane->stretches) length += norm(s.to - s.from);
  // What has slid past the toe lies on the plane no more.
  const double whole = std::hypot(20.0, 11.0), rounding = 0.01;
  EXPECT_LT(plane->slip, 0.1);
  EXPECT_GE(length, whole - plane->slip - rounding);
  EXPECT_LE(length, whole + rounding);
}

/// What slides out over the toe of a plane does not topple.
TEST(Fos, WhatGoesOutOverTheToeSlides) {
  const FosResult r = found(
      "[materials.rock]\nunit_weight = '26 kN/m3'\nyoung = '1 GPa'\npoisson = 0.25\n"
      "[joints.bedding]\nfriction_angle = 20\n[joints.cross]\nfriction_angle = 35\n"
      "[domain]\njoint = 'bedding'\n"
      "outline = [[0, 0], [44, 0], [44, 22], [24.4, 22], [20, 10], [20, 8], [0, 8]]\n"
      "[[trace]]\npoints = [[20, 10], [34.301, 22]]\njoint = 'bedding'\n"
      "[[joint_set]]\nangle = -50\nspacing = 8\norigin = [25.6, 10]\njoint = 'cross'\n"
      "region = [[20, 10], [34.301, 22], [24.4, 22]]\n[[held]]\npoint = [5, 5]\n" +
      coarse);
  ASSERT_TRUE(r.mechanism) << r.message;
  EXPECT_EQ(r.mechanism->text, "sliding along bedding: 3 blocks");
}

/// A search needs no duration, and does not look at one that is given.
TEST(Fos, NeedsNoDuration) {
  const FosResult none = found(ramp(rough, coarse, ""));
  EXPECT_NEAR(*none.factor, exact, 0.05);
  for (const char* duration : {"0.5", "500"}) {
    const FosResult given =
        found(ramp(rough, coarse, "[solver]\nduration = " + std::string(duration) + "\n"));
    EXPECT_EQ(fos_csv(given.trials), fos_csv(none.trials));
  }
}

/// But the length of a sine is that of the run.
TEST(Fos, ASineNeedsADuration) {
  const Result<FosResult> r = find_factor(
      model_of(
          ramp(rough,
               "[[shaking]]\nname = 'push'\nacceleration = { amplitude = 1, frequency = 5 }\n" +
                   coarse + "vary = 'shaking:push'\n",
               "")),
      {});
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(to_string(r.faults()[0]),
            "m.toml:18:8: fos.vary: nothing says for how long the ground shakes: give "
            "solver.duration, or the shaking a record");
}

/// A run does need one.
TEST(Fos, ARunNeedsADuration) {
  const Result<PreparedRun> run = prepare_run(model_of(ramp(rough, "", "")));
  ASSERT_FALSE(run.ok());
  EXPECT_EQ(run.faults()[0].where.key, "solver.duration");
  EXPECT_EQ(run.faults()[0].where.file, "m.toml");
}

/// Joints that keep their strength cannot fail; the search ends all the same.
TEST(Fos, ExcludedJointsHold) {
  const FosResult r = found(ramp(rough, coarse + "exclude = ['j']\n"));
  EXPECT_EQ(r.status, FosStatus::above);
  EXPECT_FALSE(r.factor);
  EXPECT_GE(*r.holds, 64.0);
  EXPECT_NE(r.message.find("holds at every factor"), std::string::npos);
}

/// What slides a little until it finds a hold has not failed.
TEST(Fos, StopsBeforeWhatFails) {
  const FosResult r = found(ramp(rough, on_ramp(2.003, 3.0, 0.0, 1.0, "fixed = true") + coarse));
  ASSERT_GE(r.trials.size(), 2u);
  EXPECT_EQ(r.trials[1].factor, 3.0);
  EXPECT_EQ(r.trials[1].end, TrialEnd::holds) << r.trials[1].reason;
  EXPECT_NEAR(r.trials[1].displacement, 0.003, 3e-4);
}

/// What a load presses together, however far, has not failed.
TEST(Fos, PressedTogether) {
  for (const char* young : {"2e8", "2e9"}) {
    const FosResult r = found(
        "[materials.rock]\ndensity = 2600\nyoung = " + std::string(young) +
        "\npoisson = 0.2\n[joints.j]\nfriction_angle = 35\n[[block]]\nfixed = true\n"
        "polygon = [[-5, -1], [9, -1], [9, 0], [-5, 0]]\n[[brick_wall]]\ncolumns = 4\nrows = 3\n"
        "brick = [1, 0.5]\n[[load]]\nname = 'top'\nalong = [[0, 1.5], [4, 1.5]]\n"
        "pressure = 1e5\n[solver]\nduration = 1\n[fos]\nvary = 'load:top'\ntolerance = 0.5\n");
    EXPECT_EQ(r.status, FosStatus::above) << young << ": " << r.message;
  }
}

/// What no strength of joints would hold is set aside, and named.
TEST(Fos, LooseHoweverStrong) {
  const FosResult r =
      found(ramp(rough, on_ramp(-4.3, -3.8, 0.0, 0.3, "name = 'overhang'") + coarse));
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_NEAR(*r.factor, exact, 0.05);
}

/// But what joints would hold if they were stronger decides the factor.
TEST(Fos, LooseInAStage) {
  const std::string resting = on_ramp(-3.0, -2.0, 0.0, 1.0, "joint = 'held'"),
                    stage = "[[stage]]\nuntil = 'equilibrium'\n";
  const std::string law =
      "friction_angle = 25\n[joints.held]\nfriction_angle = 60\n[contact]\njoint = 'j'\n";
  std::vector<std::string> said;
  const FosResult r = found(ramp(law, resting + stage + coarse, ""), 1, &said);
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_EQ(said.front(),
            "blocks come loose in stage 0 with the strength given; it is run again with a thousand "
            "times the strength");
  EXPECT_NEAR(*r.factor,
              std::tan(25.0 * std::numbers::pi / 180.0) / std::tan(std::numbers::pi / 6.0), 0.03);
}

/// The stage that comes to no rest is named.
TEST(Fos, SaysWhichStageIsRunAgain) {
  const std::string stages =
      "[[stage]]\nname = 'held'\nuntil = 'equilibrium'\njoints = 'glued'\n"
      "[[stage]]\nname = 'static'\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\n";
  std::vector<std::string> said;
  const FosResult r = found(ramp("friction_angle = 20\n", stages + coarse, ""), 1, &said);
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_EQ(said.front(),
            "stage 1 (static) comes to no rest with the strength given; the stages are run again "
            "with a thousand times the strength");
}

/// Where nothing acts the acceleration that is told is the one that T comes from.
TEST(Fos, TellsTheAccelerationThatItUses) {
  const FosResult r = found("gravity = [0, 0]\n" + ramp(rough, coarse, ""));
  EXPECT_EQ(r.criterion.acceleration, 9.81);
  EXPECT_NEAR(r.criterion.duration, 5.0 * std::sqrt(std::sqrt(2.0) / 9.81), 1e-5);
}

/// A model that does not stand as given has a factor below 1.
TEST(Fos, BelowOne) {
  const FosResult r = found(ramp("friction_angle = 20\n", coarse));
  EXPECT_EQ(r.status, FosStatus::found);
  EXPECT_NEAR(*r.factor, std::tan(20.0 * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.05);
  EXPECT_EQ(r.trials.front().factor, 1.0);
  EXPECT_EQ(r.trials.front().end, TrialEnd::fails);
}

/// Where joints that are too weak keep their strength no factor helps; without any friction, or in
/// the air, nothing finds a rest.
TEST(Fos, NothingToBracket) {
  const FosResult below = found(ramp("friction_angle = 20\n", coarse + "exclude = ['j']\n"));
  EXPECT_EQ(below.status, FosStatus::below);
  EXPECT_LE(*below.fails, 0.5 / 16.0);
  const FosResult falling =
      found("[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.2\n[joints.j]\n" + rough +
            "[solver]\nduration = 1\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n");
  EXPECT_EQ(found(ramp("friction_angle = 0\n", coarse)).status, FosStatus::unstable);
  EXPECT_EQ(falling.status, FosStatus::unstable);
  EXPECT_NE(falling.message.find("no rest"), std::string::npos) << falling.message;
}

/// The trials begin from the end of the stage named, with the strength that it has there.
TEST(Fos, BeginsFromAStage) {
  const std::string stages =
      "[[stage]]\nname = 'rest'\nuntil = 'equilibrium'\n[[stage]]\nname = 'weak'\nuntil = "
      "'equilibrium'\nstrength_factor = 1.25\n";
  std::string text = ramp(rough);
  text.erase(text.find("duration = 0.5\n"), 15);
  const FosResult first = found(text + stages + coarse + "stage = 'rest'\n");
  const FosResult last = found(text + stages + coarse);
  EXPECT_NEAR(*first.factor, exact, 0.05);
  EXPECT_NEAR(*last.factor, exact / 1.25, 0.05);
}

/// A load that no stage has switched on yet acts in the trials.
TEST(Fos, SwitchesOnWhatItVaries) {
  std::string text = ramp("friction_angle = 45\n",
                          "[[load]]\nname = 'push'\npoint = [1.1, -0.05]\nforce = [1e4, 0]\n"
                          "[[stage]]\nname = 'rest'\nuntil = 'equilibrium'\n[[stage]]\nname = "
                          "'pushed'\nuntil = 'equilibrium'\nactivate = ['push']\n");
  text.erase(text.find("duration = 0.5\n"), 15);
  const double s = 0.5, c = std::sqrt(0.75), weight = 2500.0 * 2.0 * 9.81;
  for (const char* stage : {"rest", "pushed"}) {
    const FosResult r =
        found(text + coarse + "vary = 'load:push'\nbracket = [0.5, 2]\nstage = '" + stage + "'\n");
    ASSERT_TRUE(r.factor) << r.message;
    EXPECT_NEAR(*r.factor, weight * (c - s) / (c + s) / 1e4, 0.05);
  }
}

TEST(Fos, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  FosOptions options;
  options.stop = &stop;
  int said = 0;
  options.say = [&](const std::string&) { stop = ++said >= 2; };
  const Result<FosResult> r = find_factor(model_of(ramp(rough, coarse)), options);
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r.value().status, FosStatus::interrupted);
  EXPECT_EQ(r.value().trials.size(), 2U);
  EXPECT_EQ(r.value().holds, 1.0);
}

TEST(Fos, RefusesWhatItCannotDo) {
  for (const auto& [line, key] :
       {std::pair{"method = 'dda'\n", "solver.method"}, {"mass = 'consistent'\n", "solver.mass"}}) {
    std::string text = ramp(rough);
    text.insert(text.find("duration"), line);
    const Result<FosResult> r = find_factor(model_of(text), {});
    ASSERT_FALSE(r.ok());
    EXPECT_EQ(r.faults()[0].where.key, key);
  }
}

/// A stage's factor: a block that holds at one below its limit goes at one above it, in both
/// methods.
TEST(StrengthFactor, ActsFromTheStartOfItsStage) {
  for (const std::string method : {"edda", "dda"}) {
    for (const auto& [factor, status] :
         {std::pair{0.95 * exact, Status::equilibrium}, {1.05 * exact, Status::collapsed}}) {
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
      EXPECT_EQ(run.sim.laws.divided_by[0], std::stod(number(factor)));
    }
  }
}

/// Cohesion and tension are divided, too, and all of it comes back when the factor does.
TEST(StrengthFactor, DividesAllStrength) {
  PreparedRun run =
      prepared(ramp("friction_angle = 40\ncohesion = 1e5\ntensile_strength = 2e4\nresidual = { "
                    "friction_angle = 30 }\n"));
  Simulation& sim = run.sim;
  const FaceSet before = sim.contacts;
  const Law law = sim.laws.rows[0];
  sim.set_strength_factor(2.0);
  EXPECT_EQ(sim.laws.rows[0].peak_friction, law.peak_friction / 2.0);
  EXPECT_EQ(sim.laws.rows[0].residual_friction, law.residual_friction / 2.0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(sim.contacts.friction[k], before.friction[k] / 2.0);
    EXPECT_EQ(sim.contacts.cohesion[k], before.cohesion[k] / 2.0);
    EXPECT_EQ(sim.contacts.tension[k], before.tension[k] / 2.0);
  }
  sim.set_strength_factor(1.0);
  EXPECT_EQ(sim.contacts.friction.values(), before.friction.values());
  EXPECT_EQ(sim.laws.rows[0].peak_tension, law.peak_tension);
}

/// The factor in force, and the slip that laws remember.
TEST(StrengthFactor, LivesInACheckpoint) {
  for (const std::string law :
       {"friction_angle = 45\n", "friction_angle = 45\ndilation_angle = 3\n",
        "type = 'slip-weakening'\nfriction_angle = 45\nresidual = { friction_angle = 30 }\n"
        "slip_distance = 0.05\n",
        "type = 'barton-bandis'\njrc = 5\njcs = 1e7\nresidual_angle = 25\n"}) {
    const std::string text = ramp(law);
    PreparedRun run = prepared(text), other = prepared(text);
    Simulation &a = run.sim, &b = other.sim;
    a.start(0.5);
    a.set_strength_factor(1.8);
    for (int k = 0; k < 300; ++k) ASSERT_FALSE(a.step());
    Record record;
    remember(a, record);
    b.start(0.5);
    ASSERT_EQ(recall(b, record), "");
    EXPECT_EQ(b.laws.rows[0].residual_friction, a.laws.rows[0].residual_friction);
    EXPECT_EQ(b.contacts.slid.values(), a.contacts.slid.values());
    for (int k = 0; k < 300; ++k) ASSERT_FALSE(a.step() || b.step());
    EXPECT_EQ(a.state.x, b.state.x) << law;
    EXPECT_EQ(a.state.vy, b.state.vy) << law;
  }
}

/// The factor divides the strength that slip and stress have left, too.
TEST(Fos, DividesLawsThatChange) {
  const double sigma = 2500.0 * 9.81 * std::cos(std::numbers::pi / 6.0);
  const FosResult barton =
      found(ramp("type = 'barton-bandis'\njrc = 5\njcs = 1e7\nresidual_angle = 30\n", coarse));
  const double angle = 30.0 + 5.0 * std::log10(1e7 / sigma);
  EXPECT_NEAR(*barton.factor, std::tan(angle * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.05);
  const FosResult weak = found(
      ramp("type = 'slip-weakening'\nfriction_angle = 45\nresidual = { friction_angle = 20 }\n"
           "slip_distance = 0.05\n",
           coarse));
  EXPECT_NEAR(*weak.factor, exact, 0.05);
}

}  // namespace
}  // namespace edda::fos_test
