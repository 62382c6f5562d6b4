// The critical step against the true limit.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "step/glued_scene.hpp"
#include "step/step.hpp"

namespace edda::step_bound_test {
namespace {

const std::vector<std::string>& scenes() {
  static const std::vector<std::string> all = {
      // Two joint sets through a rectangle, boundary springs at the base.
      "[domain]\noutline = [[0,0],[6,0],[6,4],[0,4]]\n[[joint_set]]\nname = 'a'\nangle = 65\n"
      "spacing = 1.3\n[[joint_set]]\nname = 'b'\nangle = -15\nspacing = 0.9\n"
      "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'fixed'\n",
      // A wall on a fixed base.
      "[[block]]\nfixed = true\npolygon = [[-1,-1],[7,-1],[7,0],[-1,0]]\n"
      "[[brick_wall]]\norigin = [0, 0]\ncolumns = 6\nrows = 5\nbrick = [1.0, 0.5]\n",
      // A column.
      "[[brick_wall]]\norigin = [0, 0]\ncolumns = 1\nrows = 1\nbrick = [1.0, 0.5]\n"
      "[[block]]\npolygon = [[0,0.5],[1,0.5],[1,1.5],[0,1.5]]\n"
      "[[block]]\npolygon = [[0,1.5],[1,1.5],[1,4],[0,4]]\n",
  };
  return all;
}

TEST(StepBound, SafeAndSharp) {
  for (const std::string& geometry : scenes()) {
    for (const char* stiffness : {"2e9", "2e11"}) {
      Simulation s = glued(geometry + "[contact]\nnormal_stiffness = " + stiffness + "\n");
      const double exact = true_critical_step(s);
      RecordProperty("ratio", std::to_string(s.control.bound.critical_step / exact));
      EXPECT_LE(s.control.bound.critical_step, exact * (1.0 + 1e-4));
      // The outer blocks of these scenes touch on some sides only.
      EXPECT_GE(s.control.bound.critical_step, 0.5 * exact);
    }
  }
}

/// A triangle of 1 m stands on its apex, of so many degrees, on a fixed floor, pressed into it.
Simulation on_its_tip(double apex) {
  const std::string half = std::to_string(std::tan(0.5 * apex * std::numbers::pi / 180.0));
  Result<Model> model = read_model_text(
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 60\n[[block]]\nfixed = true\npolygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n"
      "[[block]]\npolygon = [[0,0],[" +
          half + ",1],[-" + half + ",1]]\n[solver]\nduration = 1\n",
      "t.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  Result<Simulation> sim = Simulation::create(std::move(model.value()));
  if (!sim.ok()) ADD_FAILURE() << to_string(sim.faults()[0]);
  for (auto& y : sim.value().motion.state.position.y) y[1] -= 1e-5;
  return std::move(sim.value());
}

/// The two sides of a corner that leans both hold it along the floor.
TEST(StepBound, SafeWhereASharpCornerLeans) {
  for (const double apex : {5.0, 10.0, 20.0, 30.0, 40.0, 60.0, 90.0}) {
    Simulation s = on_its_tip(apex);
    const double exact = true_critical_step(s);
    EXPECT_LE(s.control.bound.critical_step, exact) << apex;
    EXPECT_GE(s.control.bound.critical_step, 0.5 * exact) << apex;
  }
}

/// Whether a small disturbance of all nodes grows at this step.
bool grows(const std::string& model, double damping, double step,
           const std::optional<LawDashpots>& own = {}) {
  char given[80];
  std::snprintf(given, sizeof given, "time_step = %.17g\nallow_unstable = true\n", step);
  Simulation s = glued(given + model, damping, own);
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> u(-1e-9, 1e-9);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      if (s.scene->blocks.fixed[i]) continue;
      s.motion.state.velocity.x[k][i] = u(rng);
      s.motion.state.velocity.y[k][i] = u(rng);
    }
  }
  constexpr int steps = 4000;
  start(s, steps * step);
  for (int n = 0; n < steps; ++n) {
    if (edda::step(s)) return true;
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      if (!(std::abs(s.motion.state.velocity.x[0][i]) < 1e-4)) return true;
    }
  }
  return false;
}

/// With viscous blocks and dashpots at contacts: the step at which a disturbance begins to grow.
TEST(StepBound, SafeAndSharpWithDamping) {
  struct Case {
    double strain, contact;
    const char* stiffness;
  };
  for (const std::string& geometry : scenes()) {
    for (const Case& q : {Case{0.5, 0.0, "normal_stiffness = 2e11"},
                          {0.5, 0.3, "normal_stiffness = 2e11"},
                          {0.0, 0.3, "normal_stiffness = 2e11"},
                          {0.0, 0.5, "normal_stiffness = 2e8"},
                          {0.5, 0.3, "normal_stiffness = 2e8"}}) {
      const std::string model = "damping = { contact = " + std::to_string(q.contact) + " }\n" +
                                geometry + "[contact]\n" + q.stiffness + "\n";
      const double bound = glued(model, q.strain).control.bound.critical_step;
      double stable = bound, unstable = 3.0 * bound;
      EXPECT_FALSE(grows(model, q.strain, 0.9999 * bound)) << q.stiffness << ' ' << q.contact;
      ASSERT_TRUE(grows(model, q.strain, unstable)) << q.stiffness << ' ' << q.contact;
      for (int round = 0; round < 7; ++round) {
        const double middle = 0.5 * (stable + unstable);
        (grows(model, q.strain, middle) ? unstable : stable) = middle;
      }
      // The dashpots of a light block against heavy ones count twice, where once would be enough.
      EXPECT_GT(bound / unstable, q.contact > 0.0 ? 0.35 : 0.45)
          << q.stiffness << ' ' << q.strain << ' ' << q.contact;
    }
  }
}

/// With the dashpots of a restitution, along the tangent, too.
TEST(StepBound, SafeWithDashpotsOfAJoint) {
  for (const std::string& geometry : scenes()) {
    for (const LawDashpots& own :
         {LawDashpots{4.0, 4.0, 20e9 / 15.0}, {2.5, 0.0, 20e9 / 30.0}, {0.0, 3.0, 20e9 / 30.0}}) {
      for (const double strain : {0.0, 0.5}) {
        const double bound = glued(geometry, strain, own).control.bound.critical_step;
        EXPECT_LT(
            bound,
            glued(geometry, strain, LawDashpots{0.0, 0.0, own.spring}).control.bound.critical_step);
        EXPECT_FALSE(grows(geometry, strain, 0.9999 * bound, own))
            << own.damping << ' ' << own.shear_damping << ' ' << strain;
        EXPECT_TRUE(grows(geometry, strain, 8.0 * bound, own))
            << own.damping << ' ' << own.shear_damping << ' ' << strain;
      }
    }
  }
}

}  // namespace
}  // namespace edda::step_bound_test
