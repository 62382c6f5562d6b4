// The invariants hold in a correct simulation after each step, and each violation is detected.
#include "step/invariants.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "run/prepared.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda::invariants_test {
namespace {

const char* const slider = R"(
[materials.rock]
density = 2600.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 20.0
[contact]
joint = "j"
[[block]]
name = "floor"
fixed = true
polygon = [[-4, -1], [8, -1], [8, 0], [-4, 0]]
[[block]]
name = "slider"
velocity = [1.0, 0.0]
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[solver]
duration = 0.1
)";

Simulation sliding() {
  Simulation sim = std::move(testing::prepared(slider).sim);
  start(sim, 0.1);
  for (int n = 0; n < 40; ++n) {
    EXPECT_FALSE(edda::step(sim));
    EXPECT_EQ(broken_invariant(sim), "");
  }
  return sim;
}

/// Face that carries load.
std::size_t loaded(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (face_row(sim, k).state.energy > 0.0) return k;
  }
  ADD_FAILURE() << "no face carries load";
  return 0;
}

TEST(Invariants, AreSeenWhereTheyAreBroken) {
  const auto expect = [](const char* what, const std::function<void(Simulation&, std::size_t)>& f) {
    Simulation sim = sliding();
    f(sim, loaded(sim));
    EXPECT_NE(broken_invariant(sim).find(what), std::string::npos)
        << what << ": " << broken_invariant(sim);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect("block 1 is not finite",
         [&](Simulation& s, std::size_t) { s.motion.state.velocity.x[1][1] = nan; });
  expect("block 1 is not finite", [&](Simulation& s, std::size_t) {
    s.motion.state.velocity.modes.x[s.scene->blocks.modes(1)[0]] = nan;
  });
  expect("edges are out of range", [](Simulation& s, std::size_t k) {
    std::swap(s.motion.contacts.edge[k], s.motion.contacts.facing[k]);
  });
  expect("joins a block to itself", [](Simulation& s, std::size_t k) {
    s.motion.contacts.facing[k] = s.motion.contacts.edge[k] + 1;
  });
  expect("has no law", [](Simulation& s, std::size_t k) { s.motion.contacts.law[k] = 99; });
  const auto with = [](double FaceFields::*field, double value) {
    return [=](Simulation& s, std::size_t k) {
      change_faces(s, [&](FaceSet&, FaceStates& states) { states.now[k].*field = value; });
    };
  };
  expect("slip_a is not finite", with(&FaceFields::slip_a, nan));
  expect("friction creates energy", with(&FaceFields::friction_work, -1.0));
  expect("more shear than its limit", with(&FaceFields::shear_a, 1e9));
  expect("stores less than nothing",
         [](Simulation& s, std::size_t k) { s.motion.contacts.stiffness[k] = -1.0; });
  expect("is past the event", [](Simulation& s, std::size_t) { s.motion.state.time = 0.2; });
}

}  // namespace
}  // namespace edda::invariants_test
