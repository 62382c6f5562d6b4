// A run through stages that excavate, install, activate and deactivate resumes to the same bits,
// from the end of a stage and from the middle of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "model/write_model.hpp"
#include "run/prepared.hpp"
#include "run/simulation_memory.hpp"
#include "scratch_folder.hpp"
#include "step/tile_step.hpp"

namespace edda::stage_resume_test {
namespace {

using testing::prepared;

namespace fs = std::filesystem;

const char* const everything = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 25
cohesion = 1e3
[joints.weathered]
friction_angle = 22
kn = 2e8
[contact]
joint = "j"
[domain]
outline = [[0, 0], [6, 0], [6, 5], [0, 5]]
joint = "j"
[[joint_set]]
angle = 3
spacing = 1.1
origin = [0, 0.4]
[[joint_set]]
angle = 82
spacing = 1.3
origin = [0.2, 0]
[[opening]]
name = "hole"
polygon = [[2, 1], [4, 1], [4, 2.5], [2, 2.5]]
[[boundary]]
name = "box"
sides = ["left", "right", "bottom"]
type = "roller"
[[boundary]]
name = "far"
sides = ["left", "right", "bottom"]
type = "viscous"
[[load]]
name = "surcharge"
along = [[0, 5], [6, 5]]
pressure = 2e4
[[water]]
name = "wet"
table = [[-1, 3], [7, 3]]
[[shaking]]
name = "quake"
apply = "inertia"
acceleration = { amplitude = 2.0, frequency = 5.0 }
[[bolt_pattern]]
name = "crown"
opening = "hole"
from_angle = 60
to_angle = 120
count = 3
length = 2
diameter = 0.02
pretension = 1e4
bond = { stiffness = 1e8, strength = 1e5 }
[[stage]]
name = "rest"
until = "equilibrium"
ratio = 1e-3
joints = "glued"
[[stage]]
name = "dig"
excavate = ["hole"]
relax = { hole = 0.5 }
install = ["crown"]
change = [{ joints = "j", to = "weathered", around = "hole", distance = 1 }]
until = "equilibrium"
ratio = 1e-3
duration = 2.0
[[stage]]
name = "shake"
duration = 0.05
relax = { hole = 1.0 }
deactivate = ["box"]
activate = ["far", "surcharge", "wet", "quake"]
[output]
history_every = 0.01
every = 0.05
settling = true
)";

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void expect_same_results(const fs::path& a, const fs::path& b) {
  for (const char* file : {"history.csv", "blocks.csv", "joints.csv", "stages.csv", "bolts.csv",
                           "reactions.csv", "joints_1.csv", "joints_2.csv"}) {
    EXPECT_EQ(text_of(a / file), text_of(b / file)) << file;
    EXPECT_GT(text_of(a / file).size(), 100u) << file;
  }
}

/// From the end of each stage, and from the middle of one.
void expect_resumed(const std::string& model) {
  const ScratchFolder whole, broken;
  RunOptions options;
  options.folder = whole.path().string();
  PreparedRun first = prepared(model);
  const Result<Outcome> outcome = run_model(first, options);
  ASSERT_TRUE(outcome.ok());
  ASSERT_EQ(outcome.value().status, Status::completed) << outcome.value().message;
  for (const std::size_t stage : {0u, 1u}) {
    fs::remove_all(broken.path());
    fs::copy(whole.path(), broken.path(), fs::copy_options::recursive);
    options.folder = broken.path().string();
    options.from_stage = stage;
    PreparedRun again = prepared(model);
    const Result<Outcome> resumed = run_model(again, options);
    ASSERT_TRUE(resumed.ok()) << to_string(resumed.faults()[0]);
    expect_same_results(whole.path(), broken.path());
  }
  options.from_stage.reset();
  fs::remove_all(broken.path());
  std::atomic<bool> stop{false};
  options.stop = &stop;
  options.progress_every = 0.0;
  options.progress = [&](const Progress& p) {
    if (p.fraction > 0.99 || p.steps > outcome.value().steps - 400) stop = true;
  };
  PreparedRun halted = prepared(model);
  const Result<Outcome> half = run_model(halted, options);
  ASSERT_TRUE(half.ok());
  ASSERT_EQ(half.value().status, Status::interrupted);
  options.stop = nullptr;
  options.progress = nullptr;
  options.resume = true;
  PreparedRun again = prepared(model);
  const Result<Outcome> resumed = run_model(again, options);
  ASSERT_TRUE(resumed.ok()) << to_string(resumed.faults()[0]);
  expect_same_results(whole.path(), broken.path());
}

/// A wall that reaches equilibrium, is hit while its joints have dashpots, and reaches equilibrium
/// again without them.
const char* const hit_wall = R"(
[materials.rock]
density = 2600.0
young = 5e7
poisson = 0.2
[joints.j]
friction_angle = 25.0
cohesion = 1e3
[contact]
joint = "j"
[[block]]
name = "floor"
fixed = true
polygon = [[-4, -1], [8, -1], [8, 0], [-4, 0]]
[[brick_wall]]
columns = 2
rows = 2
brick = [1.0, 0.5]
joint = "j"
[[block]]
name = "ball"
velocity = [-12.0, 3.0]
angular_velocity = 4.0
polygon = [[3, 0.2], [4, 0.4], [4.4, 1.2], [3.6, 1.7], [2.8, 1]]
[[stage]]
duration = 0.01
damping = { contact = 0.2 }
[[stage]]
name = "hit"
duration = 0.02
reset_displacements = true
damping = { contact = 0.1 }
[[stage]]
duration = 0.01
[output]
history_every = 0.005
every = 0.02
)";

/// Its contents, except wall times.
Record memory_of(Simulation& sim) {
  Record record;
  remember(sim, record);
  std::erase_if(record, [](const auto& entry) { return entry.first.starts_with("seconds."); });
  return record;
}

/// A run interrupted and resumed after each of its steps has the same numbers throughout. Returns
/// the number of joints that have spent their fracture energy.
std::uint64_t expect_same_numbers(const std::string& model) {
  const ScratchFolder whole, broken;
  RunOptions options;
  options.folder = whole.path().string();
  std::map<std::uint64_t, Record> expected;
  PreparedRun unbroken = prepared(model);
  const State& state = unbroken.sim.motion.state;
  options.after_step = [&] {
    expected[state.steps] = memory_of(unbroken.sim);
    return false;
  };
  EXPECT_TRUE(run_model(unbroken, options).ok());
  EXPECT_GT(expected.size(), 100u);
  options.folder = broken.path().string();
  std::atomic<bool> stop{false};
  options.stop = &stop;
  Status status = Status::interrupted;
  while (status == Status::interrupted && !::testing::Test::HasFailure()) {
    PreparedRun part = prepared(model);
    const std::uint64_t& steps = part.sim.motion.state.steps;
    stop = false;
    options.after_step = [&] {
      stop = true;
      for (const auto& [name, value] : memory_of(part.sim))
        EXPECT_TRUE(value == expected[steps][name]) << name << " after step " << steps;
      return false;
    };
    const Result<Outcome> outcome = run_model(part, options);
    if (!outcome.ok()) {
      ADD_FAILURE() << to_string(outcome.faults()[0]);
      break;
    }
    status = outcome.value().status;
    options.resume = true;
  }
  EXPECT_EQ(status, Status::completed);
  const FaceSet& faces = unbroken.sim.motion.contacts;
  return faces.cracks_tension + faces.cracks_shear;
}
TEST(StageResume, HasTheSameNumbersWhereverItIsInterrupted) {
  expect_same_numbers(hit_wall);
}
/// The cracks of joints with fracture energy, too.
TEST(StageResume, HasTheSameNumbersWhereverCracksAreInterrupted) {
  std::string model = hit_wall;
  const std::string cohesion = "cohesion = 1e3\n";
  model.replace(model.find(cohesion), cohesion.size(),
                "cohesion = 4e4\ntensile_strength = 1e4\nfracture_energy = 0.4\n"
                "shear_fracture_energy = 4\n");
  const std::string slow = "velocity = [-12.0, 3.0]";
  model.replace(model.find(slow), slow.size(), "velocity = [-60.0, 3.0]");
  EXPECT_GT(expect_same_numbers(model), 0u);
}

TEST(StageResume, ResumesToTheSameBits) {
  expect_resumed(everything);
}

/// Blocks that are meshed, and yield, in stages that excavate, bolt, load, drown and shake them.
TEST(StageResume, ResumesToTheSameBitsWithZones) {
  std::string model = everything;
  model.insert(model.find("[joints.j]"),
               "yield = { friction_angle = 35, cohesion = 2e5, tensile_strength = 5e4 }\n");
  model += "[zones]\nsize = 2.0\n";
  for (std::size_t at = 0; (at = model.find("duration = 2.0\n", at)) != std::string::npos;)
    model.replace(at, 14, "duration = 9.0");
  // With viscous forces, which the next step needs.
  model.insert(model.find("[joints.j]"), "rayleigh = { fraction = 0.002, frequency = 50 }\n");
  expect_resumed(model);
}

/// Linings that crack, and are damped.
TEST(StageResume, ResumesToTheSameBitsWithLinings) {
  expect_same_numbers(
      "gravity = [0, 0]\n[materials.concrete]\ndensity = 2500\nyoung = 3e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 30\n[[lining]]\nalong = [[0, 0], [3, 0]]\nthickness = 0.3\n"
      "size = 0.5\ncompressive_strength = 2e6\ntensile_strength = 2e5\n"
      "residual = { tensile_strength = 1e4 }\n"
      "[[boundary]]\ntype = 'fixed'\nstiffness = 1e11\nalong = [[0, 0], [0, 0.3]]\n"
      "[[load]]\npoint = [3, 0.15]\nforce = [0, 2e4]\n[[stage]]\nduration = 0.002\n"
      "[output]\nevery = 0.001\n");
}

/// Fill in lifts, placed in the stage before the last and excavated in that.
TEST(StageResume, ResumesToTheSameBitsWithFill) {
  std::string model = everything;
  const auto add = [&](const std::string& after, const std::string& text) {
    model.insert(model.find(after) + after.size(), text);
  };
  add("cohesion = 1e3\n", "tensile_strength = 1e3\n");
  add("name = \"dig\"\n", "fill = [\"paste\"]\n");
  add("duration = 0.05\n", "excavate = [\"paste\"]\n");
  const std::string part = "relax = { hole = 1.0 }";
  model.replace(model.find(part), part.size(), "relax = { hole = 1.0, paste = 0.7 }");
  for (std::size_t at = 0; (at = model.find("duration = 2.0\n", at)) != std::string::npos;)
    model.replace(at, 14, "duration = 9.0");
  expect_resumed(
      "[[fill]]\nname = \"paste\"\nopening = \"hole\"\nlift = 0.8\njoint = \"j\"\n"
      "material = \"rock\"\n[zones]\nsize = 1.5\n" +
      model);
}

/// Water that flows from one side to the hole, and in the last stage from a table.
TEST(StageResume, ResumesToTheSameBitsWithFlow) {
  std::string model = everything;
  const auto add = [&](const std::string& after, const std::string& text) {
    model.insert(model.find(after) + after.size(), text);
  };
  add("cohesion = 1e3\n", "aperture = 2e-4\n");
  add("kn = 2e8\n", "aperture = 3e-4\n");
  add("name = \"wet\"\n", "sides = [\"right\"]\n");
  model = "[flow]\n[[water]]\nname = \"deep\"\nlevel = 4\nsides = [\"left\"]\n" + model;
  expect_resumed(model);
  // In a time, too: of the stages before the last one.
  const std::string stage = "name = \"dig\"\n";
  model.insert(model.find(stage), "ramp = { flow = [0, 50], steps = 2 }\n");
  expect_resumed(model);
}

/// Joints with dashpots of their own.
TEST(StageResume, ResumesToTheSameBitsWithRestitution) {
  for (const char* restitution : {"restitution = \"housner\"\n", "restitution = 0.3\n"}) {
    std::string model = everything;
    model.insert(model.find("[contact]"), restitution);
    // Softer joints take longer to reach equilibrium.
    for (std::size_t at = 0; (at = model.find("duration = 2.0\n", at)) != std::string::npos;)
      model.replace(at, 14, "duration = 9.0");
    expect_resumed(model);
  }
}

/// Rows and frames of a stage until equilibrium follow from its steps.
TEST(StageResume, RowsOfAnEquilibriumStageAreThoseOfTheUnbrokenRun) {
  std::string settling = everything;
  for (const char* interval : {"history_every = 0.01", "every = 0.05"}) {
    settling.replace(settling.rfind(interval), std::strlen(interval),
                     *interval == 'h' ? "history_every = 1.0" : "every = 1.0");
  }
  const ScratchFolder whole, broken;
  RunOptions options;
  options.folder = whole.path().string();
  PreparedRun first = prepared(settling);
  ASSERT_TRUE(run_model(first, options).ok());
  const std::string rows = text_of(whole.path() / "history.csv");
  EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 20);
  options.folder = broken.path().string();
  std::atomic<bool> stop{false};
  options.stop = &stop;
  options.progress_every = 0.0;
  options.progress = [&](const Progress& p) { stop = p.stage == 0 && p.steps >= 200; };
  PreparedRun halted = prepared(settling);
  ASSERT_EQ(run_model(halted, options).value().status, Status::interrupted);
  options.stop = nullptr;
  options.progress = nullptr;
  options.resume = true;
  PreparedRun again = prepared(settling);
  ASSERT_TRUE(run_model(again, options).ok());
  EXPECT_EQ(text_of(broken.path() / "history.csv"), rows);
  EXPECT_EQ(text_of(broken.path() / "blocks.pvd"), text_of(whole.path() / "blocks.pvd"));
}

/// Later stages may change; what came before may not.
TEST(StageResume, GoesOnFromAStageWithOtherStagesBehindIt) {
  const ScratchFolder folder;
  RunOptions options;
  options.folder = folder.path().string();
  PreparedRun first = prepared(everything);
  ASSERT_TRUE(run_model(first, options).ok());
  options.from_stage = 1;
  const std::string text = everything;
  const auto at = text.find("duration = 0.05\nrelax");
  ASSERT_NE(at, std::string::npos);
  std::string other = text;
  other.replace(at, 15, "duration = 0.02");
  PreparedRun changed = prepared(other);
  const Result<Outcome> outcome = run_model(changed, options);
  ASSERT_TRUE(outcome.ok()) << to_string(outcome.faults()[0]);
  EXPECT_LT(outcome.value().time, first.sim.motion.state.time);
  EXPECT_EQ(text_of(folder.path() / "model.toml"), to_toml(changed.sim.scene->model));
  std::string earlier = text;
  earlier.replace(earlier.find("hole = 0.5"), 10, "hole = 0.4");
  PreparedRun wrong = prepared(earlier);
  const Result<Outcome> refused = run_model(wrong, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(to_string(refused.faults()[0]).find("the model is not the one"), std::string::npos);
}

/// A stage until equilibrium without a duration may last longer than all stages would by theirs.
TEST(StageResume, GoesOnWithinAStageThatOutlastsItsDuration) {
  const std::string model =
      "[materials.rock]\ndensity = 2500\nyoung = 1e7\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 40\nkn = 1e6\n[contact]\njoint = 'j'\n"
      "[[block]]\nfixed = true\npolygon = [[0, 0], [4, 0], [4, 1], [0, 1]]\n"
      "[[block]]\npolygon = [[1, 1], [2, 1], [2, 2], [1, 2]]\n"
      "[[shaking]]\nacceleration = { amplitude = 2, frequency = 5 }\napply = 'inertia'\n"
      "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nduration = 0.5\n";
  const ScratchFolder folder;
  RunOptions options;
  options.folder = folder.path().string();
  double until = 0.0;
  std::atomic<bool> stop{false};
  options.stop = &stop;
  const auto run = [&] {
    stop = false;
    PreparedRun part = prepared(model);
    until += part.sim.scene->model.solver.duration + 1.0;
    options.after_step = [&] {
      if (part.sim.motion.state.time > until) stop = true;
      return false;
    };
    const Result<Outcome> outcome = run_model(part, options);
    ASSERT_TRUE(outcome.ok()) << to_string(outcome.faults()[0]);
    EXPECT_EQ(outcome.value().status, Status::interrupted);
    EXPECT_GT(outcome.value().time, until);
  };
  run();
  options.resume = true;
  run();
}

/// What is left of other stages behind it is not taken for its own.
TEST(StageResume, LeavesNoCurveOfRampsThatAreNoMore) {
  const std::string first =
                        "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
                        "[joints.j]\nfriction_angle = 40\n[contact]\njoint = 'j'\n"
                        "[[block]]\nfixed = true\npolygon = [[0, 0], [4, 0], [4, 1], [0, 1]]\n"
                        "[[block]]\npolygon = [[1, 1], [2, 1], [2, 2], [1, 2]]\n"
                        "[[stage]]\nuntil = 'equilibrium'\n",
                    ramp = "[[stage]]\nramp = { kh = [0, 0.1], steps = 2 }\n";
  const ScratchFolder folder;
  RunOptions options;
  options.folder = folder.path().string();
  PreparedRun before = prepared(first + ramp);
  ASSERT_TRUE(run_model(before, options).ok());
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "curve.csv"));
  options.from_stage = 0;
  PreparedRun after = prepared(first + "[[stage]]\nduration = 0.01\n");
  ASSERT_TRUE(run_model(after, options).ok());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "curve.csv"));
}

}  // namespace
}  // namespace edda::stage_resume_test
