// Closures of a circular tunnel in rock that joints divide into blocks, with default settings: row
// 71. In-situ stresses of 10 and 20 MPa, E 10 GPa.
#include <cmath>

#include "observe/monitors.hpp"
#include "run/prepared.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::closures_long_test {
namespace {

constexpr double young = 10e9, poisson = 0.25, radius = 3.0, near = 3.05;

std::string box(double half) {
  const std::string l = number(half), m = number(-half);
  return "[[" + m + "," + m + "],[" + l + "," + m + "],[" + l + "," + l + "],[" + m + "," + l +
         "]]";
}

std::string set(double angle, double spacing, const std::string& more = "") {
  return "[[joint_set]]\nangle = " + number(angle) + "\nspacing = " + number(spacing) + "\n" + more;
}

/// Of rock over the domain of this half width, cut by `joints`; stiffness: lines of the joint.
std::string tunnel(double half, const std::string& joints, const std::string& stiffness) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2700\nyoung = " + number(young) +
         "\npoisson = " + number(poisson) + "\n[joints.mesh]\ntype = 'glued'\n" + stiffness +
         "[domain]\noutline = " + box(half) + "\njoint = 'mesh'\n" + joints +
         R"([[opening]]
name = 'tunnel'
shape = { kind = 'circle', at = [0, 0], width = 6 }
[initial_stress]
stress = [-10e6, -20e6, 0.0]
[[boundary]]
sides = ['left', 'bottom']
type = 'roller'
[[boundary]]
sides = ['right', 'top']
type = 'stress'
[[convergence]]
name = 'height'
between = [[0.1, -3.05], [0.1, 3.05]]
[[convergence]]
name = 'span'
between = [[-3.05, 0.1], [3.05, 0.1]]
[[stage]]
until = 'equilibrium'
[[stage]]
excavate = ['tunnel']
until = 'equilibrium'
reset_displacements = true
)";
}

struct Closures {
  double height, span;
};
Closures closures_of(const std::string& text) {
  const testing::Ran r = testing::ran(text);
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& sim = r.ready.sim;
  const std::vector<ConvergenceLine>& lines = r.ready.gauges.convergences;
  return {convergence(sim.scene->blocks, sim.motion.state, lines[0]),
          convergence(sim.scene->blocks, sim.motion.state, lines[1])};
}

/// Kirsch (1898) for rock that is softer by joints of the same stiffness along both sets and in
/// both directions, c = 1/(k s): isotropic again, with 2 G = 1/((1 + nu)/E + c). Twice
/// u = (p R^2/r + q cos 2 theta (4 (1 - n) - R^2/r^2) R^2/r)/(2 G).
Closures kirsch(double c) {
  const double a = (1.0 + poisson) / young + c, n = poisson * (1.0 + poisson) / (a * young);
  const double p = 15e6, q = -5e6, per = radius * radius / near;
  const auto closed = [&](double cosine) {
    return 2.0 * a *
           (p * per + q * cosine * (4.0 * (1.0 - n) - radius * radius / (near * near)) * per);
  };
  return {closed(-1.0), closed(1.0)};
}

/// Squares around the opening, and larger ones as far as 20 radii.
TEST(Closures, OfSquaresAreKirschs) {
  for (const double size : {0.5, 1.0, 1.5}) {
    for (const bool stiff : {false, true}) {
      const std::string inside = "region = " + box(12.0) + "\n";
      const std::string joints =
          set(0.0, 6.0) + set(90.0, 6.0) + set(0.0, size, inside) + set(90.0, size, inside);
      const Closures found =
          closures_of(tunnel(60.0, joints, stiff ? "kn = 1e12\nks = 1e12\n" : ""));
      const Closures exact = kirsch(stiff ? 1.0 / (1e12 * size) : 0.05 / young);
      const std::string label =
          "squares of R/" + brief(radius / size) + (stiff ? ", 1000 GPa/m" : "");
      expect_relative({71, label, "closure of the height", "m"}, found.height, exact.height,
                      1.5e-2);
      // A difference of two numbers each as large as the other closure.
      expect_at_most({71, label, "error of the closure of the span, over the other", ""},
                     std::abs(found.span - exact.span) / exact.height, 4e-2);
    }
  }
}

/// Against blocks of the same kind that are divided into fine triangles, in boxes of 30 and 42 m.
TEST(Closures, OfOtherBlocksAreThoseOfFineOnes) {
  std::string bond;
  const double half = 15.0;
  for (int row = 0; row < 31; ++row) {
    const double y = -half + 0.05 + row, from = row == 0 ? -half : y - 1.0;
    if (y < half)
      bond += "[[trace]]\npoints = [[" + number(-half) + "," + number(y) + "],[" + number(half) +
              "," + number(y) + "]]\n";
    for (double x = -half + 0.05 + (row % 2 == 0 ? 0.0 : 0.5); x < half; x += 1.0)
      bond += "[[trace]]\npoints = [[" + number(x) + "," + number(from) + "],[" + number(x) + "," +
              number(std::min(y, half)) + "]]\n";
  }
  struct Case {
    std::string label, joints;
    double half, height, stiff;
  };
  for (const Case& c :
       {Case{"running bond of R/3", bond, half, 20.65e-3, 19.95e-3},
        {"polygons of R/2", "[voronoi]\nsize = 1.4\nmin_edge = 0\n", 21.0, 20.1e-3, 19.3e-3}}) {
    for (const bool stiff : {false, true}) {
      const Closures found =
          closures_of(tunnel(c.half, c.joints, stiff ? "kn = 1e12\nks = 1e12\n" : ""));
      expect_relative({71, c.label + (stiff ? ", 1000 GPa/m" : ""), "closure of the height", "m"},
                      found.height, stiff ? c.stiff : c.height, 1.5e-2);
    }
  }
}

}  // namespace
}  // namespace edda::closures_long_test
