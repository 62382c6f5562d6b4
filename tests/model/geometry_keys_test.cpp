// What follows from the keys of geometry: joints as mapped, defaults; and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/base_model.hpp"
#include "model/read_model.hpp"
#include "model/write_model.hpp"

namespace edda::geometry_keys_test {
namespace {

using testing::base_model;
using testing::base_with;

Model read(const std::string& text) {
  const Result<Model> result = read_model_text(text, "m.toml");
  if (result.ok()) return result.value();
  for (const Fault& fault : result.faults()) ADD_FAILURE() << to_string(fault);
  return {};
}

JointSet mapped(double dip, double direction, double azimuth, double spacing) {
  const std::string text =
      base_with("angle = 45.0\nspacing = 2.0",
                "dip = " + std::to_string(dip) + "\ndip_direction = " + std::to_string(direction) +
                    "\nspacing = " + std::to_string(spacing)) +
      "[section]\nazimuth = " + std::to_string(azimuth) + "\n";
  return read(text).joint_sets.at(0);
}

/// Two lines of the same direction: their angles differ by multiples of 180 degrees.
void expect_direction(double angle, double expected) {
  EXPECT_NEAR(std::remainder(angle - expected, 180.0), 0.0, 1e-9);
}

TEST(MappedJoints, AlongTheSectionDipAndSpacingAreTrue) {
  // +x points east, the joints dip to the west: up to the right.
  const JointSet west = mapped(60, 270, 90, 2.0);
  expect_direction(west.angle, 60.0);
  EXPECT_NEAR(west.spacing, 2.0, 1e-12);
  expect_direction(mapped(60, 90, 90, 2.0).angle, -60.0);
  expect_direction(mapped(0, 123, 90, 2.0).angle, 0.0);
  expect_direction(mapped(90, 90, 90, 2.0).angle, 90.0);
}

/// tan(apparent dip) = tan(dip) cos(angle between dip direction and section); spacing over
/// sqrt(sin^2 dip cos^2 + cos^2 dip).
TEST(MappedJoints, AslantTheyAreApparent) {
  for (const double dip : {10.0, 45.0, 80.0}) {
    for (const double off : {20.0, 60.0, 110.0}) {
      const JointSet set = mapped(dip, 90.0 + off, 90.0, 3.0);
      const double d = dip * std::numbers::pi / 180.0, c = std::cos(off * std::numbers::pi / 180.0);
      expect_direction(set.angle, -std::atan(std::tan(d) * c) * 180.0 / std::numbers::pi);
      const double part = std::hypot(std::sin(d) * c, std::cos(d));
      EXPECT_NEAR(set.spacing, 3.0 / part, 1e-9);
      EXPECT_EQ(set.given_spacing, 3.0);
    }
  }
  // At right angles to the section only the cosine of the dip remains: horizontal traces, wider
  // apart.
  const JointSet across = mapped(60, 180, 90, 3.0);
  expect_direction(across.angle, 0.0);
  EXPECT_NEAR(across.spacing, 6.0, 1e-9);
}

/// The same by brute force: where planes meet the section, from three points of each.
TEST(MappedJoints, AreWhatPlanesLeaveOnTheSection) {
  const double dip = 35.0, direction = 215.0, azimuth = 70.0, spacing = 1.7;
  const auto rad = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  // East, north, up.
  const double n[3] = {std::sin(rad(dip)) * std::sin(rad(direction)),
                       std::sin(rad(dip)) * std::cos(rad(direction)), std::cos(rad(dip))};
  const double ex[3] = {std::sin(rad(azimuth)), std::cos(rad(azimuth)), 0.0};
  const auto height = [&](double x, int k) {  // of plane k above the section's origin at x
    return (k * spacing - x * (n[0] * ex[0] + n[1] * ex[1])) / n[2];
  };
  const double rise = height(1.0, 0) - height(0.0, 0);
  const double apart = (height(0.0, 1) - height(0.0, 0)) / std::hypot(1.0, rise);
  const JointSet set = mapped(dip, direction, azimuth, spacing);
  expect_direction(set.angle, std::atan(rise) * 180.0 / std::numbers::pi);
  EXPECT_NEAR(set.spacing, apart, 1e-9);
}

TEST(Quality, DefaultsFollowTheSmallestSpacing) {
  EXPECT_NEAR(read(base_model).quality.min_edge, 0.04, 1e-15);
  EXPECT_NEAR(read(base_model).quality.min_area, 4.0 * 0.04 * 0.04, 1e-15);
  EXPECT_EQ(read(base_model).quality.min_angle, 0.0);
  const Model given = read(base_model + "[quality]\nmin_edge = \"5 cm\"\n");
  EXPECT_EQ(given.quality.min_edge, 0.05);
  EXPECT_NEAR(given.quality.min_area, 0.01, 1e-15);
  const Model voronoi = read(base_model + "[voronoi]\nsize = 0.5\n");
  EXPECT_NEAR(voronoi.quality.min_edge, 0.01, 1e-15);
  EXPECT_NEAR(voronoi.voronoi->min_edge, 0.1, 1e-15);
  EXPECT_EQ(read(base_model + "[voronoi]\nsize = 0.5\nmin_edge = 0\n").voronoi->min_edge, 0.0);
  const Model none_given =
      read(base_with("[[joint_set]]\nname = \"bedding\"\nangle = 45.0\nspacing = 2.0\n", ""));
  EXPECT_EQ(none_given.quality.min_area, 0.0);
}

TEST(Regions, OutlinesAreGluedByALawThatIsMadeForThem) {
  const std::string region =
      "[[region]]\npolygon = [[11, 1], [12, 1], [12, 2]]\nmaterial = \"rock\"\n";
  const Model model = read(base_model + region + region);
  ASSERT_EQ(model.joints.size(), 2U);
  EXPECT_EQ(model.joints[1].name, "glued");
  EXPECT_EQ(model.joints[1].type, LawType::glued);
  EXPECT_EQ(model.regions[1].joint, 1);
  EXPECT_EQ(model.contact.joint, 0);
  EXPECT_EQ(to_toml(read(to_toml(model))), to_toml(model));
  const Model other =
      read(base_with("[joints.rough]", "[joints.glued]\nfriction_angle = 3\n[joints.rough]") +
           "[contact]\njoint = \"rough\"\n" + region);
  EXPECT_EQ(other.joints.at(static_cast<std::size_t>(other.regions[0].joint)).name, "glued 2");
}

TEST(Slope, StandsInForAnOutline) {
  const std::string slope =
      "[slope]\ntoe = [5, 2]\nheight = 4\nface_angle = 45\nbase_y = 0\nextent = [0, 20]\n";
  const Model bare =
      read(base_with("[domain]\noutline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n", slope));
  ASSERT_TRUE(bare.domain);
  EXPECT_EQ(bare.domain->outline.size(), 6U);
  EXPECT_EQ(bare.domain->material, 0);
  EXPECT_EQ(to_toml(read(to_toml(bare))), to_toml(bare));
  const Model with_domain = read(base_with("outline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n",
                                           "max_blocks = 500\n" + slope));
  EXPECT_EQ(with_domain.domain->max_blocks, 500);
  EXPECT_EQ(with_domain.domain->outline.size(), 6U);
}

struct Bad {
  std::string text;
  int line;
  std::string key, fragment;
};

void expect_fault(const std::string& text, const Bad& bad) {
  const Result<Model> result = read_model_text(text, "m.toml", {});
  ASSERT_FALSE(result.ok()) << bad.text;
  ASSERT_EQ(result.faults().size(), 1U) << bad.text << to_string(result.faults()[0]) << '\n'
                                        << to_string(result.faults()[1]);
  const Fault& f = result.faults()[0];
  EXPECT_EQ(f.where.line, bad.line) << to_string(f);
  EXPECT_EQ(f.where.key, bad.key) << to_string(f);
  EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
}

// What follows base_model, from line 42 on.

/// Fracture networks and Voronoi cells.
std::vector<Bad> bad_networks() {
  const std::string network = "[[fracture_network]]\nangle = { mean = 3 }\n";
  return {
      Bad{network + "length = { mean = 2 }\n", 42, "fracture_network.0", "neither p21 nor count"},
      Bad{network + "length = { mean = 2 }\np21 = 1\ncount = 3\n", 46, "fracture_network.0.count",
          "p21 is given too"},
      Bad{network + "length = {}\np21 = 1\n", 44, "fracture_network.0.length.mean", "is missing"},
      Bad{network + "length = { distribution = \"power\", min = 1, max = 2 }\np21 = 1\n", 44,
          "fracture_network.0.length.exponent", "is missing"},
      Bad{network + "length = { distribution = \"power\", exponent = 2, min = 3, max = 2 "
                    "}\np21 = 1\n",
          44, "fracture_network.0.length.max", "is below min"},
      Bad{network + "length = { mean = 2, min = 1 }\np21 = 1\n", 44,
          "fracture_network.0.length.min", "belongs to distribution = \"power\""},
      Bad{network + "length = { mean = 2 }\np21 = -1\n", 45, "fracture_network.0.p21",
          "out of range"},
      Bad{network + "length = { mean = 2 }\ncount = 1.5\n", 45, "fracture_network.0.count",
          "a whole number"},
      Bad{"[[fracture_network]]\nlength = { mean = 2 }\np21 = 1\n", 42, "fracture_network.0.angle",
          "is missing"},
      Bad{"[voronoi]\nsize = 0\n", 43, "voronoi.size", "out of range"},
      Bad{"[voronoi]\nsize = 0.5\nmin_edge = 0.3\n", 44, "voronoi.min_edge",
          "too long for polygons"},
      Bad{"[voronoi]\nsize = 1e-3\n", 43, "voronoi.size", "blocks would be cut"},
  };
}

/// Files of lines.
std::vector<Bad> bad_imports() {
  return {
      Bad{"[[import]]\nfile = \"a.dwg\"\n", 43, "import.0.file", "ends in none of"},
      Bad{"[[import]]\nfile = \"a.dxf\"\nlayers = { A = \"ruff\" }\n", 44, "import.0.layers.A",
          "the only known one is \"rough\""},
      Bad{"[[import]]\nfile = \"a.dxf\"\nlayers = { A = 3 }\n", 44, "import.0.layers.A", "is 3"},
      Bad{"[[import]]\nfile = \"a.dxf\"\nlayers = \"A\"\n", 44, "import.0.layers",
          "a table such as"},
      Bad{"[[import]]\nfile = \"a.dxf\"\nunits = \"yd\"\n", 44, "import.0.units",
          "is not known: known are"},
      Bad{"[[import]]\nfile = \"a.dxf\"\nmaterial = \"rock\"\n", 44, "import.0.material",
          "those of the domain"},
  };
}

/// Openings and their shapes.
std::vector<Bad> bad_openings() {
  return {
      Bad{"[[opening]]\n", 42, "opening.1", "neither polygon nor shape"},
      Bad{"[[opening]]\nshape = { kind = \"circle\", at = [1, 1], width = 1 }\npolygon = [[0, "
          "0], "
          "[1, 0], [1, 1]]\n",
          43, "opening.1.shape", "polygon is given too"},
      Bad{"[[opening]]\nshape = { kind = \"circle\", at = [1, 1], width = 1, height = 1 }\n", 43,
          "opening.1.shape.height", "a circle has no height"},
      Bad{"[[opening]]\nshape = { kind = \"arch\", at = [1, 1], width = 1 }\n", 43,
          "opening.1.shape.height", "is missing"},
      Bad{"[[opening]]\nshape = { kind = \"arc\", at = [1, 1], width = 1, height = 1 }\n", 43,
          "opening.1.shape.kind", "did you mean \"arch\"?"},
      Bad{"[[opening]]\nshape = { kind = \"horseshoe\", at = [1, 1], width = 6, height = 2 "
          "}\n",
          43, "opening.1.shape.height", "more than half the width"},
      Bad{"[[opening]]\nshape = { kind = \"arch\", at = [1e11, 0], width = 1e-6, height = 1 "
          "}\n",
          43, "opening.1.shape", "too small"},
  };
}

/// Regions and pairs of materials.
std::vector<Bad> bad_regions() {
  const std::string region = "[[region]]\npolygon = [[11, 1], [12, 1], [12, 2]]\n";
  return {
      Bad{region + "material = \"roc\"\n", 44, "region.0.material", "did you mean \"rock\"?"},
      Bad{"[[region]]\nmaterial = \"rock\"\n", 42, "region.0.polygon", "is missing"},
      Bad{"[[contact_pair]]\njoint = \"rough\"\n", 42, "contact_pair.0.between", "is missing"},
      Bad{"[[contact_pair]]\nbetween = [\"rock\"]\njoint = \"rough\"\n", 43,
          "contact_pair.0.between", "does not name two"},
      Bad{"[[contact_pair]]\nbetween = [\"rock\", \"rough\"]\njoint = \"rough\"\n", 43,
          "contact_pair.0.between", "a joint and a material"},
      Bad{"[[contact_pair]]\nbetween = [\"rock\", \"ruff\"]\njoint = \"rough\"\n", 43,
          "contact_pair.0.between[1]", "known are \"rock\", \"rough\""},
  };
}

/// Arches, limits of the quality of blocks, and a slope besides an outline.
std::vector<Bad> bad_arches() {
  return {
      Bad{"[[arch]]\nradius = 5\nthickness = 1\ncount = 0\n", 45, "arch.0.count", "out of range"},
      Bad{"[[arch]]\nradius = 5\nthickness = 10\ncount = 9\n", 44, "arch.0.thickness",
          "not below twice the radius"},
      Bad{"[[arch]]\nradius = 5\nthickness = 1\ncount = 9\nto_angle = -10\n", 46, "arch.0.to_angle",
          "lies -10 degrees from"},
      Bad{"[[arch]]\nradius = 5\nthickness = 1\ncount = 1\n", 45, "arch.0.count", "half a turn"},
      Bad{"[quality]\nmin_edge = -1\n", 43, "quality.min_edge", "out of range"},
      Bad{"[quality]\naction = \"ignore\"\n", 43, "quality.action", "\"ignore\" is not known"},
      Bad{"[slope]\ntoe = [5, 2]\nheight = 4\nface_angle = 45\nbase_y = 0\nextent = [0, 20]\n", 42,
          "slope", "domain.outline is given too"},
  };
}

TEST(BadModel, Geometry) {
  for (const std::vector<Bad>& models :
       {bad_networks(), bad_imports(), bad_openings(), bad_regions(), bad_arches()}) {
    for (const Bad& bad : models) expect_fault(base_model + bad.text, bad);
  }
}

/// In place of the joint set's angle and spacing, from line 19 on.
TEST(BadModel, MappedJoints) {
  const std::string section = "[section]\nazimuth = 90\n";
  for (const Bad& bad : {
           Bad{"spacing = 2\ndip = 30\ndip_direction = 90\n", 20, "joint_set.bedding.dip",
               "the bearing of the section"},
           Bad{"spacing = 2\ndip = 30\n", 20, "joint_set.bedding.dip_direction", "is missing"},
           Bad{"spacing = 2\nangle = 3\ndip_direction = 9\n", 21, "joint_set.bedding.dip",
               "is missing"},
           Bad{"spacing = 2\nangle = 3\ndip = 9\n", 21, "joint_set.bedding.dip",
               "angle is given too"},
           Bad{"spacing = 2\nangle = 3\ngap = 9\n", 21, "joint_set.bedding.gap",
               "extend through the whole domain"},
           Bad{"spacing = 2\nangle = 3\ndeviation = { gap = 1 }\n", 21,
               "joint_set.bedding.deviation.gap", "extend through the whole domain"},
           Bad{"spacing = 2\nangle = 3\ndeviation = { spacing = 2 }\n", 21,
               "joint_set.bedding.deviation.spacing", "not below the mean"},
           Bad{"spacing = 2\nangle = 3\ntrace_length = 1\ndeviation = { trace_length = 1.5 }\n", 22,
               "joint_set.bedding.deviation.trace_length", "not below the mean"},
           Bad{"spacing = 2\nangle = 3\ndeviation = { spacing = 2.1, distribution = "
               "\"exponential\" }\n",
               21, "joint_set.bedding.deviation.spacing", "above the mean"},
           Bad{"spacing = 2\nangle = 3\ntrace_length = 1\ngap = 1\ndeviation = { gap = 1.5 }\n", 23,
               "joint_set.bedding.deviation.gap", "above the mean"},
           Bad{"spacing = 2\nangle = 3\ndeviation = { angel = 2 }\n", 21,
               "joint_set.bedding.deviation.angel", "did you mean \"angle\"?"},
           Bad{"spacing = 2\nangle = 3\nseed = -1\n", 21, "joint_set.bedding.seed", "out of range"},
       }) {
    expect_fault(base_with("angle = 45.0\nspacing = 2.0\n", bad.text), bad);
  }
  expect_fault(base_with("angle = 45.0\n", "dip = 90\ndip_direction = 180\n") + section,
               {"", 19, "joint_set.bedding.dip", "parallel to the section"});
}

/// In place of the domain, from line 15 on.
TEST(BadModel, Slopes) {
  const auto slope = [](const char* toe, const char* angle, const char* base, const char* extent,
                        const char* more) {
    return std::string("[slope]\ntoe = ") + toe + "\nheight = 4\nface_angle = " + angle +
           "\nbase_y = " + base + "\nextent = " + extent + "\n" + more;
  };
  for (const Bad& bad : {
           Bad{slope("[5, 2]", "45", "0", "[20, 0]", ""), 20, "slope.extent", "left to right"},
           Bad{slope("[5, 2]", "45", "0", "[0, 9]", ""), 20, "slope.extent", "the crest"},
           Bad{slope("[5, 2]", "45", "0", "[6, 30]", ""), 16, "slope.toe", "left of the model"},
           Bad{slope("[5, 2]", "45", "2", "[0, 30]", ""), 19, "slope.base_y", "not below the toe"},
           Bad{slope("[5, 2]", "91", "0", "[0, 30]", ""), 18, "slope.face_angle", "out of range"},
           Bad{slope("[5, 2]", "45", "0", "[0, 30]", "bench_width = 1\n"), 21, "slope.bench_width",
               "a single face"},
       }) {
    expect_fault(
        base_with("[domain]\noutline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n", bad.text), bad);
  }
}

}  // namespace
}  // namespace edda::geometry_keys_test
