// Files of lines: drawings (DXF), tables of traces, geometry files of DDA; and those that are bad.
#include "imports/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/polygon.hpp"
#include "imports/dxf_text.hpp"

namespace edda::drawings_test {
namespace {

using namespace test;

std::string line_entity(const std::string& layer, const std::string& x1, const std::string& y1,
                        const std::string& x2, const std::string& y2) {
  return "0\nLINE\n8\n" + layer + "\n10\n" + x1 + "\n20\n" + y1 + "\n11\n" + x2 + "\n21\n" + y2 +
         "\n";
}

TEST(Dxf, LinesHaveTheirEndsToTheLastDigit) {
  const Drawing d =
      read(parse_dxf(dxf(line_entity("bedding", "0.1", "-2.3456789012345678", "1e-3", "  7.5 ") +
                         line_entity("J 2", "1000000.123456789", "3", "4", "-.5")),
                     "a.dxf"));
  ASSERT_EQ(d.lines.size(), 2U);
  EXPECT_EQ(d.lines[0].layer, "bedding");
  EXPECT_EQ(d.lines[0].points, (std::vector<Vec2>{{0.1, -2.3456789012345678}, {1e-3, 7.5}}));
  EXPECT_EQ(d.lines[1].layer, "J 2");
  EXPECT_EQ(d.lines[1].points, (std::vector<Vec2>{{1000000.123456789, 3}, {4, -0.5}}));
  EXPECT_EQ(d.lines[1].line, 17);
  EXPECT_TRUE(d.skipped.empty());
}

TEST(Dxf, WindowsLineEndsAndHeadersAreNoTrouble) {
  std::string text =
      dxf(line_entity("0", "0", "0", "1", "1"),
          "999\nmade by hand\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n"
          "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nself\n0\nINSERT\n2\nself\n0\nENDBLK\n0\nENDSEC\n");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(parse_dxf(windows, "a.dxf")).lines.size(), 1U);
}

const std::string light =
    "0\nLWPOLYLINE\n8\nJ\n90\n2\n70\nFLAG\n10\n0\n20\n0\n42\nBULGE\n10\n2\n20\n0\n42\n0\n";

std::string light_polyline(const std::string& flag, const std::string& bulge) {
  std::string text = light;
  text.replace(text.find("FLAG"), 4, flag);
  return text.replace(text.find("BULGE"), 5, bulge);
}

TEST(Dxf, BulgesAreArcs) {
  // Half a circle below the chord, then straight back: 24 pieces and the closing one.
  const Drawing d = read(parse_dxf(dxf(light_polyline("1", "1.0")), "a.dxf"));
  ASSERT_EQ(d.lines.size(), 1U);
  ASSERT_EQ(d.lines[0].points.size(), 26U);
  EXPECT_EQ(d.lines[0].points.front(), d.lines[0].points.back());
  Ring ring(d.lines[0].points.begin(), d.lines[0].points.end() - 1);
  EXPECT_NEAR(signed_area(ring), 0.5 * 24.0 * std::sin(std::acos(-1.0) / 24.0), 1e-12);
  EXPECT_NEAR(ring[12].y, -1.0, 1e-14);
  const Drawing open = read(parse_dxf(dxf(light_polyline("0", "0")), "a.dxf"));
  EXPECT_EQ(open.lines[0].points, (std::vector<Vec2>{{0, 0}, {2, 0}}));
}

TEST(Dxf, OldPolylinesAreRead) {
  const std::string text =
      "0\nPOLYLINE\n8\nJ3\n66\n1\n70\n1\n0\nVERTEX\n8\nother\n10\n3\n20\n3\n42\n1.0\n"
      "0\nVERTEX\n8\nJ3\n10\n5\n20\n3\n0\nVERTEX\n10\n4\n20\n6\n0\nSEQEND\n8\nJ3\n";
  const Drawing d = read(parse_dxf(dxf(text), "a.dxf"));
  ASSERT_EQ(d.lines.size(), 1U);
  EXPECT_EQ(d.lines[0].layer, "J3");
  EXPECT_EQ(d.lines[0].points.size(), 3U + 23U + 1U);
  EXPECT_NEAR(d.lines[0].points[12].y, 2.0, 1e-14);
  EXPECT_EQ(d.lines[0].points[24], (Vec2{5, 3}));
}

TEST(Dxf, DrawnFromBelowIsMirrored) {
  std::string text = light_polyline("0", "0.5");
  text += "210\n0\n220\n0\n230\n-1\n";
  const Drawing d = read(parse_dxf(dxf(text), "a.dxf"));
  EXPECT_EQ(d.lines[0].points.back(), (Vec2{-2, 0}));
  for (std::size_t i = 1; i + 1 < d.lines[0].points.size(); ++i) {
    EXPECT_LT(d.lines[0].points[i].y, 0.0);
  }
}

TEST(Dxf, WhatIsNoLineIsCounted) {
  const Drawing d = read(parse_dxf(
      dxf("0\nTEXT\n8\n0\n1\nhello\n0\nTEXT\n8\n0\n0\nHATCH\n2\nx\n0\nMLINE\n40\nnonsense\n" +
          line_entity("J", "0", "0", "1", "1") + "67\n1\n" + line_entity("J", "0", "0", "1", "1") +
          light_polyline("0", "0") + "210\n1\n220\n0\n230\n0\n" +
          "0\nPOLYLINE\n8\nJ\n70\n64\n0\nVERTEX\n10\n0\n20\n0\n0\nSEQEND\n"),
      "a.dxf"));
  EXPECT_EQ(d.lines.size(), 1U);
  EXPECT_EQ(d.skipped.at("TEXT"), 2);
  EXPECT_EQ(d.skipped.at("HATCH"), 1);
  EXPECT_EQ(d.skipped.at("MLINE"), 1);
  EXPECT_EQ(d.skipped.at("LINE on paper"), 1);
  EXPECT_EQ(d.skipped.at("LWPOLYLINE across the plane"), 1);
  EXPECT_EQ(d.skipped.at("POLYLINE as a mesh"), 1);
  EXPECT_FALSE(d.skipped.contains("VERTEX"));
}

TEST(Dxf, BadOnesGiveOneFaultAtTheirLine) {
  const auto dxf_fault = [](const std::string& text, int line, const std::string& fragment) {
    expect_fault(parse_dxf(text, "a.dxf"), line, fragment);
  };
  dxf_fault("", 0, "no section of entities");
  dxf_fault("AutoCAD Binary DXF\r\n\x1a", 1, "binary");
  dxf_fault("\x89PNG\r\n\x1a\n", 1, "not a group code");
  dxf_fault("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", 0, "no section of entities");
  dxf_fault("0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nJ\n", 8, "breaks off");
  dxf_fault(dxf(line_entity("J", "0", "0", "1", "1")).substr(0, 52) + "0\nEOF\n", 17,
            "not ended by ENDSEC");
  dxf_fault("0\nSECTION\n2\nENTITIES\nLINE\n8\n", 5, "\"LINE\" is not a group code");
}

/// One bad entity is left out and counted; the others are read.
TEST(Dxf, BadEntitiesAreLeftOut) {
  const std::string good = line_entity("J", "0", "0", "1", "1");
  const auto dxf_fault = [&](const std::string& bad, int line, const std::string& fragment) {
    const Result<Drawing> before = parse_dxf(dxf(good + bad), "a.dxf");
    const Result<Drawing> after = parse_dxf(dxf(bad + good), "a.dxf");
    expect_left_out(after, line, fragment);
    ASSERT_TRUE(before.ok());
    EXPECT_EQ(before.value().lines.size(), 1U) << fragment;
    EXPECT_EQ(after.value().lines.size(), 1U) << fragment;
  };
  dxf_fault(line_entity("J", "0", "zero", "1", "1"), 12, "\"zero\" is not a length");
  dxf_fault(line_entity("J", "0", "1e400", "1", "1"), 12, "is not a length");
  dxf_fault(line_entity("J", "0", "nan", "1", "1"), 12, "is not a length");
  dxf_fault(line_entity("J", "0", "1e13", "1", "1"), 12, "is not a length");
  dxf_fault("0\nLINE\n8\nJ\n10\n1\n20\n1\n11\n2\n", 5, "lacks group 21");
  dxf_fault("0\nLWPOLYLINE\n90\n1000000000\n20\n1\n", 9, "does not begin with group 10");
  dxf_fault("0\nLWPOLYLINE\n10\n1\n10\n1\n", 5, "lacks group 20");
  dxf_fault("0\nPOLYLINE\n0\nVERTEX\n10\n1\n20\n1\n", 5, "not ended by SEQEND");
  dxf_fault("0\nPOLYLINE\n", 5, "not ended by SEQEND");
  dxf_fault("0\nPOLYLINE\n70\nx\n0\nSEQEND\n", 8, "not a whole number");
  dxf_fault("0\nPOLYLINE\n0\nVERTEX\n10\n1\n0\nVERTEX\n10\n1\n20\n0\n0\nSEQEND\n", 7,
            "lacks group 20");
  dxf_fault("0\nLINE\n8\nJ\n10\nLost a line\n1\n20\n1\n11\n2\n21\n2\n30\n0\nx\n", 10, "is not a");
  dxf_fault("0\nCIRCLE\n8\nJ\nhello\n10\n1\n20\n1\n40\n1\n", 9, "\"hello\" is not a group code");
}

TEST(Dxf, NothingIsReadAfterItsEnd) {
  const std::string text = dxf(line_entity("J", "0", "0", "1", "1"));
  for (const char* after : {"-- \nplease ignore\n", "0\nSECTION\n2\nENTITIES\n", "\x1a"}) {
    EXPECT_EQ(read(parse_dxf(text + after, "a.dxf")).lines.size(), 1U);
  }
}

TEST(Dxf, CountsThatLieDoNoHarm) {
  for (const char* claim : {"0", "-5", "1", "2000000000"}) {
    std::string text = light_polyline("0", "0");
    text.replace(text.find("90\n2"), 4, std::string("90\n") + claim);
    EXPECT_EQ(read(parse_dxf(dxf(text), "a.dxf")).lines[0].points.size(), 2U) << claim;
  }
}

/// A drawing with an entity of every kind, two blocks among them.
std::string drawing_of_every_entity() {
  const std::string spline = entity("SPLINE", {{70, "8"},
                                               {71, "2"},
                                               {40, "0"},
                                               {40, "0"},
                                               {40, "0"},
                                               {40, "1"},
                                               {40, "1"},
                                               {40, "1"},
                                               {41, "1"},
                                               {41, "2"},
                                               {41, "1"},
                                               {10, "0"},
                                               {20, "0"},
                                               {10, "1"},
                                               {20, "1"},
                                               {10, "2"},
                                               {20, "0"}});
  const std::string arc =
      entity("ARC", {{10, "0"}, {20, "0"}, {40, "2"}, {50, "0"}, {51, "90"}, {230, "-1"}});
  const std::string insert = entity(
      "INSERT", {{2, "A"}, {10, "0"}, {20, "0"}, {41, "2"}, {50, "30"}, {70, "5"}, {44, "1"}});
  const std::string ellipse =
      entity("ELLIPSE", {{10, "0"}, {20, "0"}, {11, "2"}, {21, "0"}, {40, "0.5"}, {42, "5"}});
  return dxf(line_entity("J", "0", "0", "1", "1") + light_polyline("1", "0.3") +
                 "0\nPOLYLINE\n8\nJ3\n66\n1\n70\n8\n0\nVERTEX\n8\nJ3\n10\n3\n20\n3\n"
                 "30\n1\n0\nVERTEX\n10\n4\n20\n4\n0\nSEQEND\n0\nTEXT\n1\nx\n" +
                 insert + arc + spline,
             blocks(block("A", "0", "0", ellipse + arc) + block("B", "1", "1", insert + spline)));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = text.find('\n', i);
    lines.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return lines;
}

/// Leaves out, doubles or replaces a line, or leaves out all that follow it.
void change_a_line(std::vector<std::string>& odd, std::mt19937& random) {
  const std::size_t at = random() % odd.size();
  constexpr const char* values[] = {"0",      "-1", "70", "66", "10", "999",    "1e308",
                                    "VERTEX", "",   "90", "42", "5",  "16",     "EOF",
                                    "SEQEND", "A",  "B",  "2",  "71", "ENDBLK", "INSERT"};
  switch (random() % 4) {
    case 0:
      odd.erase(odd.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 1:
      odd.insert(odd.begin() + static_cast<std::ptrdiff_t>(at), odd[random() % odd.size()]);
      break;
    case 2:
      odd[at] = values[random() % std::size(values)];
      break;
    default:
      odd.resize(std::max<std::size_t>(at, 1));
  }
}

/// A drawing with lines left out, doubled, shortened and made up, time and again.
TEST(Dxf, OddDrawingsNeverCrash) {
  const std::vector<std::string> lines = lines_of(drawing_of_every_entity());
  std::mt19937 random(8);
  int read_ones = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::string> odd = lines;
    const unsigned changes = 1 + random() % 2;
    for (unsigned change = 0; change < changes; ++change) {
      if (odd.empty()) break;
      change_a_line(odd, random);
    }
    std::string text;
    for (const std::string& line : odd) text += line + '\n';
    const Result<Drawing> result = parse_dxf(text, "odd.dxf");
    read_ones += result.ok();
    if (!result.ok()) {
      ASSERT_EQ(result.faults().size(), 1U);
      continue;
    }
    for (const DrawnLine& line : result.value().lines) {
      for (const Vec2 p : line.points) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
    }
  }
  EXPECT_GT(read_ones, 100);
  EXPECT_LT(read_ones, 2990);
}

TEST(Traces, RowsAreRead) {
  const Drawing d =
      read(parse_traces("\xEF\xBB\xBFx1, y1, x2, y2, joint\r\n# a comment\n\n0,0,1.5,2\n 1e1 , -2 "
                        ",3,4, \"bedding\" \n"
                        "1,2,3,4,\n",
                        "a.csv"));
  ASSERT_EQ(d.lines.size(), 3U);
  EXPECT_EQ(d.lines[0].points, (std::vector<Vec2>{{0, 0}, {1.5, 2}}));
  EXPECT_EQ(d.lines[0].layer, "");
  EXPECT_EQ(d.lines[1].points[0], (Vec2{10, -2}));
  EXPECT_EQ(d.lines[1].layer, "bedding");
  EXPECT_EQ(d.lines[1].line, 5);
  EXPECT_EQ(d.lines[2].layer, "");
}

/// Columns are found by their names, in any order, as geographers call them; others are left out
/// and counted.
TEST(Traces, ColumnsGoByTheirNames) {
  const std::vector<Vec2> expected{{1, 2}, {3, 4}};
  for (const char* text :
       {"FID,START_X,START_Y,END_X,END_Y\n7,1,2,3,4\n", "START_X,END_X,START_Y,END_Y\n1,3,2,4\n",
        "y2;x2;y1;x1;id\n4;3;2;1;9\n",
        "\"x_start\"\t\"y_start\"\t\"x_end\"\t\"y_end\"\n1\t2\t3\t4\n",
        "name,x0,y0,x1,y1\n\"a, b\",1,2,3,4\n",
        "From X [m],From Y [m],To X [m],To Y [m],length\n1,2,3,4,2.8\n",
        "xstart,xend,ystart,yend\n1,3,2,4\n", "sep=;\nx1;y1;x2;y2\n1,0;2,0;3,0;4,0\n",
        "set,X1,Y1,X2,Y2\nbed,1,2,3,4\n"}) {
    const Drawing d = read(parse_traces(text, "a.csv"));
    ASSERT_EQ(d.lines.size(), 1U) << text;
    EXPECT_EQ(d.lines[0].points, expected) << text;
  }
  const Drawing d = read(parse_traces("fid,x1,y1,x2,y2,joint,dip\n7,1,2,3,4,bed,60\n", "a.csv"));
  EXPECT_EQ(d.lines[0].layer, "bed");
  EXPECT_EQ(d.skipped.at("column \"fid\""), 1);
  EXPECT_EQ(d.skipped.at("column \"dip\""), 1);
}

TEST(Traces, HeadersThatSayLittleAreNamed) {
  expect_fault(parse_traces("# traces\nid,east,north,dip\n1,2,3,4\n", "a.csv"), 2,
               "does not name the columns of both ends: id, east, north, dip");
  expect_fault(parse_traces("x,y,x,y\n1,2,3,4\n", "a.csv"), 1, "both ends: x, y, x, y");
  expect_fault(parse_traces("x1,y1,x2,y2,x1\n1,2,3,4,5\n", "a.csv"), 1, "both ends");
  expect_fault(parse_traces("fid,x1,y1,x2,y2\n1,2,3,4\n", "a.csv"), 2,
               "has 4 fields, its header names 5");
  expect_fault(parse_traces("fid,x1,y1,x2,y2\n1,2,3,4,w\n", "a.csv"), 2, "\"w\" is not a length");
}

TEST(Traces, BadRowsAreNamed) {
  expect_fault(parse_traces("0,0,1\n", "a.csv"), 1, "has 3 fields");
  expect_fault(parse_traces("0,0,1,1\n0,0,1,1,j,k\n", "a.csv"), 2, "has 6 fields");
  expect_fault(parse_traces("0,0,1,1\n\n0,x,1,1\n", "a.csv"), 3, "\"x\" is not a length");
  expect_fault(parse_traces("0 0 1 1\n", "a.csv"), 1, "has 1 field");
  expect_fault(parse_traces("x1,y1,x2,y2\nx1,y1,x2,y2\n", "a.csv"), 2, "is not a length");
}

const std::string two_squares =
    "0.01\n7 6\n1\n0\n2\n1\n1\n0\n"
    "0 0 3 0 1\n3 0 3 1.5 1\n3 1.5 0 1.5 1\n0 1.5 0 0 1\n1.5 0 1.5 1.5 2\n0 3 1 3 1\n1 3 1 4 7\n"
    "0 0.5 3 0.5 2\n"
    "0.2 0.75 1.3 0.75\n2.0 0.3 2.0 0.3\n"
    "1 1\n2 1\n";

TEST(Geo, NumbersAreRead) {
  const Drawing d = read(parse_geo(two_squares, "a.geo"));
  ASSERT_EQ(d.lines.size(), 7U);
  EXPECT_EQ(d.lines[4].points, (std::vector<Vec2>{{1.5, 0}, {1.5, 1.5}}));
  EXPECT_EQ(d.lines[4].layer, "2");
  EXPECT_EQ(d.lines[6].layer, "7");
  ASSERT_EQ(d.fixed.size(), 2U);
  EXPECT_EQ(d.fixed[0], (std::pair<Vec2, Vec2>{{0.2, 0.75}, {1.3, 0.75}}));
  EXPECT_EQ(d.fixed[1].first, d.fixed[1].second);
  EXPECT_EQ(d.skipped.at("material lines"), 1);
  EXPECT_EQ(d.skipped.at("loading points"), 1);
  EXPECT_EQ(d.skipped.at("measured points"), 1);
  EXPECT_FALSE(d.skipped.contains("hole points"));
}

const std::string tags =
    "<?xml version=\"1.0\"?>\n<!DOCTYPE x>\n<N:DDA xmlns:N=\"y\">\n<N:Geometry>\n<N:Edgenodedist "
    "distance=\"0.01\"/>\n<Jointlist>\n<Joint type=\"1\"> 0 0 2 0 </Joint>\n<Joint type='3'>2 0 2 "
    "2</Joint>\n<Joint type=\"1\">2 2, 0 0</Joint>\n</Jointlist>\n<!-- <Joint> 9 9 9 </Joint> "
    "-->\n<Fixedpointlist>\n<Line> 0.5 0.1 1.5 0.1 </Line>\n<Point> 1 0.5 </Point>\n"
    "</Fixedpointlist>\n<Measuredpointlist><Point> 1 1 </Point></Measuredpointlist>\n"
    "</N:Geometry>\n</N:DDA>\n";

TEST(Geo, TagsAreRead) {
  const Drawing d = read(parse_geo(tags, "a.geo"));
  ASSERT_EQ(d.lines.size(), 3U);
  EXPECT_EQ(d.lines[1].points, (std::vector<Vec2>{{2, 0}, {2, 2}}));
  EXPECT_EQ(d.lines[1].layer, "3");
  EXPECT_EQ(d.lines[1].line, 8);
  ASSERT_EQ(d.fixed.size(), 2U);
  EXPECT_EQ(d.fixed[0].second, (Vec2{1.5, 0.1}));
  EXPECT_EQ(d.fixed[1], (std::pair<Vec2, Vec2>{{1, 0.5}, {1, 0.5}}));
  EXPECT_EQ(d.skipped.at("measured points"), 1);
}

TEST(Geo, BadOnesGiveOneFault) {
  const auto without = [](std::string text, const std::string& part, const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
  };
  expect_fault(parse_geo("", "a.geo"), 1, "ends before");
  expect_fault(parse_geo("nonsense\n", "a.geo"), 1, "\"nonsense\"");
  expect_fault(parse_geo(without(two_squares, "7 6", "7000000 6"), "a.geo"), 2,
               "more than the file");
  expect_fault(parse_geo(without(two_squares, "7 6", "7 9000000000"), "a.geo"), 2,
               "more than the file");
  expect_fault(parse_geo(without(two_squares, "7 6", "-7 6"), "a.geo"), 2, "\"-7\"");
  expect_fault(parse_geo(without(two_squares, "7 6", "7.5 6"), "a.geo"), 2, "\"7.5\"");
  expect_fault(parse_geo(without(two_squares, "7 6", "6 6"), "a.geo"), 18, "after its last number");
  expect_fault(parse_geo(without(two_squares, "1 1\n2 1\n", "1 1\n2\n"), "a.geo"), 20,
               "ends before");
  expect_fault(parse_geo(without(two_squares, "\n1\n0\n2", "\n1\n3\n2"), "a.geo"), 9, "bolts");
  expect_fault(parse_geo(without(two_squares, "0 1.5 0 0", "0 1.5 x 0"), "a.geo"), 12, "\"x\"");
  expect_fault(parse_geo(without(tags, "2 0 2 2", "2 0 2"), "a.geo"), 8, "ends before");
  expect_fault(parse_geo(without(tags, " 1 0.5 ", " 1 0.5 7 "), "a.geo"), 14, "\"7\" after");
  expect_fault(parse_geo("<Joint 0 0 1 1", "a.geo"), 1, "does not end");
}

}  // namespace
}  // namespace edda::drawings_test
