// The page of a picture: its format, size, title, window and legends.
#include "report/plot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "report/picture_reading.hpp"
#include "report/relative.hpp"
#include "report/snapshots.hpp"

namespace edda::plot_test {
namespace {

using testing::crumb;
using testing::drawn;
using testing::snapshot;

TEST(Plot, DrawsAllFormatsWithTextAsText) {
  const Snapshot shot = snapshot("displacement");
  PlotOptions options;
  options.title = "Title <&> of it";
  options.monitors = {{"M", {0.0, 0.5}}};
  EXPECT_EQ(drawn({&shot, 1}, options, "plot.png").substr(0, 4), "\x89PNG");
  const std::string svg = drawn({&shot, 1}, options);
  EXPECT_EQ(svg.substr(0, 5), "<?xml");
  EXPECT_TRUE(text_of(svg, "Title &lt;&amp;&gt; of it"));
  EXPECT_TRUE(text_of(svg, "M"));
  EXPECT_TRUE(text_of(svg, "x (m)"));
  const std::string pdf = drawn({&shot, 1}, options, "plot.pdf");
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.find("/Font"), std::string::npos);
}

TEST(Plot, TellsOfAFileThatCannotBeWritten) {
  const Snapshot shot = snapshot("none");
  EXPECT_TRUE(plot({&shot, 1}, {}, ScratchFolder().at("none/x.png")));
}

TEST(Plot, UnknownFieldsNameTheKnown) {
  const Result<ShownField> none = shown_field("displacment", two_blocks(), nullptr);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.faults()[0].remedy.find("displacement"), std::string::npos);
}

TEST(Plot, EveryMillimetreOfPaperCounts) {
  const Snapshot shot = snapshot("displacement");
  PlotOptions options;
  const double wide = size_of_svg(drawn({&shot, 1}, options)).x;
  options.paper.width /= 2.0;
  const double half = size_of_svg(drawn({&shot, 1}, options)).x;
  EXPECT_NEAR(half, wide / 2.0, 1e-3 * wide);
  EXPECT_NEAR(wide, 160.0 / 25.4 * 72.0, 0.1);
}

TEST(Plot, PagesOfTallModelsKeepAWidthThatWasAskedFor) {
  const Snapshot shot = snapshot("displacement");
  PlotOptions options;
  options.window = Box{{0.0, 0.0}, {1.0, 9.0}};
  const double slim = size_of_svg(drawn({&shot, 1}, options)).x;
  EXPECT_LT(slim, 0.9 * options.paper.width);
  options.paper.whole = true;
  EXPECT_NEAR(size_of_svg(drawn({&shot, 1}, options)).x, options.paper.width, 0.01);
}

// Cairo stops drawing where it meets what is no text, and XML has no control characters.
TEST(Plot, TakesAnyTitle) {
  const Snapshot shot = snapshot("displacement");
  PlotOptions options;
  options.title = "A\xff\x01\xed\xa0\x80\xef\xbf\xbe\nB";
  for (const char* name : {"plot.png", "plot.pdf"}) drawn({&shot, 1}, options, name);
  const std::string svg = drawn({&shot, 1}, options);
  const std::string no = "\xef\xbf\xbd";
  EXPECT_TRUE(text_of(svg, "A" + no + " " + no + no + no + no + " B"));
  EXPECT_TRUE(text_of(svg, "displacement (mm)"));
  options.title = "A B";
  const std::size_t plain = drawn({&shot, 1}, options, "plot.png").size();
  options.title =
      "A\x01"
      "B";
  EXPECT_EQ(drawn({&shot, 1}, options, "plot.png").size(), plain);
}

TEST(Plot, TellsOfAPictureThatCannotBeDrawn) {
  const ScratchFolder folder;
  Canvas canvas(folder.at("none.png"), 10.0, 10.0, 1.0);
  cairo_restore(canvas.cr());  // nothing was saved
  EXPECT_TRUE(canvas.finish());
  EXPECT_FALSE(std::filesystem::exists(folder.at("none.png")));
}

TEST(Plot, WindowsWithNothingInThemAreRefused) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  EXPECT_FALSE(check_window({&shot, 1}, options));
  for (const Box& window :
       {Box{{0.0, 0.0}, {1e-310, 1e-310}}, Box{{5.0, 0.0}, {6.0, 1.0}}, Box{{0, 0}, {1e9, 1e9}}}) {
    options.window = window;
    EXPECT_TRUE(check_window({&shot, 1}, options)) << window.high.x;
  }
  options.window = Box{{0.0, 0.0}, {1e-310, 1e-310}};
  const ScratchFolder folder;
  EXPECT_TRUE(plot({&shot, 1}, options, folder.at("plot.svg")));
  EXPECT_FALSE(std::filesystem::exists(folder.at("plot.svg")));
  options.window = Box{{1.9, 0.0}, {6.0, 1.0}};
  EXPECT_FALSE(check_window({&shot, 1}, options));
}

TEST(Plot, LegendsOfNarrowPagesStandBelow) {
  Snapshot shot = snapshot("displacement");
  PlotOptions options;
  options.vectors = "velocity";
  std::string svg = drawn({&shot, 1}, options);
  EXPECT_GT(text_of(svg, "displacement (mm)")->x, text_of(svg, "x (m)")->x);
  EXPECT_LT(text_of(svg, "displacement (mm)")->y, text_of(svg, "x (m)")->y);
  options.paper.width = 85.0 * 72.0 / 25.4;
  svg = drawn({&shot, 1}, options);
  EXPECT_LT(text_of(svg, "displacement (mm)")->x, text_of(svg, "x (m)")->x);
  EXPECT_GT(text_of(svg, "displacement (mm)")->y, text_of(svg, "x (m)")->y);
  EXPECT_GT(text_of(svg, "velocity")->y, text_of(svg, "displacement (mm)")->y);
  EXPECT_LT(text_of(svg, "velocity")->y, size_of_svg(svg).y);
}

TEST(Plot, DisplacementsMayBeRelativeToAMonitor) {
  Snapshot shot = snapshot("none");
  shot.bolts = std::vector<BoltChain>{{{{0.9, 0.5}}, {0.0}}};
  const std::vector<double> before = shot.blocks.points;
  // All blocks have moved by 0.5: none has, as seen from any of them.
  ASSERT_TRUE(move_with(shot, {0.25, 0.5}));
  for (const double u : shot.blocks.cell_field("displacement")->values) EXPECT_NEAR(u, 0.0, 1e-12);
  for (const double u : shot.blocks.point_field("displacement")->values) EXPECT_NEAR(u, 0.0, 1e-12);
  EXPECT_NEAR(shot.blocks.points[0], before[0] - 0.5, 1e-12);
  EXPECT_NEAR((*shot.bolts)[0].points[0].x, 0.4, 1e-12);
  EXPECT_FALSE(move_with(shot, {77.0, 0.5}));
}

TEST(Plot, HeadingsOfLegendsBelowStayOnThePage) {
  const Snapshot shot = snapshot("displacement");
  PlotOptions options;
  options.paper.font = 40.0;
  Snapshot long_one = shot;
  long_one.field.label = "most compressive stress of all (tension positive)";
  const std::string svg = drawn({&long_one, 1}, options);
  ASSERT_TRUE(text_of(svg, "most compressive")) << svg;
  EXPECT_LT(text_of(svg, "most compressive")->x, 40.0);
  EXPECT_GT(text_of(svg, "stress of all")->y, text_of(svg, "most compressive")->y);
}

/// A crumb that falls without end leaves the picture, which shows the others as large as before.
TEST(Plot, WhatFallsFarAwayLeavesThePicture) {
  const auto fallen = [](double by) {
    Snapshot shot = crumb();
    std::vector<double>& all = shot.blocks.points;
    Field u{"displacement", 3, std::vector<double>(all.size(), 0.0), {}, false};
    for (std::size_t k = all.size() - 12; k < all.size(); k += 3) {
      all[k + 1] -= by;
      u.values[k + 1] = -by;
    }
    shot.blocks.point_fields = {u};
    return drawn({&shot, 1}, {});
  };
  const auto places = [](const std::string& svg) { return all_texts(svg, "0"); };
  EXPECT_FALSE(text_of(fallen(50.0), "1 block far beyond the picture"));
  EXPECT_TRUE(text_of(fallen(100.0), "1 block far beyond the picture"));
  EXPECT_EQ(places(fallen(100.0)), places(fallen(1e6)));
}

}  // namespace
}  // namespace edda::plot_test
