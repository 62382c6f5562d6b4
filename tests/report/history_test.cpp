#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "report/history_panels.hpp"
#include "report/history_plot.hpp"
#include "report/peaks.hpp"
#include "report/picture_reading.hpp"
#include "report/relative.hpp"
#include "scratch_folder.hpp"

namespace edda::history_test {
namespace {

Table small_history() {
  return {{{"time", {0.0, 1.0, 2.0, 3.0, 4.0}},
           {"P.ux", {0.0, 1.0, 4.0, 2.0, 3.0}},
           {"P.vx", {0.0, 1.0, 0.0, 1.0, 0.0}},
           {"kinetic", {1.0, 2.0, 3.0, 4.0, 5.0}},
           {"fracture", {0.0, 0.0, 0.0, 0.0, 0.0}},
           {"unbalanced", {1.0, 1e-2, 1e-1, 1e-5, 1e-4}}}};
}

std::string drawn(const HistoryPicture& picture) {
  const ScratchFolder folder;
  EXPECT_FALSE(plot_history(picture, folder.at("history.svg")));
  return read_file(folder.at("history.svg")).value();
}

HistoryPicture picture_of(const Table& table, const std::vector<std::string>& names) {
  HistoryPicture picture;
  picture.time = table.columns[0].values;
  picture.panels = history_panels(table, names).value();
  return picture;
}

/// The line drawn with the first colour, 1 pt wide.
std::vector<Vec2> first_line(const std::string& svg) {
  for (const std::string& path : stroked(svg, {0.000, 0.447, 0.698})) {
    if (property(path, "stroke-width") == "1") return points_of(path);
  }
  return {};
}

TEST(HistoryPanels, OneForEachKindOfQuantity) {
  const Table table = small_history();
  const auto panels = history_panels(table, {"P", "unbalanced", "P.ux"});
  ASSERT_TRUE(panels.ok());
  ASSERT_EQ(panels.value().size(), 3u);
  EXPECT_EQ(panels.value()[0].label, "displacement");
  EXPECT_EQ(panels.value()[0].lines.size(), 1u);  // though named twice
  EXPECT_EQ(panels.value()[1].unit, "m/s");
}

TEST(HistoryPanels, EnergyLeavesOutWhatCannotBeSeen) {
  const Table table = small_history();
  const auto panels = history_panels(table, {"energy"});
  ASSERT_TRUE(panels.ok());
  ASSERT_EQ(panels.value()[0].lines.size(), 1u);
  EXPECT_EQ(panels.value()[0].lines[0]->name, "kinetic");
  EXPECT_EQ(history_panels(table, {"fracture"}).value()[0].lines.size(), 1u);  // asked for
}

TEST(HistoryPanels, UnknownNamesAreAFaultThatListsTheKnown) {
  for (const char* name : {"Q", "P.", "time", ""}) {
    const auto panels = history_panels(small_history(), {"P.ux", name});
    ASSERT_FALSE(panels.ok()) << name;
    ASSERT_EQ(panels.faults().size(), 1u);
    EXPECT_NE(panels.faults()[0].remedy.find("kinetic"), std::string::npos);
  }
}

/// Equal ratios of the axis are equal ways on the page.
TEST(HistoryPlot, ALogarithmicAxisHasEqualRatiosAtEqualWays) {
  const Table table{{{"time", {0.1, 1.0, 10.0}}, {"P.ax", {0.0, 40.0, 20.0}}}};
  HistoryPicture picture = picture_of(table, {"P.ax"});
  picture.ratios = true;
  const std::string svg = drawn(picture);
  const std::vector<Vec2> line = first_line(svg);
  ASSERT_EQ(line.size(), 3u);
  EXPECT_NEAR(line[1].x - line[0].x, line[2].x - line[1].x, 0.02);
  EXPECT_NEAR(text_of(svg, "0.1")->x, line[0].x, 0.02);
  EXPECT_NEAR(text_of(svg, "1")->x, line[1].x, 0.02);
  EXPECT_NEAR(text_of(svg, "5")->x, line[1].x + std::log10(5.0) * (line[2].x - line[1].x), 0.02);
  EXPECT_TRUE(text_of(svg, "acceleration (m/s2)"));
}

TEST(HistoryPlot, TheLineGoesThroughItsValues) {
  const Table table = small_history();
  const std::string svg = drawn(picture_of(table, {"P.ux"}));
  const std::vector<Vec2> line = first_line(svg);
  ASSERT_EQ(line.size(), 5u);
  // The ticks say where 0 and 4 are; a tick's label lies a third of its size below its middle.
  const double x_of_0 = text_of(svg, "0.0")->x, x_of_4 = text_of(svg, "4.0")->x;
  const double y_of_0 = text_of(svg, "0")->y, y_of_4 = text_of(svg, "4")->y;
  for (std::size_t r = 0; r < 5; ++r) {
    const double time = table.columns[0].values[r], value = table.columns[1].values[r];
    EXPECT_NEAR(line[r].x, x_of_0 + time / 4.0 * (x_of_4 - x_of_0), 0.02);
    EXPECT_NEAR(line[r].y + 0.36 * 8.0, y_of_0 + value / 4.0 * (y_of_4 - y_of_0), 0.02);
  }
  EXPECT_TRUE(text_of(svg, "P.ux"));
  EXPECT_TRUE(text_of(svg, "time (s)"));
}

TEST(HistoryPlot, RatiosOverManyPowersOfTenAreLogarithmic) {
  const Table table = small_history();
  const std::vector<Vec2> line = first_line(drawn(picture_of(table, {"unbalanced"})));
  ASSERT_EQ(line.size(), 5u);
  const double decade = line[1].y - line[2].y;
  EXPECT_GT(decade, 5.0);
  EXPECT_NEAR(line[1].y - line[0].y, 2.0 * decade, 0.02);
  EXPECT_NEAR(line[3].y - line[2].y, 4.0 * decade, 0.02);
}

TEST(HistoryPlot, NamesOfStagesStandAboveThem) {
  const Table table = small_history();
  HistoryPicture picture = picture_of(table, {"P.ux"});
  picture.stages = {{"early", 0.0, 2.0}, {"late", 2.0, 4.0}};
  const std::string svg = drawn(picture);
  ASSERT_TRUE(text_of(svg, "early"));
  EXPECT_LT(text_of(svg, "early")->x, text_of(svg, "late")->x);
  picture.stages = {{"short", 0.0, 0.1}, {"long", 0.1, 4.0}};  // no room for the first
  EXPECT_FALSE(text_of(drawn(picture), "short"));
  picture.stages = {{"early", 0.0, 2.0}, {"", 2.0, 4.0}};  // those without a name have a number
  const auto numbers = all_texts(drawn(picture), "2");
  EXPECT_TRUE(std::any_of(numbers.begin(), numbers.end(),
                          [&](Vec2 p) { return p.y == text_of(svg, "late")->y; }));
}

TEST(HistoryPlot, NamesOfLinesThatEndTogetherStandApart) {
  Table table = small_history();
  table.columns[2] = {"P.uy", table.columns[1].values};
  table.columns.push_back({"Q.ux", table.columns[1].values});
  const std::string svg = drawn(picture_of(table, {"P.ux", "P.uy", "Q.ux"}));
  const double a = text_of(svg, "P.ux")->y, b = text_of(svg, "P.uy")->y,
               c = text_of(svg, "Q.ux")->y;
  for (const double apart : {a - b, b - c, a - c}) EXPECT_GE(std::abs(apart), 8.0);
}

TEST(HistoryPlot, LongHistoriesKeepTheirPeaks) {
  std::vector<double> time, values;
  for (int k = 0; k < 200000; ++k) {
    time.push_back(k);
    values.push_back(k == 123456 ? 7.0 : k == 65432 ? -7.0 : std::sin(0.1 * k));
  }
  const auto rows = rows_with_peaks(time, values, 1200);
  EXPECT_LT(rows.size(), 6000u);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 123456u));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 65432u));
  EXPECT_EQ(rows.back(), 199999u);
  // Nor is one lost behind a value that is none.
  values[65430] = std::nan("");
  const auto few = rows_with_peaks(time, values, 20);
  EXPECT_TRUE(std::binary_search(few.begin(), few.end(), 65432u));
}

TEST(HistoryPlot, ShowsTheWindowThatIsAskedFor) {
  const Table table = small_history();
  HistoryPicture picture = picture_of(table, {"P.ux"});
  picture.span = Vec2{1.5, 3.5};
  picture.range = Vec2{0.0, 8.0};
  const std::string svg = drawn(picture);
  const std::vector<Vec2> line = first_line(svg);
  ASSERT_EQ(line.size(), 4u) << "two rows, and one on each side";
  const double x_of_2 = text_of(svg, "2.0")->x, x_of_3 = text_of(svg, "3.0")->x;
  EXPECT_NEAR(line[1].x, x_of_2, 0.6);
  EXPECT_NEAR(line[2].x, x_of_3, 0.6);
  // From 4 m at 2 s to 2 m at 3 s is a quarter of the range.
  const std::string whole = drawn(picture_of(table, {"P.ux"}));
  const double down = line[2].y - line[1].y;
  const std::vector<Vec2> all = first_line(whole);
  EXPECT_GT(down, 0.0);
  EXPECT_NEAR(down, 0.55 * (all[3].y - all[2].y), 0.05 * (all[3].y - all[2].y))
      << "its range went to 4.2 with a margin";
  EXPECT_FALSE(text_of(svg, "0.5")) << "no tick before the window";
  picture.range.reset();
  picture.span = Vec2{2.5, 3.5};
  EXPECT_LT(first_line(drawn(picture))[0].y, first_line(drawn(picture))[1].y);
}

TEST(History, IsDrawnRelativeToAMonitor) {
  Table table = small_history();
  table.columns.push_back({"Q.ux", {0.5, 0.5, 1.0, 2.0, 2.0}});
  Table other = table;
  EXPECT_FALSE(move_with(other, "R"));
  EXPECT_EQ(other.column("P.ux")->values, table.column("P.ux")->values);
  EXPECT_TRUE(move_with(other, "Q"));
  EXPECT_EQ(other.column("P.ux")->values, (std::vector<double>{-0.5, 0.5, 3.0, 0.0, 1.0}));
  EXPECT_EQ(other.column("Q.ux")->values, std::vector<double>(5, 0.0));
  EXPECT_EQ(other.column("P.vx")->values, table.column("P.vx")->values);  // Q has none
  EXPECT_EQ(other.column("kinetic")->values, table.column("kinetic")->values);
}

}  // namespace
}  // namespace edda::history_test
