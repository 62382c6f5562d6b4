// Names that nothing or several things have, and keys that exclude each other, with exactly the
// faults that they must give.
#include <gtest/gtest.h>

#include <string>

#include "model/bad_model.hpp"

namespace edda::bad_combinations_test {
namespace {

using testing::base_with;
using testing::broken;
using testing::expect_all;
using testing::expect_faults;

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
      broken("opening names", "[[fixed]]",
             "[[opening]]\nname = \"hole\"\npolygon = [[17, 7], [18, 7], [17, 8]]\n[[fixed]]", 27,
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
      broken("which edges name no joint", "[joints.rough]", smooth, 1, "contact.joint",
             "no joint is named for the edges of block.floor (line "),
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
             "solver.damping.local", "is not available with mass = \"consistent\""),
      broken("steps", "duration = 0.1", "duration = 0.1\ntime_step = 1e-14", 40, "solver.time_step",
             "would take 1.0e+13 steps"),
      broken("frames", "every = 0.01", "every = 1e-7", 41, "output.every", "more than 1e+05"),
      broken("rows of a record", "every = 0.01", "history_every = 'record'", 41,
             "output.history_every", "no [[shaking]] has one"),
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
                  {24, "fixed", "add a [domain]"}}});
}

}  // namespace
}  // namespace edda::bad_combinations_test
