// Changes of joints that take time, and do not fit: one clear message each.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "model/bad_model.hpp"
#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::bad_changes_test {
namespace {

struct Bad {
  std::string text;  ///< after the base model
  int line;          ///< with its line 42
  std::string key, fragment;
};

const std::string clay =
    "[joints.clay]\nfriction_angle = 20\nresidual = { friction_angle = 10 }\ndecay_time = \"3 "
    "d\"\n";

TEST(BadModel, ChangesThatTakeTime) {
  const std::string worn = "[materials.worn]\ndensity = 2700\nyoung = 20e9\npoisson = 0.25\n",
                    weak = "[joints.weak]\nfriction_angle = 20\n",
                    stage = "[[stage]]\nduration = 0.1\n";
  for (const Bad& bad : {
           Bad{weak + stage +
                   "change = [{ joints = \"rough\", to = \"weak\", set = \"beding\" }]\n",
               46, "stage.0.change[0].set", "did you mean \"bedding\""},
           Bad{worn + stage +
                   "change = [{ material = \"rock\", to = \"worn\", set = \"bedding\" }]\n",
               48, "stage.0.change[0].set", "chooses among joints"},
           Bad{weak + stage + "change = [{ joints = \"rough\", to = \"weak\", over = 2 }]\n", 46,
               "stage.0.change[0].over", "longer than the 0.1 s"},
           Bad{weak + "[[stage]]\nuntil = \"equilibrium\"\n" +
                   "change = [{ joints = \"rough\", to = \"weak\", over = 2 }]\n",
               46, "stage.0.change[0].over", "belongs to a stage with a duration"},
           Bad{weak + "kn = 1e9\n" + stage +
                   "change = [{ joints = \"rough\", to = \"weak\", over = 0.1 }]\n",
               47, "stage.0.change[0].over", "differ in more than the numbers of strength"},
           Bad{worn + "[[stage]]\nramp = { change = [0, 1] }\n" +
                   "change = [{ material = \"rock\", to = \"worn\" }]\n",
               48, "stage.0.change[0]", "a material changes at once"},
           Bad{"[[stage]]\nramp = { change = [0, 1] }\n", 43, "stage.0.ramp", "does not make"},
           Bad{weak + "[[stage]]\nramp = { change = [0, 2] }\n" +
                   "change = [{ joints = \"rough\", to = \"weak\" }]\n",
               45, "stage.0.ramp.change", "to a larger one"},
           Bad{"[[stage]]\nramp = { time = [0, 2] }\n", 43, "stage.0.ramp.time",
               "no joint loses strength"},
           Bad{clay + "[[stage]]\nramp = { time = [\"1 h\", \"2 h\"] }\n", 47, "stage.0.ramp.time",
               "begin with \"0 s\""},
           Bad{clay + "[[stage]]\nramp = { time = [0, \"1 h\"] }\n[[stage]]\nduration = 2.5\n" +
                   "[[stage]]\nuntil = \"equilibrium\"\n" +
                   "[[stage]]\nramp = { time = [\"1 h\", \"2 h\"] }\n",
               53, "stage.3.ramp.time", "begin with \"3602.5 s\""},
           Bad{"[joints.clay]\nfriction_angle = 20\ndecay_time = \"3 d\"\n", 44,
               "joints.clay.decay_time", "which is the residual one"},
       }) {
    const Result<Model> result =
        read_model_text(testing::base_with("duration = 0.1\n", "") + bad.text, "m.toml", {});
    ASSERT_FALSE(result.ok()) << bad.text;
    // A second law or material has to be named elsewhere, too.
    const Faults& faults = result.faults();
    const auto f = std::find_if(faults.begin(), faults.end(),
                                [&](const Fault& fault) { return fault.where.key == bad.key; });
    ASSERT_NE(f, faults.end()) << bad.text << testing::as_lines(faults);
    EXPECT_EQ(f->where.line, bad.line - 1) << to_string(*f);
    EXPECT_NE(to_string(*f).find(bad.fragment), std::string::npos) << to_string(*f);
  }
}

/// Joints that have no peak strength to lose get one message.
TEST(BadModel, JointsThatCannotDecay) {
  for (const char* type :
       {"type = \"glued\"\n",
        "type = \"barton-bandis\"\njrc = 10\njcs = 1e8\nresidual_angle = 30\n"}) {
    const Result<Model> result = read_model_text(
        testing::base_model + "[joints.clay]\n" + type + "decay_time = 3\n", "m.toml", {});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(std::count_if(result.faults().begin(), result.faults().end(),
                            [](const Fault& f) { return f.where.key == "joints.clay.decay_time"; }),
              1)
        << testing::as_lines(result.faults());
  }
}

}  // namespace
}  // namespace edda::bad_changes_test
