// Factors of safety that have a formula: validation.md rows 40 to 46.
#include "run/fos.hpp"

#include <array>

#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::fos_test {
namespace {

FosResult factor_of(const std::string& toml, const std::string& fos = {}) {
  const Result<Model> model =
      read_model_text(toml + "[fos]\n" + fos, EDDA_SOURCE_DIR "/scene.toml", {});
  if (!model.ok()) {
    ADD_FAILURE() << to_string(model.faults().front());
    return {};
  }
  Result<FosResult> found = find_factor(model.value(), {});
  if (!found.ok()) {
    ADD_FAILURE() << to_string(found.faults().front());
    return {};
  }
  EXPECT_EQ(found.value().status, FosStatus::found) << found.value().message;
  return std::move(found.value());
}

/// Holds the factor to its formula, and keeps the state of its mechanism.
void expect_factor(const FosResult& r, int row, const std::string& label, double exact,
                   double bound) {
  ASSERT_TRUE(r.factor) << label;
  expect_relative({row, label, "factor of safety", ""}, *r.factor, exact, bound);
  if (r.failed) record_model(row, label, *r.failed);
  for (const Trial& trial : r.trials) {
    EXPECT_FALSE(trial.reason.starts_with("diverged")) << trial.reason;
  }
}

const MovingBlock* moving(const FosResult& r, Id id) {
  if (!r.mechanism) return nullptr;
  for (const MovingBlock& b : r.mechanism->blocks) {
    if (b.id == id) return &b;
  }
  return nullptr;
}

/// Row 40: the paper's ramp; F = tan(phi)/tan(alpha).
TEST(FactorOfSafety, Ramp) {
  Series factors(40, "", {"phi", "exact", "computed"});
  for (const auto& [phi, young] : {std::pair{35.0, "200e6"},
                                   {40.0, "200e6"},
                                   {45.0, "200e6"},
                                   {50.0, "200e6"},
                                   {35.0, "2e9"}}) {
    const FosResult r = factor_of(ramp(30.0, phi, young), "tolerance = 0.004\n");
    const double exact = std::tan(radians(phi)) / std::tan(radians(30.0));
    expect_factor(r, 40, ramp_label(30.0, phi, young), exact, 5e-3);
    if (r.factor && std::string(young) == "200e6") factors.add({phi, exact, *r.factor});
    const MovingBlock* slider = moving(r, 1);
    ASSERT_NE(slider, nullptr);
    EXPECT_EQ(slider->motion, Motion::slides);
    EXPECT_LT(slider->turning_part, 0.05);
    ASSERT_EQ(r.mechanism->joints.size(), 1U);
    EXPECT_GT(r.mechanism->joints[0].slip, 0.5 * slider->largest);
  }
}

/// Row 41: a block over a plane that daylights, an open vertical tension crack behind it, cohesion
/// on the plane, water in the crack and, from its foot to nothing at the toe, on the plane (Hoek
/// and Bray 1981): F = [c A + (W cos p - U - V sin p) tan phi]/(W sin p + V cos p).
struct PlaneSlide {
  double dip = 35.0, face = 60.0, height = 12.0, crack_at = 12.0;  ///< degrees, m
  double cohesion = 20e3, phi = 30.0, water = 0.0;                 ///< Pa, degrees, m in the crack

  double foot() const { return crack_at * std::tan(radians(dip)); }
  double plane() const { return crack_at / std::cos(radians(dip)); }

  double exact() const {
    const double p = radians(dip), unit_weight = 26e3, gw = 9810.0;
    const double crest = height / std::tan(radians(face));
    const double area =
        0.5 * height * crest + height * (crack_at - crest) - 0.5 * crack_at * foot();
    const double w = unit_weight * area, v = 0.5 * gw * water * water;
    const double u = 0.5 * gw * water * plane();
    return (cohesion * plane() + (w * std::cos(p) - u - v * std::sin(p)) * std::tan(radians(phi))) /
           (w * std::sin(p) + v * std::cos(p));
  }

  std::string toml() const {
    const auto point = [](double x, double y) { return "[" + number(x) + "," + number(y) + "]"; };
    const std::string foot_of_crack = point(crack_at, foot()), top = point(crack_at, height);
    const std::string crest = point(height / std::tan(radians(face)), height);
    std::string text =
        "[materials.rock]\nunit_weight = 26e3\nyoung = 5e9\npoisson = 0.25\n[joints.plane]\n"
        "friction_angle = " +
        number(phi) + "\ncohesion = " + number(cohesion) +
        "\n[solver]\nduration = 1\n[[block]]\nfixed = true\npolygon = [[0, 0], [-4, -9], [30, "
        "-9], " +
        point(30, foot()) + ", " + foot_of_crack + "]\n[[block]]\npolygon = [[0, 0], " +
        foot_of_crack + ", " + top + ", " + crest + "]\n";
    if (water > 0.0) {
      text += "[[water]]\ntable = [[0, 0], " + point(crack_at, foot() + water) + "]\n";
    }
    return text;
  }
};

TEST(FactorOfSafety, PlaneSlideWithCohesionAndWater) {
  for (const auto& [cohesion, water] : {std::pair{20e3, 0.0}, {20e3, 1.8}, {40e3, 3.4}}) {
    PlaneSlide slide;
    slide.cohesion = cohesion;
    slide.water = water;
    const FosResult r = factor_of(slide.toml(), "tolerance = 0.004\n");
    expect_factor(r, 41, "c " + brief(cohesion / 1e3) + " kPa, water " + brief(water) + " m",
                  slide.exact(), 1e-2);
    const MovingBlock* slider = moving(r, 1);
    ASSERT_NE(slider, nullptr);
    EXPECT_EQ(slider->motion, Motion::slides);
  }
}

/// A block of 1 x h on level ground, pushed along it at the height `at` by a tenth of its weight.
std::string pushed(double h, double at, double phi) {
  const double weight = 26e3 * h;
  return "[materials.rock]\nunit_weight = 26e3\nyoung = 2e9\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = " +
         number(phi) +
         "\n[solver]\nduration = 1\n[[block]]\nfixed = true\npolygon = [[-9, -1], [9, -1], [9, 0], "
         "[-9, 0]]\n[[block]]\npolygon = " +
         rectangle(0, 0, 1, h) + "\n[[load]]\nname = 'push'\npoint = [0, " + number(at) +
         "]\nforce = [" + number(0.1 * weight) + ", 0]\n";
}

/// Row 42: slides where P = W tan(phi), tips where P h = W b/2.
TEST(FactorOfSafety, LoadThatGrows) {
  const std::string vary = "vary = 'load:push'\nbracket = [0.5, 4.0]\ntolerance = 0.01\n";
  const FosResult slides = factor_of(pushed(1.0, 0.1, 20.0), vary);
  expect_factor(slides, 42, "slides", std::tan(radians(20.0)) / 0.1, 1e-2);
  ASSERT_NE(moving(slides, 1), nullptr);
  EXPECT_EQ(moving(slides, 1)->motion, Motion::slides);
  const FosResult tips = factor_of(pushed(4.0, 3.0, 40.0), vary);
  expect_factor(tips, 42, "tips", 0.5 / 3.0 / 0.1, 1e-2);
  ASSERT_NE(moving(tips, 1), nullptr);
  EXPECT_EQ(moving(tips, 1)->motion, Motion::topples);
  EXPECT_LT(moving(tips, 1)->rotation, 0.0);
}

/// Row 43: the slope of sixteen blocks of Goodman and Bray (1976), in the numbers of Hoek and
/// Bray's example.
struct TopplingSlope {
  static constexpr int count = 16, crest = 10;
  static constexpr double width = 10.0, a1 = 5.0, a2 = 5.2, b = 1.0, unit_weight = 25e3;
  static constexpr double dip = 30.0;  ///< of the bases, degrees

  std::array<double, count + 1> height{};  ///< [1..count] from the toe

  TopplingSlope() {
    for (int n = 1; n <= count; ++n) {
      height[static_cast<std::size_t>(n)] =
          n <= crest ? n * (a1 - b) : height[static_cast<std::size_t>(n - 1)] - a2 - b;
    }
  }
  double y(int n) const { return height[static_cast<std::size_t>(n)]; }

  /// Force that keeps block 1 from going, from block to block down the slope: each passes on what
  /// it needs not to topple, or not to slide, whichever is more (Goodman and Bray's equations).
  double tie(double phi) const {
    const double t = std::tan(radians(phi)), s = std::sin(radians(dip)), c = std::cos(radians(dip));
    double p = 0.0;
    for (int n = count; n >= 1; --n) {
      const double w = unit_weight * width * y(n);
      const double m = n < crest ? y(n) : y(n) - a2, l = n <= crest ? y(n) - a1 : y(n);
      const double topples =
          l > 0.0 ? (p * (m - width * t) + 0.5 * w * (y(n) * s - width * c)) / l : 0.0;
      const double slides = p - w * (c * t - s) / (1.0 - t * t);
      p = std::max(topples, slides);
      if (n > 1) p = std::max(p, 0.0);
    }
    return p;
  }
  /// The friction angle at which no tie is needed.
  double limit() const {
    double low = 30.0, high = 44.0;
    while (high - low > 1e-6) {
      const double middle = 0.5 * (low + high);
      (tie(middle) > 0.0 ? low : high) = middle;
    }
    return low;
  }

  std::string toml(double phi) const {
    const double c = std::cos(radians(dip)), s = std::sin(radians(dip));
    const auto point = [&](double u, double v) {
      return "[" + number(u * c - v * s) + "," + number(u * s + v * c) + "]";
    };
    std::string text =
        "[materials.rock]\nunit_weight = 25e3\nyoung = 5e9\npoisson = 0.25\n[joints.j]\n"
        "friction_angle = " +
        number(phi) + "\n[solver]\nduration = 1\n[[block]]\nfixed = true\npolygon = [" +
        point(-40, -20) + "," + point(190, -20) + "," + point(190, b * (count - 1));
    for (int n = count - 1; n >= 1; --n) {
      text += "," + point(n * width, n * b) + "," + point(n * width, (n - 1) * b);
    }
    text += "," + point(-40, 0) + "]\n";
    for (int n = 1; n <= count; ++n) {
      const double u = (n - 1) * width, v = (n - 1) * b;
      text += "[[block]]\npolygon = [" + point(u, v) + "," + point(u + width, v) + "," +
              point(u + width, v + y(n)) + "," + point(u, v + y(n)) + "]\n";
    }
    return text;
  }
};

TEST(FactorOfSafety, GoodmanAndBraysSlope) {
  const TopplingSlope slope;
  EXPECT_NEAR(slope.limit(), 38.15, 0.05);  // as the book has it
  EXPECT_EQ(slope.y(10), 40.0);
  EXPECT_NEAR(slope.y(16), 2.8, 1e-12);
  const double phi = 38.15;
  const FosResult r = factor_of(slope.toml(phi), "bracket = [0.9, 1.1]\ntolerance = 0.01\n");
  ASSERT_TRUE(r.factor);
  const double at_limit = std::atan(std::tan(radians(phi)) / *r.factor) * 180.0 / std::numbers::pi;
  expect_relative({43, "", "friction angle at the limit", "degrees"}, at_limit, slope.limit(),
                  1.5 / 38.15);
  record_model(43, "", *r.failed);
  // The book: blocks 16 to 14 stay, 13 to 4 topple, 3 to 1 slide.
  for (Id n = 1; n <= 16; ++n) {
    const MovingBlock* block = moving(r, n);
    ASSERT_EQ(block == nullptr, n >= 14) << n;
    if (block != nullptr) {
      EXPECT_EQ(block->motion, n >= 4 ? Motion::topples : Motion::slides) << n;
    }
  }
}

/// Row 44: a block on a slope yields to a horizontal acceleration of g tan(phi - alpha).
TEST(FactorOfSafety, ShakingThatGrows) {
  const double alpha = 20.0, phi = 35.0;
  const std::string toml = ramp(alpha, phi, "200e6", 1, "damping = { contact = 0.1 }\n") +
                           "[[shaking]]\nname = 'push'\napply = 'inertia'\nacceleration = "
                           "'tests/verification/push.csv'\n";
  const FosResult r = factor_of(toml,
                                "vary = 'shaking:push'\nbracket = [1.0, 4.0]\ntolerance = 0.01\n"
                                "fails = { displacement = 0.005 }\n");
  expect_factor(r, 44, "", 9.8 * std::tan(radians(phi - alpha)), 1e-2);
}

/// Row 45: the dam of row 14 under a lake of 5 m whose water grows heavier: it overturns where
/// F gw h^3/6 = gc B^2 H/2.
TEST(FactorOfSafety, WaterThatGrows) {
  const double depth = 5.0;
  const std::string toml =
      "[materials.concrete]\nunit_weight = 24e3\nyoung = 20e9\npoisson = 0.2\n[joints.base]\n"
      "friction_angle = 35\n[contact]\nnormal_stiffness = 20e9\n[[block]]\nfixed = true\n"
      "polygon = [[-3, -1], [9, -1], [9, 0], [-3, 0]]\n[[block]]\npolygon = " +
      rectangle(0, 0, 2, 8) +
      "\n[[water]]\nname = 'lake'\ntable = [[-9, 5], [0, 5]]\n[solver]\nduration = 1\n";
  const FosResult r = factor_of(toml, "vary = 'water:lake'\ntolerance = 0.01\n");
  expect_factor(r, 45, "", 3.0 * 24e3 * 4.0 * 8.0 / (9810.0 * depth * depth * depth), 1e-2);
  ASSERT_NE(moving(r, 1), nullptr);
  EXPECT_EQ(moving(r, 1)->motion, Motion::topples);
}

}  // namespace
}  // namespace edda::fos_test
