// What a picture draws over the blocks: lines, monitors, forces, stresses, joints and bolts.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "report/face_grid.hpp"
#include "report/picture_reading.hpp"
#include "report/snapshots.hpp"

namespace edda::plot_marks_test {
namespace {

using testing::crumb;
using testing::drawn;
using testing::snapshot;

TEST(Plot, NamesOfLinesStayInTheDrawing) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  options.window = Box{{-1.0, 0.0}, {4.0, 1.0}};
  // The blocks have moved by 0.5.
  options.lines = {{"seen", {{{-0.4, 0.5}, {2.4, 0.5}}}},
                   {"not seen", {{{-0.4, 0.2}, {0.4, 0.2}}}}};
  std::string svg = drawn({&shot, 1}, options);
  EXPECT_TRUE(text_of(svg, "not seen"));
  options.window = Box{{2.5, 0.0}, {4.0, 1.0}};
  svg = drawn({&shot, 1}, options);
  EXPECT_FALSE(text_of(svg, "not seen"));
  ASSERT_TRUE(text_of(svg, "seen"));
  // What is left of the line ends at 2.9.
  ASSERT_TRUE(text_of(svg, "2.6") && text_of(svg, "2.8"));
  EXPECT_GT(text_of(svg, "seen")->x, text_of(svg, "2.6")->x);
  EXPECT_LT(text_of(svg, "seen")->x, text_of(svg, "2.8")->x);
}

TEST(Plot, NamesOfCrossingLinesStandApart) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  options.lines = {{"V", {{{0.0, 0.01}, {0.0, 0.99}}}}, {"H", {{{-0.49, 0.5}, {0.49, 0.5}}}}};
  const std::string svg = drawn({&shot, 1}, options);
  ASSERT_TRUE(text_of(svg, "V") && text_of(svg, "H"));
  const double metre = text_of(svg, "1.0")->x - text_of(svg, "0.0")->x;
  const Vec2 v = *text_of(svg, "V"), h = *text_of(svg, "H");
  EXPECT_GT(norm(v - h), 0.2 * metre);
  // And each beside its own line: V at x = 0.5, where the blocks have gone, H above y = 0.5.
  const double x = text_of(svg, "0.5")->x;
  EXPECT_LT(std::abs(v.x - x), 16.0);
  EXPECT_GT(std::abs(h.x - x), 12.0);
}

TEST(Plot, CasingsOfForcesAreThinWhereBlocksAreSmall) {
  Snapshot shot = crumb();
  shot.field = ShownField{};
  Grid contacts;
  Field force{"force", 3, {}, {}, false};
  for (int k = 0; k < 60; ++k) {
    contacts.points.insert(contacts.points.end(), {1.0 * k, 0.5, 0.0});
    contacts.corners.push_back(k);
    contacts.ends.push_back(k + 1);
    contacts.types.push_back(cell_type::vertex);
    force.values.insert(force.values.end(), {0.0, 1e5, 0.0});
  }
  contacts.cell_fields = {force};
  shot.contacts = contacts;
  PlotOptions options;
  options.forces = true;
  const std::vector<double> many = stroke_widths(drawn({&shot, 1}, options), ink::white);
  shot.blocks = two_blocks();
  const std::vector<double> few = stroke_widths(drawn({&shot, 1}, options), ink::white);
  ASSERT_FALSE(many.empty() || few.empty());
  EXPECT_LT(many[0] - 0.6, 0.6 * (few[0] - 0.6));  // the shaft has 0.6
}

TEST(Plot, MonitorsStandWhereTheirBlockHasGone) {
  // The axes' labels say where on paper a place is: the monitor has moved by 0.5 to x = 0.5.
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  options.monitors = {{"M", {0.0, 0.5}}};
  options.window = Box{{-1.0, 0.0}, {4.0, 1.0}};
  const std::string svg = drawn({&shot, 1}, options);
  const double x2 = text_of(svg, "2.0")->x, x4 = text_of(svg, "4.0")->x;
  const std::vector<std::string> marks = stroked(svg, ink::monitor);
  ASSERT_EQ(marks.size(), 1u);
  constexpr double radius = 1.8;  // a circle's path starts at its right
  EXPECT_NEAR((points_of(marks[0])[0].x - radius - x2) / (x4 - x2), -0.75, 1e-3);
}

/// A monitor on the surface, which had settled a little before displacements were reset.
TEST(Plot, MonitorsStandOnASurfaceThatHasSettled) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  options.monitors = {{"high", {0.5, 1.0001}}, {"beyond", {0.5, 1.2}}};
  const std::string svg = drawn({&shot, 1}, options);
  EXPECT_TRUE(text_of(svg, "high"));
  EXPECT_FALSE(text_of(svg, "beyond"));
}

TEST(Plot, NamesOfMonitorsDoNotOverlap) {
  const Snapshot shot = snapshot("none");
  for (const int count : {5, 12, 24}) {
    PlotOptions options;
    for (int k = 0; k < count; ++k) options.monitors.push_back({"name", {0.001 * k, 0.5}});
    const std::string svg = drawn({&shot, 1}, options);
    const std::vector<Vec2> names = all_texts(svg, "name");
    ASSERT_EQ(names.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vec2 d = names[i] - names[j];
        EXPECT_TRUE(std::abs(d.y) >= 6.5 || std::abs(d.x) >= 16.0)
            << count << ": " << i << " " << j;
      }
    }
  }
}

TEST(Plot, LegendHasAnArrowOfARoundLength) {
  Snapshot shot = snapshot("none");
  for (double& v : shot.blocks.cell_fields[2].values) v *= 0.74;  // 0.37 m
  PlotOptions options;
  options.vectors = "displacement";
  EXPECT_TRUE(text_of(drawn({&shot, 1}, options), "200 mm"));
}

TEST(Plot, TheLegendSaysWhatThickJointsAre) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  EXPECT_FALSE(text_of(drawn({&shot, 1}, options), "slip or open"));
  options.joints = {{{{1.0, 0.0}, {1.0, 1.0}}}};
  const std::string svg = drawn({&shot, 1}, options);
  EXPECT_TRUE(text_of(svg, "slip or open"));
  EXPECT_EQ(stroked(svg, ink::joint).size(), 2u);  // with that of the legend
}

TEST(Plot, CracksAreLinesByWhatHasBrokenTheFace) {
  Snapshot shot = snapshot("none");
  shot.contacts = face_grid({{{1.5, 0}, {1.5, 0.4}, 0.0, 0.0, 0.0, 0.0, 4, 5, {}, 1.0},
                             {{1.5, 0.4}, {1.5, 0.9}, 0.0, 0.0, 0.0, 1.0, 4, 5, {}, 2.0},
                             {{1.5, 0.9}, {1.5, 1.0}, 1e5, 1e5}});
  PlotOptions options;
  EXPECT_TRUE(stroked(drawn({&shot, 1}, options), ink::tension).empty());
  options.cracks = true;
  const std::string svg = drawn({&shot, 1}, options);
  // In the drawing and in the legend.
  EXPECT_EQ(stroked(svg, ink::tension).size(), 2u);
  EXPECT_EQ(stroked(svg, ink::compression).size(), 2u);
  EXPECT_TRUE(text_of(svg, "in tension") && text_of(svg, "in shear"));
  const double metre = text_of(svg, "1.0")->x - text_of(svg, "0.0")->x;
  const std::vector<Vec2> line = points_of(stroked(svg, ink::compression).front());
  EXPECT_NEAR(norm(line[1] - line[0]), 0.5 * metre, 0.01 * metre);
}

/// Open faces have no stress to show, but may have damage.
TEST(Plot, DamageIsShownOfOpenFacesToo) {
  Snapshot shot = snapshot("none");
  shot.contacts = face_grid({{{1.5, 0}, {1.5, 0.4}, 0.0, 0.0, 0.0, 0.0, 4, 5, {}, 1.0},
                             {{1.5, 0.4}, {1.5, 1.0}, 1e5, 1e5}});
  const auto lines = [&](const char* field) {
    shot.field = shown_field(field, shot.blocks, &*shot.contacts).value();
    const std::string svg = drawn({&shot, 1}, {});
    return stroked(svg, sequential(1.0)).size() + stroked(svg, sequential(0.0)).size();
  };
  EXPECT_EQ(lines("damage"), 2u);
  EXPECT_EQ(lines("normal_stress"), 1u);
}

TEST(Plot, TensionAndCompressionAreToldApart) {
  Snapshot shot = snapshot("none");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  PlotOptions options;
  options.principal = true;
  const auto with = [&](double sxx) {
    Field stress{"stress", 6, {}, {}, false};
    for (int c = 0; c < 3; ++c) stress.values.insert(stress.values.end(), {sxx, 0, 0, 0, 0, 0});
    Snapshot loaded = shot;
    loaded.blocks.cell_fields.push_back(stress);
    return drawn({&loaded, 1}, options);
  };
  // The legend has one of either; the two blocks add theirs.
  EXPECT_GT(stroked(with(1e6), ink::tension).size(), stroked(with(-1e6), ink::tension).size());
  EXPECT_LT(stroked(with(1e6), ink::compression).size(),
            stroked(with(-1e6), ink::compression).size());
}

TEST(Plot, StressesThatAreRoundingAreNotDrawn) {
  Snapshot shot = snapshot("none");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  Field stress{"stress", 6, std::vector<double>(18, 1e-4), {}, false};
  shot.blocks.cell_fields.push_back(stress);
  PlotOptions options;
  options.principal = true;
  EXPECT_FALSE(stroked(drawn({&shot, 1}, options), ink::tension).empty());
  options.least_stress = 1e-3;
  const std::string svg = drawn({&shot, 1}, options);
  EXPECT_TRUE(stroked(svg, ink::tension).empty());
  EXPECT_TRUE(text_of(svg, "none"));
  EXPECT_FALSE(text_of(svg, "+none"));
}

TEST(Plot, BoltsAreAsWideAsTheirForce) {
  Snapshot shot = snapshot("none");
  shot.bolts = std::vector<BoltChain>{{{{0.1, 0.5}, {0.5, 0.5}, {0.9, 0.5}}, {1e5, 1e5, 0.0}}};
  PlotOptions options;
  options.bolt_forces = true;
  const std::string svg = drawn({&shot, 1}, options);
  const std::vector<double> widths = stroke_widths(svg, ink::bolt);
  ASSERT_EQ(widths.size(), 3u);  // two pieces and the legend
  EXPECT_NEAR(widths[1] / widths[0], 0.5, 0.01);
  EXPECT_TRUE(text_of(svg, "100 kN"));
}

}  // namespace
}  // namespace edda::plot_marks_test
