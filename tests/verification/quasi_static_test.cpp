// Loads that grow slowly, without inertia (row 65).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/read_model.hpp"
#include "study/fos.hpp"
#include "verification/record.hpp"

namespace edda::quasi_static_test {
namespace {

/// Ferris and Tin-Loi's panel: six courses of five units, half units at the ends of the first.
std::string panel(double young) {
  const double b = 0.4, h = 0.175, phi = std::atan(0.65) * 180.0 / std::numbers::pi;
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return fmt::format(
        "polygon = [[{0:.15g},{1:.15g}],[{2:.15g},{1:.15g}],[{2:.15g},{3:.15g}],"
        "[{0:.15g},{3:.15g}]]\n",
        x0, y0, x1, y1);
  };
  std::string text = fmt::format(
      "[materials.stone]\ndensity = 2000\nyoung = {}\npoisson = 0.2\n[joints.dry]\n"
      "friction_angle = {:.15g}\n[[block]]\nfixed = true\n",
      young, phi);
  text += rectangle(-b, -h, 6.0 * b, 0.0);
  for (int course = 0; course < 6; ++course) {
    double from = 0.0;
    for (double to = course % 2 == 0 ? 0.5 * b : b; from < 5.0 * b - 1e-9; to += b) {
      const double end = std::min(to, 5.0 * b);
      text += "[[block]]\n" + rectangle(from, course * h, end, (course + 1) * h);
      from = end;
    }
  }
  return text;
}

TEST(QuasiStatic, APanelFailsAtTheLimitOfRigidBlocksHoweverStiff) {
  for (const char* young : {"50", "5", "0.5"}) {
    const std::string text = panel(std::stod(young) * 1e9) +
                             "[fos]\nvary = \"kh\"\nbracket = [0.63, 0.65]\ntolerance = 0.006\n";
    const Result<Model> model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
    ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
    const Result<FosResult> r = find_factor(model.value(), {});
    ASSERT_TRUE(r.ok()) << to_string(r.faults()[0]);
    ASSERT_TRUE(r.value().factor) << r.value().message;
    expect_relative({65, std::string("E = ") + young + " GPa", "seismic coefficient", ""},
                    *r.value().factor, 0.6428590, 5e-3);
    ASSERT_TRUE(r.value().rigid);
    EXPECT_TRUE(r.value().rigid->below_most);
    EXPECT_NEAR(r.value().rigid->most, 0.6428590, 1e-6);
  }
}

}  // namespace
}  // namespace edda::quasi_static_test
