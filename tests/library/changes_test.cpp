// Changes by hand that stages know, too: what they do, what is refused, and what later stages make
// of it.
#include <cmath>

#include "library/fixture.hpp"

namespace edda::api {
namespace {

/// A square metre of 2500 kg, alone and without weight.
Model lone(const std::string& more) {
  return Model::parse(R"(
gravity = [0, 0]
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[[block]]
name = "b"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
every = 0.1
history_every = 0.1
)" + more);
}

constexpr const char* push = "[[load]]\nname = \"push\"\npoint = [0.5, 0.5]\nforce = [5e3, 0]\n";
/// A second block above, and a bolt through both.
constexpr const char* bolted = R"(
[joints.j]
friction_angle = 30.0
[contact]
normal_stiffness = 1e8
joint = "j"
[[block]]
name = "lid"
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[bolt]]
name = "pin"
from = [0.5, 1.9]
to = [0.5, 0.1]
diameter = 0.02
pretension = 1e4
type = "end"
)";

double moved(const Simulation& simulation) {
  return simulation.field(Field::displacement)[0];
}

std::string problem_of(const std::function<void()>& action) {
  const std::vector<Fault> faults = faults_of(action);
  return faults.size() == 1 ? faults.front().problem : "";
}

TEST_F(Library, ALoadSwitchedOffAndOnByHandActsBetween) {
  Simulation simulation(lone(std::string(push) + "[solver]\nduration = 0.3\n"));
  simulation.advance_to(0.1);
  simulation.switch_over({"push"}, {});
  EXPECT_EQ(problem_of([&] { simulation.switch_over({"push"}, {}); }), "\"push\" does not act");
  simulation.advance_to(0.2);
  EXPECT_NEAR(moved(simulation), 0.5 * 2.0 * 0.01 + 2.0 * 0.1 * 0.1, 1e-4);
  simulation.switch_over({}, {"push"});
  EXPECT_EQ(problem_of([&] { simulation.switch_over({}, {"push"}); }), "\"push\" acts already");
  EXPECT_EQ(problem_of([&] { simulation.switch_over({"push"}, {"push"}); }),
            "\"push\" is in deactivate, too");
  simulation.run();
  EXPECT_NEAR(moved(simulation), 0.5 * 2.0 * 0.04 + 2.0 * 0.1 * 0.1 + 0.0, 1e-3);
  EXPECT_LT(std::abs(simulation.ledger().drift), 1e-6);
}

/// Ended twice, it would take the velocity of the ground twice from that of the other.
TEST_F(Library, AShakingEndsOnce) {
  const char* shakings = R"(
[[shaking]]
name = "quake"
apply = "base"
acceleration = { amplitude = 2.0, frequency = 1.0 }
[[shaking]]
name = "other"
apply = "base"
acceleration = { amplitude = 1.0, frequency = 1.0 }
[[boundary]]
along = [[0, 0], [1, 0]]
type = "fixed"
[[stage]]
duration = 0.13
[[stage]]
duration = 0.1
deactivate = ["quake"]
)";
  Simulation staged(lone(shakings)), by_hand(lone(shakings));
  staged.run();
  by_hand.advance_to(0.13 - 1e-4);
  by_hand.switch_over({"quake"}, {});
  EXPECT_EQ(problem_of([&] { by_hand.switch_over({"quake"}, {}); }), "\"quake\" does not act");
  EXPECT_EQ(by_hand.run().status, Status::completed);  // the stage leaves it out
  EXPECT_GT(std::abs(moved(staged)), 1e-3);
  EXPECT_NEAR(moved(by_hand), moved(staged), 1e-4);
}

/// A sine that begins when it is switched on by hand, v = A (1 - cos wt)/w, and not again later.
TEST_F(Library, ALaterStageLeavesOutWhatActsAlready) {
  Simulation simulation(lone(R"(
[[shaking]]
name = "quake"
apply = "inertia"
acceleration = { amplitude = -3.0, frequency = 2.0 }
[[stage]]
duration = 0.1
[[stage]]
duration = 0.1
activate = ["quake"]
)"));
  simulation.advance_to(0.05);
  const double w = 4.0 * M_PI, t = 0.2 - simulation.time();
  simulation.switch_over({}, {"quake"});
  simulation.run();
  EXPECT_NEAR(moved(simulation), 3.0 / w * (t - std::sin(w * t) / w), 1e-5);
}

/// The energy balance closes to rounding whatever is written, also where blocks slide and are
/// bolted; what slides slips at the new velocity, not at that of the step behind.
TEST_F(Library, VelocitiesOfWhatSlidesChangeWithoutDrift) {
  Simulation sliding(ramp()), untouched(ramp());
  sliding.step(300);
  untouched.step(301);
  const double drift = sliding.ledger().drift, friction = sliding.ledger().friction;
  const double in_a_step = untouched.ledger().friction - friction;
  const std::size_t slider = *sliding.block_called("slider");
  const MutableNodes vx = sliding.node_vx(), vy = sliding.node_vy();
  for (std::size_t k = 0; k < 3; ++k) {
    vx[k][slider] *= 2.0;
    vy[k][slider] *= 2.0;
  }
  sliding.step(1);
  EXPECT_NEAR(sliding.ledger().drift, drift, 1e-10);
  EXPECT_NEAR(sliding.ledger().friction - friction, 2.0 * in_a_step, 0.05 * in_a_step);

  Simulation held(lone(bolted + std::string("[solver]\nduration = 0.1\n")));
  held.step(50);
  const std::size_t lid = *held.block_called("lid");
  for (int q = 0; q < 20; ++q) {
    held.set_velocity(lid, {0.02 * (q % 3), 0.05 - 0.01 * q}, 0.1);
    held.step(3);
  }
  EXPECT_LT(std::abs(held.ledger().drift), 1e-4);  // corners close and open, too
}

/// As the key `velocity`: no work, and not half a step of weight less.
TEST_F(Library, AVelocitySetBeforeTheFirstStepIsTheFirst) {
  Simulation thrown(Model::parse(falling));
  const std::size_t stone = *thrown.block_called("stone");
  thrown.set_velocity(stone, {2.0, 1.0});
  EXPECT_NEAR(thrown.field(Field::velocity)[2 * stone], 2.0, 1e-12);
  EXPECT_NEAR(thrown.field(Field::velocity)[2 * stone + 1], 1.0, 1e-12);
  EXPECT_EQ(thrown.ledger().external, 0.0);
  thrown.run();
  const double t = thrown.time();
  EXPECT_NEAR(thrown.field(Field::displacement)[2 * stone], 2.0 * t, 1e-9);
}

TEST_F(Library, DampingIsThatOfItsKeys) {
  Simulation simulation(ramp());
  EXPECT_FALSE(faults_of([&] { simulation.set_damping(0.0, 1.0); }).empty());
  EXPECT_TRUE(faults_of([&] { simulation.set_damping(0.0, 0.99); }).empty());
}

TEST_F(Library, ABoltIsInstalledOnce) {
  const std::string stages =
      "[[stage]]\nduration = 0.01\n[[stage]]\nduration = 0.01\ninstall = [\"pin\"]\n";
  const Model model = lone(bolted + stages);
  Simulation simulation(model), staged(model);
  const std::size_t lid = *simulation.block_called("lid");
  EXPECT_FALSE(faults_of([&] { simulation.install({"no bolt"}); }).empty());
  simulation.step(4);
  EXPECT_NEAR(simulation.field(Field::displacement)[2 * lid + 1], 0.0, 1e-12);
  simulation.install({"pin"});
  EXPECT_EQ(problem_of([&] { simulation.install({"pin"}); }), "\"pin\" has been installed before");
  EXPECT_EQ(simulation.run().status, Status::completed);
  staged.run();
  // Pressed together by one pretension, not by two.
  const auto lowest = [&](const Simulation& s) {
    return s.field(Field::displacement)[2 * lid + 1];
  };
  EXPECT_LT(lowest(simulation), 0.0);
  double force = 0.0, twice = 0.0;
  for (const Contact& c : simulation.contacts()) force += c.normal_force;
  for (const Contact& c : staged.contacts()) twice += c.normal_force;
  EXPECT_LT(force, 2.5e4);
  EXPECT_LT(twice, 2.5e4);
  EXPECT_LT(std::abs(simulation.ledger().drift), 1e-3);
}

TEST_F(Library, RockLetsGoOnlyMoreAndOnlyOnceItIsTakenOut) {
  const Model model = Model::read(examples + "tunnel.toml");
  const std::string opening = model.openings().front();
  Simulation simulation(model);
  simulation.step(4);
  EXPECT_NE(problem_of([&] { simulation.relax(opening, 0.5); }).find("not been excavated yet"),
            std::string::npos);
  simulation.excavate({opening});
  simulation.relax(opening, 0.3);
  simulation.step(2);
  simulation.relax(opening, 0.3);
  simulation.relax(opening, 0.6);
  simulation.step(2);
  EXPECT_EQ(problem_of([&] { simulation.relax(opening, 0.5); }),
            "is less than the 0.6 released so far");
  simulation.relax(opening, 1.0);
  simulation.step(2);
  EXPECT_LT(std::abs(simulation.ledger().drift), 1e-3);
}

/// What was taken out and let go by hand is not loaded again.
TEST_F(Library, ALaterStageLeavesWhatHasBeenLetGo) {
  const std::string column = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30
[domain]
outline = [[0, 0], [1, 0], [1, 3], [0, 3]]
joint = "j"
[[opening]]
name = "middle"
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[fixed]]
point = [0.5, 0.5]
[[stage]]
duration = 0.05
[[stage]]
duration = 0.05
excavate = ["middle"]
)";
  const auto falls = [&](const std::string& more) {
    Simulation simulation(Model::parse(column + more));
    simulation.step(10);
    simulation.excavate({"middle"});
    simulation.run();
    return positions(simulation);
  };
  EXPECT_EQ(falls("relax = { middle = 0.5 }\n"), falls(""));
}

TEST_F(Library, DisplacementsCountFromTheirReset) {
  Simulation simulation(lone(std::string(push) + "[solver]\nduration = 0.2\n"));
  simulation.advance_to(0.1);
  const double before = moved(simulation);
  EXPECT_GT(before, 0.0);
  simulation.reset_displacements();
  EXPECT_EQ(moved(simulation), 0.0);
  simulation.run();
  EXPECT_NEAR(moved(simulation), 3.0 * before, 1e-3 * before + 1e-4);
}

}  // namespace
}  // namespace edda::api
