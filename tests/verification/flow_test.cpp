// Water that flows through joints, against closed-form solutions: validation.md rows 92 to 94.
#include <cmath>
#include <numbers>

#include "step/faces_now.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::flow_verification {
namespace {

using std::numbers::pi;

constexpr double gamma = 9810.0, viscosity = 1e-3;

std::string rock(const std::string& joint) {
  return "[materials.rock]\ndensity = 2400\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = 45\n" +
         joint + "[flow]\n";
}
std::string block(const std::string& polygon, const std::string& more = "") {
  return "[[block]]\npolygon = " + polygon + "\n" + more;
}
std::string table(const std::string& points) {
  return "[[water]]\ntable = " + points + "\n";
}
const std::string to_rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-8\n";

/// A dam 20 m high and wide on one joint, 15 m of water before it and 3 m behind it.
std::string dam(const std::string& more) {
  return rock("aperture = 5e-4\n") +
         block("[[-10, -5], [30, -5], [30, 0], [-10, 0]]", "fixed = true\n") +
         block("[[0, 0], [20, 0], [20, 20], [0, 20]]") + table("[[-10, 15], [0, 15]]") +
         table("[[20, 3], [30, 3]]") + more + to_rest;
}
double normal_force(const Simulation& sim) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) sum += normal_force_now(sim, k);
  return sum;
}

constexpr double weight = 400.0 * 2400.0 * 9.81;

TEST(Flow, UpliftUnderADam) {
  const PreparedRun run = settled(dam(""));
  expect_relative({92, "no drains", "force on the joint", "N"}, normal_force(run.sim),
                  weight - gamma * 20.0 * 0.5 * (15.0 + 3.0), 1e-5);
}

TEST(Flow, UpliftUnderADamWithDrains) {
  // Drain holes 4 m behind the heel, open to a gallery at the level of 4 m.
  const PreparedRun run =
      settled(dam("[[water]]\nname = 'drains'\nlevel = 4\nalong = [[4, 4], [4, -4]]\n"));
  const double uplift = gamma * (4.0 * 0.5 * (15.0 + 4.0) + 16.0 * 0.5 * (4.0 + 3.0));
  expect_relative({92, "drains", "force on the joint", "N"}, normal_force(run.sim), weight - uplift,
                  1e-5);
  // What comes from the reservoir: h^3/(12 mu l) (15 - 4) gamma, of which the tailwater gets none.
  const std::vector<double>& inflow = run.sim.attached.joint_water.inflow;
  EXPECT_GT(inflow[0], 0.0);
  EXPECT_LT(inflow[1], 0.0);
  EXPECT_NEAR(inflow[0] + inflow[1] + inflow[2] + inflow[3], 0.0, 1e-12 * inflow[0]);
}

TEST(Flow, DischargeFallsAsAJointCloses) {
  // A joint with kn under the weight of a block and still heads of 6 and 4 m at its ends: its
  // normal stress less the water pressure closes it.
  const double height = 50.0, kn = 5e9, drawn = 5e-4;
  const PreparedRun run =
      settled(rock("aperture = 5e-4\nkn = 5e9\nresidual_aperture = 1e-5\n") +
              block("[[-5, -5], [15, -5], [15, 0], [-5, 0]]", "fixed = true\n") +
              block("[[0, 0], [10, 0], [10, 50], [0, 50]]") + table("[[-5, 6], [0, 6]]") +
              table("[[10, 6], [15, 6]]") + to_rest);
  const double stress = height * 2400.0 * 9.81 - 6.0 * gamma;
  const auto& faces = run.sim.attached.joint_water.rows;
  ASSERT_EQ(faces.size(), 1u);
  expect_relative({93, "closed by its weight", "hydraulic aperture", "m"}, faces[0].aperture,
                  drawn - stress / kn, 1e-3);
}

TEST(Flow, RadialFlowToATunnel) {
  // Two sets of joints 1 m apart: K = gamma h^3/(12 mu s), Q = 2 pi K (H - h)/ln(R/r).
  constexpr double radius = 4.0, far = 16.0, spacing = 1.0, aperture = 5e-4;
  const auto ring = [](double r, int parts, double turned) {
    std::string points = "[";
    for (int k = 0; k < parts; ++k) {
      const double a = 2.0 * pi * (k + turned) / parts;
      points +=
          (k == 0 ? "[" : ", [") + number(r * std::cos(a)) + ", " + number(r * std::sin(a)) + "]";
    }
    return points;
  };
  const std::string circle = ring(far, 180, 0.0) + ", [" + number(far) + ", 0]]";
  const std::string joints =
      "[[joint_set]]\nangle = 0\nspacing = 1\njoint = 'j'\n[[joint_set]]\nangle = 90\nspacing = 1\n"
      "joint = 'j'\n";
  const Simulation sim = scene(
      rock("aperture = 5e-4\n") + "[solver]\nduration = 1\n" +
      "[domain]\noutline = [[-20, -20], [20, -20], [20, 20], [-20, 20]]\nmaterial = 'rock'\n" +
      joints + "[[opening]]\nname = 'tunnel'\npolygon = " + ring(radius, 48, 0.5) + "]\n" +
      "[[boundary]]\nsides = ['left', 'right', 'top', 'bottom']\n" +
      "[[water]]\nlevel = 50\nalong = " + circle + "\n" +
      "[[water]]\nflooded = ['tunnel']\ntable = [[-20, 30], [20, 30]]\n");
  const double conductivity = gamma * aperture * aperture * aperture / (12.0 * viscosity * spacing);
  const double exact = 2.0 * pi * conductivity * 20.0 / std::log(far / radius);
  const std::vector<double>& inflow = sim.attached.joint_water.inflow;
  expect_relative({94, "from the ring", "discharge", "m2/s"}, inflow[0], exact, 1e-2);
  expect_relative({94, "into the tunnel", "discharge", "m2/s"}, -inflow[1], exact, 1e-2);
}

}  // namespace
}  // namespace edda::flow_verification
