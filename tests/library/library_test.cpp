// The interface of the library: one run whether whole or in parts, views that stay, changes that
// the energy balance contains.
#include <gtest/gtest.h>

#include <cmath>

#include "library/fixture.hpp"

namespace edda::api {
namespace {

double max_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

TEST_F(Library, FaultsComeAllTogetherWithKeyAndRemedy) {
  const auto faults = faults_of([] {
    Model::parse(std::string(falling) +
                     "\nsnap = 3\n[materials.clay]\ndensity = -1.0\nyoung = 1e9\npoisson = 0.2\n",
                 "two.toml");
  });
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].file, "two.toml");
  EXPECT_GT(faults[0].line, 0);
  EXPECT_EQ(faults[1].key, "materials.clay.density");
  EXPECT_FALSE(faults[1].remedy.empty());
  EXPECT_EQ(faults_of([] { Model::read("no such file.toml"); }).size(), 1u);
}

TEST_F(Library, OverridesCountAndModelsReadBack) {
  const Model model = Model::parse(falling, "falling.toml", {"solver.duration=0.5"});
  EXPECT_EQ(model.duration(), 0.5);
  EXPECT_EQ(model.materials(), std::vector<std::string>{"rock"});
  EXPECT_EQ(Model::parse(model.to_toml()).to_toml(), model.to_toml());
}

/// Laws on the way from one to another are not among them.
TEST_F(Library, JointsAreThoseThatTheModelGives) {
  std::string text = falling;
  text.erase(text.find("duration = 0.2\n"), 15);
  const Model model = Model::parse(
      text +
      "[joints.k]\nfriction_angle = 20\n[[stage]]\nchange = [{ joints = 'j', to = 'k' }]\n"
      "ramp = { change = [0, 1] }\n");
  EXPECT_EQ(model.joints(), (std::vector<std::string>{"j", "k"}));
}

TEST_F(Library, CutGivesPolygonsWithAJointPerEdge) {
  const Cut cut = api::cut(Model::read(examples + "cavern.toml"));
  ASSERT_GT(cut.blocks.size(), 100u);
  double area = 0.0;
  for (const CutBlock& block : cut.blocks) {
    area += block.area;
    ASSERT_EQ(block.rings.size(), block.joints.size());
    for (std::size_t r = 0; r < block.rings.size(); ++r) {
      ASSERT_EQ(block.rings[r].size(), block.joints[r].size());
    }
  }
  const Simulation simulation(Model::read(examples + "cavern.toml"));
  double weighed = 0.0;
  for (const double a : simulation.blocks().area) weighed += a;
  EXPECT_NEAR(weighed, area, 1e-9 * area);
}

TEST_F(Library, PartsMakeTheSameRunAndLookingChangesNothing) {
  Simulation whole(ramp(), {.results = in_folder("whole")});
  EXPECT_EQ(whole.run().status, Status::completed);

  Simulation parts(ramp(), {.results = in_folder("parts")});
  std::size_t looks = 0;
  parts.every(7, [&] {
    looks += parts.contacts().size() + parts.field(Field::stress).size();
    EXPECT_LT(std::abs(parts.ledger().drift), 0.01);
  });
  parts.node_vx();
  EXPECT_TRUE(parts.step());
  EXPECT_TRUE(parts.step(12));
  EXPECT_EQ(parts.steps(), 13u);
  EXPECT_TRUE(parts.advance_to(0.0213));
  EXPECT_GE(parts.time(), 0.0213);
  EXPECT_LT(parts.time(), 0.0213 + parts.time_step());
  EXPECT_EQ(parts.run().status, Status::completed);
  EXPECT_FALSE(parts.step());
  EXPECT_GT(looks, 0u);

  EXPECT_EQ(positions(parts), positions(whole));
  for (const char* file : {"history.csv", "blocks.csv", "joints.csv", "model.toml"}) {
    const std::string text = text_of(in_folder("whole") + "/" + file);
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_TRUE(text == text_of(in_folder("parts") + "/" + file)) << file;
  }
}

TEST_F(Library, ViewsStayWhereTheyAre) {
  Simulation simulation(ramp());
  const Nodes x = simulation.node_x();
  const MutableNodes vx = simulation.node_vx();
  const auto alive = simulation.alive();
  for (int k = 0; k < 5; ++k) {
    simulation.step();
    EXPECT_EQ(simulation.node_x()[2].data(), x[2].data());
    EXPECT_EQ(simulation.node_vx()[0].data(), vx[0].data());
    EXPECT_EQ(simulation.alive().data(), alive.data());
  }
  double speed = 0.0;
  for (const double v : vx[1]) speed = std::max(speed, std::abs(v));
  EXPECT_GT(speed, 0.0);
}

TEST_F(Library, AThrownStoneFliesAsItShould) {
  Simulation simulation(Model::parse(falling));
  const auto stone = simulation.block_called("stone");
  ASSERT_TRUE(stone.has_value());
  simulation.advance_to(0.05);
  const double start = simulation.time();
  const double vy = simulation.field(Field::velocity)[2 * *stone + 1];
  EXPECT_NEAR(vy, -10.0 * start, 1e-9);
  simulation.set_velocity(*stone, {3.0, 0.0}, 2.0);
  EXPECT_EQ(simulation.run().status, Status::completed);
  const double t = 0.2 - start;
  const auto moved = simulation.field(Field::displacement);
  EXPECT_NEAR(moved[2 * *stone], 3.0 * t, 1e-9);
  EXPECT_NEAR(moved[2 * *stone + 1], -5.0 * (start * start + t * t),
              10.0 * simulation.time_step() * t);
  EXPECT_NEAR(simulation.field(Field::rotation)[*stone], 2.0 * t, 1e-3);
  const Ledger ledger = simulation.ledger();
  EXPECT_NEAR(ledger.drift, 0.0, 1e-6);
  // 2000 kg: what it had fallen with is gone, what it was thrown with has come.
  const double before = 1000.0 * 100.0 * start * start,
               after = 1000.0 * 9.0 + 0.5 * 2000.0 / 6.0 * 4.0;
  EXPECT_NEAR(ledger.external, after - before, 0.01 * after);
}

TEST_F(Library, VelocitiesWrittenThroughAViewAreExternalWork) {
  Simulation simulation(Model::parse(falling));
  const std::size_t stone = *simulation.block_called("stone");
  const MutableNodes vx = simulation.node_vx();
  simulation.step(3);
  for (const auto& row : vx) row[stone] = 4.0;
  EXPECT_NEAR(simulation.ledger().external, 0.5 * 2000.0 * 16.0, 0.1);
  const double start = simulation.time();
  simulation.run();
  EXPECT_NEAR(simulation.field(Field::displacement)[2 * stone], 4.0 * (0.2 - start), 1e-9);
  EXPECT_NEAR(simulation.ledger().drift, 0.0, 1e-6);
}

TEST_F(Library, MonitorsAddedFromOutsideAreInHistory) {
  Simulation simulation(Model::parse(falling), {.results = in_folder("out")});
  simulation.add_monitor("centre", {0.5, 0.5});
  EXPECT_FALSE(faults_of([&] { simulation.add_monitor("centre", {0.5, 0.5}); }).empty());
  EXPECT_FALSE(faults_of([&] { simulation.add_monitor("outside", {5.0, 5.0}); }).empty());
  simulation.run();
  EXPECT_NEAR(simulation.read("centre").uy, -0.2, 1e-9);
  EXPECT_NE(text_of(in_folder("out") + "/history.csv").find("centre.uy"), std::string::npos);
  EXPECT_FALSE(faults_of([&] { simulation.add_monitor("late", {0.5, 0.5}); }).empty());
  EXPECT_FALSE(faults_of([&] { simulation.read("nobody"); }).empty());
}

/// By the model that lies in the folder, which has the monitors that were added.
TEST_F(Library, ARunWithAddedMonitorsCanBeTakenUp) {
  const auto begin = [&](const char* folder) {
    Simulation simulation(ramp(), {.results = in_folder(folder)});
    simulation.add_monitor("corner", {1.0, 0.3});
    return simulation;
  };
  begin("whole").run();
  begin("out").step(41);
  const Model model = Model::read(in_folder("out") + "/model.toml");
  Simulation resumed(model, {.results = in_folder("out"), .resume = true});
  EXPECT_EQ(resumed.steps(), 41u);
  EXPECT_EQ(resumed.monitors().back(), "corner");
  EXPECT_EQ(resumed.run().status, Status::completed);
  for (const char* file : {"/history.csv", "/model.toml"}) {
    EXPECT_EQ(text_of(in_folder("out") + file), text_of(in_folder("whole") + file));
  }
  EXPECT_FALSE(faults_of([&] { Simulation(model, {.results = in_folder("out")}); }).empty());
}

TEST_F(Library, PausesAndGoesOnStopsAndEnds) {
  Simulation simulation(ramp());
  const std::size_t pausing = simulation.every(20, [&] { simulation.pause(); });
  EXPECT_EQ(simulation.run().status, Status::interrupted);
  EXPECT_EQ(simulation.steps(), 20u);
  EXPECT_FALSE(simulation.over());
  simulation.forget(pausing);
  simulation.every(50, [&] { simulation.stop(); });
  EXPECT_EQ(simulation.run().status, Status::interrupted);
  EXPECT_EQ(simulation.steps(), 50u);
  EXPECT_TRUE(simulation.over());
  EXPECT_FALSE(faults_of([&] { simulation.set_strength_factor(2.0); }).empty());
}

TEST_F(Library, AStoppedRunCanBeTakenUp) {
  {
    Simulation stopped(ramp(), {.results = in_folder("out")});
    stopped.step(41);
  }  // as if the script had ended here
  EXPECT_NE(text_of(in_folder("out") + "/summary.json").find("interrupted"), std::string::npos);
  Simulation resumed(ramp(), {.results = in_folder("out"), .resume = true});
  EXPECT_EQ(resumed.steps(), 41u);
  EXPECT_EQ(resumed.run().status, Status::completed);
  Simulation whole(ramp(), {.results = in_folder("whole")});
  whole.run();
  EXPECT_EQ(positions(resumed), positions(whole));
  EXPECT_TRUE(text_of(in_folder("out") + "/history.csv") ==
              text_of(in_folder("whole") + "/history.csv"));
}

TEST_F(Library, AnExceptionInACallbackComesThrough) {
  Simulation simulation(ramp());
  const std::size_t bad = simulation.every(10, [] { throw std::out_of_range("mine"); });
  EXPECT_THROW(simulation.run(), std::out_of_range);
  EXPECT_EQ(simulation.steps(), 10u);
  simulation.forget(bad);
  EXPECT_EQ(simulation.run().status, Status::completed);
  Simulation other(ramp());
  other.run();
  EXPECT_EQ(positions(simulation), positions(other));
}

TEST_F(Library, CallsFromACallbackThatMakeNoSenseAreRefused) {
  Simulation simulation(ramp());
  simulation.every(5, [&] { simulation.step(); });
  EXPECT_THROW(simulation.run(), Error);
}

TEST_F(Library, ProgressCanStopARun) {
  Simulation simulation(ramp(),
                        {.progress = [](const Progress&) { return false; }, .progress_every = 0.0});
  EXPECT_EQ(simulation.run().status, Status::interrupted);
  EXPECT_EQ(simulation.steps(), 1u);
}

TEST_F(Library, ChangesByHandDoWhatAStageDoes) {
  const char* stages = R"(
[[stage]]
duration = 0.02
[[stage]]
duration = 0.03
strength_factor = 3.0
damping = { mass = 2.0 }
)";
  std::string text = text_of(examples + "ramp.toml");
  text.replace(text.find("\nduration ="), 1, "\n# ");  // the stages have their own
  Simulation staged(Model::parse(text + stages, "ramp.toml", {"output.history_every=0.01"}));
  staged.run();
  Simulation plain(
      Model::parse(text, "ramp.toml", {"solver.duration=0.05", "output.history_every=0.01"}));
  plain.advance_to(0.02);
  ASSERT_EQ(plain.time(), 0.02);
  plain.set_strength_factor(3.0);
  plain.set_damping(2.0);
  plain.run();
  Simulation untouched(ramp());
  untouched.run();
  const auto end = [](const Simulation& s) { return s.field(Field::displacement); };
  EXPECT_EQ(end(plain).size(), end(staged).size());
  double apart = 0.0, effect = 0.0;
  for (std::size_t k = 0; k < end(plain).size(); ++k) {
    apart = std::max(apart, std::abs(end(plain)[k] - end(staged)[k]));
    effect = std::max(effect, std::abs(end(plain)[k] - end(untouched)[k]));
  }
  EXPECT_GT(effect, 1e-5);
  EXPECT_LT(apart, 1e-9);
}

/// What brings a stage to rest is not among what set_damping sets.
TEST_F(Library, DampingByHandLeavesAdaptiveDamping) {
  Simulation untouched(Model::read(examples + "roof-wedge.toml")),
      set(Model::read(examples + "roof-wedge.toml"));
  set.set_damping(0.0);
  EXPECT_EQ(untouched.run().status, Status::equilibrium);
  EXPECT_EQ(set.run().status, Status::equilibrium);
  EXPECT_EQ(set.time(), untouched.time());
}

TEST_F(Library, RockTakenOutByHandIsGone) {
  const Model model = Model::read(examples + "tunnel.toml");
  ASSERT_FALSE(model.stages().empty());
  Simulation simulation(model);
  const std::string opening = model.openings().front();
  simulation.step(4);
  const double drift = simulation.ledger().drift;
  simulation.excavate({opening});
  std::size_t gone = 0;
  for (const std::uint8_t alive : simulation.alive()) gone += alive == 0;
  EXPECT_GT(gone, 0u);
  EXPECT_NEAR(simulation.ledger().drift, drift, 1e-9);
  EXPECT_FALSE(faults_of([&] { simulation.excavate({"no such"}); }).empty());
  simulation.relax(opening, 0.5);
  simulation.step(20);
  EXPECT_LT(std::abs(simulation.ledger().drift), 1e-3);
  Simulation twice(model);
  twice.step(4);
  twice.excavate({opening});
  twice.relax(opening, 0.5);
  twice.step();
  EXPECT_FALSE(faults_of([&] { twice.excavate({opening}); }).empty());  // nothing is left of it
  twice.step(19);
  EXPECT_LT(max_difference(positions(twice), positions(simulation)), 1e-11);
}

TEST_F(Library, ARunGoesOnFromTheEndOfAStage) {
  std::string text = text_of(examples + "ramp.toml");
  text.replace(text.find("\nduration ="), 1, "\n# ");
  const Model model = Model::parse(
      text + "[[stage]]\nduration = 0.01\n[[stage]]\nduration = 0.02\nstrength_factor = 2.0\n");
  Simulation whole(model, {.results = in_folder("out")});
  EXPECT_EQ(whole.run().status, Status::completed);
  EXPECT_EQ(whole.stage(), 2u);
  const std::string history = text_of(in_folder("out") + "/history.csv");
  Simulation second(model, {.results = in_folder("out"), .from_stage = 1});
  EXPECT_NEAR(second.time(), 0.01, 1e-15);
  const auto* vx = second.node_vx()[0].data();
  EXPECT_EQ(second.run().status, Status::completed);
  EXPECT_EQ(second.node_vx()[0].data(), vx);
  EXPECT_EQ(positions(second), positions(whole));
  EXPECT_TRUE(text_of(in_folder("out") + "/history.csv") == history);
}

TEST_F(Library, ModelsBeyondThisMachineAreRefused) {
  const Model model = Model::read(
      examples + "cavern.toml", {"joint_set.steep.spacing=1.3e-3", "joint_set.flat.spacing=1.3e-3",
                                 "domain.max_blocks=2000000000"});
  EXPECT_FALSE(faults_of([&] { Simulation too_large(model); }).empty());
  EXPECT_FALSE(faults_of([&] { cut(model); }).empty());
}

TEST_F(Library, AStoneThrownInAnImplicitRunFlies) {
  Simulation simulation(
      Model::parse(falling, "falling", {"solver.method=dda", "solver.time_step=1e-3"}));
  const std::size_t stone = *simulation.block_called("stone");
  simulation.advance_to(0.1);
  simulation.set_velocity(stone, {3.0, 0.0});
  EXPECT_EQ(simulation.run().status, Status::completed);
  const auto moved = simulation.field(Field::displacement);
  EXPECT_NEAR(moved[2 * stone], 3.0 * 0.1, 1e-9);
  EXPECT_NEAR(moved[2 * stone + 1], -5.0 * (0.01 + 0.01), 1e-9);
  EXPECT_NEAR(simulation.ledger().drift, 0.0, 1e-9);
}

TEST_F(Library, ImplicitRunsWorkTheSameWay) {
  const Model model =
      Model::read(examples + "ramp.toml",
                  {"solver.method=dda", "solver.time_step=1e-3", "solver.duration=0.02"});
  Simulation whole(model), parts(model);
  EXPECT_EQ(whole.run().status, Status::completed);
  const auto* before = parts.node_vx()[0].data();
  while (parts.step()) EXPECT_EQ(parts.node_vx()[0].data(), before);
  EXPECT_EQ(positions(parts), positions(whole));
}

}  // namespace
}  // namespace edda::api
