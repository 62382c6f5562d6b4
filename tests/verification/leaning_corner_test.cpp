// Corners that lean on an edge, at any angle, have the friction of the joint: validation.md rows 66
// and 67.
#include <optional>
#include <utility>

#include "study/fos.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::leaning_corner_test {
namespace {

constexpr double gravity = 9.81;

/// A sled of 3 m on two pointed feet, of which the sides stand at `left` and `right` degrees to the
/// ground; gravity is tilted by `angle` degrees. Damping, stiffness and step are not given.
struct Sled {
  double left, right, friction, angle;

  std::string label() const {
    return "sides at " + brief(left) + " and " + brief(right) + " degrees, " + brief(angle) + "/" +
           brief(friction);
  }
  std::string toml() const {
    const double foot = 0.4, a = radians(angle);
    const double x = foot / std::tan(radians(left)), y = foot / std::tan(radians(right));
    const auto at = [](double u, double v) { return "[" + number(u) + "," + number(v) + "],"; };
    return "gravity = [" + number(gravity * std::sin(a)) + "," + number(-gravity * std::cos(a)) +
           "]\n[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.25\n"
           "[joints.j]\nfriction_angle = " +
           number(friction) +
           "\n[[block]]\nfixed = true\npolygon = [[-5,-1],[15,-1],[15,0],[-5,0]]\n"
           "[[block]]\npolygon = [" +
           at(0.0, 0.0) + at(y, foot) + at(3.0 - x, foot) + at(3.0, 0.0) + at(3.0 + y, foot) +
           at(3.0 + y, 1.0) + at(-x, 1.0) + at(-x, foot) +
           "]\n[solver]\nduration = 1.0\n[output]\nhistory_every = 0.01\n";
  }
};

constexpr std::pair<double, double> feet[] = {{10.0, 80.0}, {20.0, 70.0}, {30.0, 30.0},
                                              {45.0, 45.0}, {60.0, 60.0}, {75.0, 75.0},
                                              {80.0, 30.0}, {80.0, 20.0}};

/// A degree below the friction angle it stands, five degrees beyond it slides as a rigid block.
TEST(LeaningCorners, HaveTheFrictionOfTheJoint) {
  for (const auto& [left, right] : feet) {
    const Sled stands{left, right, 25.0, 24.0};
    Simulation sim = scene(stands.toml());
    std::optional<double> at_start;
    run(sim, [&](Simulation& s) {
      if (!at_start && s.motion.state.time > 0.3) at_start = displacement(s, 1).x;
    });
    ASSERT_TRUE(at_start);
    expect_at_most({66, stands.label(), "creep after 0.3 s", "m"},
                   std::abs(displacement(sim, 1).x - *at_start), 1e-5);
    const Sled slides{left, right, 25.0, 30.0};
    sim = scene(slides.toml());
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    const double exact = 0.5 * gravity *
                         (std::sin(radians(slides.angle)) -
                          std::tan(radians(slides.friction)) * std::cos(radians(slides.angle)));
    expect_relative({66, slides.label(), "distance slid in 1 s", "m"}, displacement(sim, 1).x,
                    exact, 1e-2);
    EXPECT_LT(error, 1e-6) << slides.label();
  }
}

/// A bar of 4 m that leans against a wall, on its lower corner on the floor and on its upper one at
/// the wall, its underside at `angle` degrees to the floor.
struct LeaningBar {
  double angle, on_floor, on_wall;
  static constexpr double length = 4.0, thickness = 0.3;

  double reach() const { return length * std::cos(radians(angle)); }
  double height() const { return length * std::sin(radians(angle)); }
  Vec2 across() const {
    return {thickness * std::sin(radians(angle)), thickness * std::cos(radians(angle))};
  }
  std::string toml() const {
    const auto at = [](double x, double y) { return "[" + number(x) + "," + number(y) + "]"; };
    const auto joint = [](const std::string& name, double friction) {
      return "[joints." + name + "]\nfriction_angle = " + number(friction) + "\n";
    };
    return "[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.25\n" +
           joint("floor", on_floor) + joint("wall", on_wall) +
           "[contact]\njoint = 'floor'\n[[block]]\npolygon = [" + at(reach(), 0.0) + "," +
           at(0.0, height()) + "," + at(across().x, height() + across().y) + "," +
           at(reach() + across().x, across().y) +
           "]\n[[block]]\nfixed = true\njoint = 'floor'\npolygon = [[0,-1],[5,-1],[5,0],[0,0]]\n"
           "[[block]]\nfixed = true\njoint = 'wall'\npolygon = [[-1,-1],[0,-1],[0,5],[-1,5]]\n"
           "[solver]\nduration = 3.0\n[fos]\n";
  }
  /// N at the floor and m N at the wall, with friction at both limits: moments about the lower
  /// corner.
  double factor() const {
    const double centroid = 0.5 * (reach() + across().x);
    double low = 0.1, high = 10.0;
    for (int n = 0; n < 60; ++n) {
      const double f = 0.5 * (low + high);
      const double m = std::tan(radians(on_floor)) / f, w = std::tan(radians(on_wall)) / f;
      const double wall = m / (1.0 + m * w);  // of the weight
      (wall * (height() + w * reach()) > reach() - centroid ? low : high) = f;
    }
    return low;
  }
};

TEST(LeaningCorners, ABarLeansAgainstAWall) {
  for (const LeaningBar bar :
       {LeaningBar{60.0, 22.0, 14.0}, {60.0, 22.0, 0.0}, {50.0, 30.0, 14.0}, {70.0, 15.0, 30.0}}) {
    const std::string label = brief(bar.angle) + " degrees, friction " + brief(bar.on_floor) +
                              " and " + brief(bar.on_wall);
    const Result<Model> model = read_model_text(bar.toml(), EDDA_SOURCE_DIR "/scene.toml", {});
    ASSERT_TRUE(model.ok()) << to_string(model.faults().front());
    const Result<FosResult> found = find_factor(model.value(), {});
    ASSERT_TRUE(found.ok()) << to_string(found.faults().front());
    ASSERT_TRUE(found.value().factor) << label << ": " << found.value().message;
    expect_relative({67, label, "factor of safety", ""}, *found.value().factor, bar.factor(), 1e-2);
    ASSERT_TRUE(found.value().rigid);
    expect_relative({67, label, "limit of rigid blocks", ""}, found.value().rigid->most,
                    bar.factor(), 1e-3);
  }
}

}  // namespace
}  // namespace edda::leaning_corner_test
