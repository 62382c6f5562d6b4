// Warnings of joints with fracture energy in blocks that are too large, or on springs too soft.
#include "observe/fracture_report.hpp"

#include <gtest/gtest.h>

#include <string>

#include "run/prepared.hpp"

namespace edda::fracture_report_test {
namespace {

/// A plate of two squares of 1 m, with l_ch = E G_I/T^2 = 1e-2 G_I.
std::string warnings(double energy, const std::string& stiffness = "") {
  const PreparedRun run = testing::prepared(
      "gravity = [0, 0]\nplane = 'stress'\n[materials.rock]\ndensity = 2600\nyoung = 1e10\n"
      "poisson = 0.3\n[joints.j]\nfriction_angle = 30\ncohesion = 1e6\ntensile_strength = 1e6\n"
      "shear_fracture_energy = 1e4\nfracture_energy = " +
      std::to_string(energy) + "\n" + stiffness +
      "[contact]\njoint = 'j'\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
      "[[block]]\npolygon = [[1, 0], [2, 0], [2, 1], [1, 1]]\n[solver]\nduration = 1\n");
  std::vector<std::string> found;
  warn_of_coarse_cracks(run.sim, found);
  std::string all;
  for (const std::string& line : found) all += line + '\n';
  return all;
}

TEST(FractureReport, FacesLongForTheProcessZone) {
  EXPECT_EQ(warnings(301.0), "");
  EXPECT_NE(warnings(299.0).find("process zone of 2.99 m"), std::string::npos);
}

/// T/kn = 0.1 w_c = 0.2 G_I/T where kn = 5 T^2/G_I.
TEST(FractureReport, SpringsSoftForTheCrack) {
  const double least = 5.0 * 1e12 / 400.0;
  const auto springs = [](double kn) { return "kn = " + std::to_string(kn) + "\nks = 1e11\n"; };
  EXPECT_EQ(warnings(400.0, springs(1.01 * least)), "");
  EXPECT_NE(warnings(400.0, springs(0.99 * least)).find("raise its kn"), std::string::npos);
  EXPECT_NE(warnings(400.0, "kn = 1e11\nks = 4e8\n").find("raise its ks"), std::string::npos);
}

}  // namespace
}  // namespace edda::fracture_report_test
