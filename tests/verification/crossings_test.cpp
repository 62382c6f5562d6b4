// Joints that cross, end on each other or meet at a point, under one pressure all round: every
// block has that pressure, whatever the joints are, since each of them closes uniformly.
#include "verification/models.hpp"
#include "verification/settled.hpp"

namespace edda::crossings_test {
namespace {

using Blocks = std::vector<std::vector<Vec2>>;

std::string points(const std::vector<Vec2>& ring) {
  std::string text;
  for (const Vec2 p : ring) text += "[" + number(p.x) + "," + number(p.y) + "],";
  return "[" + text + "]";
}

constexpr double pressure = 1e5;

/// Two laws: a measured stiffness, and none, where it is a penalty.
struct Law {
  const char* name;
  const char* keys;
};
constexpr Law laws[] = {{"kn", "kn = 2e10\nks = 2e10\n"}, {"penalty", ""}};

/// The pressure comes slowly (twice a half of it), so that no joint opens and shears on the way.
const std::string slowly =
    "history = 'tests/verification/ramp_up.csv'\n[[stage]]\nduration = 0.06\n"
    "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-8\n";

/// Largest relative deviation of the stress of a block from -p, in any direction. `more`: the model
/// from the table of the load on.
double stress_off(const Blocks& blocks, const std::vector<Vec2>& outline, const Law& law,
                  double friction, const std::string& more = slowly) {
  std::vector<Vec2> round = outline;
  round.push_back(outline.front());
  std::string text =
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = " +
      number(friction) + "\n" + law.keys + "[[load]]\nalong = " + points(round) +
      "\npressure = " + number(0.5 * pressure) + "\n" + more;
  for (const auto& ring : blocks) text += "[[block]]\npolygon = " + points(ring) + "\n";
  const PreparedRun r = settled(text);
  double worst = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Tensor stress = stress_of(r.sim, i);
    keep_largest(worst, stress.xx / pressure + 1.0);
    keep_largest(worst, stress.yy / pressure + 1.0);
    keep_largest(worst, stress.xy / pressure);
  }
  return worst;
}

/// The sectors of a polygon with its centre at the origin.
Blocks wedges_of(const std::vector<Vec2>& outline) {
  Blocks wedges;
  for (std::size_t q = 0; q < outline.size(); ++q)
    wedges.push_back({{0, 0}, outline[q], outline[(q + 1) % outline.size()]});
  return wedges;
}

TEST(Wedges, AtOnePointCarryThePressureAllRound) {
  for (const Law& law : laws) {
    for (const int count : {4, 5, 6, 7, 8}) {
      std::vector<Vec2> outline;
      for (int q = 0; q < count; ++q)
        outline.push_back(rotated({1.0, 0.0}, 2.0 * std::numbers::pi * q / count));
      expect_at_most(
          {60, std::to_string(count) + " wedges, " + law.name, "stress, part off the pressure", ""},
          stress_off(wedges_of(outline), outline, law, 30.0), 1e-4);
    }
  }
}

/// The diagonals of a rectangle.
TEST(Crossing, OfDiagonalsCarriesThePressure) {
  for (const Law& law : laws) {
    for (const double angle : {20.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
      const double c = std::cos(0.5 * radians(angle)), s = std::sin(0.5 * radians(angle));
      const std::vector<Vec2> outline = {{-c, -s}, {c, -s}, {c, s}, {-c, s}};
      expect_at_most({60, "diagonals at " + brief(angle) + " degrees, " + law.name,
                      "stress, part off the pressure", ""},
                     stress_off(wedges_of(outline), outline, law, 30.0), 1e-4);
    }
  }
}

/// Four parallelograms.
TEST(Crossing, OfJointsThatRunThroughCarriesThePressure) {
  for (const Law& law : laws) {
    for (const double angle : {20.0, 30.0, 45.0, 60.0, 75.0}) {
      const Vec2 u{1.0, 0.0}, v{std::cos(radians(angle)), std::sin(radians(angle))};
      Blocks blocks;
      for (const Vec2 p : {Vec2{}, -1.0 * u, -1.0 * v, -1.0 * (u + v)})
        blocks.push_back({p, p + u, p + u + v, p + v});
      expect_at_most({60, "joints at " + brief(angle) + " degrees, " + law.name,
                      "stress, part off the pressure", ""},
                     stress_off(blocks, {-1.0 * (u + v), u - v, u + v, v - u}, law, 30.0), 1e-4);
    }
  }
}

/// Three blocks where a joint ends on another: the two beside it are displaced along the one that
/// runs through, so that there must be no friction.
TEST(Crossing, AJointThatEndsOnAnotherLeavesThePressure) {
  for (const Law& law : laws) {
    for (const double angle : {30.0, 60.0, 90.0}) {
      const Vec2 v{1.0 / std::tan(radians(angle)), 1.0};
      const Blocks blocks = {{{-2, -1}, {2, -1}, {2, 0}, {-2, 0}},
                             {{-2, 0}, {0, 0}, v, {-2, 1}},
                             {{0, 0}, {2, 0}, {2, 1}, v}};
      expect_at_most({60, "T at " + brief(angle) + " degrees, " + law.name,
                      "stress, part off the pressure", ""},
                     stress_off(blocks, {{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}, law, 0.0,
                                "history = 'tests/verification/ramp_up.csv'\n[solver]\n"
                                "duration = 0.1\ndamping = { mass = 500.0 }\n"),
                     1e-4);
    }
  }
}

/// A block whose sides are inclined outwards from its base is carried by the whole base: it settles
/// by W/(k L), without a kn on two springs by W/2p. That is 6e-8 m: the rounding of coordinates of
/// 5 m alone is 2e-8 of the force.
TEST(BaseCorners, OfAnyAngleSettleByTheStiffnessOfTheJoint) {
  for (const Law& law : laws) {
    for (const double angle : {100.0, 110.0, 120.0, 135.0, 150.0}) {
      const double out = std::tan(radians(angle - 90.0));
      const PreparedRun r = settled(
          std::string("[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
                      "friction_angle = 30\n") +
          law.keys + "[[block]]\nfixed = true\npolygon = " + rectangle(-5, -1, 5, 0) +
          "\n[[block]]\npolygon = " +
          points({{-0.5, 0}, {0.5, 0}, {0.5 + out, 1}, {-0.5 - out, 1}}) +
          "\n[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n");
      const Simulation& s = r.sim;
      const double stiffness = s.motion.laws.rows[0].kn > 0.0 ? 2e10 : 2.0 * 10.0 * 20e9;
      const double exact = 2600.0 * (1.0 + out) * 9.81 / stiffness;
      for (const Id v : {s.scene->blocks.vertex_begin[1], s.scene->blocks.vertex_begin[1] + 1}) {
        EXPECT_NEAR((s.scene->blocks.vertex_y[v] - s.motion.pose.y[v]) / exact, 1.0, 1e-5)
            << angle << ' ' << law.name;
      }
    }
  }
}

}  // namespace
}  // namespace edda::crossings_test
