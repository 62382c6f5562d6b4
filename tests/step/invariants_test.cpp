// The invariants hold in a correct simulation after each step, and each violation is detected.
#include "step/invariants.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "run/prepared.hpp"
#include "step/step.hpp"

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
    if (c.now.energy[k] > 0.0) return k;
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
  expect("node 1 of block 1 is not finite",
         [&](Simulation& s, std::size_t) { s.motion.state.vx[1][1] = nan; });
  expect("edges are out of range", [](Simulation& s, std::size_t k) {
    std::swap(s.motion.contacts.edge[k], s.motion.contacts.facing[k]);
  });
  expect("joins a block to itself", [](Simulation& s, std::size_t k) {
    s.motion.contacts.facing[k] = s.motion.contacts.edge[k] + 1;
  });
  expect("has no law", [](Simulation& s, std::size_t k) { s.motion.contacts.law[k] = 99; });
  expect("closure_a is not finite",
         [&](Simulation& s, std::size_t k) { s.motion.contacts.now.closure_a[k] = nan; });
  expect("gate is out of",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.gate[k] = 1.1; });
  expect("stores less than nothing",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.energy[k] = -1.0; });
  expect("friction creates energy",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.friction_work[k] = -1.0; });
  expect("overlap is negative",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.length[k] = -1.0; });
  expect("an end lies beyond its edge",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.xi_b[k] = 1.1; });
  expect("more shear than its limit",
         [](Simulation& s, std::size_t k) { s.motion.contacts.now.shear_a[k] *= 2.0; });
  expect("is past the event", [](Simulation& s, std::size_t) { s.motion.state.time = 0.2; });
}

}  // namespace
}  // namespace edda::invariants_test
