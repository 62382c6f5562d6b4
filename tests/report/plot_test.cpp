#include "report/plot.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "report/picture_reading.hpp"
#include "report/relative.hpp"
#include "report/scene.hpp"
#include "report/two_blocks.hpp"
#include "scratch_folder.hpp"

namespace edda::plot_test {
namespace {

Snapshot snapshot(const std::string& field) {
  Snapshot shot{two_blocks()};
  shot.field = shown_field(field, shot.blocks, nullptr).value();
  return shot;
}

std::string drawn(std::span<const Snapshot> shots, const PlotOptions& options,
                  const std::string& name = "plot.svg") {
  const ScratchFolder folder;
  EXPECT_FALSE(plot(shots, options, folder.at(name)));
  return read_file(folder.at(name)).value();
}

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

TEST(Plot, BlocksHaveTheColoursOfTheirValues) {
  Snapshot shot = snapshot("displacement");
  shot.blocks.cell_fields[1].values = {0, 0, 0};  // none held
  shot.field.values = {0.0, 0.0, 1.0};
  const std::string svg = drawn({&shot, 1}, {});
  const auto fills = block_fills(svg, 2);
  ASSERT_EQ(fills.size(), 2u);
  EXPECT_TRUE(looks_like(fills[0], sequential(0.0)));
  EXPECT_TRUE(looks_like(fills[1], sequential(1.0)));
  // A range that both lie beyond: the ends of the colours, and an arrowhead at either end of the
  // bar.
  PlotOptions options;
  options.range = {0.25, 0.5};
  const auto clipped = block_fills(drawn({&shot, 1}, options), 2);
  EXPECT_TRUE(looks_like(clipped[0], sequential(0.0)));
  EXPECT_TRUE(looks_like(clipped[1], sequential(1.0)));
}

/// A row of 60 squares that move by up to 6 mm, beside them a crumb that has fallen by 167 mm.
Snapshot crumb() {
  Grid g;
  Field id{"id", 1, {}, {}, true}, u{"displacement", 3, {}, {}, false};
  for (int k = 0; k <= 60; ++k) {
    const double x = k < 60 ? k : 66.0, size = k < 60 ? 1.0 : 0.1;
    for (const Vec2 p : {Vec2{0, 0}, Vec2{size, 0}, Vec2{size, size}, Vec2{0, size}}) {
      g.corners.push_back(static_cast<std::int64_t>(g.point_count()));
      g.points.insert(g.points.end(), {x + p.x, p.y, 0.0});
    }
    g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
    g.types.push_back(cell_type::polygon);
    id.values.push_back(k);
    u.values.insert(u.values.end(), {0.0, k < 60 ? 1e-4 * (k + 1) : -0.167, 0.0});
  }
  g.cell_fields = {id, u};
  Snapshot shot{g};
  shot.field = shown_field("displacement", shot.blocks, nullptr).value();
  return shot;
}

TEST(Plot, ACrumbDoesNotDarkenAllOthers) {
  const Snapshot shot = crumb();
  PlotOptions options;
  options.vectors = "displacement";
  const std::string svg = drawn({&shot, 1}, options);
  const auto fills = block_fills(svg, 61);
  // 99 % of the area reach 6 mm; the bar is half as long again.
  EXPECT_TRUE(looks_like(fills[59], sequential((6.0 - 0.1) / (1.5 * 6.0 - 0.1))));
  EXPECT_TRUE(looks_like(fills[60], sequential(1.0)));
  EXPECT_TRUE(text_of(svg, "(mm), up to 167"));
  EXPECT_TRUE(text_of(svg, "5 mm"));  // of the arrows
  options.whole_range = true;
  const std::string whole = drawn({&shot, 1}, options);
  EXPECT_FALSE(text_of(whole, "(mm), up to 167"));
  EXPECT_TRUE(text_of(whole, "100 mm"));
  EXPECT_FALSE(looks_like(block_fills(whole, 61)[59], fills[59]));
}

TEST(Plot, ColoursOfBothSignsAreWhiteAtNothing) {
  Snapshot shot = snapshot("displacement.x");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  shot.field.values = {-0.25, -0.25, 1.0};
  const std::string svg = drawn({&shot, 1}, {});
  const auto fills = block_fills(svg, 2);
  EXPECT_TRUE(looks_like(fills[0], diverging(0.375)));  // a quarter as far as the red end
  EXPECT_TRUE(looks_like(fills[1], diverging(1.0)));
  EXPECT_FALSE(text_of(svg, "\u22121.0"));  // the bar ends where the values do
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

TEST(Plot, OutlinesOfAPictureHaveOneColour) {
  Snapshot shot = snapshot("displacement");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  const auto light_lines = [&](double first, double second) {
    shot.field.values = {first, first, second};
    PlotOptions options;
    options.range = {0.0, 1.0};
    return stroked(drawn({&shot, 1}, options), ink::light_line).size();
  };
  EXPECT_EQ(light_lines(0.0, 0.5), 2u);  // both, as dark lines would vanish on one
  EXPECT_EQ(light_lines(1.0, 0.5), 0u);
  EXPECT_EQ(light_lines(0.4, 0.5), 0u);
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

TEST(Plot, NamesOfMonitorsDoNotOverlap) {
  const Snapshot shot = snapshot("none");
  PlotOptions options;
  for (int k = 0; k < 5; ++k) options.monitors.push_back({"name", {0.001 * k, 0.5}});
  const std::string svg = drawn({&shot, 1}, options);
  const std::vector<Vec2> names = all_texts(svg, "name");
  ASSERT_EQ(names.size(), 5u);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 d = names[i] - names[j];
      EXPECT_TRUE(std::abs(d.y) >= 6.5 || std::abs(d.x) >= 16.0) << i << " " << j;
    }
  }
}

TEST(Plot, SnapshotsStandSideBySideWithOneScale) {
  std::vector<Snapshot> shots{snapshot("displacement"), snapshot("displacement")};
  shots[0].heading = "t = 1 s";
  shots[1].heading = "t = 2 s";
  for (Snapshot& s : shots) s.blocks.cell_fields[1].values = {0, 0, 0};
  shots[0].field.values = {0.0, 0.0, 0.5};
  shots[1].field.values = {0.0, 0.0, 1.0};
  const std::string svg = drawn(shots, {});
  ASSERT_TRUE(text_of(svg, "t = 1 s"));
  ASSERT_TRUE(text_of(svg, "t = 2 s"));
  EXPECT_LT(text_of(svg, "t = 1 s")->x, text_of(svg, "t = 2 s")->x);
  EXPECT_EQ(text_of(svg, "t = 1 s")->y, text_of(svg, "t = 2 s")->y);
  const auto fills = block_fills(svg, 4);
  ASSERT_EQ(fills.size(), 4u);
  EXPECT_TRUE(looks_like(fills[1], sequential(0.5)));
  EXPECT_TRUE(looks_like(fills[3], sequential(1.0)));
  EXPECT_EQ(all_texts(svg, "displacement (m)").size(), 1u);
}

TEST(Plot, StatesOfContactsHaveTheirOwnColours) {
  Snapshot shot = snapshot("none");
  Grid contacts;
  for (const double state : {2.0, 0.0, 3.0, 1.0}) {
    contacts.points.insert(contacts.points.end(), {1.0 + 0.1 * state, 0.5, 0.0});
    contacts.corners.push_back(static_cast<std::int64_t>(contacts.ends.size()));
    contacts.ends.push_back(static_cast<std::int64_t>(contacts.corners.size()));
    contacts.types.push_back(cell_type::vertex);
  }
  contacts.cell_fields = {{"state", 1, {2, 0, 3, 1}, {}, true}};
  shot.contacts = contacts;
  shot.field = shown_field("state", shot.blocks, &*shot.contacts).value();
  const std::string svg = drawn({&shot, 1}, {});
  std::vector<std::size_t> order;
  for (const std::string& path : elements(svg, "path")) {
    const auto fill = colour_of(path, "fill");
    for (std::size_t k = 0; fill && k < 4; ++k) {
      if (looks_like(*fill, state_colour(k)) && attribute(path, "d").find('C') != std::string::npos)
        order.push_back(k);
    }
  }
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 3, 2}));  // those that slide on top
  for (const char* state : contact_states) EXPECT_TRUE(text_of(svg, state)) << state;
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

TEST(Plot, ValuesThatDifferByRoundingAreOne) {
  Snapshot shot = snapshot("displacement");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  const std::vector<double> values{1.2533864465827382e-06, 1.253386444295216e-06};
  shot.field.values = {values[0], values[0], values[1]};
  const ColourScale scale({&shot, 1}, {}, false);
  EXPECT_EQ(scale.low(), 0.0);
  EXPECT_EQ(scale.high(), values[0]);
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
}  // namespace edda::plot_test
