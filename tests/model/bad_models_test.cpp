// Models that are bad as a text, in their keys and in what is missing, with exactly the faults that
// they must give: line, key and part of the message.
#include <gtest/gtest.h>

#include <string>

#include "model/bad_model.hpp"

namespace edda::bad_models_test {
namespace {

using testing::as_lines;
using testing::base_model;
using testing::base_with;
using testing::broken;
using testing::expect_all;
using testing::expect_faults;

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

TEST(BadModel, Missing) {
  expect_all({
      broken("rayleigh", "poisson = 0.25", "poisson = 0.25\nrayleigh = { fraction = 0.02 }", 7,
             "materials.rock.rayleigh.frequency", "is missing"),
      broken("rayleigh frequency", "poisson = 0.25",
             "poisson = 0.25\nrayleigh = { fraction = 0.02, frequency = 0 }", 7,
             "materials.rock.rayleigh.frequency", "is out of range"),
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
