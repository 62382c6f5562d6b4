// One step of the implicit method: what it leaves behind when it fails, what it keeps from list to
// list, its dashpots, and the three kinds of mass.
#include <algorithm>

#include "run/observe.hpp"
#include "verification/models.hpp"

namespace edda::implicit_step_test {
namespace {

std::string on_floor(const std::string& blocks, const std::string& solver) {
  return R"(
[materials.rock]
density = 2500.0
young = 2e10
poisson = 0.2
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

/// An attempt that fails leaves positions, velocities, pose and contacts as they were, bit for bit,
/// with contacts that slide, close and open in it.
TEST(ImplicitAttempt, LeavesEverythingAsItWas) {
  Simulation sim = scene(on_floor(block(0, 0.501, 0.0, "velocity = [1.0, -1.0]\n") +
                                      block(0.2, 1.52, 0.01) + block(-2, 0.8, 0.3),
                                  "method = 'dda'\nduration = 0.2\ntime_step = 1e-3\n"));
  run(sim, [](Simulation&) {});
  const State state = sim.state;
  const Pose pose = sim.pose;
  const FaceSet c = sim.contacts;
  const std::vector<double> damping = sim.damping_work.joules;
  ImplicitSettings settings;
  settings.step = 1e-2;
  settings.displacement_limit = 1e-5;
  const Attempt attempt =
      newmark_step(sim.implicit, {sim.blocks, sim.laws, sim.springs, sim.model.gravity}, settings,
                   sim.state, sim.pose, sim.contacts, sim.forces, sim.damping_work.joules);
  ASSERT_EQ(attempt, Attempt::too_far);
  EXPECT_EQ(sim.state.x, state.x);
  EXPECT_EQ(sim.state.y, state.y);
  EXPECT_EQ(sim.state.vx, state.vx);
  EXPECT_EQ(sim.state.vy, state.vy);
  EXPECT_EQ(sim.pose.x, pose.x);
  EXPECT_EQ(sim.pose.y, pose.y);
  const auto expect_same = [](const auto& list, const auto& is, const auto& was) {
    for (const auto& column : list) {
      EXPECT_EQ((is.*column.values).values(), (was.*column.values).values()) << column.name;
    }
  };
  expect_same(face_properties, sim.contacts, c);
  expect_same(face_columns, sim.contacts.now, c.now);
  expect_same(face_columns, sim.contacts.before, c.before);
  EXPECT_EQ(sim.contacts.force, c.force);
  EXPECT_EQ(sim.damping_work.joules, damping);
}

/// A cut step goes on as if it had been the shorter one from the start.
TEST(ImplicitAttempt, ChangesNothingOfTheNextOne) {
  auto after = [](bool fail_first) {
    Simulation sim = scene(on_floor(block(0, 0.501, 0.0, "velocity = [1.0, -1.0]\n"),
                                    "method = 'dda'\nduration = 0.1\ntime_step = 1e-3\n"));
    run(sim, [](Simulation&) {});
    const ImplicitScene at{sim.blocks, sim.laws, sim.springs, sim.model.gravity};
    ImplicitSettings settings;
    settings.step = 1e-2;
    settings.displacement_limit = 1e-5;
    auto attempt = [&] {
      return newmark_step(sim.implicit, at, settings, sim.state, sim.pose, sim.contacts, sim.forces,
                          sim.damping_work.joules);
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
  const Simulation once = after(false), again = after(true);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(once.state.x[k][1], again.state.x[k][1], 1e-12);
    EXPECT_NEAR(once.state.y[k][1], again.state.y[k][1], 1e-12);
  }
}

/// Candidate lists made anew under a block that slides along ask for no new order of the equations.
TEST(ImplicitSolver, KeepsItsOrderWhileNeighboursStay) {
  Simulation sim = scene(on_floor(block(-2, 0.5, 0.0, "velocity = [4.0, 0.0]\n") +
                                      block(-2, 1.5, 0.0, "velocity = [4.0, 0.0]\n"),
                                  "method = 'dda'\nduration = 0.5\ntime_step = 2e-3\n"));
  run(sim, [](Simulation&) {});
  EXPECT_GT(sim.contacts.rebuilds, 20u);
  EXPECT_EQ(sim.implicit.linear.counts().orderings, 1u);
}

struct Bounce {
  double up = 0.0;       ///< largest velocity after the impact, m/s
  double largest = 0.0;  ///< total normal force seen in the rows, N
  double damping = 0.0, drift = 0.0;
};

Bounce bounce(const std::string& method) {
  Simulation sim = scene("gravity = [0, 0]\n" +
                         on_floor(block(0, 0.51, 0.0, "velocity = [0.0, -1.0]\n"),
                                  "duration = 0.05\ndamping = { contact = 0.2 }\n" + method));
  sim.model.output.history_every = 1e-4;
  Bounce b;
  Instant now;
  run(sim, [&](Simulation& s) {
    observe(s, now);
    double normal = 0.0;
    for (std::size_t k = 0; k < now.contacts.size(); ++k) {
      normal += normal_force(now.contacts, k);
    }
    b.largest = std::max(b.largest, normal);
    b.up = centroid(s.state.vx, s.state.vy, 1).y;
    const Ledger l = s.ledger();
    b.damping = l.damping;
    b.drift = std::max(b.drift, std::abs(l.drift));
  });
  return b;
}

/// Dashpots on both contacts of a falling square: it leaves with what a damped spring that may not
/// pull gives back, both methods agree on it and on the force in the tables, viscous part included.
TEST(ImplicitContactDamping, GivesTheReboundOfADampedSpring) {
  const Bounce a = bounce("time_step = 1e-6\n"), b = bounce("method = 'dda'\ntime_step = 1e-5\n");
  EXPECT_NEAR(b.up / a.up, 1.0, 1e-2);
  EXPECT_NEAR(b.largest / a.largest, 1.0, 1e-2);
  EXPECT_NEAR(b.damping / a.damping, 1.0, 1e-2);
  EXPECT_LT(b.drift, 1e-6);
  EXPECT_GT(a.damping, 0.3 * 1250.0);
}

/// Turn (rad) of a square dropped on one corner, after 0.25 s.
double turned(const std::string& mass) {
  Simulation sim = scene(on_floor(block(0, 0.75, 0.3),
                                  "method = 'dda'\nduration = 0.25\ntime_step = 1e-4\n"
                                  "mass = '" +
                                      mass + "'\n"));
  run(sim, [](Simulation&) {});
  const Rotation r = rotation(deformation(sim.blocks, sim.state.x, sim.state.y, 1));
  return std::atan2(r.s, r.c);
}

/// Matched mass is the consistent one on another cover; the covering triangle's lumped mass has
/// more inertia and turns less.
TEST(ImplicitMass, MatchedIsConsistentAndCoveringIsHeavier) {
  const double matched = turned("matched"), consistent = turned("consistent");
  EXPECT_GT(std::abs(matched), 0.1);
  EXPECT_NEAR(consistent / matched, 1.0, 1e-4);
  EXPECT_LT(turned("covering") / matched, 0.9);
}

}  // namespace
}  // namespace edda::implicit_step_test
