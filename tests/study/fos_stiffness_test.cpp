// Why the factor of an elastic arch is below that of a rigid one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/read_model.hpp"
#include "study/fos.hpp"

namespace edda::fos_stiffness_test {
namespace {

/// A semicircular arch of seven voussoirs, loaded on its haunch.
Model arch(double young, double kn) {
  constexpr int voussoirs = 7;
  constexpr double radius = 5.0, half = 0.5;
  const auto point = [&](double r, double k) {
    const double angle = std::numbers::pi * (1.0 - k / voussoirs);
    return "[" + std::to_string(r * std::cos(angle)) + ", " + std::to_string(r * std::sin(angle)) +
           "]";
  };
  std::string text =
      "[materials.stone]\ndensity = 2400\nyoung = " + std::to_string(young) +
      "\npoisson = 0.2\n[joints.j]\nfriction_angle = 50\nkn = " + std::to_string(kn) +
      "\nks = " + std::to_string(kn) + "\n[contact]\njoint = \"j\"\n";
  for (int k = 0; k < voussoirs; ++k) {
    text += "[[block]]\npolygon = [" + point(radius - half, k + 1) + ", " +
            point(radius + half, k + 1) + ", " + point(radius + half, k) + ", " +
            point(radius - half, k) + "]\n";
  }
  const double outer = radius + half, chord = outer * std::cos(0.5 * std::numbers::pi / voussoirs),
               at = std::numbers::pi * (1.0 - 2.5 / voussoirs);
  text +=
      "[[block]]\nfixed = true\npolygon = [[-6, -1], [-4, -1], [-4, 0], [-6, 0]]\n"
      "[[block]]\nfixed = true\npolygon = [[4, -1], [6, -1], [6, 0], [4, 0]]\n"
      "[[load]]\nname = \"p\"\npoint = [" +
      std::to_string(chord * std::cos(at)) + ", " + std::to_string(chord * std::sin(at)) +
      "]\nforce = [0, -1000]\n[fos]\nvary = \"load:p\"\ntolerance = 0.01\n[solver]\nduration = 1\n";
  Result<Model> model = read_model_text(text, "m.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  return std::move(model.value());
}

/// The sentence has the factor that the search finds where all is ten times as stiff.
TEST(FosStiffness, ASoftArchSaysWhatItsStiffnessCosts) {
  const Result<FosResult> soft = find_factor(arch(2e10, 3e8), {}),
                          stiff = find_factor(arch(2e11, 3e9), {});
  ASSERT_TRUE(soft.ok() && stiff.ok());
  const FosResult &r = soft.value(), &ten = stiff.value();
  ASSERT_TRUE(r.factor && ten.factor && r.rigid && ten.rigid);
  ASSERT_LT(*r.factor, 0.95 * r.rigid->least);
  ASSERT_GT(*ten.factor, 1.05 * *r.factor);
  const std::string key = ", since rock and joints deform: it is ";
  const std::size_t from = r.rigid->text.find(key);
  ASSERT_NE(from, std::string::npos) << r.rigid->text;
  EXPECT_NEAR(std::stod(r.rigid->text.substr(from + key.size())), *ten.factor, 0.03 * *ten.factor)
      << r.rigid->text;
  EXPECT_NE(r.rigid->text.find("% lower than theirs"), std::string::npos);
}

/// Nothing is said of stiffness where the factor is that of rigid blocks.
TEST(FosStiffness, AStiffArchSaysNothing) {
  const Result<FosResult> found = find_factor(arch(2e12, 1e13), {});
  ASSERT_TRUE(found.ok() && found.value().rigid);
  EXPECT_EQ(found.value().rigid->text.find("ten times as stiff"), std::string::npos)
      << found.value().rigid->text;
}

}  // namespace
}  // namespace edda::fos_stiffness_test
