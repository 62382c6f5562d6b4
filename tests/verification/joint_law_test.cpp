// Direct shear of one joint: validation.md rows 46 to 48. A block is thrown along a level joint and
// slides until friction stops it; the normal load is its weight and that of a pressure.
#include <cmath>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::joint_law_test {
namespace {

constexpr double length = 2.0, height = 0.2, density = 2500.0, gravity = 10.0, start = 0.5;

/// `pressure` on top, Pa. Stiffness and damping are those that the program chooses.
std::string thrown(const std::string& law, double pressure = 0.0, double duration = 0.15) {
  std::string text =
      "gravity = [0, -10]\n[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = "
      "0\n[joints.j]\n" +
      law +
      "[[block]]\nfixed = true\npolygon = [[-3, -1], [9, -1], "
      "[9, 0], [-3, 0]]\n[[block]]\nvelocity = [0.5, 0]\npolygon = " +
      rectangle(0, 0, length, height) + "\n[solver]\nduration = " + number(duration) +
      "\n[output]\nhistory_every = 0.0025\n";
  if (pressure > 0.0) {
    text += "[[load]]\nalong = [[0, 0.2], [2, 0.2]]\npressure = " + number(pressure) + "\n";
  }
  return text;
}

double normal_load(double pressure) {
  return length * (height * density * gravity + pressure);
}

/// Results of a shear test: the work of friction over the normal load, the slip, and the rise of
/// the block.
struct Shown {
  double slip = 0.0, work = 0.0, rise = 0.0, error = 0.0;
};

/// Runs it; the energy balance must close, and friction may only dissipate.
Shown shear(Simulation& sim, double pressure, const std::function<void(const Shown&)>& each = {}) {
  Shown shown;
  double first_y = 0.0, before = 0.0;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    keep_largest(shown.error, l.error);
    EXPECT_GE(l.friction, before - 1e-9 * l.kinetic);
    before = l.friction;
    const Vec2 u = displacement(s, 1);
    if (s.motion.state.time < 0.01) first_y = u.y;
    shown.slip = u.x;
    shown.work = l.friction / normal_load(pressure);
    shown.rise = u.y - first_y;
    if (each) each(shown);
  });
  EXPECT_LT(shown.error, 1e-5);
  return shown;
}

/// Integral of f from 0 to s.
double integral(const std::function<double(double)>& f, double s) {
  constexpr int n = 2000;
  double sum = 0.0;
  for (int q = 0; q < n; ++q) sum += f((q + 0.5) * s / n);
  return sum * s / n;
}

/// Row 46: tan(phi) falls from tan 40 to tan 20 over 8 mm.
TEST(DirectShear, SlipWeakening) {
  const std::string law =
      "type = 'slip-weakening'\nfriction_angle = 40\nresidual = { friction_angle = 20 }\n"
      "slip_distance = 0.008\n";
  const auto friction = [](double u) {
    const double peak = std::tan(radians(40)), residual = std::tan(radians(20));
    return peak + (residual - peak) * std::min(u / 0.008, 1.0);
  };
  Simulation sim = scene(thrown(law));
  Series series(46, "", {"slip", "exact", "computed"});
  const Shown shown = shear(sim, 0.0, [&](const Shown& s) {
    series.add({s.slip, integral(friction, s.slip), s.work});
  });
  expect_relative({46, "", "work of friction over normal load", "m"}, shown.work,
                  integral(friction, shown.slip), 5e-3);
  // The block has stopped by then.
  double stops = 0.0;
  while (gravity * integral(friction, stops) < 0.5 * start * start) stops += 1e-5;
  expect_relative({46, "", "slip until it stops", "m"}, shown.slip, stops, 1e-2);
  record_model(46, "", sim);
  const std::vector<double> slip_so_far = sim.motion.contacts.slip_so_far.values();
  EXPECT_GT(*std::max_element(slip_so_far.begin(), slip_so_far.end()), 0.0);
}

/// Cohesion depends on slip, too: no bond breaks, and its dissipation is friction.
TEST(DirectShear, SlipWeakeningTakesCohesionAway) {
  const double c = 4e3;
  const std::string law = "type = 'slip-weakening'\nfriction_angle = 20\ncohesion = " + number(c) +
                          "\nslip_distance = 0.004\n";
  const auto strength = [&](double u) {
    return std::tan(radians(20)) + c * length * std::max(1.0 - u / 0.004, 0.0) / normal_load(0.0);
  };
  Simulation sim = scene(thrown(law));
  EXPECT_EQ(bonded_faces(sim), 0u);
  const Shown shown = shear(sim, 0.0);
  EXPECT_NEAR(shown.work / integral(strength, shown.slip), 1.0, 1e-2);
}

/// A stiff block on a level joint under gravity (0, -g), in equilibrium by damping until drive()
/// removes it. `soft`: springs as stiff as the rock and a little contact damping.
Simulation driven(const std::string& law, double g, double duration, bool soft = false,
                  Vec2 size = {length, height}, const std::string& more = {}) {
  std::string text = more + thrown(law, 0.0, duration);
  text.replace(text.find("[0, -10]"), 8, "[0, " + number(-g) + "]");
  text.replace(text.find("young = 2e8"), 11, "young = 2e10");
  text.replace(text.find("velocity = [0.5, 0]\n"), 20, "");
  const std::string drawn = rectangle(0, 0, length, height);
  text.replace(text.find(drawn), drawn.size(), rectangle(0, 0, size.x, size.y));
  const std::string contact = soft ? "contact = 0.2, " : "";
  text.insert(text.find("\n[output]"), "\ndamping = { " + contact + "mass = 1e4 }");
  if (soft) text.insert(text.find("[[block]]"), "[contact]\nnormal_stiffness = 2e10\n");
  return scene(text);
}

/// Largest deviations of slip and opening from `slip` (m, over the time since the release) and
/// `opening` (m, over the slip), over the second half of the slip `until`.
struct Ways {
  FurthestOff slip, opening;
  double end = 0.0;  ///< m, of the slip
};

Ways drive(Simulation& sim, double gx, const std::function<double(double)>& slip,
           const std::function<double(double)>& opening, double until, Series& series) {
  Ways ways;
  const double damped_time = 0.01;
  edda::start(sim, damped_time);
  Vec2 at_start;
  double friction = 0.0;
  while (sim.motion.state.time < sim.scene->model.solver.duration) {
    if (sim.motion.state.time >= damped_time && sim.motion.damping.mass > 0.0) {
      sim.motion.damping.mass = 0.0;
      sim.scene.edit().model.gravity.x = gx;
      at_start = displacement(sim, 1);
    }
    if (sim.motion.state.time >= damped_time) fit_step_to(sim, sim.scene->model.solver.duration);
    if (step(sim)) {
      ADD_FAILURE() << "diverged";
      return ways;
    }
    const EnergyBalance l = account_energy(sim);
    EXPECT_GE(l.friction, friction - 1e-6 * sim.accounts.largest_energy);
    friction = l.friction;
    if (sim.motion.damping.mass > 0.0) continue;  // a change of gravity is no work
    const Vec2 u = displacement(sim, 1) - at_start;
    ways.end = u.x;
    if (u.x < 0.5 * until || u.x > until) continue;
    ways.slip.see(u.x, slip(sim.motion.state.time - damped_time));
    ways.opening.see(u.y, opening(u.x));
    if (sim.motion.state.steps % 16 == 0) series.add({u.x, opening(u.x), u.y});
  }
  return ways;
}

/// Row 47: a joint of 30 degrees that opens at 5 degrees over 10 mm of slip. Pulled by m gx,
/// pressed by N = m (g + a tan(psi)): a = (gx - g tan(phi))/(1 + tan(phi) tan(psi)), and it rises
/// by tan(psi) u. In a step it rises by up to 50 times its closure under its weight where it is
/// flat.
void expect_dilation(const std::string& label, bool soft, Vec2 size, double excess = 1.0,
                     double bound = 1e-2) {
  const std::string law = "friction_angle = 30\ndilation_angle = 5\nslip_distance = 0.01\n";
  const double t = std::tan(radians(30)), psi = std::tan(radians(5)), g = 10.0;
  Simulation sim = driven(law, g, 0.01 + 0.16 / std::sqrt(excess), soft, size);
  const double a = excess / (1.0 + t * psi);
  Series series(47, label, {"slip", "exact", "computed"});
  const Ways ways = drive(
      sim, g * t + excess, [&](double time) { return 0.5 * a * time * time; },
      [&](double u) { return psi * u; }, 0.0098, series);
  ways.slip.expect({47, label, "distance slid, furthest off", "m"}, 2e-2);
  ways.opening.expect({47, label, "opening, furthest off", "m"}, bound);
  EXPECT_GT(ways.end, 0.01);
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
  record_model(47, label, sim);
}

TEST(DirectShear, Dilation) {
  expect_dilation("soft contacts", true, {2.0, 0.2});
  expect_dilation("2 x 0.2 m", false, {2.0, 0.2});
  expect_dilation("1 x 0.5 m", false, {1.0, 0.5});
  expect_dilation("1 x 0.1 m", false, {1.0, 0.1});
  expect_dilation("2 x 0.2 m, six times the excess", false, {2.0, 0.2}, 6.0);
}

/// Row 48: Barton and Bandis at three normal stresses. With mass damping so strong that it creeps,
/// the block sticks at 0.99 of tan(phi_r + JRC log10(JCS/sigma)) and slides at 1.01, dilating at
/// half of the angle above phi_r. (The peak is at l/500 (JRC/l)^0.33 = 6.6 mm of slip, more than
/// the block slips here.)
TEST(DirectShear, BartonBandisPeak) {
  const std::string law = "type = 'barton-bandis'\njrc = 9\njcs = 60e6\nresidual_angle = 28\n";
  for (const double sigma : {0.1e6, 0.5e6, 2e6}) {
    const double g = sigma / (density * height);
    const double angle = 28.0 + 9.0 * std::log10(60e6 / sigma), t = std::tan(radians(angle));
    const std::string label = brief(sigma / 1e6) + " MPa";
    double low = 0.93, high = 1.1;
    bool seen = false;
    while (high - low > 0.01) {
      const double middle = 0.5 * (low + high);
      // Under so strong a damping a block that bends would creep for seconds.
      Simulation sim = driven(law, g, 0.06, false, {length, height}, "deformation = 'uniform'\n");
      edda::start(sim, 0.02);
      while (sim.motion.state.time < 0.02) ASSERT_FALSE(step(sim));
      const Vec2 at_start = displacement(sim, 1);
      sim.scene.edit().model.gravity.x = middle * g * t;
      fit_step_to(sim, 0.04);
      while (sim.motion.state.time < 0.04) ASSERT_FALSE(step(sim));
      const Vec2 halfway = displacement(sim, 1);
      fit_step_to(sim, 0.06);
      while (sim.motion.state.time < 0.06) ASSERT_FALSE(step(sim));
      const Vec2 u = displacement(sim, 1) - halfway;
      const bool goes = u.x > 0.02 * (halfway.x - at_start.x);
      (goes ? high : low) = middle;
      if (!goes || seen) continue;
      seen = true;
      expect_relative({48, label, "opening over slip", ""}, u.y / u.x,
                      std::tan(radians(0.5 * (angle - 28.0))), 3e-2);
      record_model(48, label, sim);
    }
    expect_relative({48, label, "shear over normal stress at which it slides", ""},
                    0.5 * (low + high) * t, t, 1e-2);
  }
}

}  // namespace
}  // namespace edda::joint_law_test
