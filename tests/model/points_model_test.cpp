// contact.model = "points" allows what the paper has; all else is refused.
#include <gtest/gtest.h>

#include "model/read_model.hpp"
#include "model/write_model.hpp"

namespace edda::points_model_test {
namespace {

const std::string head =
    "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
    "[contact]\nmodel = \"points\"\n"
    "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n";
const std::string solver = "[solver]\nduration = 1\n";
const std::string joint = "[joints.j]\nfriction_angle = 30\n";

TEST(PointsModel, IsReadAndWritten) {
  const Result<Model> model = read_model_text(head + joint + solver, "m.toml", {});
  ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
  EXPECT_EQ(model.value().contact.model, ContactModel::points);
  EXPECT_EQ(model.value().solver.switching, Switching::plain);
  const Result<Model> again = read_model_text(to_toml(model.value()), "m.toml", {});
  ASSERT_TRUE(again.ok()) << to_string(again.faults()[0]);
  EXPECT_EQ(again.value().contact.model, ContactModel::points);
}

TEST(PointsModel, FacesAreTheDefault) {
  std::string text = head + joint + solver;
  text.erase(text.find("[contact]"), std::string("[contact]\nmodel = \"points\"\n").size());
  const Result<Model> model = read_model_text(text, "m.toml", {});
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model.value().contact.model, ContactModel::faces);
  EXPECT_EQ(model.value().solver.switching, Switching::exact);
}

TEST(PointsModel, WhatThePaperDoesNotHave) {
  struct Bad {
    std::string text;
    int line;
    std::string key, what;
  };
  for (const Bad& bad : {
           Bad{joint + "cohesion = 1e3\n" + solver, 11, "joints.j.cohesion", "cohesion"},
           Bad{joint + "tensile_strength = 1e3\n" + solver, 11, "joints.j.tensile_strength",
               "tensile strength"},
           Bad{joint + "residual = { friction_angle = 20 }\n" + solver, 11, "joints.j.residual",
               "residual strength"},
           Bad{joint + "dilation_angle = 5\n" + solver, 11, "joints.j.dilation_angle", "dilation"},
           Bad{joint + "kn = 1e9\n" + solver, 11, "joints.j.kn", "stiffness per area"},
           Bad{joint + "restitution = 0.5\n" + solver, 11, "joints.j.restitution", "restitution"},
           Bad{"[joints.j]\ntype = \"glued\"\n" + solver, 10, "joints.j.type", "Coulomb"},
           Bad{"[joints.j]\ntype = \"barton-bandis\"\njrc = 9\njcs = 8e7\nresidual_angle = 28\n" +
                   solver,
               10, "joints.j.type", "Coulomb"},
           Bad{joint + solver + "method = \"dda\"\n", 13, "solver.method", "implicit method"},
           Bad{joint + solver + "switching = \"exact\"\n", 13, "solver.switching",
               "exact switching"},
           Bad{joint + solver + "mass_scaling = 1e-5\n", 13, "solver.mass_scaling", "masses"},
           Bad{joint + solver + "damping = { contact = 0.1 }\n", 13, "solver.damping.contact",
               "dashpots"},
           Bad{joint + solver + "[initial_stress]\nstress = [-1e6, -1e6, 0]\n", 13,
               "initial_stress", "initial stress"},
           Bad{joint + solver + "[[water]]\ntable = [[-1, 0.5], [2, 0.5]]\n", 13, "water",
               "water in joints"},
           Bad{joint + solver + "[[boundary]]\nsides = [\"bottom\"]\ntype = \"viscous\"\n", 15,
               "boundary.0.type", "fixed and roller"},
           Bad{joint + solver + "[[stage]]\nduration = 1\n", 13, "stage", "stages"},
           Bad{joint + solver + "[fos]\n", 13, "fos", "factor of safety"},
           Bad{joint + solver +
                   "[[bolt]]\nname = \"b\"\nfrom = [0.5, 0.5]\nto = [0.5, 0.9]\ntype = \"end\"\n"
                   "diameter = 0.02\n",
               13, "bolt", "bolts"},
           Bad{joint + solver +
                   "[[shaking]]\nname = \"q\"\napply = \"base\"\n"
                   "acceleration = { amplitude = 1, frequency = 1, direction = [1, 0] }\n",
               13, "shaking", "shaking"},
       }) {
    const Result<Model> model = read_model_text(head + bad.text, "m.toml", {});
    ASSERT_FALSE(model.ok()) << bad.text;
    bool found = false;
    for (const Fault& f : model.faults()) {
      if (f.problem.find("is the paper's contact model, without") == std::string::npos) continue;
      EXPECT_FALSE(found) << bad.text << to_string(f);
      found = true;
      EXPECT_EQ(f.where.file, "m.toml");
      EXPECT_EQ(f.where.line, bad.line) << to_string(f);
      EXPECT_EQ(f.where.key, bad.key) << to_string(f);
      EXPECT_NE(f.problem.find(bad.what), std::string::npos) << to_string(f);
      EXPECT_EQ(f.remedy, "leave it out, or use contact.model = \"faces\"");
    }
    EXPECT_TRUE(found) << bad.text << to_string(model.faults()[0]);
    EXPECT_EQ(model.faults().size(), 1u) << bad.text << to_string(model.faults().back());
  }
}

}  // namespace
}  // namespace edda::points_model_test
