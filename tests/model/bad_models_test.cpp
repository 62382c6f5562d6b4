// Every kind of bad model, with exactly the faults it must give: line, key and part of the message.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::bad_models_test {
namespace {

using testing::base_model;
using testing::base_with;

struct Expected {
  int line;
  std::string key;
  std::string fragment;
};

struct Bad {
  std::string name;
  std::string text;
  std::vector<Expected> faults;
};

std::string as_lines(const Faults& faults) {
  std::string lines;
  for (const Fault& fault : faults) lines += to_string(fault) + '\n';
  return lines;
}

void expect_faults(const Bad& bad) {
  SCOPED_TRACE(bad.name);
  const Result<Model> result = read_model_text(bad.text, "m.toml");
  ASSERT_FALSE(result.ok()) << "no fault was found";
  const Faults& faults = result.faults();
  ASSERT_EQ(faults.size(), bad.faults.size()) << as_lines(faults);
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(faults[i].where.line, bad.faults[i].line) << to_string(faults[i]);
    EXPECT_EQ(faults[i].where.key, bad.faults[i].key) << to_string(faults[i]);
    EXPECT_EQ(faults[i].where.file, "m.toml");
    EXPECT_NE(to_string(faults[i]).find(bad.faults[i].fragment), std::string::npos)
        << to_string(faults[i]) << "\n lacks: " << bad.faults[i].fragment;
    EXPECT_FALSE(faults[i].problem.empty());
    EXPECT_FALSE(faults[i].remedy.empty());
    EXPECT_EQ(to_string(faults[i]).find('\n'), std::string::npos);
  }
}

/// base_model with one replacement and the one fault that it must give.
Bad broken(const std::string& name, const std::string& from, const std::string& to, int line,
           const std::string& key, const std::string& fragment) {
  return {name, base_with(from, to), {{line, key, fragment}}};
}

void expect_all(const std::vector<Bad>& models) {
  for (const Bad& bad : models) expect_faults(bad);
}

TEST(BadModel, BaseIsGood) {
  const Result<Model> result = read_model_text(base_model, "m.toml");
  ASSERT_TRUE(result.ok()) << as_lines(result.faults());
}

TEST(BadModel, Text) {
  const std::string nested = "x = " + std::string(100000, '[');
  std::string dotted = "y";
  for (int i = 0; i < 200000; ++i) dotted += ".y";
  expect_all({
      {"empty", "", {{0, "", "is empty"}}},
      {"blank", "\n \n", {{0, "", "is empty"}}},
      {"comments only", "# nothing\n", {{0, "", "is empty"}}},
      {"binary",
       std::string("\x7f"
                   "ELF\x02\x01\x01\0\0\xb8\xff",
                   11),
       {{1, "", "UTF-8"}}},
      {"latin-1", "title = \"a\"\ntitle2 = \"h\xf6hle\"\n", {{2, "", "is not UTF-8"}}},
      {"control characters", std::string("a\0b", 3), {{1, "", "not valid TOML"}}},
      {"unclosed list", base_with("[0.0, -9.81]", "[0.0, -9.81"), {{3, "", "not valid TOML"}}},
      {"unclosed string", base_with("\"base\"", "\"base"), {{1, "", "not valid TOML"}}},
      {"half a word", base_with("true", "tr"), {{12, "", "not valid TOML"}}},
      {"no value", base_with("20e9", ""), {{5, "", "not valid TOML"}}},
      {"key twice", base_with("young = 20e9", "density = 1.0"), {{5, "", "not valid TOML"}}},
      {"table twice", base_model + "[solver]\n", {{42, "", "not valid TOML"}}},
      {"syntax stands alone",
       base_with("density = 2700.0", "density = -1.0") + "x = \n",
       {{42, "", "not valid TOML"}}},
      {"deeply nested lists", nested, {{1, "", "not valid TOML"}}},
      {"deeply dotted key", "a = 1\n" + dotted + " = 1\n", {{2, "", "32 parts"}}},
      {"deeply dotted header", "[" + dotted + "]\n", {{1, "", "32 parts"}}},
      {"line break in a key", "\"a\\nb\" = 1\n" + base_model, {{1, "a?b", "unknown key"}}},
      {"line break in a value",
       base_with("young = 20e9", "young = \"2\\n0\""),
       {{5, "materials.rock.young", "\"2?0\""}}},
  });
}

TEST(BadModel, UnknownKeys) {
  expect_all({
      broken("root", "title =", "titel =", 1, "titel", "did you mean \"title\"?"),
      broken("section", "[solver]", "[slover]\nx = 1\n[solver]", 38, "slover",
             "did you mean \"solver\"?"),
      broken("material", "poisson = 0.25", "poisson = 0.25\nyoungs = 1", 7, "materials.rock.youngs",
             "did you mean \"young\"?"),
      broken("list element by name", "fixed = true", "fixd = true", 12, "block.floor.fixd",
             "did you mean \"fixed\"?"),
      broken("list element by number", "points =", "points = [[1, 1], [2, 2]]\npoint =", 23,
             "trace.0.point", "did you mean \"points\"?"),
      broken("inner table", "friction_angle = 30.0",
             "friction_angle = 30.0\nresidual = { friction = 20.0 }", 9,
             "joints.rough.residual.friction", "did you mean \"friction_angle\"?"),
      broken("key of another table", "title = \"base\"", "columns = 2", 1, "columns",
             "columns belongs to [[brick_wall]]"),
      broken("key of the top below a table", "[solver]\n", "[solver]\ngravity = [0, -5]\n", 39,
             "solver.gravity", "gravity belongs at the top of the file, before the first [table]"),
      broken("key of one other table", "[solver]\n", "[solver]\nhistory_every = 1\n", 39,
             "solver.history_every", "history_every belongs to [output]"),
      broken("key of a few other tables", "[output]\n", "[output]\nscale = 1\n", 41, "output.scale",
             "scale belongs to [[import]] or [[shaking]]"),
      broken("nothing near", "title = \"base\"", "qwertyuiop = 1", 1, "qwertyuiop",
             "unknown key: known are \""),
      broken("a key that is not due yet", "spacing = 2.0", "spacing = 2.0\nstrength = 3.0", 21,
             "joint_set.bedding.strength", "unknown key"),
  });
}

TEST(BadModel, Types) {
  expect_all({
      broken("string for number", "young = 20e9", "young = \"stiff\"", 5, "materials.rock.young",
             "\"stiff\" is not a stress"),
      broken("flag for number", "young = 20e9", "young = true", 5, "materials.rock.young",
             "is true: expects a stress"),
      broken("list for number", "young = 20e9", "young = [1]", 5, "materials.rock.young",
             "is a list"),
      broken("table for number", "young = 20e9", "young = {}", 5, "materials.rock.young",
             "is a table"),
      broken("date for number", "young = 20e9", "young = 2020-01-01", 5, "materials.rock.young",
             "is a date"),
      broken("number for string", "\"base\"", "5", 1, "title", "is 5: expects a string"),
      broken("number for flag", "fixed = true", "fixed = 1", 12, "block.floor.fixed",
             "expects true or false"),
      broken("number for name", "name = \"hole\"", "name = 3", 24, "opening.0.name",
             "expects a name"),
      broken("empty name", "\"floor\"", "\"\"", 10, "block.0.name", "is empty"),
      broken("number for choice", "duration = 0.1", "duration = 0.1\nmass = 1", 40, "solver.mass",
             "\"matched\""),
      broken("unknown choice", "duration = 0.1", "duration = 0.1\nmass = \"mached\"", 40,
             "solver.mass", "did you mean \"matched\"?"),
      broken("number for joint", "fixed = true", "joint = 3", 12, "block.floor.joint",
             "expects a name"),
      broken("fraction for whole number", "columns = 4", "columns = 4.5", 29,
             "brick_wall.0.columns", "expects a whole number"),
      broken("string for whole number", "rows = 3", "rows = \"3\"", 30, "brick_wall.0.rows",
             "expects a whole number"),
      broken("number for points", "points = [[11, 1], [12, 5]]", "points = 3", 22, "trace.0.points",
             "expects a list of points"),
      {"numbers for points",
       base_with("[[11, 1], [12, 5]]", "[11, 1]"),
       {{22, "trace.0.points[0]", "is 11"}, {22, "trace.0.points[1]", "is 1"}}},
      broken("point of three", "[4, 1], [0, 1]", "[4, 1, 0], [0, 1]", 11, "block.floor.polygon[2]",
             "has 3 numbers"),
      broken("point of one", "point = [15, 1]", "point = [15]", 27, "held.0.point",
             "has 1 numbers"),
      broken("string in a point", "point = [15, 1]", "point = [15, \"up\"]", 27, "held.0.point[1]",
             "\"up\" is not a length"),
      broken("number for sides", "[\"bottom\"]", "3", 34, "boundary.base.sides",
             "expects a list of \"left\""),
      broken("number for inner table", "duration = 0.1", "duration = 0.1\ndamping = 0.5", 40,
             "solver.damping", "expects a table"),
      broken("number in sides", "[\"bottom\"]", "[3]", 34, "boundary.base.sides[0]", "is 3"),
      broken("list for a table", "[output]\nevery = 0.01", "[[output]]\nevery = 0.01", 40, "output",
             "is a list: write [output]"),
      broken("table for a list", "[[held]]", "[held]", 26, "held", "write [[held]]"),
      broken("number for a material", "[joints.rough]", "[materials]\nsoil = 3\n[joints.rough]", 8,
             "materials.soil", "write [materials.soil]"),
      broken("material without a name", "[materials.rock]",
             "[materials]\nyoung = 3\n[materials.rock]", 4, "materials.young",
             "write [materials.NAME]"),
  });
  expect_faults({"list of numbers for tables",
                 "held = [3]\n" + base_with("[[held]]\npoint = [15, 1]\n", ""),
                 {{1, "held.0", "write [[held]]"}}});
  expect_faults({"nothing named",
                 "[materials]\ndensity = 1\n[joints]\nfriction_angle = 1\n[[block]]\n"
                 "polygon = [[0, 0], [1, 0], [0, 1]]\n[[block]]\n"
                 "polygon = [[2, 0], [3, 0], [2, 1]]\n[solver]\nduration = 1\n",
                 {{2, "materials.density", "write [materials.NAME]"},
                  {4, "joints.friction_angle", "write [joints.NAME]"}}});
}

TEST(BadModel, NumbersAndUnits) {
  expect_all({
      broken("nan", "spacing = 2.0", "spacing = nan", 20, "joint_set.bedding.spacing",
             "not a finite number"),
      broken("inf", "spacing = 2.0", "spacing = inf", 20, "joint_set.bedding.spacing",
             "not a finite number"),
      broken("minus inf in a polygon", "[4, 0]", "[4, -inf]", 11, "block.floor.polygon[1][1]",
             "not a finite number"),
      broken("huge number", "young = 20e9", "young = 1e200", 5, "materials.rock.young",
             "too large"),
      broken("tiny number", "spacing = 2.0", "spacing = 1e-300", 20, "joint_set.bedding.spacing",
             "too small"),
      broken("huge length", "[20, 10], [10", "[1e13, 10], [10", 16, "domain.outline[2][0]",
             "too large"),
      broken("huge number in a string", "20e9", "\"1e999 Pa\"", 5, "materials.rock.young",
             "out of range"),
      broken("wrong dimension", "spacing = 2.0", "spacing = \"20 GPa\"", 20,
             "joint_set.bedding.spacing",
             "\"20 GPa\" is not a length: expects a length above 0 such as 2.5 or \"2.5 m\""),
      broken("unknown unit", "20e9", "\"20 GPA\"", 5, "materials.rock.young", "unknown unit, GPA"),
      broken("no unit", "spacing = 2.0", "spacing = \"2.0\"", 20, "joint_set.bedding.spacing",
             "has no unit"),
      broken("unit alone", "spacing = 2.0", "spacing = \"m\"", 20, "joint_set.bedding.spacing",
             "is not a length"),
      broken("unit of a point", "[15, 9]", "[\"15 m\", \"9 s\"]", 37, "monitor.P1.point[1]",
             "\"9 s\" is not a length"),
      broken("word that is not auto", "duration = 0.1", "duration = 0.1\ntime_step = \"automatic\"",
             40, "solver.time_step", "expects \"auto\" or a time above 0"),
  });
}

TEST(BadModel, Ranges) {
  const std::string more = "duration = 0.1\n";
  expect_all({
      broken("negative density", "2700.0", "-2700.0", 4, "materials.rock.density",
             "expects a density above 0"),
      broken("zero young", "20e9", "0", 5, "materials.rock.young", "0 is out of range"),
      broken("poisson 0.5", "0.25", "0.5", 6, "materials.rock.poisson", "below 0.5"),
      broken("poisson -1", "0.25", "-1", 6, "materials.rock.poisson", "above -1"),
      broken("friction 90", "30.0", "90", 8, "joints.rough.friction_angle", "below 90"),
      broken("negative friction", "30.0", "\"-1 deg\"", 8, "joints.rough.friction_angle",
             "\"-1 deg\" is out of range"),
      broken("negative cohesion", "30.0", "30.0\ncohesion = -1", 9, "joints.rough.cohesion",
             "at least 0"),
      broken("negative tension", "30.0", "30.0\nresidual = { tensile_strength = -1 }", 9,
             "joints.rough.residual.tensile_strength", "at least 0"),
      broken("zero kn", "30.0", "30.0\nkn = 0", 9, "joints.rough.kn", "above 0"),
      broken("zero spacing", "spacing = 2.0", "spacing = 0", 20, "joint_set.bedding.spacing",
             "expects a length above 0"),
      broken("negative duration", "duration = 0.1", "duration = -1.0", 39, "solver.duration",
             "expects a time above 0"),
      broken("safety 0", more, more + "safety = 0\n", 40, "solver.safety", "above 0 and at most 1"),
      broken("safety 2", more, more + "safety = 2\n", 40, "solver.safety", "2 is out of range"),
      broken("negative step", more, more + "time_step = -1e-3\n", 40, "solver.time_step",
             "above 0"),
      broken("local damping 1", more, more + "damping.local = 1\n", 40, "solver.damping.local",
             "below 1"),
      broken("negative mass damping", more, more + "damping = { mass = -1 }\n", 40,
             "solver.damping.mass", "at least 0"),
      broken("negative mass scaling", more, more + "mass_scaling = -1\n", 40, "solver.mass_scaling",
             "at least 0"),
      broken("displacement ratio 0", more, more + "max_displacement_ratio = 0\n", 40,
             "solver.max_displacement_ratio", "above 0"),
      broken("thickness 0", "title = \"base\"", "thickness = 0", 1, "thickness", "above 0"),
      broken("brick of no height", "[1.0, 0.5]", "[1.0, 0.0]", 31, "brick_wall.0.brick[1]",
             "above 0"),
      broken("no columns", "columns = 4", "columns = 0", 29, "brick_wall.0.columns", "at least 1"),
      broken("max_blocks 0", "[domain]", "[domain]\nmax_blocks = 0", 16, "domain.max_blocks",
             "at least 1"),
      broken("zero interval", "every = 0.01", "every = 0", 41, "output.every", "above 0"),
  });
}

TEST(BadModel, Missing) {
  expect_all({
      broken("young", "young = 20e9\n", "", 3, "materials.rock.young", "is missing: give a stress"),
      broken("poisson", "poisson = 0.25\n", "", 3, "materials.rock.poisson", "is missing"),
      broken("density", "density = 2700.0\n", "", 3, "materials.rock.density", "or unit_weight"),
      broken("friction angle", "friction_angle = 30.0\n", "", 7, "joints.rough.friction_angle",
             "type = \"glued\""),
      broken("polygon", "polygon = [[1, 1], [2, 1], [2, 2], [1, 2]]\n", "", 13, "block.1.polygon",
             "is missing: give a list of points"),
      broken("outline", "outline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n", "", 15,
             "domain.outline", "is missing"),
      broken("spacing", "spacing = 2.0\n", "", 17, "joint_set.bedding.spacing", "is missing"),
      broken("angle", "angle = 45.0\n", "", 17, "joint_set.bedding.angle", "is missing"),
      broken("monitor name", "name = \"P1\"\n", "", 35, "monitor.0.name", "is missing"),
      broken("duration", "duration = 0.1\n", "", 38, "solver.duration", "is missing: give a time"),
      broken("solver", "[solver]\nduration = 0.1\n", "", 1, "solver.duration", "is missing"),
      broken("joint laws", "[joints.rough]\nfriction_angle = 30.0\n", "", 1, "joints",
             "add [joints.NAME]"),
  });
  const std::string rest = "[joints.a]\nfriction_angle = 1\n[solver]\nduration = 1\n";
  expect_faults({"blocks", rest, {{1, "block", "the model has no blocks"}}});
  expect_faults({"blocks in the list", "block = []\n" + rest, {{1, "block", "has no blocks"}}});
  expect_faults({"materials",
                 "[[block]]\npolygon = [[0, 0], [1, 0], [0, 1]]\n" + rest,
                 {{1, "block.0.material", "[materials.rock]"}}});
}

TEST(BadModel, Polygons) {
  const std::string square = "[[1, 1], [2, 1], [2, 2], [1, 2]]";
  expect_all({
      broken("no points", square, "[]", 14, "block.1.polygon", "has 0 points"),
      broken("two points", square, "[[1, 1], [2, 1]]", 14, "block.1.polygon",
             "at least three corners"),
      broken("self-crossing", square, "[[1, 1], [2, 2], [2, 1], [1, 3]]", 14, "block.1.polygon",
             "crosses or touches itself"),
      broken("on one line", square, "[[1, 1], [2, 2], [3, 3]]", 14, "block.1.polygon",
             "has no area"),
      broken("all but on one line", square, "[[0.1, 0.1], [0.2, 0.2], [0.3, 0.3000000000000001]]",
             14, "block.1.polygon", "has no area"),
      broken("zero-area outline", "[[10, 0], [20, 0], [20, 10], [10, 10]]",
             "[[10, 0], [20, 0], [15, 0]]", 16, "domain.outline", "has no area"),
      broken("point twice", square, "[[1, 1], [2, 1], [2, 1], [1, 2]]", 14, "block.1.polygon[2]",
             "same point as the one before"),
      broken("first point repeated", square, "[[1, 1], [2, 1], [2, 2], [1, 1]]", 14,
             "block.1.polygon[3]", "repeats the first point"),
      broken("lines of a long list", square, "[\n[1, 1],\n[2, 1],\n[2, true],\n[1, 2]]", 17,
             "block.1.polygon[2][1]", "is true"),
      broken("region", "spacing = 2.0", "spacing = 2.0\nregion = [[11, 1], [12, 2]]", 21,
             "joint_set.bedding.region", "has 2 points"),
      broken("opening", "[[14, 4], [16, 4], [16, 6], [14, 6]]",
             "[[14, 4], [16, 6], [16, 4], [14, 6]]", 25, "opening.hole.polygon", "has no area"),
      broken("trace of one point", "[[11, 1], [12, 5]]", "[[11, 1]]", 22, "trace.0.points",
             "at least two points"),
      broken("trace of no length", "[[11, 1], [12, 5]]", "[[11, 1], [11, 1]]", 22,
             "trace.0.points[1]", "same point"),
      broken("boundary of one point", "sides = [\"bottom\"]", "along = [[11, 1]]", 34,
             "boundary.base.along", "at least two points"),
  });
}

TEST(BadModel, NamesAndReferences) {
  const std::string soil =
      "[materials.soil]\nunit_weight = 1\nyoung = 1\npoisson = 0\n[joints.rough]";
  const std::string smooth = "[joints.smooth]\ntype = \"glued\"\n[joints.rough]";
  expect_all({
      broken("unknown material", "fixed = true", "material = \"rok\"", 12, "block.floor.material",
             "did you mean \"rock\"?"),
      broken("unknown joint", "spacing = 2.0", "spacing = 2.0\njoint = \"ruff\"", 21,
             "joint_set.bedding.joint",
             "no joint is called \"ruff\": the only known one is \"rough\""),
      broken("unknown joint, nothing near", "[domain]", "[domain]\njoint = \"clay seam\"", 16,
             "domain.joint", "\"rough\""),
      broken("block names", "[[block]]\npolygon", "[[block]]\nname = \"floor\"\npolygon", 14,
             "block.floor.name", "is the name of element 0 (line 9) too"),
      broken("joint set names", "[[trace]]",
             "[[joint_set]]\nname = \"bedding\"\nangle = 0\nspacing = 3\n[[trace]]", 22,
             "joint_set.bedding.name", "is the name of element 0"),
      broken("opening names", "[[held]]",
             "[[opening]]\nname = \"hole\"\npolygon = [[17, 7], [18, 7], [17, 8]]\n[[held]]", 27,
             "opening.hole.name", "is the name of element 0"),
      broken("boundary names", "[[monitor]]",
             "[[boundary]]\nname = \"base\"\nsides = [\"top\"]\n[[monitor]]", 36,
             "boundary.base.name", "is the name of element 0"),
      broken("monitor names", "[solver]", "[[monitor]]\nname = \"P1\"\npoint = [1, 1]\n[solver]",
             39, "monitor.P1.name", "is the name of element 0"),
      {"which material",
       base_with("[joints.rough]", soil),
       {{13, "block.floor.material", "name one of \"rock\", \"soil\""},
        {17, "block.1.material", "several are defined"},
        {19, "domain.material", "several are defined"},
        {32, "brick_wall.0.material", "several are defined"}}},
      broken("which joint", "[joints.rough]", smooth, 1, "contact.joint",
             "name one of \"smooth\", \"rough\""),
      broken("which joint, with a contact table", "[joints.rough]",
             "[contact]\nnormal_stiffness = 1\n" + smooth, 7, "contact.joint", "name one of"),
  });
  expect_faults({"unknown joint where none is defined",
                 "[materials.rock]\ndensity = 1\nyoung = 1\npoisson = 0\n[[block]]\n"
                 "polygon = [[0, 0], [1, 0], [0, 1]]\njoint = \"rough\"\n[solver]\nduration = 1\n",
                 {{7, "block.0.joint", "add [joints.rough]"}}});
}

TEST(BadModel, KeysTogether) {
  const std::string wall = "columns = 4\nrows = 3";
  expect_all({
      broken("density and unit weight", "density = 2700.0", "density = 2700.0\nunit_weight = 26e3",
             5, "materials.rock.unit_weight", "density is given too"),
      broken("unit weight wrong", "density = 2700.0", "unit_weight = \"26 kN\"", 4,
             "materials.rock.unit_weight", "is not a unit weight"),
      broken("fixed with velocity", "fixed = true", "fixed = true\nvelocity = [1, 0]", 13,
             "block.floor.velocity", "fixed block cannot have a velocity"),
      broken("fixed with rotation", "fixed = true", "fixed = true\nangular_velocity = 1", 13,
             "block.floor.angular_velocity", "fixed block"),
      broken("sides and along", "sides = [\"bottom\"]",
             "sides = [\"bottom\"]\nalong = [[0, 0], [1, 0]]", 35, "boundary.base.along",
             "give only one of them"),
      broken("neither sides nor along", "sides = [\"bottom\"]\n", "", 32, "boundary.base",
             "neither sides nor along"),
      broken("no sides", "[\"bottom\"]", "[]", 34, "boundary.base.sides", "expects a list of"),
      broken("unknown side", "[\"bottom\"]", "[\"botom\"]", 34, "boundary.base.sides[0]",
             "did you mean \"bottom\"?"),
      broken("side twice", "[\"bottom\"]", "[\"top\", \"top\"]", 34, "boundary.base.sides[1]",
             "twice"),
      broken("local damping with the implicit method", "duration = 0.1",
             "duration = 0.1\nmethod = \"dda\"\ndamping = { local = 0.5 }", 41,
             "solver.damping.local", "belongs to method = \"edda\""),
      broken("dropped velocities with the explicit method", "duration = 0.1",
             "duration = 0.1\ndynamic = false", 40, "solver.dynamic",
             "belongs to method = \"dda\""),
      broken("local damping with consistent mass", "duration = 0.1",
             "duration = 0.1\nmass = \"consistent\"\ndamping = { local = 0.5 }", 41,
             "solver.damping.local", "does not go with mass = \"consistent\""),
      broken("steps", "duration = 0.1", "duration = 0.1\ntime_step = 1e-14", 40, "solver.time_step",
             "would take 1.0e+13 steps"),
      broken("frames", "every = 0.01", "every = 1e-7", 41, "output.every", "more than 1e+05"),
      broken("rows", "every = 0.01", "history_every = 1e-9", 41, "output.history_every",
             "more than 1e+07"),
      broken("coarse snap", "[domain]", "[domain]\nsnap = 1", 16, "domain.snap", "too coarse"),
      broken("bricks", wall, "columns = 4000\nrows = 3000", 29, "brick_wall.0.columns",
             "1.20e+07 bricks, more than 5000000"),
      broken("a million blocks by mistake", "spacing = 2.0",
             "spacing = 0.1\n[[joint_set]]\nangle = -45\nspacing = \"1 mm\"", 23,
             "joint_set.1.spacing",
             "about 1014285 blocks would be cut, more than domain.max_blocks = 300000"),
      broken("spacing next to nothing", "spacing = 2.0",
             "spacing = 1e-140\n[[joint_set]]\nangle = 0\nspacing = 1e-140", 20,
             "joint_set.bedding.spacing", "e+281 blocks"),
  });
  expect_faults({"cutting nothing",
                 base_with("[domain]\noutline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n", ""),
                 {{15, "joint_set", "add a [domain]"},
                  {19, "trace", "add a [domain]"},
                  {21, "opening", "add a [domain]"},
                  {24, "held", "add a [domain]"}}});
}

TEST(BadModel, AllFaultsAtOnceInOrder) {
  const std::string text =
      "titel = \"x\"\n[solver]\nsafety = 7\n[materials.rock]\npoisson = 3\nyoung = \"5 m\"\n"
      "[[block]]\npolygon = [[0, 0]]\nmaterial = \"rok\"\nfixed = \"no\"\n";
  expect_faults({"many",
                 text,
                 {{1, "titel", "title"},
                  {2, "solver.duration", "missing"},
                  {3, "solver.safety", "range"},
                  {4, "materials.rock.density", "missing"},
                  {5, "materials.rock.poisson", "range"},
                  {6, "materials.rock.young", "not a stress"},
                  {8, "block.0.polygon", "1 point"},
                  {9, "block.0.material", "rok"},
                  {10, "block.0.fixed", "true or false"}}});
}

TEST(BadModel, ColumnsPointAtTheValue) {
  const auto result = read_model_text(base_with("[4, 1], [0, 1]", "[4, 1], [0, nan]"), "m.toml");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(to_string(result.faults()[0]).substr(0, 13), "m.toml:11:40:");
}

}  // namespace
}  // namespace edda::bad_models_test
