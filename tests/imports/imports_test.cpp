// [[import]] as lines of a model: units, shifts, layers, laws, fixed lines, blocks without a
// domain.
#include "imports/imports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"
#include "imports/dxf_text.hpp"
#include "scratch_folder.hpp"

namespace edda::imports_test {
namespace {

using namespace test;

/// A file that is gone with the test.
class File {
 public:
  File(const std::string& name, const std::string& text) : path_(folder_.at(name)) {
    std::FILE* file = std::fopen(path_.c_str(), "wb");
    std::fwrite(text.data(), 1, text.size(), file);
    std::fclose(file);
  }
  const std::string& path() const { return path_; }

 private:
  ScratchFolder folder_;
  std::string path_;
};

Import import_of(const File& file) {
  Import import;
  import.file = file.path();
  import.where = {"import.0", "test.toml", 4, 1};
  return import;
}

Model with_joints(Model model) {
  for (const char* name : {"rough", "bedding", "smooth"}) {
    JointLaw law;
    law.name = name;
    model.joints.push_back(law);
  }
  return model;
}

std::string fault_of(const Model& model) {
  const auto result = build_polygons(model);
  EXPECT_FALSE(result.ok());
  EXPECT_TRUE(result.ok() || result.faults().size() == 1U);
  return reason(result);
}

TEST(Imports, TracesCutTheDomainWithTheirLaws) {
  const File file("t.csv", "-1,5,11,5\n5,-1,5,11,bedding\n-1,2,11,2,smooth\n");
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(file));
  model.imports[0].joint = 0;
  const auto result = build_polygons(model);
  expect_sound(result, 1e-8);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().blocks.size(), 6U);
  auto length = length_by_law(result.value().blocks);
  EXPECT_NEAR(length[0], 20.0, 1e-9);
  EXPECT_NEAR(length[1], 20.0, 1e-9);
  EXPECT_NEAR(length[2], 20.0, 1e-9);
  ASSERT_EQ(result.value().report.notes.size(), 1U);
  EXPECT_NE(result.value().report.notes[0].find("t.csv: 3 lines (1 bedding, 1 smooth)"),
            std::string::npos)
      << result.value().report.notes[0];
}

/// Laws that stages add do not take the layers of those that the model gives.
TEST(Imports, LayersAreLawsOfTheModel) {
  const File file("t.csv", "-1,5,11,5,smooth\n");
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.joints.push_back(model.joints[2]);
  model.joints.back().change = {0, 2, 0, 0.0};
  model.imports.push_back(import_of(file));
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(length_by_law(result.value().blocks)[2], 20.0, 1e-9);
}

TEST(Imports, UnitsScaleAndShiftPlaceTheLines) {
  const File file("t.csv", "0,0,1000,0\n");
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(file));
  model.imports[0].units = LengthUnit::mm;
  model.imports[0].scale = 20.0;
  model.imports[0].shift = {-5.0, 4.0};
  const Result<Imports> imports = read_imports(model);
  ASSERT_TRUE(imports.ok());
  const auto& points = imports.value().lines[0].points;
  EXPECT_EQ(points[0], (Vec2{-5, 4}));
  EXPECT_NEAR(points[1].x, 15.0, 1e-12);
  for (const auto& [unit, metres] : {std::pair{LengthUnit::m, 1.0},
                                     {LengthUnit::cm, 0.01},
                                     {LengthUnit::km, 1e3},
                                     {LengthUnit::ft, 0.3048},
                                     {LengthUnit::in, 0.0254}}) {
    model.imports[0].units = unit;
    EXPECT_NEAR(read_imports(model).value().lines[0].points[1].x, -5.0 + 2e4 * metres, 1e-9);
  }
}

std::string drawing() {
  const auto line = [](const char* layer, const char* rest) {
    return std::string("0\nLINE\n8\n") + layer + "\n" + rest;
  };
  return "0\nSECTION\n2\nENTITIES\n" + line("bedding", "10\n-1\n20\n5\n11\n11\n21\n5\n") +
         line("J1", "10\n5\n20\n-1\n11\n5\n21\n11\n") +
         line("frame", "10\n2\n20\n-1\n11\n2\n21\n11\n") +
         "0\nTEXT\n8\nframe\n1\nhello\n0\nENDSEC\n0\nEOF\n";
}

TEST(Imports, LayersAreJointsOfTheirNameUnlessTheyAreNamed) {
  const File file("d.dxf", drawing());
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(file));
  auto all = build_polygons(model);
  ASSERT_TRUE(all.ok()) << reason(all);
  EXPECT_EQ(all.value().blocks.size(), 6U);
  EXPECT_NEAR(length_by_law(all.value().blocks)[1], 20.0, 1e-9);
  EXPECT_NE(all.value().report.notes[0].find("left out: 1 TEXT"), std::string::npos);
  model.imports[0].layers = {{"J1", 2}, {"bedding", 0}};
  auto named = build_polygons(model);
  ASSERT_TRUE(named.ok()) << reason(named);
  EXPECT_EQ(named.value().blocks.size(), 4U);
  EXPECT_NEAR(length_by_law(named.value().blocks)[2], 20.0, 1e-9);
  EXPECT_NEAR(length_by_law(named.value().blocks)[0], 20.0, 1e-9);
  EXPECT_NE(named.value().report.notes[0].find("on layer \"frame\""), std::string::npos);
}

/// Half discs of 24 pieces, as one block of the drawing on two layers, twice as high the second
/// time.
TEST(Imports, InsertedBlocksCutTheDomain) {
  const std::string half =
      entity("ARC", {{10, "0"}, {20, "0"}, {40, "2"}, {50, "0"}, {51, "180"}}) +
      entity("LINE", {{10, "-2"}, {20, "0"}, {11, "2"}, {21, "0"}});
  const File file("b.dxf",
                  dxf(entity("INSERT", {{8, "bedding"}, {2, "half"}, {10, "3"}, {20, "1"}}) +
                          entity("INSERT", {{8, "smooth"},
                                            {2, "half"},
                                            {10, "7"},
                                            {20, "9"},
                                            {42, "-2"},
                                            {70, "1"},
                                            {71, "1"}}),
                      blocks(block("half", "0", "0", half + entity("TEXT", {})))));
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(file));
  const auto result = build_polygons(model);
  expect_sound(result, 1e-8);
  ASSERT_TRUE(result.ok()) << reason(result);
  ASSERT_EQ(result.value().blocks.size(), 3U);
  std::vector<double> areas;
  for (const BlockPolygon& b : result.value().blocks)
    areas.push_back(std::abs(signed_area(b.rings[0])));
  std::sort(areas.begin(), areas.end());
  const double area = 48.0 * std::sin(std::acos(-1.0) / 24.0);
  EXPECT_NEAR(areas[0], area, 1e-7);
  EXPECT_NEAR(areas[1], 2.0 * area, 1e-7);
  EXPECT_NEAR(length_by_law(result.value().blocks)[1],
              2.0 * (4.0 + 24.0 * 4.0 * std::sin(std::acos(-1.0) / 48.0)), 1e-6);
  EXPECT_NE(result.value().report.notes[0].find("left out: 2 TEXT"), std::string::npos);
}

TEST(Imports, FaultsSayWhere) {
  const File drawing_file("d.dxf", drawing()), table("t.csv", "0,0,1,1\n0,0,9,9,beding\n"),
      broken("b.csv", "0,0,1\n"), empty("e.csv", "# nothing\n"), far("f.csv", "0,0,1e11,1\n");
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(drawing_file));
  model.imports[0].layers = {{"J2", 0}};
  EXPECT_NE(fault_of(model).find("import.0.layers.J2: no line of the file is on this layer"),
            std::string::npos);
  model.imports = {import_of(table)};
  EXPECT_NE(
      fault_of(model).find("t.csv:2:1: no joint is called \"beding\": did you mean \"bedding\"?"),
      std::string::npos)
      << fault_of(model);
  model.imports = {import_of(broken)};
  EXPECT_NE(fault_of(model).find("b.csv:1:1: has 3 fields"), std::string::npos);
  model.imports = {import_of(empty)};
  EXPECT_NE(fault_of(model).find("import.0.file: "), std::string::npos);
  model.imports = {import_of(far)};
  model.imports[0].scale = 1e6;
  EXPECT_NE(fault_of(model).find("beyond 1e12 m"), std::string::npos);
  model.imports = {import_of(empty)};
  model.imports[0].file += "-not";
  EXPECT_NE(fault_of(model).find("no such file"), std::string::npos);
}

Model geo_model(const File& file) {
  Model model;
  model.imports.push_back(import_of(file));
  model.imports[0].material = 0;
  return with_joints(model);
}

std::string geo(const std::string& fixed, int count) {
  return "0.01\n5 4\n0\n0\n" + std::to_string(count) +
         "\n0\n0\n0\n0 0 4 0 1\n4 0 4 2 1\n4 2 0 2 1\n0 2 0 0 1\n2 0 2 2 1\n" + fixed;
}

/// Two squares side by side, and what a fixed line holds of them.
TEST(Imports, FixedLinesHoldTheBlocksTheyRunInto) {
  const auto held = [](const std::string& fixed) {
    const File file("g.geo", geo(fixed, 1));
    const auto result = build_polygons(geo_model(file));
    EXPECT_TRUE(result.ok()) << reason(result);
    if (!result.ok()) return std::string();
    EXPECT_EQ(result.value().blocks.size(), 2U);
    std::string which;
    for (const BlockPolygon& block : result.value().blocks) which += block.fixed ? '1' : '0';
    return which;
  };
  EXPECT_EQ(held("-1 1 5 1"), "11");     // across both
  EXPECT_EQ(held("0.2 1 1.8 1"), "10");  // within one
  EXPECT_EQ(held("0.2 1 3.8 1"), "11");  // from one into the other
  EXPECT_EQ(held("-1 1 1 1"), "10");     // from outside
  EXPECT_EQ(held("1 -1 1 5"), "10");     // upright
  EXPECT_EQ(held("3 1 3 1"), "01");      // a point
  EXPECT_EQ(held("4 0 4 0"), "01");      // a corner of one alone
  EXPECT_EQ(held("0.5 0 1.5 0"), "10");  // along an edge of one alone
  EXPECT_EQ(held("2 1 5 1"), "01");      // from the edge they share
  const File shared("g.geo", geo("2 0.5 2 1.5", 1)), beside("h.geo", geo("7 0 8 0", 1));
  EXPECT_NE(fault_of(geo_model(shared)).find("an edge shared by blocks 0 and 1"),
            std::string::npos);
  EXPECT_NE(fault_of(geo_model(beside)).find("fixed line 0 meets no block"), std::string::npos);
}

TEST(Imports, WithoutADomainTheLinesBoundTheBlocks) {
  // A hill with a flat top over a level base: no rock between it and the box round it.
  const File file("g.geo",
                  "0.01\n6 5\n0\n0\n0\n0\n0\n0\n0 0 10 0 1\n10 0 10 2 1\n10 2 6 5 1\n6 5 4 5 1\n"
                  "4 5 0 0 1\n-0.01 2 10.01 2 2\n");
  const auto result = build_polygons(geo_model(file));
  expect_sound(result, 1e-8);
  ASSERT_TRUE(result.ok());
  const Ring hill = {{0, 0}, {10, 0}, {10, 2}, {6, 5}, {4, 5}};
  EXPECT_EQ(result.value().blocks.size(), 2U);
  EXPECT_NEAR(result.value().report.area_out, signed_area(hill), 1e-9);
}

TEST(Imports, LinesThatEncloseNothingAreAFault) {
  const File open("t.csv", "0,0,1,0\n1,0,1,1\n"), flat("u.csv", "0,0,1,0\n2,0,3,0\n");
  Model model = geo_model(open);
  EXPECT_NE(fault_of(model).find("the lines enclose nothing"), std::string::npos);
  model.imports[0].file = flat.path();
  EXPECT_NE(fault_of(model).find("the lines enclose nothing"), std::string::npos);
}

std::string only_warning(const Model& model) {
  const auto result = build_polygons(model);
  EXPECT_TRUE(result.ok());
  if (!result.ok()) return reason(result);
  const auto& warnings = result.value().report.warnings;
  EXPECT_LE(warnings.size(), 1U);
  return warnings.empty() ? "" : warnings[0];
}

TEST(Imports, DrawingsFarLargerThanTheDomainAreDoubted) {
  const File file("t.csv", "-40000,-34000,40000,34000\n-40000,20000,40000,34000\n");
  Model model = with_joints(domain_model(box(0, 0, 50, 50), 1e-8));
  model.imports.push_back(import_of(file));
  EXPECT_EQ(only_warning(model),
            "import.0: the drawing spans 80000 x 68000 m, the domain 50 x 50 m: units = \"mm\"?");
  model.imports[0].units = LengthUnit::mm;
  model.imports[0].size_given = true;
  EXPECT_EQ(only_warning(model), "");
  model.imports[0].shift = {500, 0};
  EXPECT_EQ(only_warning(model).substr(0, 23), "import.0 cuts nothing: ");
}

TEST(Imports, UnitsThatADrawingSaysAreComparedAndNotTaken) {
  const auto drawing = [](const char* unit) {
    return std::string("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n") + unit +
           "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n-1\n20\n5\n11\n11\n21\n5\n"
           "0\nENDSEC\n0\nEOF\n";
  };
  const File file("t.dxf", drawing("4")), silent("u.dxf", drawing("0"));
  Model model = with_joints(domain_model(box(0, 0, 10, 10), 1e-8));
  model.imports.push_back(import_of(file));
  EXPECT_EQ(only_warning(model).substr(0, 72),
            "import.0.units: t.dxf gives its unit as mm ($INSUNITS), but it is read a");
  EXPECT_EQ(build_polygons(model).value().blocks.size(), 2U);
  model.imports[0].size_given = true;
  EXPECT_EQ(only_warning(model), "");
  model.imports[0] = import_of(silent);
  EXPECT_EQ(only_warning(model), "");
}

/// Two piers and a lintel, each a closed polyline, and a line that is not closed.
std::string portal() {
  const auto box = [](const char* layer, double x0, double y0, double x1, double y1) {
    DxfPairs pairs{{8, layer}, {90, "4"}, {70, "1"}};
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}) {
      pairs.emplace_back(10, std::to_string(x));
      pairs.emplace_back(20, std::to_string(y));
    }
    return entity("LWPOLYLINE", pairs);
  };
  return dxf(box("GROUND", -1, -1, 4, 0) + box("PIER", 0, 0, 1, 2) + box("PIER", 2, 0, 3, 2) +
             box("LINTEL", 0, 2, 3, 3) +
             entity("LINE", {{8, "NOTE"}, {10, "0"}, {20, "5"}, {11, "1"}, {21, "5"}}));
}

Model drawn_as(const File& file, ImportAs as) {
  Model model = with_joints({});
  model.materials.resize(2);
  model.contact.joint = 0;
  Import import = import_of(file);
  import.as = as;
  import.material = 0;
  if (as == ImportAs::blocks) {
    import.materials = {{ "LINTEL", 1 }};
    import.fixed = {"GROUND"};
    import.joint = 2;
  }
  model.imports = {import};
  return model;
}

TEST(Imports, ClosedPolylinesAreBlocks) {
  const File file("portal.dxf", portal());
  const auto made = build_polygons(drawn_as(file, ImportAs::blocks));
  ASSERT_TRUE(made.ok()) << reason(made);
  const PolygonSet& set = made.value();
  ASSERT_EQ(set.blocks.size(), 4U);
  EXPECT_TRUE(set.blocks[0].fixed);
  EXPECT_FALSE(set.blocks[1].fixed);
  EXPECT_EQ(set.blocks[1].material, 0);
  EXPECT_EQ(set.blocks[3].material, 1);
  EXPECT_EQ(set.blocks[3].joint, (std::vector<std::vector<Index>>{{2, 2, 2, 2}}));
  double area = 0.0;
  for (const BlockPolygon& block : set.blocks) area += signed_area(block.rings[0]);
  EXPECT_NEAR(area, 5.0 + 2.0 + 2.0 + 3.0, 1e-12);
  ASSERT_EQ(set.report.notes.size(), 1U);
  EXPECT_NE(set.report.notes[0].find("1 not closed"), std::string::npos) << set.report.notes[0];
}

TEST(Imports, LinesWarnOfRockBetweenClosedOnes) {
  const File file("portal.dxf", portal());
  const auto made = build_polygons(drawn_as(file, ImportAs::lines));
  ASSERT_TRUE(made.ok()) << reason(made);
  EXPECT_EQ(made.value().blocks.size(), 5U);  // with the doorway
  const auto& warnings = made.value().report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
    return w.find("1 area that no closed line") != std::string::npos &&
           w.find("(1.5, 1)") != std::string::npos;
  }));
}

TEST(Imports, FixedPointsActOnDrawnBlocks) {
  const File file("portal.dxf", portal());
  Model model = drawn_as(file, ImportAs::blocks);
  model.imports[0].fixed = {};
  model.fixed.push_back({{0.5, 1.0}, {}});
  const auto made = build_polygons(model);
  ASSERT_TRUE(made.ok()) << reason(made);
  EXPECT_TRUE(made.value().blocks[1].fixed);
  EXPECT_FALSE(made.value().blocks[0].fixed);
}

TEST(Imports, LayersOfBlocksMustExist) {
  const File file("portal.dxf", portal());
  Model model = drawn_as(file, ImportAs::blocks);
  model.imports[0].fixed = {"BASE"};
  EXPECT_NE(fault_of(model).find("\"BASE\""), std::string::npos);
  model.imports[0].fixed = {};
  model.imports[0].materials = {{"BASE", 0}};
  EXPECT_NE(fault_of(model).find("layer"), std::string::npos);
}

TEST(Imports, DrawingsWithoutClosedPolylinesHaveNoBlocks) {
  const File file("lines.dxf",
                  dxf(entity("LINE", {{8, "A"}, {10, "0"}, {20, "5"}, {11, "1"}, {21, "5"}})));
  Model model = drawn_as(file, ImportAs::blocks);
  model.imports[0].fixed = {};
  model.imports[0].materials = {};
  EXPECT_NE(fault_of(model).find("closed polyline"), std::string::npos);
}

/// A fault across a square and two joints that end on it, all to 1 mm: the ends miss it by as much.
TEST(Imports, LinesOfADrawingInMillimetresMeetWithoutADomain) {
  const auto line = [](const char* x1, const char* y1, const char* x2, const char* y2) {
    return entity("LINE", {{8, "0"}, {10, x1}, {20, y1}, {11, x2}, {21, y2}});
  };
  DxfPairs square{{8, "0"}, {90, "4"}, {70, "1"}};
  for (const auto& [x, y] : {std::pair{"0", "0"}, {"10", "0"}, {"10", "10"}, {"0", "10"}}) {
    square.emplace_back(10, x);
    square.emplace_back(20, y);
  }
  const File file("d.dxf",
                  dxf(entity("LWPOLYLINE", square) + line("0", "3.333", "10", "6.667") +
                      line("2.5", "4.167", "2.5", "10") + line("5.1", "5.033", "5.1", "10")));
  const auto made = build_polygons(geo_model(file));
  ASSERT_TRUE(made.ok()) << reason(made);
  EXPECT_EQ(made.value().blocks.size(), 4U);
  EXPECT_NEAR(made.value().report.area_out, 100.0, 1e-6);
}

}  // namespace
}  // namespace edda::imports_test
