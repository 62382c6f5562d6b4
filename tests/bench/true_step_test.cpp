// The true limit of the step against what blocks do at steps just below and above it.
#include "true_step.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"

#include <gtest/gtest.h>

#include "run/prepared.hpp"

namespace edda::true_step_test {
namespace {

/// A block that has come to rest on a base, where friction holds it.
Simulation at_rest(const std::string& polygon) {
  Simulation sim = testing::prepared(
                       "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n"
                       "damping = 0\n[joints.j]\nfriction_angle = 80\n[contact]\n"
                       "normal_stiffness = 2e9\n[solver]\nduration = 1\n"
                       "damping = { local = 0.8 }\n[[block]]\nfixed = true\n"
                       "polygon = [[-3,-1],[5,-1],[5,0],[-3,0]]\n[[block]]\npolygon = " +
                       polygon + "\n")
                       .sim;
  start(sim, 1e4 * sim.control.limit);
  for (int n = 0; n < 6000; ++n) EXPECT_FALSE(step(sim));
  change_damping(sim, {}, true);
  return sim;
}

bool grows(Simulation sim, double step) {
  sim.scene.edit().model.solver.time_step = step;
  sim.scene.edit().model.solver.allow_unstable = true;
  change_damping(sim, {}, true);
  constexpr int steps = 1000;
  fit_step_to(sim, sim.motion.state.time + steps * step);
  for (int n = 0; n < steps; ++n) {
    if (edda::step(sim)) return true;
  }
  constexpr double much = 1e-5;  // m/s
  return norm(centroid(sim.motion.state.velocity, 1)) > much;
}

TEST(TrueStep, IsWhereMotionBeginsToGrow) {
  for (const char* polygon : {"[[0,0],[1,0],[1,1],[0,1]]", "[[0,0],[2,0],[2,1.1547]]",
                              "[[0,0],[2,0],[1,0.3527]]", "[[0,0],[2,0],[3.5,0.8],[1.5,0.8]]"}) {
    const Simulation sim = at_rest(polygon);
    const double limit = true_critical_step(sim, Carrying::now, 2000);
    EXPECT_FALSE(grows(sim, 0.98 * limit)) << polygon;
    EXPECT_TRUE(grows(sim, 1.02 * limit)) << polygon;
    // What would carry if it touched makes it no longer, and the bound counts all of that.
    const double of_all = true_critical_step(sim, Carrying::may, 2000);
    EXPECT_LE(of_all, limit * (1.0 + 1e-6)) << polygon;
    EXPECT_GE(of_all, sim.control.bound.critical_step * (1.0 - 1e-4)) << polygon;
  }
}

}  // namespace
}  // namespace edda::true_step_test
