// Linings against closed-form solutions: beams, their vibration and their collapse, and a ring in
// ground under two pressures.
#include <Eigen/Dense>
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
  expect_relative({79, "straight", "deflection", "m"}, middle(sim, 16).y, exact, 1e-3);
  expect_relative({79, "straight", "moment at the clamp", "N m"}, forces(sim, 0).moment[0],
                  load * length, 1e-3);
}

TEST(Lining, QuarterCircle) {
  constexpr double radius = 4.0, load = 1e3;
  std::string along = "[";
  for (int k = 0; k <= 32; ++k) {
    const double a = 0.5 * pi * k / 32, r = radius + 0.5 * thick;
    along +=
        (k == 0 ? "[" : ", [") + number(r * std::cos(a)) + ", " + number(r * std::sin(a)) + "]";
  }
  const std::string model =
      concrete(lining(along + "]", "size = 1\n") + boundary("[[3.8, 0], [4.2, 0]]") +
               force({0, 4}, {0, -load}) + to_rest);
  const Simulation& sim = settled(model).sim;
  const double exact =
      load * (0.25 * pi * (std::pow(radius, 3) / bending + radius / shear) +
              radius * radius / clamp + 0.5 / spring);
  expect_relative({79, "quarter circle", "deflection", "m"}, -middle(sim, 32).y, exact, 1e-3);
}

/// The first frequency of a cantilever, after Timoshenko's correction of order (t/L)^2 by Rayleigh:
/// shear and rotary inertia, here (t/2)^2 of the sections.
TEST(Lining, VibrationOfACantilever) {
  constexpr double length = 6.0, load = 1e4;
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
  expect_relative({80, "", "period", "s"}, period, 2.0 * pi / std::sqrt(square / (1.0 + softer)),
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
                                     "\npressure = 1e5\n" + to_rest);
  const Simulation& sim = settled(model).sim;
  const double mean = radius - 0.5 * thick;
  expect_relative({79, "ring", "thrust", "N"}, -forces(sim, 5).axial, pressure * radius, 2e-3);
  expect_relative({79, "ring", "decrease of the radius", "m"}, -middle(sim, 0).x,
                  pressure * radius * mean / axial, 4e-3);
}

/// A ring in ground under the pressures P (vertical) and K P, excavated and lined at once
/// (Einstein and Schwartz 1979): thrust and moment are T0 + T2 cos 2a and M2 cos 2a, a from the
/// horizontal.
struct Ground {
  double young = 1e9, poisson = 0.25, pressure = 1e6, ratio = 0.5, radius = 5.0;
};
struct Shell {
  double young = 25e9, poisson = 0.2, thickness = 0.2;
  double axial() const { return young * thickness / (1.0 - poisson * poisson); }
  double bending() const {
    return young * std::pow(thickness, 3) / 12.0 / (1.0 - poisson * poisson);
  }
};
struct Ring {
  double thrust, thrust_2, moment_2;
};
Ring einstein_schwartz(const Ground& g, const Shell& shell, bool slips) {
  const double plane = g.young / (1.0 - g.poisson * g.poisson), n = 1.0 - g.poisson,
               c = plane * g.radius / shell.axial(),
               f = plane * std::pow(g.radius, 3) / shell.bending();
  const double a0 = c * f * n / (c + f + c * f * n), mean = 0.5 * (1.0 + g.ratio) * (1.0 - a0),
               half = 0.5 * (1.0 - g.ratio), pr = g.pressure * g.radius;
  if (slips) {
    const double a2 = (f + 6.0) * n / (2.0 * f * n + 6.0 * (5.0 - 6.0 * g.poisson));
    return {pr * mean, pr * half * (1.0 - 2.0 * a2), pr * g.radius * half * (1.0 - 2.0 * a2)};
  }
  const double b = ((6.0 + f) * c * n + 2.0 * f * g.poisson) /
                   (3.0 * f + 3.0 * c + 2.0 * c * f * n),
               b2 = c * n / (2.0 * (c * n + 4.0 * g.poisson - 6.0 * b - 3.0 * b * c * n)),
               a2 = b * b2;
  return {pr * mean, pr * half * (1.0 + 2.0 * a2),
          0.5 * pr * g.radius * half * (1.0 - 2.0 * a2 + 2.0 * b2)};
}
/// The same with the ground at the outer face of a shell whose middle is at the radius r: Airy's
/// function (B/r^2 + C) cos 2a in the ground, displacements W cos 2a and V sin 2a of the middle.
Ring in_ground(const Ground& g, const Shell& shell, bool slips, double r) {
  const double shear_modulus = 0.5 * g.young / (1.0 + g.poisson), kappa = 3.0 - 4.0 * g.poisson,
               big = g.radius, ea = shell.axial(), ei = shell.bending(), off = (big - r) / r;
  const double mean = -0.5 * g.pressure * (1.0 + g.ratio),
               half = 0.5 * g.pressure * (1.0 - g.ratio);
  // u = -A/(2 G R) = r R s/EA with s = mean + A/R^2.
  const double per = r * big / ea;
  const double a = per * mean / (-0.5 / (shear_modulus * big) - per / (big * big));
  Eigen::RowVector4d normal(-6.0 / std::pow(big, 4), -4.0 / (big * big), 0.0, 0.0),
      tangential(-6.0 / std::pow(big, 4), -2.0 / (big * big), 0.0, 0.0);
  Eigen::Matrix4d k;
  k.row(0) = Eigen::RowVector4d(0, 0, ea / r + 9.0 * ei / std::pow(r, 3), 2.0 * ea / r) -
             big * (normal + 2.0 * off * tangential);
  k.row(1) = Eigen::RowVector4d(0, 0, 2.0 * ea / r, 4.0 * ea / r) - big * (1.0 + off) * tangential;
  k.row(2) =
      Eigen::RowVector4d(1.0 / std::pow(big, 3), 0.5 * (kappa + 1.0) / big, 0, 0) / shear_modulus -
      Eigen::RowVector4d(0, 0, 1, 0);
  k.row(3) = slips ? tangential
                   : Eigen::RowVector4d(1.0 / std::pow(big, 3), -0.5 * (kappa - 1.0) / big, 0, 0) /
                             shear_modulus -
                         Eigen::RowVector4d(0, 0, 2.0 * off, 1.0 + off);
  const Eigen::Vector4d loads(big * (half - 2.0 * off * half), -big * (1.0 + off) * half, 0.0,
                              slips ? half : 0.0);
  const Eigen::Vector4d x = k.fullPivLu().solve(loads);
  return {-big * (mean + a / (big * big)), -ea / r * (x[2] + 2.0 * x[3]),
          3.0 * ei / (r * r) * x[2]};
}

std::string tunnel(const Ground& g, const Shell& shell, bool slips) {
  std::string outline = "[";
  for (int k = 0; k < 64; ++k) {
    const double a = 2.0 * pi * k / 64;
    outline += (k == 0 ? "[" : ", [") + number(g.radius * std::cos(a)) + ", " +
               number(g.radius * std::sin(a)) + "]";
  }
  return "gravity = [0, 0]\n[materials.ground]\ndensity = 2500\nyoung = " + number(g.young) +
         "\npoisson = " + number(g.poisson) +
         "\n[materials.shotcrete]\ndensity = 2500\nyoung = " + number(shell.young) +
         "\npoisson = " + number(shell.poisson) + "\n[joints.wall]\n" +
         (slips ? "friction_angle = 0\n"
                : "friction_angle = 40\ncohesion = 1e8\ntensile_strength = 1e8\n") +
         "kn = 1e11\nks = 1e11\n[contact]\njoint = 'wall'\n"
         "[domain]\noutline = [[-60, -60], [60, -60], [60, 60], [-60, 60]]\nmaterial = 'ground'\n"
         "[zones]\nsize = 0.5\ngrowth = 0.2\n[[opening]]\nname = 'tunnel'\npolygon = " +
         outline +
         "]\n[[lining]]\nname = 'shell'\nopening = 'tunnel'\nmaterial = 'shotcrete'\n"
         "thickness = " +
         number(shell.thickness) + "\nsize = 1\ninterface = 'wall'\n[initial_stress]\nstress = [" +
         number(-g.ratio * g.pressure) + ", " + number(-g.pressure) +
         ", 0]\n[[boundary]]\ntype = 'roller'\nsides = ['left', 'right', 'bottom', 'top']\n"
         "[[stage]]\nuntil = 'equilibrium'\nexcavate = ['tunnel']\ninstall = ['shell']\n";
}

/// Of thrust and moment along the lining.
Ring fitted(const Simulation& sim) {
  Ring ring{};
  const auto& pieces = sim.motion.zones.piece;
  const double per = 1.0 / static_cast<double>(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double a = 2.0 * pi * (static_cast<double>(k) + 0.5) * per;
    const BeamForces& f = pieces[k].forces;
    ring.thrust -= per * f.axial;
    ring.thrust_2 -= 2.0 * per * std::cos(2.0 * a) * f.axial;
    ring.moment_2 += per * std::cos(2.0 * a) * (f.moment[0] + f.moment[1]);
  }
  return ring;
}

TEST(Lining, RingInGroundUnderTwoPressures) {
  const Ground ground;
  const Shell shell;
  for (const bool slips : {false, true}) {
    // The closed form is that of a shell whose middle is at the wall.
    const Ring theirs = einstein_schwartz(ground, shell, slips),
               same = in_ground(ground, shell, slips, ground.radius);
    EXPECT_NEAR(same.thrust, theirs.thrust, 1e-3 * theirs.thrust);
    EXPECT_NEAR(same.moment_2, theirs.moment_2, 1e-3 * theirs.moment_2);
    const std::string which = slips ? "full slip" : "no slip";
    const Simulation& sim = settled(tunnel(ground, shell, slips)).sim;
    const Ring found = fitted(sim),
               exact = in_ground(ground, shell, slips, ground.radius - 0.5 * shell.thickness);
    expect_relative({82, which, "mean thrust", "N/m"}, found.thrust, exact.thrust, 2e-2);
    expect_relative({82, which, "moment", "N"}, -found.moment_2, exact.moment_2, 2e-2);
    if (!slips)
      expect_relative({82, which, "variation of the thrust", "N/m"}, found.thrust_2, exact.thrust_2,
                      2e-2);
  }
}

}  // namespace
}  // namespace edda::lining_test
