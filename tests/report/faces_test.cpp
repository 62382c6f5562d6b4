// Pressures on faces: their diagrams in metres of the model, and what is drawn of them.
#include "report/faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "report/face_grid.hpp"
#include "report/picture_reading.hpp"
#include "report/relative.hpp"
#include "report/scene.hpp"
#include "report/two_blocks.hpp"
#include "scratch_folder.hpp"

namespace edda::faces_test {
namespace {

constexpr double all = 1e300;  // Pa: nothing is cut

DrawnFace face(Vec2 a, Vec2 b, double pressure_a, double pressure_b, double closed = 1.0) {
  return {a, b, pressure_a, pressure_b, closed, false};
}

void expect_ring(const PressureArea& area, const std::vector<Vec2>& ring, bool tension = false) {
  EXPECT_EQ(area.tension, tension);
  ASSERT_EQ(area.ring.size(), ring.size());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(area.ring[k].x, ring[k].x, 1e-12) << k;
    EXPECT_NEAR(area.ring[k].y, ring[k].y, 1e-12) << k;
  }
}

/// The only part of a diagram that has one.
PressureArea only(const std::vector<PressureArea>& areas) {
  EXPECT_EQ(areas.size(), 1u);
  return areas.empty() ? PressureArea{} : areas[0];
}

TEST(PressureDiagram, IsATrapezoidWhereBothEndsAreClosed) {
  expect_ring(only(pressure_diagram(face({1, 5}, {3, 5}, 1e6, 3e6), 1e-6, all)),
              {{1, 5}, {1, 6}, {3, 8}, {3, 5}});
}

TEST(PressureDiagram, IsATriangleOverTheClosedLengthWhereOneEndIsOpen) {
  expect_ring(only(pressure_diagram(face({0, 0}, {2, 0}, 1e6, 0.0, 0.75), 1e-6, all)),
              {{0, 0}, {0, 1}, {1.5, 0}});
  expect_ring(only(pressure_diagram(face({0, 0}, {2, 0}, 0.0, 1e6, 0.75), 1e-6, all)),
              {{0.5, 0}, {2, 1}, {2, 0}});
  EXPECT_TRUE(pressure_diagram(face({0, 0}, {2, 0}, 0.0, 0.0, 0.0), 1e-6, all).empty());
}

TEST(PressureDiagram, LiesAboveTheFaceWhicheverBlockIsFirst) {
  expect_ring(only(pressure_diagram(face({2, 0}, {0, 0}, 1e6, 3e6), 1e-6, all)),
              {{2, 0}, {2, 1}, {0, 3}, {0, 0}});
  // Across it, not upright; of upright ones on the left.
  expect_ring(only(pressure_diagram(face({0, 0}, {3, 4}, 5e6, 5e6), 1e-6, all)),
              {{0, 0}, {-4, 3}, {-1, 7}, {3, 4}});
  expect_ring(only(pressure_diagram(face({0, 2}, {0, 0}, 1e6, 1e6), 1e-6, all)),
              {{0, 2}, {-1, 2}, {-1, 0}, {0, 0}});
}

TEST(PressureDiagram, TensionIsOnTheOtherSide) {
  const auto areas = pressure_diagram(face({0, 0}, {4, 0}, 1e6, -3e6), 1e-6, all);
  ASSERT_EQ(areas.size(), 2u);
  expect_ring(areas[0], {{0, 0}, {0, 1}, {1, 0}});
  expect_ring(areas[1], {{1, 0}, {4, -3}, {4, 0}}, true);
}

TEST(PressureDiagram, IsCutWhereItWouldBeTooHigh) {
  expect_ring(only(pressure_diagram(face({0, 0}, {2, 0}, 1e6, 3e6), 1e-6, 2e6)),
              {{0, 0}, {0, 1}, {1, 2}, {2, 2}, {2, 0}});
  const auto areas = pressure_diagram(face({0, 0}, {6, 0}, 3e6, -3e6), 1e-6, 2e6);
  ASSERT_EQ(areas.size(), 2u);
  expect_ring(areas[0], {{0, 0}, {0, 2}, {1, 2}, {3, 0}});
  expect_ring(areas[1], {{3, 0}, {5, -2}, {6, -2}, {6, 0}}, true);
}

TEST(DrawnFaces, AreWhereTheFrameSays) {
  Grid g = face_grid({{{1, 0}, {1, 1}, 2e6, 0.0, 0.6}});
  const std::vector<DrawnFace> faces = drawn_faces(g);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].a, (Vec2{1.0, 0.0}));
  EXPECT_EQ(faces[0].b, (Vec2{1.0, 1.0}));
  EXPECT_DOUBLE_EQ(faces[0].pressure_a, 2e6);
  EXPECT_DOUBLE_EQ(faces[0].pressure_b, 0.0);
  EXPECT_DOUBLE_EQ(faces[0].closed, 0.6);
  EXPECT_FALSE(faces[0].open);
  // Frames of older versions do not say where faces end.
  g.cell_fields.pop_back();
  EXPECT_TRUE(drawn_faces(g).empty());
}

/// Where displacements are drawn larger, faces stay on the edges of their block j, which moves,
/// turns, is strained and bends, whatever block i does.
TEST(DrawnFaces, GoAlongWithTheirBlock) {
  Snapshot shot{two_blocks()};
  std::vector<double>& u = shot.blocks.point_fields[0].values;
  for (std::size_t p = 4; p < 8; ++p) {
    const double x = shot.blocks.points[3 * p], y = shot.blocks.points[3 * p + 1];
    u[3 * p] = 0.1 - 0.2 * y + 0.01 * x;
    u[3 * p + 1] = -0.3 + 0.2 * x + 0.03 * y;
  }
  u[3 * 7] += 0.4;
  shot.contacts = face_grid({{{2, 0}, {2, 0.5}, 1e6, 1e6, 1.0, 1.0, 4, 5, {7.0, 7.0}},
                             {{0.25, 0}, {1, 0}, 1e6, 1e6, 1.0, 1.0, 5, 4, {7.0, 7.0}},
                             {{0.5, 0}, {1, 0}, 1e6, 1e6, 1.0, 1.0, 5, 9, {7.0, 7.0}}});
  const PlotScene s = make_scene(shot, 4.0);
  ASSERT_EQ(s.faces.size(), 3u);
  const auto expect_at = [](Vec2 found, Vec2 place) { EXPECT_LT(norm(found - place), 1e-12); };
  expect_at(s.faces[0].a, s.points[4]);
  expect_at(s.faces[0].b, 0.5 * (s.points[4] + s.points[7]));
  expect_at(s.contacts[0], 0.75 * s.points[4] + 0.25 * s.points[7]);
  expect_at(s.faces[1].a, 0.75 * s.points[0] + 0.25 * s.points[1]);
  expect_at(s.faces[1].b, s.points[1]);
  expect_at(s.faces[2].a, {0.5, 0.0});  // of a block that is gone
}

TEST(DrawnFaces, StayOnTheirBlocksBesideAMonitor) {
  Snapshot shot{two_blocks()};
  shot.contacts = face_grid({{{1, 0}, {1, 1}, 1e6, 1e6}});
  ASSERT_TRUE(move_with(shot, {-0.2, 0.5}));
  EXPECT_EQ(drawn_faces(*shot.contacts)[0].a, (Vec2{0.5, 0.0}));
}

Snapshot with_faces(const std::vector<TestFace>& faces, const std::string& field = "none") {
  Snapshot shot{two_blocks()};
  shot.contacts = face_grid(faces);
  shot.field = shown_field(field, shot.blocks, &*shot.contacts).value();
  return shot;
}

std::string drawn(const Snapshot& shot, const PlotOptions& options) {
  const ScratchFolder folder;
  EXPECT_FALSE(plot({&shot, 1}, options, folder.at("plot.svg")));
  return read_file(folder.at("plot.svg")).value();
}

/// Points of the areas filled with that colour, the legend's last.
std::vector<std::vector<Vec2>> filled(const std::string& svg, Colour colour) {
  std::vector<std::vector<Vec2>> found;
  for (const std::string& path : elements(svg, "path")) {
    const auto fill = colour_of(path, "fill");
    if (fill && looks_like(*fill, colour)) found.push_back(points_of(path));
  }
  return found;
}

TEST(Pressures, AreDrawnWithContactForcesOnOneScale) {
  PlotOptions options;
  options.forces = true;
  // Open ones carry nothing, whatever they are said to.
  const std::string svg = drawn(with_faces({{{0, 0}, {1, 0}, 1e6, 3e6},
                                            {{2, 0}, {3, 0}, 2e6, 0.0, 0.5},
                                            {{1, 0}, {1, 1}, 9e6, 9e6, 1.0, 0.0}}),
                                options);
  const auto areas = filled(svg, ink::pressure);
  ASSERT_EQ(areas.size(), 3u);
  const auto& [trapezoid, triangle, sample] = std::tie(areas[0], areas[1], areas[2]);
  const double metre = trapezoid[3].x - trapezoid[0].x;
  EXPECT_NEAR(triangle[2].x - triangle[0].x, 0.5 * metre, 1e-3 * metre);
  const double height = trapezoid[0].y - trapezoid[1].y;  // of 1 MPa
  EXPECT_GT(height, 4.0);
  EXPECT_NEAR(trapezoid[3].y - trapezoid[2].y, 3.0 * height, 0.02);
  EXPECT_NEAR(triangle[0].y - triangle[1].y, 2.0 * height, 0.02);
  EXPECT_TRUE(text_of(svg, "pressure on joints"));
  EXPECT_TRUE(text_of(svg, "2 MPa"));
  EXPECT_NEAR(sample[1].x - sample[0].x, 2.0 * height, 0.02);
  EXPECT_FALSE(text_of(svg, "tension"));
  EXPECT_FALSE(text_of(drawn(with_faces({}), options), "2 MPa"));
  options.forces = false;
  EXPECT_TRUE(
      filled(drawn(with_faces({{{0, 0}, {1, 0}, 1e6, 3e6}}), options), ink::pressure).empty());
}

TEST(Pressures, OfAPointAreCutAndSaidToBe) {
  std::vector<TestFace> faces(30, {{0, 0}, {1, 0}, 1e6, 1e6});
  faces.push_back({{1, 0}, {1, 1}, 1e8, 0.0, 0.05});
  PlotOptions options;
  options.forces = true;
  const std::string svg = drawn(with_faces(faces), options);
  EXPECT_TRUE(text_of(svg, "cut at 2.25 MPa"));
  const auto areas = filled(svg, ink::pressure);
  ASSERT_EQ(areas.size(), 32u);
  const double height = areas[0][0].y - areas[0][1].y;
  EXPECT_NEAR(areas[30][0].x - areas[30][1].x, 2.25 * height, 0.05);
  // Nor is there anything to see of one over next to no length.
  faces.push_back({{1, 0}, {1, 1}, 1e8, 0.0, 1e-4});
  EXPECT_EQ(filled(drawn(with_faces(faces), options), ink::pressure).size(), 32u);
  options.whole_range = true;
  EXPECT_TRUE(text_of(drawn(with_faces(faces), options), "100 MPa"));
}

TEST(Pressures, TensionHasItsColour) {
  PlotOptions options;
  options.forces = true;
  const std::string svg = drawn(with_faces({{{0, 0}, {1, 0}, 1e6, -1e6}}), options);
  EXPECT_EQ(filled(svg, ink::pressure).size(), 2u);
  EXPECT_GE(filled(svg, ink::tension).size(), 2u);
  EXPECT_TRUE(text_of(svg, "tension"));
}

TEST(FaceField, IsALineFromEndToEndInTheColourOfItsStress) {
  const Snapshot shot = with_faces({{{0, 0}, {1, 0}, 1e6, 3e6},
                                    {{2, 0}, {3, 0}, 2e6, 0.0, 0.5},
                                    {{1, 0}, {1, 1}, 0.0, 0.0, 0.0, 0.0}},
                                   "normal_stress");
  EXPECT_TRUE(shot.field.along_faces);
  EXPECT_EQ(shot.field.values, (std::vector<double>{2e6, 0.5e6, 0.0}));
  const std::string svg = drawn(shot, {});
  const auto lines = stroked(svg, sequential(1.0));
  ASSERT_EQ(lines.size(), 1u);
  const std::vector<Vec2> ends = points_of(lines[0]);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[0].y, ends[1].y, 1e-3);
  const auto other = stroked(svg, sequential(0.25));
  ASSERT_EQ(other.size(), 1u);
  EXPECT_NEAR(points_of(other[0])[0].x - ends[0].x, 2.0 * (ends[1].x - ends[0].x), 0.02);
  const std::vector<double> outlines = stroke_widths(svg, ink::line);
  EXPECT_GT(stroke_widths(svg, sequential(1.0))[0], 3.0 * outlines.front());
  EXPECT_TRUE(text_of(svg, "normal stress on"));
  EXPECT_EQ(shown_field("shear_stress", shot.blocks, &*shot.contacts).value().values[0], 0.4e6);
}

}  // namespace
}  // namespace edda::faces_test
