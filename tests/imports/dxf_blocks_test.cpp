// Blocks of drawings: where they come to lie, on which layer, and those that would never end.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "imports/dxf_text.hpp"

namespace edda::dxf_blocks_test {
namespace {

using namespace test;

std::string line(const std::string& layer, const std::string& x1, const std::string& y1,
                 const std::string& x2, const std::string& y2) {
  return entity("LINE", {{8, layer}, {10, x1}, {20, y1}, {11, x2}, {21, y2}});
}

std::string insert(const std::string& name, const std::string& x, const std::string& y,
                   const DxfPairs& more = {}, const std::string& layer = "0") {
  return entity("INSERT", {{8, layer}, {2, name}, {10, x}, {20, y}}) + groups(more);
}

std::vector<Vec2> all_points(const Drawing& drawing) {
  std::vector<Vec2> points;
  for (const DrawnLine& l : drawing.lines) {
    points.insert(points.end(), l.points.begin(), l.points.end());
  }
  return points;
}

TEST(DxfBlocks, ScaledTurnedAndShifted) {
  const std::string one = blocks(block("A", "1", "1", line("J", "1", "1", "2", "5")));
  EXPECT_EQ(all_points(read_dxf(insert("A", "10", "20"), one)),
            (std::vector<Vec2>{{10, 20}, {11, 24}}));
  // (1, 4) from the base point, scaled (2, 12), turned by a right angle (-12, 2).
  EXPECT_EQ(all_points(read_dxf(insert("A", "10", "20", {{41, "2"}, {42, "3"}, {50, "90"}}), one)),
            (std::vector<Vec2>{{10, 20}, {-2, 22}}));
  EXPECT_EQ(all_points(read_dxf(insert("A", "10", "20", {{41, "-1"}, {50, "-450"}}), one)),
            (std::vector<Vec2>{{10, 20}, {14, 21}}));
  // Seen from below: what is drawn at the point (10, 20) and turned counter-clockwise, mirrored.
  EXPECT_EQ(all_points(read_dxf(insert("A", "10", "20", {{50, "90"}, {230, "-1"}}), one)),
            (std::vector<Vec2>{{-10, 20}, {-6, 21}}));
}

TEST(DxfBlocks, ColumnsAndRowsAreTurnedButNotScaled) {
  const std::string one = blocks(block("A", "0", "0", line("J", "0", "0", "1", "0")));
  const DxfPairs array = {{41, "10"}, {42, "10"}, {50, "90"}, {70, "3"},
                          {71, "2"},  {44, "5"},  {45, "4"}};
  const Drawing d = read_dxf(insert("A", "1", "2", array), one);
  ASSERT_EQ(d.lines.size(), 6U);
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const Vec2 at{1.0 - 4.0 * static_cast<double>(row), 2.0 + 5.0 * static_cast<double>(column)};
      EXPECT_EQ(d.lines[3 * row + column].points, (std::vector<Vec2>{at, at + Vec2{0, 10}}));
    }
  }
  // In one place they are one, and counts below 1 are 1.
  const DxfPairs odd = {{70, "2000000000"}, {71, "-7"}, {45, "1"}};
  EXPECT_EQ(read_dxf(insert("A", "1", "2", odd), one).lines.size(), 1U);
}

/// Where an INSERT puts a point, as its definition says, one step after the other.
Vec2 by_hand(Vec2 p, Vec2 base, Vec2 scale, double degrees, Vec2 offset, Vec2 at) {
  p = p - base;
  p = {p.x * scale.x, p.y * scale.y};
  return at + rotated(p + offset, degrees * std::numbers::pi / 180.0);
}

TEST(DxfBlocks, NestedOnesGoThroughEveryMap) {
  const std::string both =
      blocks(block("outer", "-1", "2",
                   insert("Inner", "3", "1", {{41, "2"}, {42, "-0.5"}, {50, "25"}}) +
                       line("J", "0", "0", "1", "0")) +
             block("INNER", "0.5", "0.25", line("J", "1", "2", "3", "4")));
  const Drawing d = read_dxf(
      insert("OUTER", "10", "-5",
             {{41, "1.5"}, {42, "3"}, {50, "-70"}, {70, "2"}, {71, "2"}, {44, "7"}, {45, "11"}}),
      both);
  ASSERT_EQ(d.lines.size(), 8U);
  std::size_t i = 0;
  for (const double row : {0.0, 11.0}) {
    for (const double column : {0.0, 7.0}) {
      const auto outer = [&](Vec2 p) {
        return by_hand(p, {-1, 2}, {1.5, 3}, -70, {column, row}, {10, -5});
      };
      const auto inner = [&](Vec2 p) {
        return outer(by_hand(p, {0.5, 0.25}, {2, -0.5}, 25, {}, {3, 1}));
      };
      expect_near(d.lines[i].points[0], outer({0, 0}), 1e-13);
      expect_near(d.lines[i].points[1], outer({1, 0}), 1e-13);
      expect_near(d.lines[i + 1].points[0], inner({1, 2}), 1e-13);
      expect_near(d.lines[i + 1].points[1], inner({3, 4}), 1e-13);
      i += 2;
    }
  }
}

TEST(DxfBlocks, MirroredBulgesAndUnequalScales) {
  // Half a circle below the chord from (-1, 0) to (1, 0), and a whole one.
  const std::string round = blocks(block(
      "A", "0", "0",
      entity("LWPOLYLINE", {{8, "J"}, {10, "-1"}, {20, "0"}, {42, "1"}, {10, "1"}, {20, "0"}}) +
          entity("CIRCLE", {{8, "J"}, {10, "0"}, {20, "0"}, {40, "1"}})));
  const Drawing up = read_dxf(insert("A", "5", "0", {{42, "-1"}}), round);
  const Drawing left = read_dxf(insert("A", "5", "0", {{41, "-1"}}), round);
  ASSERT_EQ(up.lines[0].points.size(), 25U);
  expect_near(up.lines[0].points[12], {5, 1}, 1e-15);
  expect_near(left.lines[0].points[12], {5, -1}, 1e-15);
  EXPECT_EQ(up.lines[0].points[0], (Vec2{4, 0}));
  EXPECT_EQ(left.lines[0].points[0], (Vec2{6, 0}));
  const Drawing wide = read_dxf(insert("A", "0", "0", {{41, "4"}, {42, "0.5"}}), round);
  for (const Vec2 p : all_points(wide)) {
    EXPECT_NEAR(p.x * p.x / 16.0 + p.y * p.y / 0.25, 1.0, 1e-14);
  }
}

TEST(DxfBlocks, LayerZeroIsThatOfTheInsert) {
  const std::string nested =
      blocks(block("A", "0", "0",
                   line("0", "0", "0", "1", "0") + line("J", "0", "1", "1", "1") +
                       insert("B", "0", "0") + insert("B", "0", "0", {}, "K")) +
             block("B", "0", "0", line("0", "0", "2", "1", "2")));
  const auto layers = [&](const std::string& layer) {
    std::vector<std::string> names;
    for (const DrawnLine& l : read_dxf(insert("A", "0", "0", {}, layer), nested).lines) {
      names.push_back(l.layer);
    }
    return names;
  };
  EXPECT_EQ(layers("L"), (std::vector<std::string>{"L", "J", "L", "K"}));
  EXPECT_EQ(layers("0"), (std::vector<std::string>{"0", "J", "0", "K"}));
}

TEST(DxfBlocks, WhatIsLeftOutOfThemIsCounted) {
  const std::string text = blocks(
      block("A", "0", "0",
            line("J", "0", "0", "1", "1") + entity("ATTDEF", {{1, "x"}}) + entity("HATCH", {}) +
                insert("missing", "0", "0") + insert("flat", "0", "0", {{42, "0"}}) +
                insert("A", "0", "0", {{210, "1"}, {230, "0"}})) +
      block("unused", "0", "0", entity("TEXT", {})) +
      entity("BLOCK", {{2, "other"}, {70, "4"}, {10, "0"}, {20, "0"}, {1, "other.dwg"}}) +
      entity("ENDBLK", {}));
  const Drawing d = read_dxf(insert("A", "0", "0", {{66, "1"}, {70, "2"}, {44, "5"}}) +
                                 entity("ATTRIB", {{1, "x"}}) + entity("SEQEND", {}) +
                                 insert("other", "0", "0") + insert("A", "9", "9", {{67, "1"}}),
                             text);
  EXPECT_EQ(d.lines.size(), 2U);
  const std::map<std::string, int> expected = {{"ATTDEF", 2},
                                               {"ATTRIB", 1},
                                               {"HATCH", 2},
                                               {"INSERT across the plane", 2},
                                               {"INSERT of another drawing", 1},
                                               {"INSERT of scale 0", 2},
                                               {"INSERT on paper", 1},
                                               {"INSERT without its block", 2}};
  EXPECT_EQ(d.skipped, expected);
}

TEST(DxfBlocks, SectionsComeInAnyOrder) {
  const std::string entities = "0\nSECTION\n2\nENTITIES\n" + insert("A", "1", "1") + "0\nENDSEC\n";
  const std::string one = blocks(block("A", "0", "0", line("J", "0", "0", "1", "0")));
  EXPECT_EQ(read(parse_dxf(entities + one + "0\nEOF\n", "a.dxf")).lines.size(), 1U);
}

TEST(DxfBlocks, FaultsOfBlocksThatNothingNeedsAreNone) {
  const std::string broken = block("bad", "0", "0", line("J", "0", "0", "nan", "0"));
  const std::string good = block("A", "0", "0", line("J", "0", "0", "1", "0"));
  EXPECT_EQ(read_dxf(insert("A", "0", "0"), blocks(broken + good)).lines.size(), 1U);
  expect_left_out(parse_dxf(dxf(insert("bad", "0", "0"), blocks(broken + good)), "a.dxf"), 26,
                  "\"nan\" is not a length");
}

TEST(DxfBlocks, BadOnesGiveOneFault) {
  const auto fault = [](const std::string& text, const std::string& entities, int at,
                        const std::string& fragment) {
    expect_fault(parse_dxf(dxf(entities, text), "a.dxf"), at, fragment);
  };
  const std::string begun = "0\nSECTION\n2\nBLOCKS\n";
  const std::string head = entity("BLOCK", {{2, "A"}, {10, "0"}, {20, "0"}});
  const std::string end = entity("ENDBLK", {});
  fault(begun + head, "", 13, "a BLOCK is not ended by ENDBLK");
  fault(blocks(head), "", 13, "a BLOCK is not ended by ENDBLK");
  fault(blocks(head + head + end), "", 13, "a BLOCK is not ended by ENDBLK");
  fault(begun + head + end, "", 15, "the section of blocks is not ended by ENDSEC");
  expect_fault(parse_dxf(begun + head, "a.dxf"), 12, "breaks off within its blocks");
  expect_fault(parse_dxf(begun + head + end, "a.dxf"), 14, "breaks off within its blocks");
}

TEST(DxfBlocks, BadInsertsAreLeftOut) {
  const auto left_out = [](const std::string& text, const std::string& entities, int at,
                           const std::string& fragment) {
    expect_left_out(parse_dxf(dxf(entities, text), "a.dxf"), at, fragment);
  };
  const std::string end = entity("ENDBLK", {});
  left_out("", insert("A", "0", "inf"), 14, "\"inf\" is not a length");
  left_out("", entity("INSERT", {{2, "A"}, {10, "0"}}), 5, "INSERT lacks group 20");
  left_out("", entity("INSERT", {{10, "0"}, {20, "0"}}), 5, "INSERT lacks group 2");
  left_out("", insert("A", "0", "0", {{70, "many"}}), 16, "\"many\" is not a whole number");
  left_out("", insert("A", "0", "0", {{41, "1e999"}}), 16, "\"1e999\" is not a number");
  const std::string no_base = blocks(entity("BLOCK", {{2, "A"}, {10, "0"}}) + end);
  left_out(no_base, insert("A", "0", "0"), 5, "BLOCK lacks group 20");
  const std::string open = block("A", "0", "0", entity("POLYLINE", {}));
  left_out(blocks(open), insert("A", "0", "0"), 17, "a POLYLINE is not ended by SEQEND");
  const std::string far = block("A", "0", "0", line("J", "0", "0", "1e6", "0"));
  left_out(blocks(far), insert("A", "0", "0", {{41, "1e7"}}), 37, "reaches beyond 1e12");
}

TEST(DxfBlocks, ThoseWithinThemselvesAreLeftOut) {
  const auto fault = [](const std::string& text) {
    expect_left_out(parse_dxf(dxf(insert("A", "0", "0"), blocks(text)), "a.dxf"), 17,
                    "is inserted into itself");
  };
  fault(block("A", "0", "0", insert("a", "0", "0")));
  fault(block("A", "0", "0", insert("A", "1", "1", {{41, "0.5"}, {70, "9"}, {44, "1"}})));
  fault(block("B", "0", "0", insert("A", "0", "0")) + block("A", "0", "0", insert("B", "0", "0")));
}

std::string chain(int length, const DxfPairs& more = {}) {
  std::string text = block("0", "0", "0", line("J", "0", "0", "1", "1"));
  for (int i = 1; i < length; ++i) {
    text += block(std::to_string(i), "0", "0", insert(std::to_string(i - 1), "0", "0", more));
  }
  return blocks(text);
}

TEST(DxfBlocks, NestsAndArraysHaveAnEnd) {
  EXPECT_EQ(read_dxf(insert("99", "0", "0"), chain(100)).lines.size(), 1U);
  const auto fails = [](const std::string& entities, const std::string& text,
                        const std::string& fragment) {
    const Result<Drawing> result = parse_dxf(dxf(entities, text), "a.dxf");
    ASSERT_FALSE(result.ok()) << fragment;
    EXPECT_NE(to_string(result.faults()[0]).find(fragment), std::string::npos)
        << to_string(result.faults()[0]);
  };
  for (const int deep : {100, 30000}) {
    const Drawing d = read_dxf(insert(std::to_string(deep), "0", "0"), chain(deep + 1));
    EXPECT_TRUE(d.lines.empty());
    ASSERT_TRUE(d.fault.has_value());
    EXPECT_NE(d.fault->problem.find("nested more than 100 deep"), std::string::npos);
  }
  const DxfPairs ten = {{70, "10"}, {44, "1"}},
                 huge = {{70, "2000000000"}, {44, "1"}, {71, "2000000000"}, {45, "1"}};
  fails(insert("20", "0", "0"), chain(21, ten), "more than 1000000 points");
  fails(insert("0", "0", "0", huge), chain(1), "more than 1000000 points");
  fails(insert("A", "0", "0", huge), blocks(block("A", "0", "0", "")), "more than 1000000 points");
  std::string empties = block("0", "0", "0", "");
  for (int i = 1; i < 60; ++i) {
    const std::string before = std::to_string(i - 1);
    empties +=
        block(std::to_string(i), "0", "0", insert(before, "0", "0") + insert(before, "1", "0"));
  }
  fails(insert("59", "0", "0"), blocks(empties), "more than 1000000 points");
}

}  // namespace
}  // namespace edda::dxf_blocks_test
