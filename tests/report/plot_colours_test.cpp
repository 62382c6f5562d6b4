// Colours of blocks, of their outlines and of contacts in a picture.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "report/picture_reading.hpp"
#include "report/snapshots.hpp"

namespace edda::plot_colours_test {
namespace {

using testing::crumb;
using testing::drawn;
using testing::snapshot;

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

/// 167 m beside a bar in mm, 0.8 m beside one in um: the far value has a unit of its own.
TEST(Plot, AValueFarBeyondTheBarHasItsOwnUnit) {
  for (const auto& [by, said] : {std::pair{1e3, "167 m"}, {1e2, "16.7 m"}, {5.0, "835"}}) {
    Snapshot shot = crumb();
    std::vector<double>& u = shot.blocks.cell_fields[1].values;
    u[u.size() - 2] *= by;
    shot.field = shown_field("displacement", shot.blocks, nullptr).value();
    const std::string svg = drawn({&shot, 1}, {});
    EXPECT_TRUE(text_of(svg, std::string("(mm), up to ") + said)) << said;
  }
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

TEST(Plot, ValuesThatDifferByRoundingAreOne) {
  Snapshot shot = snapshot("displacement");
  shot.blocks.cell_fields[1].values = {0, 0, 0};
  const std::vector<double> values{1.2533864465827382e-06, 1.253386444295216e-06};
  shot.field.values = {values[0], values[0], values[1]};
  const ColourScale scale({&shot, 1}, {}, false);
  EXPECT_EQ(scale.low(), 0.0);
  EXPECT_EQ(scale.high(), values[0]);
}

}  // namespace
}  // namespace edda::plot_colours_test
