// A lining in ground under two pressures: validation.md rows 84 and 85.
#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "verification/record.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::lined_ring_long_test {
namespace {

using std::numbers::pi;

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
  // Stresses and lengths differ by many orders of magnitude.
  const Eigen::Vector4d columns = k.cwiseAbs().colwise().maxCoeff().cwiseInverse().transpose();
  k = (k * columns.asDiagonal()).eval();
  const Eigen::Vector4d rows = k.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
  const Eigen::Vector4d x =
      columns.asDiagonal() * (rows.asDiagonal() * k).fullPivLu().solve(rows.asDiagonal() * loads);
  return {-big * (mean + a / (big * big)), -ea / r * (x[2] + 2.0 * x[3]),
          3.0 * ei / (r * r) * x[2]};
}

std::string tunnel(const Ground& g, const Shell& shell, bool slips, const std::string& then) {
  std::string outline = "[";
  for (int k = 0; k < 128; ++k) {
    const double a = 2.0 * pi * k / 128;
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
         "[domain]\noutline = [[-120, -120], [120, -120], [120, 120], [-120, 120]]\nmaterial = "
         "'ground'\n"
         "[zones]\nsize = 0.25\ngrowth = 0.1\n[[opening]]\nname = 'tunnel'\npolygon = " +
         outline +
         "]\n[[lining]]\nname = 'shell'\nopening = 'tunnel'\nmaterial = 'shotcrete'\n"
         "thickness = " +
         number(shell.thickness) + "\nsize = 1\ninterface = 'wall'\n[initial_stress]\nstress = [" +
         number(-g.ratio * g.pressure) + ", " + number(-g.pressure) +
         ", 0]\n[[boundary]]\ntype = 'roller'\nsides = ['left', 'right', 'bottom', 'top']\n"
         "[[stage]]\nuntil = 'equilibrium'\nexcavate = ['tunnel']\n" +
         then;
}

/// Of thrust and moment at the ends of the pieces.
Ring fitted(const Simulation& sim) {
  Ring ring{};
  const auto& pieces = sim.motion.zones.piece;
  const double per = 0.5 / static_cast<double>(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (const std::size_t end : {0u, 1u}) {
      const double wave = 2.0 * std::cos(8.0 * pi * static_cast<double>(k + end) * per);
      const BeamForces& f = pieces[k].forces;
      ring.thrust -= per * f.axial;
      ring.thrust_2 -= per * wave * f.axial;
      ring.moment_2 += per * wave * f.moment[end];
    }
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
    const Simulation& sim = settled(tunnel(ground, shell, slips, "install = ['shell']\n")).sim;
    const Ring found = fitted(sim),
               exact = in_ground(ground, shell, slips, ground.radius - 0.5 * shell.thickness);
    expect_relative({84, which, "mean thrust", "N/m"}, found.thrust, exact.thrust, 2e-2);
    expect_relative({84, which, "moment", "N"}, found.moment_2, exact.moment_2, 2e-2);
    if (!slips)
      expect_relative({84, which, "variation of the thrust", "N/m"}, found.thrust_2, exact.thrust_2,
                      2e-2);
  }
}

/// Of what is released after the lining has come, on the wall as it is then.
TEST(Lining, InstalledWhenTheGroundHasMoved) {
  Ground ground;
  ground.ratio = 1.0;
  const Shell shell;
  const Ring at_once = fitted(settled(tunnel(ground, shell, false, "install = ['shell']\n")).sim);
  const Ring later = fitted(settled(tunnel(ground, shell, false,
                                           "relax = { tunnel = 0.6 }\n[[stage]]\n"
                                           "until = 'equilibrium'\ninstall = ['shell']\n"
                                           "relax = { tunnel = 1.0 }\n"))
                                .sim);
  expect_relative({85, "", "thrust over that of a lining from the beginning", ""},
                  later.thrust / at_once.thrust, 0.4, 1e-3);
}

}  // namespace
}  // namespace edda::lined_ring_long_test
