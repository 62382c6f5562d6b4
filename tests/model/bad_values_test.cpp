// Values of a wrong type, dimension or range, and bad polygons, with exactly the faults that they
// must give.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/bad_model.hpp"

namespace edda::bad_values_test {
namespace {

using testing::base_with;
using testing::broken;
using testing::expect_all;
using testing::expect_faults;

/// Numbers, words and flags of another type.
std::vector<testing::BadModel> single_values_of_other_types() {
  return {
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
  };
}

/// Points, lists and tables of another type.
std::vector<testing::BadModel> lists_of_other_types() {
  return {
      broken("number for points", "points = [[11, 1], [12, 5]]", "points = 3", 22, "trace.0.points",
             "expects a list of points"),
      {"numbers for points",
       base_with("[[11, 1], [12, 5]]", "[11, 1]"),
       {{22, "trace.0.points[0]", "is 11"}, {22, "trace.0.points[1]", "is 1"}}},
      broken("point of three", "[4, 1], [0, 1]", "[4, 1, 0], [0, 1]", 11, "block.floor.polygon[2]",
             "has 3 numbers"),
      broken("point of one", "point = [15, 1]", "point = [15]", 27, "fixed.0.point",
             "has 1 numbers"),
      broken("string in a point", "point = [15, 1]", "point = [15, \"up\"]", 27, "fixed.0.point[1]",
             "\"up\" is not a length"),
      broken("number for sides", "[\"bottom\"]", "3", 34, "boundary.base.sides",
             "expects a list of \"left\""),
      broken("number for inner table", "duration = 0.1", "duration = 0.1\ndamping = 0.5", 40,
             "solver.damping", "expects a table"),
      broken("number in sides", "[\"bottom\"]", "[3]", 34, "boundary.base.sides[0]", "is 3"),
      broken("list for a table", "[output]\nevery = 0.01", "[[output]]\nevery = 0.01", 40, "output",
             "is a list: write [output]"),
      broken("table for a list", "[[fixed]]", "[fixed]", 26, "fixed", "write [[fixed]]"),
      broken("number for a material", "[joints.rough]", "[materials]\nsoil = 3\n[joints.rough]", 8,
             "materials.soil", "write [materials.soil]"),
      broken("material without a name", "[materials.rock]",
             "[materials]\nyoung = 3\n[materials.rock]", 4, "materials.young",
             "write [materials.NAME]"),
  };
}

TEST(BadModel, Types) {
  expect_all(single_values_of_other_types());
  expect_all(lists_of_other_types());
  expect_faults({"list of numbers for tables",
                 "fixed = [3]\n" + base_with("[[fixed]]\npoint = [15, 1]\n", ""),
                 {{1, "fixed.0", "write [[fixed]]"}}});
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
             "[[14, 4], [16, 6], [16, 4], [14, 6]]", 25, "opening.hole.polygon",
             "crosses or touches itself"),
      broken("no area, there and back", square, "[[1, 1], [2, 1], [2, 2], [2, 1]]", 14,
             "block.1.polygon", "crosses or touches itself"),
      broken("trace of one point", "[[11, 1], [12, 5]]", "[[11, 1]]", 22, "trace.0.points",
             "at least two points"),
      broken("trace of no length", "[[11, 1], [12, 5]]", "[[11, 1], [11, 1]]", 22,
             "trace.0.points[1]", "same point"),
      broken("boundary of one point", "sides = [\"bottom\"]", "along = [[11, 1]]", 34,
             "boundary.base.along", "at least two points"),
  });
}

}  // namespace
}  // namespace edda::bad_values_test
