// Linings against closed-form solutions: beams, their vibration, and a ring under pressure:
// validation.md rows 81 to 83 and 90, and linings that harden.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "blocks/build_blocks.hpp"
#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::lining_test {
namespace {

using std::numbers::pi;

constexpr double young = 30e9, poisson = 0.2, density = 2500.0, thick = 0.3;
constexpr double in_plane = young / (1.0 - poisson * poisson);
constexpr double bending = in_plane * thick * thick * thick / 12.0, axial = in_plane * thick;
constexpr double shear = 5.0 / 6.0 * 12.5e9 * thick;
/// Of the boundary springs of a clamp, at the two corners of a section.
constexpr double spring = 1e12;
constexpr double clamp = 2.0 * spring * (0.5 * thick) * (0.5 * thick);

std::string concrete(const std::string& more) {
  return "gravity = [0, 0]\n[materials.concrete]\ndensity = 2500\nyoung = 30e9\npoisson = 0.2\n"
         "[joints.rough]\nfriction_angle = 30\n" +
         more;
}
std::string lining(const std::string& along, const std::string& more = "") {
  return "[[lining]]\nname = 'beam'\nalong = " + along + "\nthickness = 0.3\n" + more;
}
std::string boundary(const std::string& along, const std::string& type = "fixed") {
  return "[[boundary]]\ntype = '" + type + "'\nstiffness = 1e12\nalong = " + along + "\n";
}
std::string force(Vec2 at, Vec2 f) {
  return "[[load]]\npoint = [" + number(at.x) + ", " + number(at.y) + "]\nforce = [" + number(f.x) +
         ", " + number(f.y) + "]\n";
}
const std::string to_rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n";

/// Middle of section k (0: the first), and its displacement.
Vec2 middle(const Simulation& sim, std::uint32_t k, bool displaced = true) {
  const BlockSet& b = sim.scene->blocks;
  const StripSections s = sections_of(b, 0);
  const auto at = [&](Id v) {
    return Vec2{sim.motion.pose.x[v], sim.motion.pose.y[v]} - (displaced ? b.vertex(v) : Vec2{});
  };
  return 0.5 * (at(s.outer(k)) + at(s.inner(k)));
}
const BeamForces& forces(const Simulation& sim, std::size_t piece) {
  return sim.motion.zones.piece[piece].forces;
}

TEST(Lining, StraightCantilever) {
  constexpr double length = 4.0, load = 1e3;
  const std::string model =
      concrete(lining("[[0, -0.15], [4, -0.15]]", "size = 0.25\n") +
               boundary("[[0, -0.15], [0, 0.15]]") + force({4, 0}, {0, load}) + to_rest);
  const Simulation& sim = settled(model).sim;
  const double exact = load * (length * length * length / (3.0 * bending) + length / shear +
                               length * length / clamp + 0.5 / spring);
  expect_relative({81, "straight", "deflection", "m"}, middle(sim, 16).y, exact, 1e-3);
  expect_relative({81, "straight", "moment at the clamp", "N m"}, forces(sim, 0).moment[0],
                  load * length, 1e-3);
}

TEST(Lining, QuarterCircle) {
  constexpr double radius = 4.0, load = 1e3;
  std::string along = "[";
  for (int k = 0; k <= 96; ++k) {
    const double a = 0.5 * pi * k / 96, r = radius + 0.5 * thick;
    along +=
        (k == 0 ? "[" : ", [") + number(r * std::cos(a)) + ", " + number(r * std::sin(a)) + "]";
  }
  // The first section stands at right angles to the first chord.
  const double turn = pi / 384;
  const Vec2 inner = Vec2{radius + 0.5 * thick, 0.0} - thick * Vec2{std::cos(turn), std::sin(turn)};
  const std::string clamped = "[[" + number(radius + 0.5 * thick) + ", 0], [" + number(inner.x) +
                              ", " + number(inner.y) + "]]";
  const std::string model = concrete(lining(along + "]", "size = 1\n") + boundary(clamped) +
                                     force({0, 4}, {0, -load}) + to_rest);
  const Simulation& sim = settled(model).sim;
  const double exact = load * (0.25 * pi * (std::pow(radius, 3) / bending + radius / shear) +
                               radius * radius / clamp + 0.5 / spring);
  expect_relative({81, "quarter circle", "deflection", "m"}, -middle(sim, 96).y, exact, 1e-3);
}

/// The first frequency of a cantilever, after Timoshenko's correction of order (t/L)^2 by Rayleigh:
/// shear and rotary inertia, here (t/2)^2 of the sections.
TEST(Lining, VibrationOfACantilever) {
  constexpr double length = 6.0;
  const std::string model = concrete(
      lining("[[0, -0.15], [6, -0.15]]", "size = 0.25\n") + boundary("[[0, -0.15], [0, 0.15]]") +
      "[[load]]\nname = 'push'\npoint = [6, 0]\nforce = [0, 1e4]\n"
      "[[stage]]\nuntil = 'equilibrium'\n"
      "[[stage]]\ndeactivate = ['push']\nduration = 0.6\n[output]\nevery = 0.001\n");
  Result<Model> read = read_model_text(model, EDDA_SOURCE_DIR "/scene.toml", {});
  ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  std::vector<double> crossings;
  double before = 0.0, time_before = 0.0, error = 0.0;
  RunOptions options;
  options.after_step = [&] {
    const double y = middle(ready.sim, 24).y, t = ready.sim.motion.state.time;
    if (before > 0.0 && y <= 0.0)
      crossings.push_back(time_before + (t - time_before) * before / (before - y));
    before = y;
    time_before = t;
    return false;
  };
  const Result<Outcome> outcome = run_model(ready, options);
  ASSERT_TRUE(outcome.ok());
  error = outcome.value().energy.error;
  ASSERT_GE(crossings.size(), 3u);
  const double period = (crossings.back() - crossings.front()) / double(crossings.size() - 1);
  const double root = 1.875104, square = std::pow(root / length, 4) * bending / (density * thick);
  // Of the first mode: integrals of the squares of its slope and of its curvature and third
  // derivative, by the square of itself: 4.648/L^2 for the slope.
  const double slope = 4.648 / (length * length), inertia = 0.25 * thick * thick;
  const double softer = bending / shear * slope + inertia * slope;
  expect_relative({82, "", "period", "s"}, period, 2.0 * pi / std::sqrt(square / (1.0 + softer)),
                  5e-3);
  EXPECT_LT(std::abs(error), 1e-6);
}

/// A ring in vacuum under pressure from outside: N = -p r, u = p r^2/EA.
TEST(Lining, RingUnderPressure) {
  constexpr double radius = 4.0, pressure = 1e5;
  std::string ring = "[";
  for (int k = 0; k <= 64; ++k) {
    const double a = 2.0 * pi * (k % 64) / 64;
    ring += (k == 0 ? "[" : ", [") + number(radius * std::cos(a)) + ", " +
            number(radius * std::sin(a)) + "]";
  }
  ring += "]";
  const std::string model = concrete(lining(ring, "size = 1\n") + "[[load]]\nalong = " + ring +
                                     "\npressure = 1e5\n[[stage]]\nduration = 0.1\ndamping = "
                                     "{ local = 0.5 }\n");
  const Simulation& sim = settled(model).sim;
  const double mean = radius - 0.5 * thick;
  expect_relative({81, "ring", "thrust", "N"}, -forces(sim, 5).axial, pressure * radius, 2e-3);
  expect_relative({81, "ring", "decrease of the radius", "m"}, -middle(sim, 0).x,
                  pressure * radius * mean / axial, 4e-3);
}

/// A ring under p1, whose concrete becomes as stiff as `later` with the strength given, then under
/// p2.
std::string hardening_ring(double first, double second, const std::string& later) {
  std::string ring = "[";
  for (int k = 0; k <= 64; ++k) {
    const double a = 2.0 * pi * (k % 64) / 64;
    ring +=
        (k == 0 ? "[" : ", [") + number(4.0 * std::cos(a)) + ", " + number(4.0 * std::sin(a)) + "]";
  }
  ring += "]";
  const auto press = [&](const char* name, double pressure) {
    return std::string("[[load]]\nname = '") + name + "'\nalong = " + ring +
           "\npressure = " + number(pressure) + "\n";
  };
  const std::string damped = "duration = 0.1\ndamping = { local = 0.5 }\n";
  return concrete("[materials.hardened]\ndensity = 2500\npoisson = 0.2\n" + later +
                  lining(ring, "size = 1\nmaterial = 'concrete'\n") + press("first", first) +
                  press("second", second) + "[[stage]]\n" + damped + "[[stage]]\n" + damped +
                  "change = [{ material = 'concrete', to = 'hardened' }]\n[[stage]]\n" + damped +
                  "activate = ['second']\n");
}

/// Thrusts are p r. Each load meets the stiffness of its time: u = r r_m (p1/E1 + p2/E2)/t.
TEST(Lining, ConcreteThatHardens) {
  constexpr double radius = 4.0, mean = radius - 0.5 * thick, p = 1e5, q = 3e5;
  Result<Model> read =
      read_model_text(hardening_ring(p, q, "young = 90e9\n"), EDDA_SOURCE_DIR "/scene.toml", {});
  ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  const Simulation& sim = ready.sim;
  std::vector<double> thrust;  // before and after the change
  RunOptions options;
  options.after_step = [&] {
    const double time = sim.motion.state.time;
    if (time > 0.0999 && time < 0.1001) thrust.push_back(-forces(sim, 5).axial);
    return false;
  };
  const Result<Outcome> outcome = run_model(ready, options);
  ASSERT_TRUE(outcome.ok());
  EXPECT_LT(std::abs(outcome.value().energy.error), 1e-6);
  ASSERT_GE(thrust.size(), 2u);
  for (const double f : thrust) EXPECT_NEAR(f, p * radius, 2e-3 * p * radius);
  expect_relative({81, "ring that hardens", "thrust", "N"}, -forces(sim, 5).axial, (p + q) * radius,
                  2e-3);
  expect_relative({81, "ring that hardens", "decrease of the radius", "m"},
                  0.5 * (middle(sim, 32).x - middle(sim, 0).x),
                  (p + q / 3.0) * radius * mean / axial, 4e-3);
}

/// Its sections have the strength of the material that they have by then.
TEST(Lining, StrengthHardensToo) {
  constexpr double radius = 4.0, p = 1e5, q = 3e5, demand = (p + q) * radius;
  for (const double part : {0.75, 4.0}) {
    const double ucs = part * demand / thick;
    const PreparedRun ready = settled(hardening_ring(
        p, q, "young = 30e9\nstrength = { ucs = " + number(ucs) + ", tension = 1e5 }\n"));
    const SectionStrength& strength = ready.sim.scene->zones.strength.front();
    double used = 0.0, least = 1.0;
    for (const BeamState& piece : ready.sim.motion.zones.piece) {
      for (const double moment : piece.forces.moment)
        used = std::max(used, utilisation(strength, piece.forces.axial, moment));
      least = std::min(least, piece.free.length / piece.length);
    }
    EXPECT_NEAR(used, std::min(1.0, 1.0 / part), part < 1.0 ? 1e-6 : 2e-2) << part;
    EXPECT_EQ(least < 0.999, part < 1.0) << part;  // it has been squeezed
  }
}

/// The period in which a free ring of mean radius r swings as an oval, under a pressure p on its
/// outer face that turns with it, Pa.
double ovalling_period(double pressure, double r, double t) {
  const double outer = r + 0.5 * t;
  std::string ring = "[";
  for (int k = 0; k <= 64; ++k) {
    const double a = 2.0 * pi * (k % 64) / 64;
    ring += (k == 0 ? "[" : ", [") + number(outer * std::cos(a)) + ", " +
            number(outer * std::sin(a)) + "]";
  }
  ring += "]";
  const std::string load = "[[load]]\nalong = " + ring + "\npressure = " + number(pressure) + "\n";
  const auto pinch = [&](double x) {
    return std::string("[[load]]\nname = '") + (x > 0.0 ? "right" : "left") + "'\npoint = [" +
           number(x) + ", 0]\nforce = [" + number(x > 0.0 ? -100.0 : 100.0) + ", 0]\n";
  };
  const std::string model =
      concrete("[[lining]]\nalong = " + ring + "\nsize = 1\nthickness = " + number(t) + "\n" +
               (pressure > 0.0 ? load : "") + pinch(r) + pinch(-r) +
               "[[stage]]\nduration = 0.1\ndamping = { local = 0.5 }\n"
               "[[stage]]\ndeactivate = ['left', 'right']\nduration = 0.9\n");
  Result<Model> read = read_model_text(model, EDDA_SOURCE_DIR "/scene.toml", {});
  EXPECT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  std::vector<double> crossings;
  double before = 0.0, time_before = 0.0;
  RunOptions options;
  options.after_step = [&] {
    double oval = 0.0;  // the part of the radial displacement in cos 2a
    for (std::uint32_t k = 0; k < 64; ++k) {
      const double a = 2.0 * pi * k / 64;
      oval += std::cos(2.0 * a) * dot(middle(ready.sim, k), Vec2{std::cos(a), std::sin(a)});
    }
    const double now = ready.sim.motion.state.time;
    if (now > 0.1 && before * oval < 0.0)
      crossings.push_back(time_before + (now - time_before) * before / (before - oval));
    before = oval;
    time_before = now;
    return false;
  };
  EXPECT_TRUE(run_model(ready, options).ok());
  EXPECT_GE(crossings.size(), 3u);
  if (crossings.size() < 2) return 0.0;
  return 2.0 * (crossings.back() - crossings.front()) / double(crossings.size() - 1);
}

/// A thin ring swings as an oval with omega^2 = 7.2 EI/(m r^4) (1 - p/p_c), and buckles under a
/// pressure that turns with its face at p_c = 3 EI/r^3.
TEST(Lining, RingBuckles) {
  constexpr double radius = 4.0, t = 0.1, stiff = in_plane * t * t * t / 12.0;
  constexpr double critical = 3.0 * stiff / (radius * radius * radius);
  const double square = 7.2 * stiff / (density * t * std::pow(radius, 4));
  const double alone = ovalling_period(0.0, radius, t),
               pressed = ovalling_period(0.5 * critical, radius, t);
  expect_relative({90, "", "period as an oval", "s"}, alone, 2.0 * pi / std::sqrt(square), 1e-2);
  const double left = std::pow(alone / pressed, 2);
  expect_relative({90, "", "critical pressure", "Pa"}, 0.5 * critical / (1.0 - left), critical,
                  1e-2);
}

/// A beam on two supports under a force at its middle becomes a mechanism at P = 4 M_p/L, with M_p
/// = f t^2/4: ramped in steps of half a per cent.
TEST(Lining, ThreePointCollapse) {
  constexpr double length = 4.0, yield = 20e6, collapse = yield * thick * thick / length;
  const std::string support = "[[boundary]]\ntype = 'roller'\nstiffness = 1e10\nalong = ";
  const std::string model =
      concrete(lining("[[0, -0.15], [4, -0.15]]",
                      "size = 0.5\ncompressive_strength = 20e6\ntensile_strength = 20e6\n") +
               support + "[[-0.05, -0.15], [0.05, -0.15]]\n" + support +
               "[[3.95, -0.15], [4.05, -0.15]]\n[[load]]\nname = 'press'\npoint = [2, 0]\n"
               "force = [0, -1]\n[[stage]]\nuntil = 'collapse'\n"
               "ramp = { 'load:press' = [" +
               number(0.97 * collapse) + ", " + number(1.03 * collapse) +
               "], hold = 'equilibrium', steps = 12 }\n");
  Result<Model> read = read_model_text(model, EDDA_SOURCE_DIR "/scene.toml", {});
  ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  const Result<Outcome> outcome = run_model(ready, RunOptions{});
  ASSERT_TRUE(outcome.ok());
  // "... holds at load:press = 447750 and fails at load:press = 450000: ..."
  const std::string& text = outcome.value().message;
  const std::size_t at = text.find("fails at load:press = ");
  ASSERT_NE(at, std::string::npos) << text;
  expect_relative({83, "", "load that fails", "N"}, std::stod(text.substr(at + 22)), collapse,
                  1e-2);
  const BeamForces& middle_piece = forces(ready.sim, 3);
  expect_relative({83, "", "moment of the hinge", "N m"}, middle_piece.moment[1],
                  0.25 * yield * thick * thick, 1e-3);
  EXPECT_GT(ready.sim.motion.zones.piece[3].hinge[1], 1e-3);
}

/// The part of critical with which the end of a cantilever swings once its load is gone, and the
/// frequency (1/s), from the extremes of its displacement.
struct Swings {
  double fraction = 0.0, omega = 0.0, error = 0.0;
  double damped = 0.0;  ///< J, while it swings
};
Swings cantilever_swings(const std::string& damping, const std::string& stage) {
  const std::string model =
      "gravity = [0, 0]\n[materials.concrete]\ndensity = 2500\nyoung = 30e9\npoisson = 0.2\n" +
      damping + "[joints.rough]\nfriction_angle = 30\n" +
      lining("[[0, -0.15], [6, -0.15]]", "size = 0.5\n") + boundary("[[0, -0.15], [0, 0.15]]") +
      "[[load]]\nname = 'push'\npoint = [6, 0]\nforce = [0, 1e4]\n"
      "[[stage]]\nuntil = 'equilibrium'\n"
      "[[stage]]\ndeactivate = ['push']\nduration = 0.8\n" +
      stage + "[output]\nevery = 0.001\n";
  Result<Model> read = read_model_text(model, EDDA_SOURCE_DIR "/scene.toml", {});
  EXPECT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  std::vector<double> extremes, times;
  double before = 0.0, slope = 0.0, began = -1.0, damped = 0.0;
  RunOptions options;
  options.after_step = [&] {
    const Simulation& sim = ready.sim;
    if (sim.motion.damping.adaptive > 0.0) return false;
    if (began < 0.0) {
      began = sim.motion.state.time;
      damped = energy_balance(sim).damping;
    }
    const double now = middle(sim, 12).y;
    if (sim.motion.state.time > began + 0.1 && slope * (now - before) < 0.0) {
      extremes.push_back(before);
      times.push_back(sim.motion.state.time);
    }
    slope = now - before;
    before = now;
    return false;
  };
  const Result<Outcome> outcome = run_model(ready, options);
  EXPECT_TRUE(outcome.ok());
  EXPECT_GE(extremes.size(), 4u);
  if (!outcome.ok() || extremes.size() < 4) return {};
  const double many = double(extremes.size() - 1);
  return {std::log(std::abs(extremes.front() / extremes.back())) / (many * pi),
          many * pi / (times.back() - times.front()), outcome.value().energy.error,
          outcome.value().energy.damping - damped};
}

/// Rayleigh damping of the concrete, or of the model, and none of both.
TEST(Lining, RayleighDampingOfACantilever) {
  const Swings none = cantilever_swings("damping = 0\n", "");
  EXPECT_LT(std::abs(none.fraction), 3e-3);  // of the higher modes that swing on
  EXPECT_EQ(none.damped, 0.0);
  const std::string rayleigh = "rayleigh = { fraction = 0.03, frequency = 4 }";
  const double ratio = none.omega / (2.0 * pi * 4.0), expected = 0.5 * 0.03 * (ratio + 1.0 / ratio);
  const Swings own = cantilever_swings(rayleigh + "\n", ""),
               all = cantilever_swings("", "damping = { " + rayleigh + " }\n");
  for (const Swings& s : {own, all}) {
    EXPECT_NEAR(s.fraction, expected, 0.02 * expected);
    EXPECT_LT(std::abs(s.error), 1e-4);
  }
  EXPECT_EQ(own.fraction, all.fraction);
}

/// Its own damping is a fraction of critical at the highest frequency of a piece: what is slow has
/// as much less as it is slower.
TEST(Lining, OwnDampingLeavesSlowMotionAlone) {
  const Swings s = cantilever_swings("", "");
  EXPECT_LT(std::abs(s.fraction), 3e-3);
  EXPECT_GT(s.damped, 0.0);
  EXPECT_LT(std::abs(s.error), 1e-4);
}

/// A beam on two supports whose middle is pushed down: the section there cracks at M = f t^2/4 and
/// falls to that of the residual strengths, and what is released is dissipated.
TEST(Lining, ThreePointBeamThatCracks) {
  constexpr double peak = 20e6 * thick * thick / 4.0, after = 4e6 * thick * thick / 4.0;
  const std::string support = "[[boundary]]\ntype = 'roller'\nstiffness = 1e10\nalong = ";
  const std::string model = concrete(
      lining("[[0, -0.15], [4, -0.15]]",
             "size = 0.5\ncompressive_strength = 20e6\ntensile_strength = 20e6\n"
             "residual = { compressive_strength = 4e6, tensile_strength = 4e6 }\n") +
      support + "[[-0.05, -0.15], [0.05, -0.15]]\n" + support + "[[3.95, -0.15], [4.05, -0.15]]\n" +
      "[[boundary]]\ntype = 'velocity'\nvelocity = [0, -0.02]\nstiffness = 1e10\n"
      "along = [[1.95, 0.15], [2.05, 0.15]]\n"
      "[[stage]]\nduration = 1\ndamping = { local = 0.3 }\n");
  Result<Model> read = read_model_text(model, EDDA_SOURCE_DIR "/scene.toml", {});
  ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
  PreparedRun ready = prepare_run(std::move(read.value())).value();
  double most = 0.0;
  RunOptions options;
  options.after_step = [&] {
    most = std::max(most, std::abs(forces(ready.sim, 3).moment[1]));
    return false;
  };
  const Result<Outcome> outcome = run_model(ready, options);
  ASSERT_TRUE(outcome.ok());
  expect_relative({83, "cracks", "moment before", "N m"}, most, peak, 2e-2);
  const double left =
      std::max(std::abs(forces(ready.sim, 3).moment[1]), std::abs(forces(ready.sim, 4).moment[0]));
  expect_relative({83, "cracks", "moment after", "N m"}, left, after, 2e-2);
  EXPECT_LT(std::abs(outcome.value().energy.error), 1e-3);
  std::size_t yielded = 0;
  for (const BeamState& piece : ready.sim.motion.zones.piece)
    yielded += piece.yielded[0] + piece.yielded[1] > 0.0 ? 1 : 0;
  EXPECT_GE(yielded, 1u);
  EXPECT_LE(yielded, 2u);
}

}  // namespace
}  // namespace edda::lining_test
