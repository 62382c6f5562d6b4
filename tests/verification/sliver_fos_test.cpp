// A plane slide with slivers beside its plane: whatever [quality] merges, the plane stays whole.
#include "cutting/build_polygons.hpp"
#include "study/fos.hpp"
#include "verification/models.hpp"

namespace edda::sliver_fos_test {
namespace {

/// A slab of 6 m x 1.5 m on a plane that dips 35 degrees and daylights at the face. Two joints,
/// inclined towards each other, end on the plane, and between them a third one that leaves a strip
/// of 5 cm there. A last one cuts off a wedge of 15 cm at the toe. Both slivers have the plane as
/// their longest edge.
std::string slab(double phi, const std::string& quality) {
  const auto at = [](double u, double v) { return on_slope(35.0, u, v); };
  const auto trace = [&](double u0, double v0, double u1, double v1) {
    return "[[trace]]\npoints = [" + at(u0, v0) + "," + at(u1, v1) + "]\n";
  };
  return "[materials.rock]\ndensity = 2650\nyoung = 2e9\npoisson = 0.25\n[joints.j]\n"
         "friction_angle = " +
         number(phi) + "\n[solver]\nduration = 1\n[domain]\noutline = [" + at(0, -1) + "," +
         at(6, -1) + "," + at(6, 0) + "," + at(5.4, 1.5) + "," + at(0, 1.5) + "]\n" +
         trace(-1, 0, 7, 0) + trace(2, 0, 2.5, 1.5) + trace(4, 0, 3.6, 1.5) +
         trace(2.0 + 0.05 / 3.0, 0.05, 4.0 - 0.05 * 0.4 / 1.5, 0.05) +
         trace(4.2, 0, 6.0 - 0.15 * 0.4, 0.15) + "[[boundary]]\nalong = [" + at(0, -1) + "," +
         at(6, -1) + "]\ntype = 'fixed'\n[quality]\n" + quality;
}

TEST(SliversBesideAPlane, LeaveItsFactorOfSafetyAsItIs) {
  const double phi = 45.0, exact = std::tan(radians(phi)) / std::tan(radians(35.0));
  const Result<Model> model =
      read_model_text(slab(phi, "min_edge = 0.2\nmin_area = 0.0\n") + "[fos]\ntolerance = 0.004\n",
                      EDDA_SOURCE_DIR "/scene.toml", {});
  ASSERT_TRUE(model.ok()) << to_string(model.faults().front());
  const Result<PolygonSet> cut = build_polygons(model.value());
  ASSERT_TRUE(cut.ok()) << to_string(cut.faults().front());
  const CutReport& report = cut.value().report;
  EXPECT_EQ(report.merges.size(), 1U);
  EXPECT_EQ(report.kept.size(), 1U);
  EXPECT_NEAR(report.area_out, report.area_in, 1e-9 * report.area_in);
  Result<FosResult> found = find_factor(model.value(), {});
  ASSERT_TRUE(found.ok()) << to_string(found.faults().front());
  ASSERT_TRUE(found.value().factor) << found.value().message;
  EXPECT_NEAR(*found.value().factor, exact, 0.01 * exact);
}

}  // namespace
}  // namespace edda::sliver_fos_test
