// The estimate of what blocks of one strain take off closures and deflections, against what runs
// to equilibrium have shown of these models.
#include "observe/locking.hpp"

#include <gtest/gtest.h>

#include <string>

#include "run/prepared.hpp"

namespace edda::locking_test {
namespace {

using testing::prepared;

/// A circular opening of radius `radius` in a mass cut by sets at these angles.
std::string tunnel(const std::string& angles, double spacing, double radius,
                   const std::string& joint,
                   const std::string& deformation = "deformation = 'uniform'") {
  std::string text = deformation + R"(
gravity = [0, 0]
[materials.rock]
density = 2600
young = 10e9
poisson = 0.25
[joints.j]
type = "glued"
)" + joint + R"(
[domain]
outline = [[-14, -14], [14, -14], [14, 14], [-14, 14]]
joint = "j"
)";
  for (std::size_t from = 0; from < angles.size();) {
    const std::size_t to = std::min(angles.find(' ', from), angles.size());
    text += "[[joint_set]]\nangle = " + angles.substr(from, to - from) +
            "\nspacing = " + std::to_string(spacing) + "\norigin = [0.05, 0.05]\n";
    from = to + 1;
  }
  return text + "[[opening]]\nname = \"t\"\nshape = { kind = \"circle\", at = [0, 0], width = " +
         std::to_string(2.0 * radius) + R"( }
[initial_stress]
stress = [-10e6, -10e6, 0]
[[boundary]]
sides = ["left", "right", "bottom", "top"]
type = "roller"
[[stage]]
until = "equilibrium"
[[stage]]
until = "equilibrium"
excavate = ["t"]
)";
}

double lost(const std::string& angles, double spacing, double radius, const std::string& joint) {
  const PreparedRun run = prepared(tunnel(angles, spacing, radius, joint));
  return locked_openings(run.sim).at(0).lost;
}

/// Measured against elastic solutions, joints included.
TEST(Locking, OfSquaresAroundAnOpening) {
  EXPECT_NEAR(lost("0 90", 2.0, 4.0, ""), 0.44, 0.08);
  EXPECT_NEAR(lost("0 90", 1.0, 4.0, ""), 0.21, 0.05);
  EXPECT_NEAR(lost("0 90", 0.5, 4.0, ""), 0.066, 0.03);
  EXPECT_NEAR(lost("0 90", 1.0, 3.0, ""), 0.35, 0.08);
  EXPECT_NEAR(lost("0 90", 1.0, 3.0, "kn = 1e12\nks = 1e12\n"), 0.57, 0.08);
  // kn s/E, ks s/E, s, and what is lost of what s -> 0 leaves.
  const struct {
    double kn, ks, s, lost;
  } cases[] = {{5, 2.5, 2, 0.07},  {5, 2.5, 1, 0.037}, {10, 5, 2, 0.165},   {10, 5, 1, 0.071},
               {20, 10, 2, 0.274}, {20, 10, 1, 0.118}, {20, 10, 0.5, 0.03}, {20, 20, 2, 0.348},
               {20, 20, 1, 0.161}, {20, 20, 0.5, 0.04}};
  for (const auto& c : cases) {
    const std::string joint = "kn = " + std::to_string(c.kn * 10e9 / c.s) +
                              "\nks = " + std::to_string(c.ks * 10e9 / c.s) + "\n";
    EXPECT_NEAR(lost("0 90", c.s, 4.0, joint), c.lost, 0.02 + 0.15 * c.lost)
        << c.kn << ' ' << c.ks << ' ' << c.s;
  }
}

TEST(Locking, NotOfTrianglesNorOfSoftJoints) {
  EXPECT_LT(lost("0 60 120", 1.3, 3.0, ""), 0.08);
  EXPECT_LT(lost("0 60 120", 1.3, 3.0, "kn = 1e12\nks = 1e12\n"), 0.1);
  EXPECT_LT(lost("0 90", 1.0, 4.0, "kn = 1e10\nks = 4e9\n"), 0.03);
}

/// More where joints are stiffer or blocks larger; the same in other units of length.
TEST(Locking, GrowsWithStiffnessAndSizeAlone) {
  double before = 0.0;
  for (const char* kn : {"1e10", "3e10", "1e11", "3e11", "1e12", "1e13"}) {
    const double now = lost("0 90", 1.0, 3.0, "kn = " + std::string(kn) + "\n");
    EXPECT_GT(now, before) << kn;
    before = now;
  }
  EXPECT_GT(lost("0 90", 1.0, 2.0, ""), lost("0 90", 1.0, 4.0, ""));
  EXPECT_NEAR(lost("0 90", 1.0, 4.0, ""), lost("0 90", 0.5, 2.0, ""), 0.03);
}

/// A beam of glued blocks, fixed at one end, under this load.
std::string beam(const std::string& load, const std::string& joint,
                 const std::string& deformation = "deformation = 'uniform'") {
  std::string text = deformation + R"(
gravity = [0, 0]
[materials.rock]
density = 2600
young = 20e9
poisson = 0.2
[joints.j]
type = "glued"
)" + joint + "\n[[block]]\nfixed = true\npolygon = [[-2, -1], [0, -1], [0, 2], [-2, 2]]\n";
  for (int k = 0; k < 10; ++k) {
    const std::string a = std::to_string(k), b = std::to_string(k + 1);
    text +=
        "[[block]]\npolygon = [[" + a + ", 0], [" + b + ", 0], [" + b + ", 1], [" + a + ", 1]]\n";
  }
  return text + "[[load]]\npoint = [10, 0.5]\nforce = " + load +
         "\n[[stage]]\nuntil = \"equilibrium\"\n";
}

/// Against the elastic beam with shear, P L^3/(3 E' I) + 1.2 P L/(G A).
TEST(Locking, OfACantileverIsWhatTheRunLoses) {
  for (const char* joint : {"", "kn = 2e11\nks = 8e10\n", "kn = 6e11\nks = 6e11\n"}) {
    PreparedRun run = prepared(beam("[0, -1e4]", joint));
    const LockedRow row = locked_row(run.sim);
    EXPECT_EQ(row.blocks.size(), 9u);
    EXPECT_NEAR(row.kn, 20e9 / (1.0 - 0.04), 1e6);
    ASSERT_TRUE(run_model(run, {}).ok());
    const Simulation& sim = run.sim;
    const std::size_t tip = 10;
    const double moved =
        sim.scene->blocks.centroid_y[tip] - centroid(sim.motion.state.position, tip).y;
    const double young = 20e9 / 0.96, shear = 20e9 / 2.4, at = 9.5;  // of the last centroid
    const double exact =
        1e4 * (at * at * (3.0 * 10.0 - at) / (6.0 * young / 12.0) + 1.2 * at / shear);
    EXPECT_NEAR(row.lost, 1.0 - moved / exact, 0.05) << joint;
  }
}

TEST(Locking, IsWarnedOfWhereItBends) {
  const auto warned = [](const std::string& model) {
    const PreparedRun run = prepared(model);
    for (const std::string& w : run.warnings) {
      if (w.find("one strain each") != std::string::npos) return true;
    }
    return false;
  };
  EXPECT_TRUE(warned(beam("[0, -1e4]", "")));
  EXPECT_FALSE(warned(beam("[1e4, 0]", "")));
  EXPECT_FALSE(warned(beam("[0, -1e4]", "kn = 2e10\nks = 2e10\n")));
  EXPECT_TRUE(warned(tunnel("0 90", 1.0, 4.0, "")));
  // Joints that slip close the opening whatever the blocks do.
  const std::string slips = "type = \"coulomb\"\nfriction_angle = 30\ncohesion = ";
  const auto coulomb = [&](const char* cohesion) {
    std::string model = tunnel("0 90", 1.0, 4.0, "");
    const std::string glued = "type = \"glued\"\n";
    return model.replace(model.find(glued), glued.size(), slips + cohesion + "\n");
  };
  EXPECT_FALSE(warned(coulomb("1e5")));
  EXPECT_TRUE(warned(coulomb("20e6")));
  EXPECT_FALSE(warned(tunnel("0 60 120", 1.3, 3.0, "")));
  // A triangle at the edge of a sample is no row, though two joints hold it on opposite sides.
  const std::string sample = R"(
[materials.rock]
density = 2600
young = 30e9
poisson = 0.2
[joints.j]
type = "glued"
[domain]
outline = [[0, 0], [2, 0], [2, 2], [0, 2]]
joint = "j"
[[trace]]
points = [[0, 1], [2, 1]]
[[trace]]
points = [[1, 0.2], [1, 2]]
[[trace]]
points = [[0.5, 0], [1, 0.2], [1.5, 0]]
[[boundary]]
sides = ["top"]
type = "fixed"
[[stage]]
until = "equilibrium"
)";
  EXPECT_FALSE(warned(sample));
  // As blocks are by default.
  EXPECT_FALSE(warned(beam("[0, -1e4]", "", "")));
  EXPECT_FALSE(warned(tunnel("0 90", 1.0, 4.0, "", "")));
}

/// Blocks that bend lock nothing, but may be too coarse for an opening.
TEST(Locking, OfBlocksThatBendIsOfTheirSizeAlone) {
  const auto lost = [](double spacing, double radius, const std::string& joint) {
    const PreparedRun run =
        prepared(tunnel("0 90", spacing, radius, joint, "deformation = 'corners'"));
    return locked_openings(run.sim).at(0);
  };
  EXPECT_EQ(lost(1.0, 3.0, "").lost, 0.0);
  EXPECT_EQ(lost(1.0, 3.0, "kn = 1e12\nks = 1e12\n").lost, 0.0);
  EXPECT_LT(lost(1.5, 3.0, "").lost, 0.01);
  EXPECT_NEAR(lost(2.0, 3.0, "").lost, 0.08, 0.02);
  EXPECT_NEAR(lost(3.0, 3.0, "").lost, 0.09, 0.02);
  EXPECT_TRUE(lost(1.0, 3.0, "").bends);
}

}  // namespace
}  // namespace edda::locking_test
