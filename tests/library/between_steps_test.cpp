// What a caller does between two steps, from whichever callback: it sees the simulation as it is,
// what it writes counts, and what it throws comes through.
#include <omp.h>

#include <cmath>
#include <limits>
#include <thread>

#include "library/fixture.hpp"

namespace edda::api {
namespace {

/// The ramp with rows at every 10 ms.
Model ramp_with_rows(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"solver.duration=0.05", "output.history_every=0.01"});
  return Model::read(examples + "ramp.toml", more);
}

/// The ramp in two stages, the second weaker.
Model staged_ramp() {
  std::string text = text_of(examples + "ramp.toml");
  text.replace(text.find("\nduration ="), 1, "\n# ");  // the stages have their own
  return Model::parse(
      text + "[[stage]]\nduration = 0.01\n[[stage]]\nname = \"weak\"\nduration = 0.02\n",
      "ramp.toml", {"output.history_every=0.005", "output.every=0.01"});
}

TEST_F(Library, LookingFromProgressChangesNothing) {
  Simulation whole(ramp_with_rows());
  whole.run();
  double drift = 0.0;
  std::vector<double> kinetic, speeds;
  Simulation* self = nullptr;
  Simulation watched(ramp_with_rows(), {.progress =
                                            [&](const Progress& p) {
                                              drift =
                                                  std::max(drift, std::abs(self->ledger().drift));
                                              if (kinetic.size() > 200) return true;
                                              kinetic.push_back(self->ledger().kinetic - p.kinetic);
                                              const double t = self->read("centre").uy;
                                              speeds.push_back(t);
                                              return true;
                                            },
                                        .progress_every = 0.0});
  self = &watched;
  watched.node_vx();
  EXPECT_EQ(watched.run().status, Status::completed);
  EXPECT_LT(drift, 1e-3);
  EXPECT_GT(kinetic.size(), 200u);
  for (const double difference : kinetic) EXPECT_EQ(difference, 0.0);
  EXPECT_NE(speeds[1], speeds[0]);  // of this step, not of the one before
  EXPECT_EQ(positions(watched), positions(whole));
  EXPECT_EQ(watched.ledger().external, whole.ledger().external);
}

TEST_F(Library, VelocitiesWrittenFromProgressCount) {
  Simulation* self = nullptr;
  std::size_t stone = 0;
  bool thrown = false;
  Simulation simulation(Model::parse(falling), {.progress =
                                                    [&](const Progress&) {
                                                      if (thrown) return true;
                                                      thrown = true;
                                                      for (const auto& row : self->node_vx()) {
                                                        row[stone] = 4.0;
                                                      }
                                                      return true;
                                                    },
                                                .progress_every = 0.0});
  self = &simulation;
  stone = *simulation.block_called("stone");
  simulation.step();
  const double start = simulation.time();
  EXPECT_NEAR(simulation.ledger().external, 0.5 * 2000.0 * 16.0, 0.1);
  simulation.run();
  EXPECT_NEAR(simulation.field(Field::displacement)[2 * stone], 4.0 * (0.2 - start), 1e-9);
  EXPECT_NEAR(simulation.ledger().drift, 0.0, 1e-6);
}

/// A change in the step that ends at a row, a frame or a stage.
TEST_F(Library, ChangesMayComeWithARow) {
  for (const char* method : {"solver.method=edda", "solver.method=dda"}) {
    Simulation simulation(ramp_with_rows({method}), {.results = in_folder(method)});
    std::size_t changes = 0;
    simulation.every(1, [&] {
      simulation.set_damping(0.5, 0.0, 0.05);
      ++changes;
      EXPECT_GT(simulation.time_step(), 0.0) << simulation.time();
    });
    EXPECT_EQ(simulation.run().status, Status::completed) << method;
    EXPECT_EQ(simulation.steps(), changes);
    const std::string history = text_of(in_folder(method) + "/history.csv");
    EXPECT_EQ(history.find("nan"), std::string::npos) << history;
    EXPECT_EQ(history.find("inf"), std::string::npos) << history;
  }
}

TEST_F(Library, AChangeAtTheEndOfAStageLeavesItsCheckpointWhole) {
  const Model model = staged_ramp();
  Simulation whole(model, {.results = in_folder("out")});
  whole.every(1, [&] {
    if (whole.time() == 0.01) whole.set_damping(0.5, 0.0, 0.05);
  });
  EXPECT_EQ(whole.run().status, Status::completed);
  const std::string history = text_of(in_folder("out") + "/history.csv");
  EXPECT_EQ(history.find("nan"), std::string::npos) << history;
  Simulation second(model, {.results = in_folder("out"), .from_stage = 1});
  EXPECT_EQ(second.run().status, Status::completed);
  EXPECT_EQ(positions(second), positions(whole));
  EXPECT_EQ(text_of(in_folder("out") + "/history.csv"), history);
}

TEST_F(Library, ARunTakenUpAtTheEndOfAStageBeginsTheNextBeforeAnyChange) {
  const Model model = staged_ramp();
  Simulation(model, {.results = in_folder("out")}).run();
  const auto end_of = [&](bool weaker) {
    Simulation second(model, {.results = in_folder("out"), .from_stage = 1});
    EXPECT_EQ(second.stage(), 2u);
    if (weaker) second.set_strength_factor(3.0);
    EXPECT_EQ(second.run().status, Status::completed);
    return positions(second);
  };
  EXPECT_NE(end_of(true), end_of(false));
}

TEST_F(Library, BlocksThatAreHeldStayWhereTheyAreWhateverIsWritten) {
  for (const char* method : {"solver.method=edda", "solver.method=dda"}) {
    Simulation simulation(Model::read(examples + "ramp.toml", {"solver.duration=0.02", method}));
    const std::size_t held = *simulation.block_called("ramp"),
                      free = *simulation.block_called("slider");
    simulation.step(3);
    for (const auto& row : simulation.node_vx()) {
      for (double& v : row) v = 1.0;
    }
    simulation.step(5);
    const auto moved = simulation.field(Field::displacement);
    EXPECT_EQ(moved[2 * held], 0.0) << method;
    EXPECT_GT(moved[2 * free], 0.0) << method;
    EXPECT_EQ(simulation.node_vx()[0][held], 0.0) << method;
    EXPECT_LT(std::abs(simulation.ledger().drift), 1e-3) << method;
  }
}

TEST_F(Library, VelocitiesThatAreNoNumbersAreRefused) {
  Simulation simulation(ramp(), {.results = in_folder("out")}), untouched(ramp());
  const std::size_t slider = *simulation.block_called("slider");
  const MutableNodes vx = simulation.node_vx();
  simulation.step(3);
  const double before = vx[1][slider];
  vx[1][slider] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faults_of([&] { simulation.step(); }).size(), 1u);
  EXPECT_EQ(vx[1][slider], before);
  const std::size_t bad =
      simulation.every(7, [&] { vx[1][slider] = std::numeric_limits<double>::infinity(); });
  EXPECT_FALSE(faults_of([&] { simulation.run(); }).empty());
  simulation.forget(bad);
  EXPECT_EQ(simulation.steps(), 7u);
  EXPECT_EQ(simulation.run().status, Status::completed);
  untouched.run();
  EXPECT_EQ(positions(simulation), positions(untouched));
}

/// A run that ends with velocities that are no numbers ends, as without views of them.
TEST_F(Library, ARunThatFailsEndsWithViewsToo) {
  Simulation simulation(ramp(), {.results = in_folder("out")});
  EXPECT_FALSE(simulation.node_vx()[0].empty());
  simulation.set_velocity(*simulation.block_called("slider"), {0.0, 0.0}, 1.7e308);
  EXPECT_EQ(simulation.run().status, Status::failed);
  EXPECT_TRUE(std::filesystem::exists(in_folder("out") + "/summary.json"));
}

/// They are the simulation's own, no work of its surroundings, whether it is looked at or not.
TEST_F(Library, VelocitiesWrittenBeforeTheFirstStepAreTheFirstOnes) {
  const auto thrown = [&](const char* folder, bool look) {
    Simulation simulation(Model::parse(falling), {.results = in_folder(folder)});
    for (const auto& row : simulation.node_vx()) {
      for (double& v : row) v = 4.0;  // the block that is held, too
    }
    if (look) {
      EXPECT_NEAR(simulation.ledger().kinetic, 0.5 * 2000.0 * 16.0, 1e-6);
    }
    simulation.run();
    EXPECT_NEAR(simulation.ledger().external, 0.0, 1e-9);
    EXPECT_NEAR(simulation.field(Field::displacement)[0], 4.0 * 0.2, 1e-9);
    EXPECT_EQ(simulation.field(Field::displacement)[2], 0.0);
    return text_of(in_folder(folder) + "/history.csv");
  };
  EXPECT_EQ(thrown("blind", false), thrown("looked", true));
  Simulation bad(Model::parse(falling));
  bad.node_vx()[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(faults_of([&] { bad.step(); }).empty());
  EXPECT_EQ(bad.steps(), 0u);
  EXPECT_TRUE(bad.step());
}

TEST_F(Library, AnExceptionInWarnComesThroughAndTheRunMayGoOn) {
  const std::string folder = in_folder("out");
  Simulation simulation(
      Model::read(examples + "ramp.toml", {"solver.duration=0.05", "output.checkpoint_every=1e-9"}),
      {.results = folder, .warn = [](const std::string&) { throw std::out_of_range("mine"); }});
  const MutableNodes vx = simulation.node_vx();
  simulation.step();
  // A folder in the place of the checkpoint before: none can be written.
  const std::string in_the_way = folder + "/checkpoint.previous.h5";
  std::filesystem::create_directories(in_the_way + "/folder");
  EXPECT_THROW(simulation.run(), std::out_of_range);
  const std::uint64_t steps = simulation.steps();
  EXPECT_EQ(simulation.node_vx()[0].data(), vx[0].data());
  std::filesystem::remove_all(in_the_way);
  EXPECT_EQ(simulation.run().status, Status::completed);
  EXPECT_GT(simulation.steps(), steps);
  Simulation untouched(ramp());
  untouched.run();
  EXPECT_EQ(positions(simulation), positions(untouched));
}

TEST_F(Library, WhatTheLastProgressCallThrowsComesThrough) {
  bool throws = false;
  const auto progress = [&](const Progress&) -> bool {
    if (throws) throw std::out_of_range("mine");
    return true;
  };
  Simulation simulation(ramp(), {.progress = progress, .progress_every = 1e9});
  simulation.step(3);
  throws = true;
  EXPECT_THROW(simulation.finish(), std::out_of_range);
  EXPECT_TRUE(simulation.over());
  EXPECT_EQ(simulation.finish().status, Status::interrupted);
}

TEST_F(Library, AStepInWhichProgressThrowsIsSeenAllTheSame) {
  Simulation simulation(ramp(), {.progress = [](const Progress& p) -> bool {
                                   if (p.steps == 4) throw std::out_of_range("mine");
                                   return true;
                                 },
                                 .progress_every = 0.0});
  std::vector<std::uint64_t> seen;
  simulation.every(2, [&] { seen.push_back(simulation.steps()); });
  EXPECT_THROW(simulation.step(6), std::out_of_range);
  EXPECT_EQ(simulation.steps(), 4u);
  simulation.step(2);
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{2, 4, 6}));
}

TEST_F(Library, ProgressTellsStagesAndSpeed) {
  std::vector<Progress> told;
  Simulation simulation(staged_ramp(), {.progress =
                                            [&](const Progress& p) {
                                              told.push_back(p);
                                              return true;
                                            },
                                        .progress_every = 0.0});
  simulation.run();
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().stage, 1u);
  EXPECT_EQ(told.front().stage_name, "");
  EXPECT_EQ(told.back().stage, 2u);
  EXPECT_EQ(told.back().stage_name, "weak");
  EXPECT_EQ(told.back().stages, 2u);
  EXPECT_EQ(told.back().fraction, 1.0);
  EXPECT_GT(told.back().largest_velocity, 0.0);
}

TEST_F(Library, ThreadsAreSetForAllThreadsOfTheCaller) {
  const int before = omp_get_max_threads();
  set_threads(3);
  Simulation simulation(ramp());
  int stepping = 0;
  simulation.every(1, [&] { stepping = omp_get_max_threads(); });
  std::thread([&] {
    omp_set_num_threads(1);
    simulation.step();
  }).join();
  EXPECT_EQ(stepping, 3);
  set_threads(4);  // of a simulation that is there, too
  simulation.step(200);
  EXPECT_EQ(stepping, 4);
  set_threads(before);
  EXPECT_FALSE(faults_of([] { set_threads(0); }).empty());
}

TEST_F(Library, TimesAndFunctionsThatAreNoneAreRefused) {
  Simulation simulation(ramp());
  EXPECT_FALSE(
      faults_of([&] { simulation.advance_to(std::numeric_limits<double>::quiet_NaN()); }).empty());
  EXPECT_FALSE(faults_of([&] { simulation.every(3, {}); }).empty());
  EXPECT_FALSE(faults_of([&] { static_cast<void>(simulation.name(2)); }).empty());
  EXPECT_EQ(simulation.steps(), 0u);
}

}  // namespace
}  // namespace edda::api
