// Bad loads, waters and stages, with exactly the fault each must give.
#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"
#include "model/write_model.hpp"

namespace edda::bad_parts_test {
namespace {

struct Bad {
  std::string text;  ///< after the base model, from its line 42 on
  int line;
  std::string key, fragment;
};

void expect_fault(const Bad& bad, const std::string& base = testing::base_model) {
  const Result<Model> result = read_model_text(base + bad.text, "m.toml", {});
  ASSERT_FALSE(result.ok()) << bad.text;
  ASSERT_EQ(result.faults().size(), 1U) << bad.text << to_string(result.faults()[1]);
  const Fault& f = result.faults()[0];
  EXPECT_EQ(f.where.line, bad.line) << to_string(f);
  EXPECT_EQ(f.where.key, bad.key) << to_string(f);
  EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
}

TEST(BadModel, Loads) {
  const std::string at = "[[load]]\npoint = [15, 9]\n",
                    line = "[[load]]\nalong = [[10, 0], [10, 9]]\n";
  for (const Bad& bad : {
           Bad{"[[load]]\nforce = [1, 0]\n", 42, "load.0", "none of point, along and within"},
           Bad{at, 42, "load.0", "none of force, pressure and body_force"},
           Bad{at + "along = [[0, 0], [1, 0]]\nforce = [1, 0]\n", 44, "load.0.along",
               "point is given too"},
           Bad{at + "force = [1, 0]\npressure = 5\n", 45, "load.0.pressure", "force is given too"},
           Bad{at + "pressure = 5\n", 44, "load.0.pressure", "no face"},
           Bad{at + "body_force = [1, 0]\n", 44, "load.0.body_force", "belongs to a polygon"},
           Bad{"[[load]]\nwithin = [[0, 0], [9, 0], [9, 9]]\nforce = [1, 0]\n", 43, "load.0.within",
               "belongs to a body force"},
           Bad{"[[load]]\nwithin = [[0, 0], [9, 0], [9, 9]]\nbody_force = [\"1 kN\", 0]\n", 44,
               "load.0.body_force[0]", "is not a"},
           Bad{at + "force = [0, \"3 kPa\"]\n", 44, "load.0.force", "is not a force"},
           Bad{line + "force = [0, \"3 kN\"]\n", 44, "load.0.force", "is not a stress"},
           Bad{at + "force = [0, \"3 m\"]\n", 44, "load.0.force[1]", "is not a load"},
           Bad{at + "force = 3\n", 44, "load.0.force", "two numbers"},
           Bad{at + "force = [1, 0]\nhistory = \"no.csv\"\n", 45, "load.0.history",
               "no.csv no such file"},
           Bad{at + "force = [1, 0]\nhistory = \"\"\n", 45, "load.0.history", "is empty"},
           Bad{at +
                   "force = [1, 0]\nname = \"a\"\n[[load]]\nname = \"a\"\npoint = [15, 9]\nforce = "
                   "[1, 0]\n",
               47, "load.a.name", "is the name of element 0"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, NamesWithControlCharacters) {
  for (const Bad& bad : {
           Bad{"[[block]]\nname = \"a\\nb\"\npolygon = [[30, 0], [31, 0], [31, 1]]\n", 43,
               "block.a?b.name", "\"a?b\" has a line break or another control character"},
           Bad{"[[boundary]]\nname = \"\\u001b[31m\"\nsides = [\"top\"]\n", 43,
               "boundary.?[31m.name", "give a name of"},
           Bad{"[[monitor]]\nname = \"a\\u007f\"\npoint = [15, 9]\n", 43, "monitor.a?.name",
               "control"},
           Bad{"[joints.\"a\\tb\"]\nfriction_angle = 30\n[contact]\njoint = \"rough\"\n", 42,
               "joints.a?b", "control"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Waters) {
  for (const Bad& bad : {
           Bad{"[[water]]\n", 42, "water.0.table", "is missing"},
           Bad{"[[water]]\ntable = [[0, 1]]\n", 43, "water.0.table", "has 1 point"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1], [1, 1]]\n", 43, "water.0.table[2]",
               "to the right"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nflooded = [\"hol\"]\n", 44, "water.0.flooded",
               "did you mean \"hole\""},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nflooded = \"hole\"\n", 44, "water.0.flooded",
               "a list of names"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nunit_weight = 0\n", 44, "water.0.unit_weight",
               "out of range"},
           Bad{"[[water]]\nlevel = 3\n", 43, "water.0.level", "add [flow]"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nsides = [\"left\"]\n", 44, "water.0.sides",
               "add [flow]"},
       }) {
    expect_fault(bad);
  }
}

/// With more keys of the joint law of the base model on its line 9, and text from line 43 on.
void expect_flow_fault(const std::string& of_joint, const Bad& bad) {
  std::string base = testing::base_model;
  const std::string angle = "friction_angle = 30.0\n";
  base.insert(base.find(angle) + angle.size(), of_joint + "\n");
  expect_fault(bad, base);
}

TEST(BadModel, Flow) {
  const std::string flow = "[[water]]\ntable = [[0, 1], [2, 1]]\n[flow]\n", second = "[[water]]\n",
                    aperture = "aperture = 1e-4";
  for (const auto& [joint, bad] : std::vector<std::pair<std::string, Bad>>{
           {aperture, {"[flow]\n", 43, "flow", "there is no water"}},
           {aperture, {flow + "viscosity = 0\n", 46, "flow.viscosity", "out of range"}},
           {"", {flow, 7, "joints.rough.aperture", "is missing"}},
           {"residual_aperture = 2e-4\n" + aperture,
            {flow, 9, "joints.rough.residual_aperture", "larger than aperture"}},
           {"largest_aperture = 5e-5\n" + aperture,
            {flow, 9, "joints.rough.largest_aperture", "smaller than aperture"}},
           {"residual_aperture = 5e-5", {"", 9, "joints.rough.residual_aperture", "add aperture"}},
           {aperture, {flow + second + "level = 3\n", 47, "water.1.level", "add sides or along"}},
           {aperture,
            {flow + second + "level = 3\ntable = [[0, 1], [2, 1]]\n", 47, "water.1.level",
             "table is given too"}},
           {aperture,
            {flow + second + "level = 3\nsides = [\"left\"]\nalong = [[0, 0], [1, 1]]\n", 49,
             "water.1.along", "sides is given too"}},
           {aperture,
            {flow + second + "level = 3\nsides = [\"left\"]\nunit_weight = 1e4\n", 49,
             "water.1.unit_weight", "differs from that of water.0"}},
           {aperture,
            {flow + "[[stage]]\nduration = 0.05\nramp = { flow = [60, 0], steps = 1 }\n", 48,
             "stage.0.ramp.flow", "does not go from a time to a later one"}},
           {aperture,
            {"[[stage]]\nduration = 0.05\nramp = { flow = [0, 60], steps = 1 }\n", 45,
             "stage.0.ramp.flow", "there is no flow of water"}},
           {aperture,
            {flow + second + "rain = 1e-6\nlevel = 3\n", 48, "water.1.level", "rain is given too"}},
           {aperture, {flow + second + "injection = 1e-4\n", 46, "water.1.at", "is missing"}},
           {aperture,
            {flow + second + "level = 3\nat = [1, 2]\n", 48, "water.1.at", "add injection"}},
           {aperture,
            {flow + second + "injection = 1e-4\nat = [1, 2]\nrain = 1e-6\n", 49, "water.1.rain",
             "injection is given too"}},
           {aperture,
            {flow + second +
                 "injection = 1e-4\nat = [1, 2]\nhistory = \"" EDDA_SOURCE_DIR
                 "/tests/model/out_and_in.csv\"\n",
             49, "water.1.history", "has the factor -0.5, below 0"}},
           {aperture,
            {flow + second +
                 "rain = 1e-6\nhistory = \"" EDDA_SOURCE_DIR "/tests/model/out_and_in.csv\"\n",
             48, "water.1.history", "has the factor -0.5, below 0"}},
           {aperture, {flow + second + "rain = 0\n", 47, "water.1.rain", "out of range"}},
           {aperture,
            {second + "rain = '5 mm/h'\n", 44, "water.0.rain", "through joints: add [flow]"}},
           {aperture,
            {flow + second + "name = \"lake\"\nrain = 1e-6\n[fos]\nvary = \"water:lake\"\n" +
                 "[[stage]]\nduration = 0.05\nramp = { flow = [0, 60], steps = 1 }\n",
             50, "fos.vary", "trials hold the water"}},
           {aperture, {flow + "[fos]\nvary = \"flow\"\n", 47, "fos.vary", "has no factor"}},
       }) {
    expect_flow_fault(joint, bad);
  }
}

TEST(BadModel, Boundaries) {
  const std::string at = "[[boundary]]\nsides = [\"left\"]\n";
  for (const Bad& bad : {
           Bad{"[[boundary]]\nsides = [\"left\", \"top\"]\ntype = \"free-field\"\n", 43,
               "boundary.1.sides", "is vertical"},
           Bad{"[[boundary]]\nalong = [[0, 0], [1, 9]]\ntype = \"free-field\"\n", 43,
               "boundary.1.along", "is vertical"},
           Bad{at + "type = \"viscus\"\n", 44, "boundary.1.type", "did you mean \"viscous\""},
           Bad{at + "type = \"stress\"\n", 42, "boundary.1.traction", "is missing"},
           Bad{at + "type = \"velocity\"\n", 42, "boundary.1.velocity", "is missing"},
           Bad{at + "traction = [1, 0]\n", 44, "boundary.1.traction", "does not apply to type"},
           Bad{at + "frictionless = true\n", 44, "boundary.1.frictionless",
               "does not apply to type"},
           Bad{at + "type = \"viscous\"\nhistory = \"" EDDA_SOURCE_DIR "/tests/model/rise.csv\"\n",
               45, "boundary.1.history", "give another type: \"stress\""},
           Bad{at + "type = \"viscous\"\nwave_speeds = [0, 1]\n", 45, "boundary.1.wave_speeds[0]",
               "out of range"},
           Bad{at + "type = \"stress\"\ntraction = [0, \"3 kN\"]\n", 45, "boundary.1.traction[1]",
               "is not a stress"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, GroundMotions) {
  const std::string at = "[[shaking]]\nacceleration = { amplitude = 1, frequency = 2 }\n",
                    viscous = "[[boundary]]\nsides = [\"left\"]\ntype = \"viscous\"\n";
  for (const Bad& bad : {
           Bad{"[[shaking]]\n", 42, "shaking.0.acceleration", "is missing"},
           Bad{"[[shaking]]\nacceleration = 3\n", 43, "shaking.0.acceleration",
               "the path of a file in quotes, or a table"},
           Bad{"[[shaking]]\nacceleration = { amplitude = 1 }\n", 43,
               "shaking.0.acceleration.frequency", "is missing"},
           Bad{"[[shaking]]\nacceleration = \"no.csv\"\n", 43, "shaking.0.acceleration",
               "no.csv no such file"},
           Bad{at + "direction = [0, 0]\n", 44, "shaking.0.direction", "has no length"},
           Bad{at + "apply = \"upgoing\"\n", 42, "shaking.0.apply", "needs a viscous boundary"},
           Bad{at + "boundary = \"b\"\n", 44, "shaking.0.boundary", "belongs to apply"},
           Bad{viscous + "name = \"low\"\n" + at + "apply = \"upgoing\"\nboundary = \"lov\"\n", 49,
               "shaking.0.boundary", "did you mean \"low\""},
           Bad{viscous + viscous + at + "apply = \"upgoing\"\n", 48, "shaking.0.boundary",
               "several viscous"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Fills) {
  const std::string paste = "[[fill]]\nname = \"paste\"\nopening = \"hole\"\n",
                    pile = "[[fill]]\nname = \"pile\"\npolygon = [[0, 0], [1, 0], [1, 1]]\n";
  const std::string only = "[[stage]]\nduration = 0.1\n", stage = "[[stage]]\nduration = 0.05\n",
                    half = "[[stage]]\nduration = 0.025\n";
  const std::string fill = "fill = [\"paste\"]\n", place = stage + fill,
                    dig = "excavate = [\"hole\"]\n";
  for (const Bad& bad : {
           Bad{"[[fill]]\nopening = \"hole\"\n", 42, "fill.0.name", "is missing"},
           Bad{"[[fill]]\nname = \"paste\"\n" + only + fill, 42, "fill.paste", "opening"},
           Bad{"[[fill]]\nname = \"paste\"\nopening = \"hol\"\n" + only + fill, 44,
               "fill.paste.opening", "did you mean \"hole\""},
           Bad{"[[fill]]\nname = \"hole\"\nopening = \"hole\"\n" + only + "fill = [\"hole\"]\n", 43,
               "fill.hole.name", "is the name of an opening, too"},
           Bad{paste, 42, "fill.paste", "no stage places it"},
           Bad{paste + paste + only + fill, 46, "fill.paste.name", "is the name of element 0"},
           Bad{paste + "lift = 0\n" + only + fill, 45, "fill.paste.lift", "out of range"},
           Bad{paste + place + stage + "fill = [\"past\"]\n", 50, "stage.1.fill[0]",
               "did you mean \"paste\""},
           Bad{paste + place + place, 50, "stage.1.fill[0]", "has been placed before"},
           Bad{paste + place + stage + dig, 47, "stage.0.fill[0]",
               "which has not been excavated yet"},
           Bad{pile + stage + "excavate = [\"pile\"]\n" + stage + "fill = [\"pile\"]\n", 47,
               "stage.0.excavate[0]", "has not been placed yet"},
           Bad{pile + stage + "fill = [\"pile\"]\n" + half + "excavate = [\"pile\"]\n" + half +
                   "excavate = [\"pile\"]\n",
               53, "stage.2.excavate[0]", "has been excavated before"},
           Bad{pile + only + "fill = [\"pile\"]\nrelax = { pile = 0.5 }\n", 48,
               "stage.0.relax.pile", "has not been excavated yet"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Linings) {
  const std::string at = "[[lining]]\nopening = \"hole\"\n", thick = at + "thickness = 0.2\n";
  const std::string first = "[[lining]]\nname = \"a\"\nopening = \"hole\"\nthickness = 0.2\n";
  for (const Bad& bad : {
           Bad{at, 42, "lining.0.thickness", "is missing"},
           Bad{"[[lining]]\nthickness = 0.2\n", 42, "lining.0", "opening"},
           Bad{at + "area = 1e-3\n", 42, "lining.0.inertia", "is missing"},
           Bad{thick + "area = 1e-3\ninertia = 1e-5\n", 44, "lining.0.thickness",
               "area and inertia are given"},
           Bad{"[[lining]]\nopening = \"hol\"\nthickness = 0.2\n", 43, "lining.0.opening",
               "did you mean \"hole\""},
           Bad{thick + "along = [[0, 0], [1, 0]]\n", 45, "lining.0.along", "opening is given too"},
           Bad{thick + "from_angle = 10\n", 42, "lining.0.to_angle", "is missing"},
           Bad{thick + "from_angle = 10\nto_angle = 370\n", 46, "lining.0.to_angle",
               "is the direction of from_angle"},
           Bad{thick + "tensile_strength = 1e6\n", 45, "lining.0.tensile_strength",
               "belongs to a compressive_strength"},
           Bad{thick + "compressive_strength = 2e7\nplastic_moment = 1e4\n", 46,
               "lining.0.plastic_moment", "of steel sets"},
           Bad{thick + "residual = { tensile_strength = 1e5 }\n", 45, "lining.0.residual",
               "belongs to a compressive_strength"},
           Bad{thick + "compressive_strength = 2e7\nresidual = {}\n", 46, "lining.0.residual",
               "gives no strength: give compressive_strength"},
           Bad{thick + "compressive_strength = 2e7\nresidual = { compressive_strength = 3e7 }\n",
               46, "lining.0.residual.compressive_strength",
               "is more than before the section yields"},
           Bad{thick + "compressive_strength = 2e7\nresidual = { tensile_strength = 1e5 }\n", 46,
               "lining.0.residual.tensile_strength",
               "is more than before the section yields, 0 Pa"},
           Bad{first + "[[lining]]\non = \"b\"\nthickness = 0.2\n", 47, "lining.1.on",
               "no lining before it is called"},
           Bad{first + "[[stage]]\nduration = 0.1\nexcavate = [\"hole\"]\n", 42, "lining.a",
               "which is not excavated at the start"},
           Bad{first + "[[stage]]\nduration = 0.05\ninstall = [\"a\"]\n[[stage]]\nduration = 0.05\n"
                       "excavate = [\"hole\"]\n",
               48, "stage.0.install", "which has not been excavated yet"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Bolts) {
  const std::string at = "[[bolt]]\nfrom = [15, 1]\nto = [15, 3]\ndiameter = 0.02\n",
                    end = at + "type = \"end\"\n";
  const std::string bond = "bond = { stiffness = 1e9, strength = 4e5 }\n";
  for (const Bad& bad : {
           Bad{at, 42, "bolt.0.bond", "is missing"},
           Bad{at + "bond = { stiffness = 0, strength = 4e5 }\n", 46, "bolt.0.bond.stiffness",
               "is zero"},
           Bad{at + "bond = { stiffness = 1e9 }\n", 46, "bolt.0.bond.strength", "is missing"},
           Bad{at + "bond = { stiffness = 1e9, strength = \"4 kN\" }\n", 46, "bolt.0.bond.strength",
               "is not a force per length"},
           Bad{end + "dowel = { stiffness = 1e8, strength = 1e5 }\n", 47, "bolt.0.dowel",
               "does not apply"},
           Bad{end + "dowel = { bearing_strength = 5e7 }\n", 47, "bolt.0.dowel", "does not apply"},
           Bad{at + bond + "dowel = { stiffness = 1e8 }\n", 47, "bolt.0.dowel.strength",
               "is missing"},
           Bad{at + bond + "dowel = { bearing_strength = 5e7 }\n", 42, "bolt.0.yield_stress",
               "is missing"},
           Bad{at + bond + "dowel = { stiffness = 1e8, strength = 1e5, bearing_strength = 5e7 }\n",
               47, "bolt.0.dowel.bearing_strength", "follow from the bar"},
           Bad{at + bond + "yield_stress = 4e8\ndowel = { bearing_strength = \"5 kN\" }\n", 48,
               "bolt.0.dowel.bearing_strength", "is not a stress"},
           Bad{end + "yield_stress = 1e6\npretension = 1e6\n", 48, "bolt.0.pretension",
               "at which the bolt yields"},
           Bad{end + "yield_stress = 4e8\nrupture_strain = 1e-3\n", 48, "bolt.0.rupture_strain",
               "less than the strain"},
           Bad{"[[bolt]]\nfrom = [1, 1]\nto = [1, 1]\ndiameter = 0.02\ntype = \"end\"\n", 44,
               "bolt.0.to", "is where from is"},
           Bad{"[[bolt_pattern]]\nopening = \"hol\"\nfrom_angle = 0\nto_angle = 90\ncount = "
               "3\nlength = 1\ndiameter = 0.02\n" +
                   bond,
               43, "bolt_pattern.0.opening", "did you mean \"hole\""},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, WhatTheImplicitMethodCannotDo) {
  const std::string solver = "method = \"dda\"\n";
  for (const auto& [text, key] :
       {std::pair<std::string, std::string>{
            "[[boundary]]\nsides = [\"left\"]\ntype = \"viscous\"\n", "boundary.1.type"},
        {"[[boundary]]\nsides = [\"left\"]\ntype = \"velocity\"\nvelocity = [1, 0]\n",
         "boundary.1.type"},
        {"[[shaking]]\nacceleration = { amplitude = 1, frequency = 2 }\n", "shaking.0.apply"},
        {"[joints.a]\nfriction_angle = 30\ndilation_angle = 3\n[contact]\njoint = \"rough\"\n",
         "joints.a"},
        {"[joints.a]\nfriction_angle = 30\ncohesion = 1e6\ntensile_strength = 1e5\n"
         "fracture_energy = 10\nshear_fracture_energy = 99\n[contact]\njoint = \"rough\"\n",
         "joints.a.fracture_energy"},
        {"[[bolt]]\nfrom = [15, 1]\nto = [15, 3]\ndiameter = 0.02\ntype = \"end\"\n", "bolt.0"}}) {
    const std::string whole = testing::base_with("duration = 0.1\n", "duration = 0.1\n" + solver);
    const Result<Model> result = read_model_text(whole + text, "m.toml", {});
    ASSERT_FALSE(result.ok()) << text;
    EXPECT_EQ(result.faults()[0].where.key, key);
    EXPECT_NE(to_string(result.faults()[0]).find("dda"), std::string::npos);
  }
}

TEST(BadModel, JointLaws) {
  const std::string weak = "[joints.a]\ntype = \"slip-weakening\"\nfriction_angle = 30\n",
                    barton =
                        "[joints.a]\ntype = \"barton-bandis\"\njrc = 9\njcs = 1e8\n"
                        "residual_angle = 28\n[contact]\njoint = \"rough\"\n",
                    plain = "[joints.a]\nfriction_angle = 30\n",
                    end = "[contact]\njoint = \"rough\"\n";
  const auto barton_with = [&](const std::string& line) {
    std::string text = barton;
    return text.insert(text.find("[contact]"), line);
  };
  for (const Bad& bad : {
           Bad{weak + end, 42, "joints.a.slip_distance", "is missing"},
           Bad{weak + "slip_distance = 0\n" + end, 45, "joints.a.slip_distance", "above 0"},
           Bad{weak + "slip_distance = 1\njrc = 3\n" + end, 46, "joints.a.jrc", "does not apply"},
           Bad{weak + "slip_distance = 1\ndilation_angle = 31\n" + end, 46,
               "joints.a.dilation_angle", "not below the friction angle of 30"},
           Bad{plain + "residual = { friction_angle = 5 }\ndilation_angle = 6\n" + end, 45,
               "joints.a.dilation_angle", "angle of 5 degrees"},
           Bad{plain + "slip_distance = 1\n" + end, 44, "joints.a.slip_distance", "dilation_angle"},
           Bad{barton_with("cohesion = 5\n"), 47, "joints.a.cohesion", "does not apply"},
           Bad{barton_with("friction_angle = 5\n"), 47, "joints.a.friction_angle",
               "does not apply"},
           Bad{barton_with("dilation_angle = 5\n"), 47, "joints.a.dilation_angle",
               "does not apply"},
           Bad{barton_with("residual = { cohesion = 5 }\n"), 47, "joints.a.residual",
               "does not apply"},
           Bad{"[joints.a]\ntype = \"barton-bandis\"\njrc = 9\nresidual_angle = 28\n" + end, 42,
               "joints.a.jcs", "is missing"},
           Bad{"[joints.a]\ntype = \"barton-bandis\"\njrc = 21\njcs = 1e8\nresidual_angle = 28\n" +
                   end,
               44, "joints.a.jrc", "at most 20"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, FractureEnergy) {
  const std::string rock =
      "[joints.a]\nfriction_angle = 30\ncohesion = 1e6\ntensile_strength = 1e5\n";
  const std::string end = "[contact]\njoint = \"rough\"\n",
                    both = "fracture_energy = 10\nshear_fracture_energy = 100\n";
  for (const Bad& bad : {
           Bad{rock + "fracture_energy = 10\n" + end, 46, "joints.a.fracture_energy",
               "give shear_fracture_energy, too"},
           Bad{rock + "shear_fracture_energy = 10\n" + end, 46, "joints.a.shear_fracture_energy",
               "give fracture_energy, too"},
           Bad{rock + "fracture_energy = 0\nshear_fracture_energy = 1\n" + end, 46,
               "joints.a.fracture_energy", "above 0"},
           Bad{"[joints.a]\nfriction_angle = 30\ncohesion = 1e6\n" + both + end, 45,
               "joints.a.fracture_energy", "tensile_strength and cohesion above 0"},
           Bad{"[joints.a]\nfriction_angle = 30\ntensile_strength = 1e6\n" + both + end, 45,
               "joints.a.fracture_energy", "tensile_strength and cohesion above 0"},
           Bad{rock + both + "residual = { cohesion = 5 }\n" + end, 46, "joints.a.fracture_energy",
               "another residual"},
           Bad{rock + both + "residual = { friction_angle = 25 }\n" + end, 46,
               "joints.a.fracture_energy", "another residual"},
           Bad{rock + both + "dilation_angle = 5\n" + end, 46, "joints.a.fracture_energy",
               "dilation_angle"},
           Bad{"[joints.a]\ntype = \"glued\"\nfracture_energy = 10\n" + end, 44,
               "joints.a.fracture_energy", "does not apply"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, FactorOfSafety) {
  const std::string load = "[[load]]\nname = \"push\"\npoint = [15, 9]\nforce = [1, 0]\n";
  for (const Bad& bad : {
           Bad{"[fos]\nvary = \"strenght\"\n", 43, "fos.vary", "load:NAME"},
           Bad{load + "[fos]\nvary = \"load:pusch\"\n", 47, "fos.vary", "did you mean \"push\""},
           Bad{"[fos]\nvary = \"water:lake\"\n", 43, "fos.vary", "no water is called"},
           Bad{"[fos]\nvary = \"shaking:\"\n", 43, "fos.vary", "no shaking is called"},
           Bad{"[fos]\nstage = \"last\"\n", 43, "fos.stage", "no stage is called \"last\""},
           Bad{"[fos]\nexclude = [\"rouh\"]\n", 43, "fos.exclude", "did you mean \"rough\""},
           Bad{"[fos]\nbracket = [2, 1]\n", 43, "fos.bracket", "not below"},
           Bad{"[fos]\nbracket = [0, 1]\n", 43, "fos.bracket[0]", "above 0"},
           Bad{"[fos]\ntolerance = 0\n", 43, "fos.tolerance", "out of range"},
           Bad{"[fos]\ntolerance = 0.6\n", 43, "fos.tolerance", "above 0 and at most 0.5"},
           Bad{"[fos]\nfails = { displacement = -1 }\n", 43, "fos.fails.displacement",
               "out of range"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Stages) {
  for (const Bad& bad : {
           Bad{"[[stage]]\nduration = 0.1\nuntil = \"rest\"\n", 44, "stage.0.until", "not known"},
           Bad{"[[stage]]\nname = \"a\"\n", 42, "stage.a.duration", "is missing"},
           Bad{"[[stage]]\nduration = 0.1\nratio = 0\n", 44, "stage.0.ratio", "out of range"},
           Bad{"[[stage]]\nduration = 0.05\n[[stage]]\nduration = 0.1\n", 39, "solver.duration",
               "is not the 0.15 s of the stages together"},
           Bad{"[[stage]]\nduration = 0.1\ndamping = { local = 1.5 }\n", 44,
               "stage.0.damping.local", "out of range"},
           Bad{"[[stage]]\nduration = 0.1\nstrength_factor = 0\n", 44, "stage.0.strength_factor",
               "out of range"},
       }) {
    expect_fault(bad);
  }
  const std::string load = "[[load]]\nname = \"push\"\npoint = [15, 9]\nforce = [1, 0]\n";
  const std::string bolt =
      "[[bolt]]\nname = \"nail\"\nfrom = [15, 1]\nto = [15, 3]\ndiameter = 0.02\ntype = \"end\"\n";
  const std::string stage = "[[stage]]\nduration = 0.1\n", next = "[[stage]]\nduration = 0.1\n";
  const std::string known = testing::base_with("duration = 0.1\n", "");
  for (const Bad& bad : {
           Bad{stage + "joints = \"loose\"\n", 44, "stage.0.joints", "not known"},
           Bad{stage + "masses = \"none\"\n", 44, "stage.0.masses", "not known"},
           Bad{stage + "otherwise = \"stop\"\n", 44, "stage.0.otherwise",
               "belongs to a stage with until"},
           Bad{stage + "detached = 3\n", 44, "stage.0.detached", "expects one of"},
           Bad{stage + "excavate = [\"cave\"]\n", 44, "stage.0.excavate[0]",
               "names no opening or fill"},
           Bad{stage + "relax = { cave = 0.5 }\n", 44, "stage.0.relax.cave", "names no opening"},
           Bad{stage + "excavate = [\"hole\"]\nrelax = { hole = 0.6 }\n" + next +
                   "relax = { hole = 0.4 }\n",
               48, "stage.1.relax.hole", "is less than the 0.6 released so far"},
           Bad{stage + "install = [\"nail\"]\n", 44, "stage.0.install[0]",
               "names no bolt, pattern of bolts or lining"},
           Bad{bolt + stage + "install = [\"nial\"]\n", 50, "stage.0.install[0]", "nail"},
           Bad{bolt + stage + "install = [\"nail\"]\n" + next + "install = [\"nail\"]\n", 53,
               "stage.1.install[0]", "has been installed before"},
           Bad{load + stage + "activate = [\"pusch\"]\n", 48, "stage.0.activate[0]", "push"},
           Bad{load + stage + "activate = [\"push\"]\n" + next + "activate = [\"push\"]\n", 51,
               "stage.1.activate[0]", "acts already"},
           Bad{load + stage + "deactivate = [\"push\"]\n" + next + "deactivate = [\"push\"]\n", 51,
               "stage.1.deactivate[0]", "does not act before this stage"},
           Bad{load + stage + "deactivate = [\"push\"]\nactivate = [\"push\"]\n", 48,
               "stage.0.deactivate[0]", "does not act before this stage"},
           Bad{load + stage + next + "deactivate = [\"push\"]\nactivate = [\"push\"]\n", 51,
               "stage.1.activate", "is in deactivate, too"},
       }) {
    const std::string text = known + bad.text;
    const Result<Model> result = read_model_text(text, "m.toml", {});
    ASSERT_FALSE(result.ok()) << bad.text;
    const Fault& f = result.faults()[0];
    EXPECT_EQ(f.where.line, bad.line - 1) << to_string(f);
    EXPECT_EQ(f.where.key, bad.key) << to_string(f);
    EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
  }
  const auto missing = read_model_text(testing::base_with("duration = 0.1\n", ""), "m.toml", {});
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.faults()[0].where.key, "solver.duration");
  EXPECT_EQ(missing.faults()[0].where.line, 38);
}

TEST(BadModel, ChangesOfProperties) {
  const std::string soft = "[materials.soft]\ndensity = 2700\nyoung = 2e9\npoisson = 0.25\n",
                    worn = "[materials.worn]\ndensity = 2700\nyoung = 20e9\npoisson = 0.25\n",
                    tough =
                        "[joints.tough]\nfriction_angle = 30\ncohesion = 1e6\n"
                        "tensile_strength = 1e6\nfracture_energy = 40\n"
                        "shear_fracture_energy = 400\n";
  const std::string stage = "[[stage]]\nduration = 0.1\n";
  for (const Bad& bad : {
           Bad{stage + "change = \"weathered\"\n", 44, "stage.0.change", "a list of tables"},
           Bad{stage + "change = []\n", 44, "stage.0.change", "a list of tables"},
           Bad{stage + "change = [3]\n", 44, "stage.0.change[0]", "a list of tables"},
           Bad{stage + "change = [{ to = \"rough\" }]\n", 44, "stage.0.change[0]",
               "neither joints nor material"},
           Bad{stage + "change = [{ joints = \"rough\" }]\n", 44, "stage.0.change[0].to",
               "is missing"},
           Bad{stage + "change = [{ joints = \"rouhg\", to = \"rough\" }]\n", 44,
               "stage.0.change[0].joints", "did you mean \"rough\""},
           Bad{stage + "change = [{ joints = \"rough\", to = \"rouhg\" }]\n", 44,
               "stage.0.change[0].to", "did you mean \"rough\""},
           Bad{stage + "change = [{ material = \"rock\", to = \"rock\" }]\n", 44,
               "stage.0.change[0].to", "already"},
           Bad{soft + stage + "change = [{ material = \"rock\", to = \"soft\" }]\n", 48,
               "stage.0.change[0].to", "another density, young"},
           Bad{tough + stage + "change = [{ joints = \"rough\", to = \"tough\" }]\n", 50,
               "stage.0.change[0]", "fracture energy"},
           Bad{worn + stage + "change = [{ material = \"rock\", to = \"worn\", distance = 2 }]\n",
               48, "stage.0.change[0]", "distance is given without an opening"},
           Bad{worn + stage +
                   "change = [{ material = \"rock\", to = \"worn\", around = \"hole\" }]\n",
               48, "stage.0.change[0]", "around is given without a distance"},
           Bad{worn + stage +
                   "change = [{ material = \"rock\", to = \"worn\", around = \"cave\", distance = "
                   "2 }]\n",
               48, "stage.0.change[0].around", "names no opening"},
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

/// Models that are not run need no duration, and are written without one.
TEST(BadParts, DurationIsMissingInARunAlone) {
  const std::string none = testing::base_with("duration = 0.1\n", "");
  const auto model = read_model_text(none, "m.toml", {}, ReadFor::no_run);
  ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
  EXPECT_EQ(to_string(*missing_duration(model.value())),
            "m.toml:38:1: solver.duration: is missing: give a time above 0 such as 0.1 or "
            "\"100 ms\" for a run; edda fos needs none");
  const std::string again = to_toml(model.value());
  const auto read = read_model_text(again, "m.toml", {}, ReadFor::no_run);
  ASSERT_TRUE(read.ok()) << to_string(read.faults()[0]);
  EXPECT_EQ(to_toml(read.value()), again);
  const auto wrong = read_model_text(testing::base_with("duration = 0.1\n", "duration = -1\n"),
                                     "m.toml", {}, ReadFor::no_run);
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.faults().size(), 1U);
}

TEST(BadModel, Ramps) {
  const std::string load = "[[load]]\nname = \"push\"\npoint = [15, 9]\nforce = [1, 0]\n",
                    stage = "[[stage]]\nduration = 0.1\n",
                    wall = "[[boundary]]\nname = \"w\"\nsides = [\"left\"]\n";
  const auto ramp = [&](const std::string& keys) {
    return "[[stage]]\nduration = 0.05\nramp = { " + keys + "steps = 1 }\n";
  };
  for (const Bad& bad : {
           Bad{stage + "until = \"collapse\"\n", 44, "stage.0.until",
               "belongs to a stage with a ramp"},
           Bad{ramp("kh = [0, 1], ") + "until = \"time\"\n", 45, "stage.0.until",
               "does not go with"},
           Bad{ramp(""), 44, "stage.0.ramp", "says nothing"},
           Bad{ramp("kx = [0, 1], "), 44, "stage.0.ramp.kx", "unknown key"},
           Bad{ramp("kh = [0, 1], kv = [0, 1], "), 44, "stage.0.ramp.kv", "\"kh\" is varied too"},
           Bad{ramp("kh = [0.2, 0.2], "), 44, "stage.0.ramp.kh", "ends where it begins"},
           Bad{ramp("kh = 0.2, "), 44, "stage.0.ramp.kh", "from and to"},
           Bad{"[[stage]]\nduration = 0.00049751243781094527\nramp = { kh = [0, 1], steps = 0 }\n",
               44, "stage.0.ramp.steps", "out of range"},
           Bad{ramp("kh = [0, 1], hold = \"time\", "), 44, "stage.0.ramp.hold", "not known"},
           Bad{ramp("strength = [1, 0], "), 44, "stage.0.ramp.strength", "not above 0"},
           Bad{load + "[[stage]]\nduration = 0.025\nramp = { 'load:push' = [0, 1], steps = 1 }\n"
                      "[[stage]]\nduration = 0.05\nactivate = [\"push\"]\n",
               48, "stage.0.ramp.load:push", "does not act in this stage"},
           Bad{ramp("gravity = [1, -1], "), 44, "stage.0.ramp.gravity", "below 0"},
           Bad{ramp("strength = [1, 2], ") + "strength_factor = 2\n", 45, "stage.0.strength_factor",
               "beside a ramp"},
           Bad{load + ramp("'load:pusch' = [0, 1], "), 48, "stage.0.ramp.load:pusch",
               "did you mean"},
           Bad{wall + ramp("'boundary:w' = [0, 1], "), 47, "stage.0.ramp.boundary:w",
               "neither a displacement nor a traction"},
           Bad{ramp("kh = [0, 1], ") + "damping = { local = 0.5 }\n", 45, "stage.0.damping",
               "needs adaptive damping"},
           Bad{wall + "type = \"displacement\"\n", 42, "boundary.w.displacement", "is missing"},
           Bad{wall + "displacement = [1, 0]\n", 45, "boundary.w.displacement",
               "does not apply to type"},
       }) {
    expect_fault(bad);
  }
}

}  // namespace
}  // namespace edda::bad_parts_test
