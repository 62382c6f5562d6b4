// Direct shear of one joint: validation.md rows 46 to 48. A block is thrown along a level joint and
// slides until friction has taken its motion; the normal load is its weight and that of a pressure.
#include <cmath>

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

/// What a shear test shows: the work of friction over the normal load, against the way slid, and
/// how far the block rises.
struct Shown {
  double slip = 0.0, work = 0.0, rise = 0.0, drift = 0.0;
};

/// Runs it; the ledger must close, and friction only take.
Shown shear(Simulation& sim, double pressure, const std::function<void(const Shown&)>& each = {}) {
  Shown shown;
  double settled = 0.0, before = 0.0;
  run(sim, [&](Simulation& s) {
    const Ledger l = s.ledger();
    keep_largest(shown.drift, l.drift);
    EXPECT_GE(l.friction, before - 1e-9 * l.kinetic);
    before = l.friction;
    const Vec2 u = displacement(s, 1);
    if (s.state.time < 0.01) settled = u.y;
    shown.slip = u.x;
    shown.work = l.friction / normal_load(pressure);
    shown.rise = u.y - settled;
    if (each) each(shown);
  });
  EXPECT_LT(shown.drift, 1e-5);
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
  // All of the motion is gone by then.
  double stops = 0.0;
  while (gravity * integral(friction, stops) < 0.5 * start * start) stops += 1e-5;
  expect_relative({46, "", "slip until it stops", "m"}, shown.slip, stops, 1e-2);
  record_model(46, "", sim);
  const std::vector<double> slid = sim.contacts.slid.values();
  EXPECT_GT(*std::max_element(slid.begin(), slid.end()), 0.0);
}

/// Cohesion goes with slip, too: no segment breaks, and what it takes is friction.
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

/// A block on a level joint under gravity (0, -g), stiff, settled by damping until drive() lets it
/// go. `soft`: springs as stiff as the rock and a little damping of contacts, for a joint that
/// forgets its dilation as soon as it opens.
Simulation driven(const std::string& law, double g, double duration, bool soft = false) {
  std::string text = thrown(law, 0.0, duration);
  text.replace(text.find("[0, -10]"), 8, "[0, " + number(-g) + "]");
  text.replace(text.find("young = 2e8"), 11, "young = 2e10");
  text.replace(text.find("velocity = [0.5, 0]\n"), 20, "");
  const std::string contact = soft ? "contact = 0.2, " : "";
  text.insert(text.find("\n[output]"), "\ndamping = { " + contact + "mass = 1e4 }");
  if (soft) text.insert(text.find("[[block]]"), "[contact]\nnormal_stiffness = 2e10\n");
  return scene(text);
}

/// Largest departures of the way slid and of the opening from `slip` (m, of the time since it was
/// let go) and `opening` (m, of the slip), over the second half of the way `until`.
struct Ways {
  FurthestOff slip, opening;
  double end = 0.0;  ///< m, of the slip
};

Ways drive(Simulation& sim, double gx, const std::function<double(double)>& slip,
           const std::function<double(double)>& opening, double until, Series& series) {
  Ways ways;
  const double settle = 0.01;
  sim.start(settle);
  Vec2 at_rest;
  double friction = 0.0;
  while (sim.state.time < sim.model.solver.duration) {
    if (sim.state.time >= settle && sim.damping.mass > 0.0) {
      sim.damping.mass = 0.0;
      sim.model.gravity.x = gx;
      at_rest = displacement(sim, 1);
    }
    if (sim.state.time >= settle) sim.aim_at(sim.model.solver.duration);
    if (sim.step()) {
      ADD_FAILURE() << "diverged";
      return ways;
    }
    const Ledger l = sim.ledger();
    EXPECT_GE(l.friction, friction - 1e-6 * sim.largest_energy);
    friction = l.friction;
    if (sim.damping.mass > 0.0) continue;  // a change of gravity is no work
    const Vec2 u = displacement(sim, 1) - at_rest;
    ways.end = u.x;
    if (u.x < 0.5 * until || u.x > until) continue;
    ways.slip.see(u.x, slip(sim.state.time - settle));
    ways.opening.see(u.y, opening(u.x));
    if (sim.state.steps % 16 == 0) series.add({u.x, opening(u.x), u.y});
  }
  return ways;
}

/// Row 47: a joint of 30 degrees that opens at 5 degrees over 10 mm of slip. Pulled by m gx,
/// pressed by N = m (g + a tan(psi)): a = (gx - g tan(phi))/(1 + tan(phi) tan(psi)), and it rises
/// by tan(psi) u. On stiff contacts the block hops, and the joint opens as much all the same.
void expect_dilation(bool soft, double bound) {
  const std::string law = "friction_angle = 30\ndilation_angle = 5\nslip_distance = 0.01\n";
  const double t = std::tan(radians(30)), psi = std::tan(radians(5)), g = 10.0, excess = 1.0;
  Simulation sim = driven(law, g, 0.17, soft);
  const double a = excess / (1.0 + t * psi);
  const std::string label = soft ? "" : "stiff contacts";
  Series series(47, label, {"slip", "exact", "computed"});
  const Ways ways = drive(
      sim, g * t + excess, [&](double time) { return 0.5 * a * time * time; },
      [&](double u) { return psi * u; }, 0.0098, series);
  ways.slip.expect({47, label, "way slid, furthest off", "m"}, 2e-2);
  ways.opening.expect({47, label, "opening, furthest off", "m"}, bound);
  EXPECT_GT(ways.end, 0.01);
  record_model(47, label, sim);
}

TEST(DirectShear, Dilation) {
  expect_dilation(true, 1e-2);
  expect_dilation(false, 4e-2);
}

/// Row 48: Barton and Bandis at three normal stresses. Pulled in so thick a fluid that it creeps,
/// the block holds at 0.99 of tan(phi_r + JRC log10(JCS/sigma)), and goes at 1.01, rising by half
/// of what is above phi_r. (The peak is at l/500 (JRC/l)^0.33 = 6.6 mm of slip, further than it
/// comes.)
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
      Simulation sim = driven(law, g, 0.06);
      sim.start(0.02);
      while (sim.state.time < 0.02) ASSERT_FALSE(sim.step());
      const Vec2 at_rest = displacement(sim, 1);
      sim.model.gravity.x = middle * g * t;
      sim.aim_at(0.04);
      while (sim.state.time < 0.04) ASSERT_FALSE(sim.step());
      const Vec2 settled = displacement(sim, 1);
      sim.aim_at(0.06);
      while (sim.state.time < 0.06) ASSERT_FALSE(sim.step());
      const Vec2 u = displacement(sim, 1) - settled;
      const bool goes = u.x > 0.02 * (settled.x - at_rest.x);
      (goes ? high : low) = middle;
      if (!goes || seen) continue;
      seen = true;
      expect_relative({48, label, "opening over slip", ""}, u.y / u.x,
                      std::tan(radians(0.5 * (angle - 28.0))), 3e-2);
      record_model(48, label, sim);
    }
    expect_relative({48, label, "shear over normal stress at which it goes", ""},
                    0.5 * (low + high) * t, t, 1e-2);
  }
}

}  // namespace
}  // namespace edda::joint_law_test
