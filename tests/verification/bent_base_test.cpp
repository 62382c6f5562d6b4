// Cohesion under a base that is not quite plane: a toe that bends up by a hundredth of a degree
// lies open by hundredths of a millimetre, and its surface still belongs to the joint.
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::bent_base_test {
namespace {

constexpr double cohesion = 2e4, friction = 30.0, length = 2.0, height = 0.2, density = 2500.0;

/// Shear strength of the joint: c L + N tan(phi), N the weight.
double shear_strength() {
  return cohesion * length + density * 9.81 * length * height * std::tan(radians(friction));
}

struct Base {
  double bend;        ///< degrees, at a fifth of the length from the toe
  bool of_floor;      ///< the floor bends down there, else the block's base up
  const char* joint;  ///< kn and ks, or nothing
};

/// Final speed of the block after a force along its base has been raised to `part` of that strength
/// and kept constant. The strength does not decrease with slip, so that no part of the base fails
/// before another.
double speed_under(const Base& base, double part) {
  const double toe = 0.2 * length, edge = 0.5 * length, bent = toe * std::tan(radians(base.bend));
  const double beyond = 3.0 - edge + toe, down = beyond * std::tan(radians(base.bend));
  const auto point = [](double x, double y) { return "[" + number(x) + "," + number(y) + "],"; };
  std::string text =
      "[materials.rock]\ndensity = " + number(density) +
      "\nyoung = 20e9\npoisson = 0.2\n[joints.j]\nfriction_angle = " + number(friction) +
      "\ncohesion = " + number(cohesion) + "\nresidual = { friction_angle = " + number(friction) +
      ", cohesion = " + number(cohesion) + " }\n" + base.joint +
      "[solver]\nduration = 0.3\ndamping = { mass = 200.0 }\n[output]\nhistory_every = 0.3\n";
  text += "[[block]]\nfixed = true\npolygon = [[-3,-1],[3,-1]," +
          (base.of_floor ? point(3.0, -down) : point(3.0, 0.0)) + point(edge - toe, 0.0) +
          "[-3,0]]\n";
  text += "[[block]]\npolygon = [" + point(-edge, 0.0) +
          (base.of_floor ? "" : point(edge - toe, 0.0)) + point(edge, base.of_floor ? 0.0 : bent) +
          point(edge, height) + point(-edge, height) + "]\n[[load]]\npoint = [0, 1e-6]\nforce = [" +
          number(part * shear_strength()) +
          ", 0]\nhistory = 'tests/verification/push_slowly.csv'\n";
  Simulation sim = scene(text);
  run(sim, [](Simulation&) {});
  return centroid(sim.motion.state.velocity, 1).x;
}

/// Shear force of the joint: the load less the damping force, 200 1/s times the mass times the
/// constant sliding speed.
TEST(BentBase, ItsToeLosesNoCohesion) {
  const double mass = density * length * height;
  for (const char* joint : {"", "kn = 1e9\nks = 1e9\n"}) {
    for (const bool of_floor : {false, true}) {
      for (const double bend : {0.0, 1e-4, 0.01, 0.1}) {
        const Base base{bend, of_floor, joint};
        const std::string label = brief(bend) + " degrees, " + (of_floor ? "floor" : "base") +
                                  (*joint != 0 ? ", kn" : "");
        EXPECT_LT(speed_under(base, 0.999), 1e-7) << label;
        const double speed = speed_under(base, 1.001);
        EXPECT_GT(speed, 1e-5) << label;
        expect_relative({62, label, "force that it carries along the joint", "N"},
                        1.001 * shear_strength() - 200.0 * mass * speed, shear_strength(), 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace edda::bent_base_test
