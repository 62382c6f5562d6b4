// One step of the implicit method: the state after an attempt that fails, what is kept from list to
// list, dashpots, and the three kinds of mass.
#include <algorithm>

#include "contacts/tile_trials.hpp"
#include "observe/observe.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/tile_step.hpp"
#include "verification/models.hpp"

namespace edda::implicit_step_test {
namespace {

std::string on_floor(const std::string& blocks, const std::string& solver) {
  return R"(
[materials.rock]
density = 2500.0
young = 2e10
poisson = 0.2
deformation = "uniform"
[contact]
normal_stiffness = 2e8
[joints.j]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-6, -1], [6, -1], [6, 0], [-6, 0]]
)" + blocks +
         "[output]\nhistory_every = 0.01\n[solver]\n" + solver;
}

std::string block(double x, double y, double turn, const std::string& more = "") {
  std::string text = "[[block]]\n" + more + "polygon = [";
  for (const Vec2 corner : {Vec2{-.5, -.5}, Vec2{.5, -.5}, Vec2{.5, .5}, Vec2{-.5, .5}}) {
    const Vec2 p = rotated(corner, turn) + Vec2{x, y};
    text += "[" + number(p.x) + "," + number(p.y) + "],";
  }
  return text + "]\n";
}

void expect_same(const std::vector<FaceFields>& is, const std::vector<FaceFields>& was) {
  ASSERT_EQ(is.size(), was.size());
  for (std::size_t k = 0; k < is.size(); ++k) {
    for (const FaceField& field : face_fields)
      EXPECT_EQ(is[k].*field.value, was[k].*field.value) << field.name << " of face " << k;
  }
}

/// An attempt that fails leaves positions, velocities, pose and contacts as they were, bit for bit,
/// with contacts that slide, close and open in it.
TEST(ImplicitAttempt, LeavesEverythingAsItWas) {
  Simulation sim =
      scene(on_floor(block(0, 0.501, 0.0, "velocity = [1.0, -1.0]\n") + block(0.2, 1.52, 0.01) +
                         block(-2, 0.8, 0.3) + block(-4, 0.5, 0.0, "velocity = [3.0, 0.0]\n"),
                     "method = 'dda'\nduration = 0.2\ntime_step = 1e-3\n"));
  run(sim, [](Simulation&) {});
  const State state = sim.motion.state;
  const Pose pose = sim.motion.pose;
  put_faces(sim, take_faces(sim));  // as by a stage or a checkpoint
  drop_trial(sim.motion.tiled.tiles);
  const FaceSet c = sim.motion.contacts;
  const FaceStates was = take_faces(sim);
  const std::vector<double> damping = sim.accounts.damping_work.joules;
  ImplicitSettings settings;
  settings.step = 1e-2;
  settings.displacement_limit = 1e-5;
  const Attempt attempt = newmark_step(sim.implicit,
                                       {sim.scene->blocks, sim.motion.masses, sim.motion.laws,
                                        sim.attached.springs, sim.scene->model.gravity},
                                       settings, sim.motion.state, sim.motion.pose,
                                       {sim.motion.contacts, sim.motion.tiled}, sim.motion.forces,
                                       sim.accounts.damping_work.joules);
  ASSERT_EQ(attempt, Attempt::too_far);
  EXPECT_EQ(sim.motion.state.position.x, state.position.x);
  EXPECT_EQ(sim.motion.state.position.y, state.position.y);
  EXPECT_EQ(sim.motion.state.velocity.x, state.velocity.x);
  EXPECT_EQ(sim.motion.state.velocity.y, state.velocity.y);
  EXPECT_EQ(sim.motion.pose.x, pose.x);
  EXPECT_EQ(sim.motion.pose.y, pose.y);
  std::size_t sliding = 0;
  for (std::size_t k = 0; k < c.size(); ++k) sliding += slides(face_row(sim, k)) ? 1 : 0;
  EXPECT_GT(sliding, 0u);
  const FaceStates is = take_faces(sim);
  for (const auto& column : face_properties)
    EXPECT_EQ((sim.motion.contacts.*column.values).values(), (c.*column.values).values())
        << column.name;
  EXPECT_EQ(sim.motion.contacts.flags, c.flags);
  expect_same(is.now, was.now);
  expect_same(is.before, was.before);
  EXPECT_EQ(sim.accounts.damping_work.joules, damping);
}

/// A halved step continues as if it had been the shorter one from the start.
TEST(ImplicitAttempt, ChangesNothingOfTheNextOne) {
  auto after = [](bool fail_first, bool taken_out = false) {
    Simulation sim = scene(on_floor(block(0, 0.5, 0.0, "velocity = [1.0, 0.0]\n"),
                                    "method = 'dda'\nduration = 0.1\ntime_step = 1e-3\n"));
    run(sim, [](Simulation&) {});
    if (taken_out) put_faces(sim, take_faces(sim));
    drop_trial(sim.motion.tiled.tiles);
    const ImplicitScene at{sim.scene->blocks, sim.motion.masses, sim.motion.laws,
                           sim.attached.springs, sim.scene->model.gravity};
    ImplicitSettings settings;
    settings.step = 1e-2;
    settings.displacement_limit = 1e-5;
    auto attempt = [&] {
      return newmark_step(sim.implicit, at, settings, sim.motion.state, sim.motion.pose,
                          {sim.motion.contacts, sim.motion.tiled}, sim.motion.forces,
                          sim.accounts.damping_work.joules);
    };
    if (fail_first) {
      EXPECT_EQ(attempt(), Attempt::too_far);
    }
    settings = {};
    settings.step = 1e-3;
    settings.displacement_limit = 1e-2;
    EXPECT_EQ(attempt(), Attempt::accepted);
    return sim;
  };
  Simulation once = after(false), again = after(true);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(once.motion.state.position.x[k][1], again.motion.state.position.x[k][1], 1e-12);
    EXPECT_NEAR(once.motion.state.position.y[k][1], again.motion.state.position.y[k][1], 1e-12);
  }
  // Nor do faces that were taken out of their tiles before the step that fails, as by a stage or a
  // checkpoint.
  Simulation resumed = after(true, true);
  EXPECT_EQ(again.motion.state.position.x, resumed.motion.state.position.x);
  EXPECT_EQ(again.implicit.springs.state, resumed.implicit.springs.state);
  EXPECT_EQ(again.implicit.switched, resumed.implicit.switched);
  expect_same(take_faces(again).now, take_faces(resumed).now);
  EXPECT_GT(std::count_if(again.implicit.springs.state.begin(), again.implicit.springs.state.end(),
                          [](std::uint8_t state) { return state > 3; }),
            0);
}

/// New lists of faces under a sliding block require no new order of the equations.
TEST(ImplicitSolver, KeepsItsOrderWhileNeighboursStay) {
  Simulation sim = scene(on_floor(block(-2, 0.5, 0.0, "velocity = [4.0, 0.0]\n") +
                                      block(-2, 1.5, 0.0, "velocity = [4.0, 0.0]\n"),
                                  "method = 'dda'\nduration = 0.5\ntime_step = 2e-3\n"));
  run(sim, [](Simulation&) {});
  EXPECT_GT(sim.motion.contacts.rebuilds, 12u);
  EXPECT_EQ(sim.implicit.linear.counts().orderings, 1u);
}

struct Bounce {
  double up = 0.0;       ///< largest velocity after the impact, m/s
  double largest = 0.0;  ///< largest total normal force at the rows, N
  double damping = 0.0, error = 0.0;
};

Bounce bounce(const std::string& method) {
  Simulation sim = scene("gravity = [0, 0]\n" +
                         on_floor(block(0, 0.51, 0.0, "velocity = [0.0, -1.0]\n"),
                                  "duration = 0.05\ndamping = { contact = 0.2 }\n" + method));
  sim.scene.edit().model.output.history_every = 1e-4;
  Bounce b;
  Instant now;
  run(sim, [&](Simulation& s) {
    observe(s, now);
    double normal = 0.0;
    for (std::size_t k = 0; k < s.motion.contacts.size(); ++k)
      normal += normal_force(face_row(s, k));
    b.largest = std::max(b.largest, normal);
    b.up = centroid(s.motion.state.velocity, 1).y;
    const EnergyBalance l = account_energy(s);
    b.damping = l.damping;
    b.error = std::max(b.error, std::abs(l.error));
  });
  return b;
}

/// Dashpots on both contacts of a falling square: it rebounds as from a damped spring without
/// tension, and both methods agree on this and on the reported force, its viscous part included.
TEST(ImplicitContactDamping, GivesTheReboundOfADampedSpring) {
  const Bounce a = bounce("time_step = 1e-6\n"), b = bounce("method = 'dda'\ntime_step = 1e-5\n");
  EXPECT_NEAR(b.up / a.up, 1.0, 1e-2);
  EXPECT_NEAR(b.largest / a.largest, 1.0, 1e-2);
  EXPECT_NEAR(b.damping / a.damping, 1.0, 1e-2);
  EXPECT_LT(b.error, 1e-6);
  EXPECT_GT(a.damping, 0.3 * 1250.0);
}

/// Rotation (rad) of a square dropped on one corner, after 0.25 s.
double turned(const std::string& mass) {
  Simulation sim = scene(on_floor(block(0, 0.75, 0.3),
                                  "method = 'dda'\nduration = 0.25\ntime_step = 1e-4\n"
                                  "mass = '" +
                                      mass + "'\n"));
  run(sim, [](Simulation&) {});
  const Rotation r = rotation(deformation(sim.scene->blocks, sim.motion.state.position, 1));
  return std::atan2(r.s, r.c);
}

/// Matched mass is the consistent one on another cover; the covering triangle's lumped mass has
/// more inertia and rotates less.
TEST(ImplicitMass, MatchedIsConsistentAndCoveringIsHeavier) {
  const double matched = turned("matched"), consistent = turned("consistent");
  EXPECT_GT(std::abs(matched), 0.1);
  EXPECT_NEAR(consistent / matched, 1.0, 1e-4);
  EXPECT_LT(turned("covering") / matched, 0.9);
}

}  // namespace
}  // namespace edda::implicit_step_test
