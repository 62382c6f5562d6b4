#include "model/read_model.hpp"
#include "model/contact_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "model/base_model.hpp"
#include "model/completion/complete.hpp"
#include "scratch_folder.hpp"

namespace edda::read_model_test {
namespace {

using testing::base_model;
using testing::base_with;

Model read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Result<Model> result = read_model_text(text, "m.toml", overrides);
  if (!result) {
    for (const Fault& fault : result.faults()) ADD_FAILURE() << to_string(fault);
    return {};
  }
  return result.value();
}

/// 10 s, or 200 times the larger side over sqrt(young/density), of the softest rock.
TEST(ReadModel, StagesLastLongerInLargeModels) {
  const auto longest = [](const std::string& side) {
    const Model m = read(
        "[materials.soft]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
        "[materials.hard]\ndensity = 2500\nyoung = 4e9\npoisson = 0.2\n"
        "[joints.j]\nfriction_angle = 30\n[domain]\nmaterial = 'hard'\n"
        "outline = [[100, 0], [" +
        side + ", 0], [" + side +
        ", 20], [100, 20]]\n"
        "[[stage]]\nuntil = 'equilibrium'\n"
        "[[stage]]\nuntil = 'equilibrium'\nduration = 3\n");
    EXPECT_EQ(m.stages.at(1).duration, 3.0);
    EXPECT_DOUBLE_EQ(m.solver.duration, m.stages[0].duration + 3.0);
    EXPECT_DOUBLE_EQ(m.output.history_every, 0.065) << "of 10 s and 3 s";
    return m.stages[0].duration;
  };
  const double speed = std::sqrt(1e9 / 2500);
  EXPECT_EQ(longest("120"), 10.0);
  EXPECT_DOUBLE_EQ(longest("1100"), 200.0 * 1000.0 / speed);
}

TEST(ReadModel, Defaults) {
  const Model m = read(base_model);
  EXPECT_EQ(m.file, "m.toml");
  EXPECT_EQ(m.title, "base");
  EXPECT_EQ(m.plane, Plane::strain);
  EXPECT_EQ(m.thickness, 1.0);
  ASSERT_EQ(m.joints.size(), 1U);
  EXPECT_EQ(m.joints[0].type, LawType::coulomb);
  EXPECT_EQ(m.joints[0].residual.friction_angle, 30.0);
  EXPECT_EQ(m.joints[0].residual.cohesion, 0.0);
  EXPECT_FALSE(m.joints[0].kn || m.joints[0].ks);
  EXPECT_FALSE(m.contact.normal_stiffness || m.contact.shear_stiffness);
  EXPECT_EQ(contact_springs(m).normal, 200e9);
  EXPECT_EQ(contact_springs(m).shear_over_young, 10.0);
  EXPECT_EQ(m.contact.joint, 0);
  ASSERT_EQ(m.blocks.size(), 2U);
  EXPECT_EQ(m.blocks[0].material, 0);
  EXPECT_EQ(m.blocks[0].joint, none);
  EXPECT_EQ(m.blocks[1].name, "");
  EXPECT_EQ(m.blocks[1].velocity, Vec2{});
  ASSERT_TRUE(m.domain);
  EXPECT_EQ(m.domain->material, 0);
  EXPECT_EQ(m.domain->joint, none);
  EXPECT_EQ(m.domain->snap, 1e-8);
  EXPECT_EQ(m.domain->max_blocks, 300000);
  EXPECT_EQ(m.joint_sets[0].origin, Vec2{});
  EXPECT_TRUE(m.joint_sets[0].region.empty());
  EXPECT_EQ(m.openings[0].joint, none);
  EXPECT_EQ(m.walls[0].material, 0);
  EXPECT_EQ(m.walls[0].origin, Vec2{});
  EXPECT_EQ(m.boundaries[0].type, BoundaryType::fixed);
  EXPECT_FALSE(m.boundaries[0].stiffness);  // as the joints
  EXPECT_EQ(m.solver.method, Method::edda);
  EXPECT_EQ(m.solver.mass, MassKind::matched);
  EXPECT_EQ(m.solver.switching, Switching::exact);
  EXPECT_FALSE(m.solver.time_step);
  EXPECT_FALSE(m.solver.allow_unstable);
  EXPECT_EQ(m.solver.safety, 0.7);
  EXPECT_EQ(m.solver.max_displacement_ratio, 0.01);
  EXPECT_EQ(m.solver.damping.local, 0.0);
  EXPECT_EQ(m.output.every, 0.01);
  EXPECT_EQ(m.output.history_every, 0.1 / 200);
  EXPECT_EQ(read(base_with("every = 0.01", "")).output.every, 0.1 / 20);
}

/// Rows and frames are for what is run: a record is resolved, and stages until equilibrium, which
/// end long before their time, do not thin out those of the others.
TEST(ReadModel, RowsResolveWhatHappens) {
  const std::string model =
      "[materials.rock]\ndensity = 2700\nyoung = 2e10\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\nfixed = true\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
      "[[block]]\npolygon = [[0, 1], [1, 1], [1, 2], [0, 2]]\n";
  const auto output = [&](const std::string& more) {
    const Result<Model> read = read_model_text(model + more, "m.toml");
    EXPECT_TRUE(read.ok());
    return read.value().output;
  };
  const std::string rest = "[[stage]]\nuntil = 'equilibrium'\n",
                    quake = "[[stage]]\nduration = 12\n",
                    sine = "[[shaking]]\nacceleration = { amplitude = 1, frequency = 5 }\n";
  EXPECT_DOUBLE_EQ(output(quake).every, 0.6);
  EXPECT_DOUBLE_EQ(output(rest + quake).every, 0.6);
  EXPECT_DOUBLE_EQ(output(rest + rest + rest + quake).history_every, 0.06);
  EXPECT_DOUBLE_EQ(output(rest + quake + sine).history_every, 0.01);
  EXPECT_DOUBLE_EQ(output(rest + quake + sine).every, 0.6);
  EXPECT_DOUBLE_EQ(output(rest).every, 0.5);
  // Ten times as many frames as without the short stage, not ten thousand.
  EXPECT_DOUBLE_EQ(output(rest + "[[stage]]\nduration = 0.01\n").every, 0.1 * 10.01 / 20.0);
  const std::string record =
      "[[shaking]]\nacceleration = '" EDDA_SOURCE_DIR "/tests/verification/pulse.csv'\n";
  const std::string rows = "[solver]\nduration = 10\n[output]\nhistory_every = 'record'\n";
  EXPECT_DOUBLE_EQ(output(rows + sine + record).history_every, 0.1) << "that of pulse.csv";
  EXPECT_FALSE(output(rows + record).settling);
  // A record of 0.01 s, and one so long that rows would fill the disk.
  EXPECT_DOUBLE_EQ(output("[solver]\nduration = 10000\n" + sine).history_every, 0.5);
}

TEST(ReadModel, PlacesAndKeys) {
  const Model m = read(base_model);
  EXPECT_EQ(m.blocks[0].where.key, "block.floor");
  EXPECT_EQ(m.blocks[0].where.file, "m.toml");
  EXPECT_EQ(m.blocks[0].where.line, 9);
  EXPECT_EQ(m.blocks[1].where.key, "block.1");
  EXPECT_EQ(m.traces[0].where.key, "trace.0");
  EXPECT_EQ(m.materials[0].where.key, "materials.rock");
  EXPECT_EQ(m.materials[0].where.line, 3);
  EXPECT_EQ(m.domain->where.key, "domain");
  EXPECT_EQ(m.solver.where.line, 38);
}

TEST(ReadModel, NamedTablesKeepTheOrderOfTheFile) {
  const Model m = read(
      "[materials.zinc]\ndensity = 1\nyoung = 1\npoisson = 0\n"
      "[joints.b]\ntype = \"glued\"\n[joints]\na = { friction_angle = 1 }\n"
      "[materials.\"a b\"]\ndensity = 2\nyoung = 1\npoisson = 0\n"
      "[contact]\njoint = \"b\"\n"
      "[[block]]\npolygon = [[0, 0], [1, 0], [0, 1]]\nmaterial = \"a b\"\njoint = \"a\"\n"
      "[solver]\nduration = 1\n");
  ASSERT_EQ(m.materials.size(), 2U);
  EXPECT_EQ(m.materials[0].name, "zinc");
  EXPECT_EQ(m.materials[1].name, "a b");
  EXPECT_EQ(m.joints[0].name, "b");
  EXPECT_EQ(m.joints[0].type, LawType::glued);
  EXPECT_EQ(m.joints[1].name, "a");
  EXPECT_EQ(m.blocks[0].material, 1);
  EXPECT_EQ(m.blocks[0].joint, 1);
  EXPECT_EQ(m.contact.joint, 0);
}

TEST(ReadModel, UnitWeight) {
  EXPECT_EQ(
      read(base_with("density = 2700.0", "unit_weight = \"19.62 kN/m3\"")).materials[0].density,
      2000.0);
  std::string weightless = base_with("density = 2700.0", "unit_weight = 9810");
  weightless.replace(weightless.find("-9.81"), 5, "0.0");
  EXPECT_EQ(read(weightless).materials[0].density, 1000.0);
}

TEST(ReadModel, DefaultsThatFollowOtherKeys) {
  const Model m = read(base_with("friction_angle = 30.0",
                                 "friction_angle = 30\ncohesion = 5\nkn = 10\n"
                                 "residual = { cohesion = 1 }\n[contact]\nnormal_stiffness = 7"));
  EXPECT_EQ(m.joints[0].residual.friction_angle, 30.0);
  EXPECT_EQ(m.joints[0].residual.cohesion, 1.0);
  EXPECT_EQ(m.joints[0].kn, 10.0);
  EXPECT_EQ(m.joints[0].ks, 4.0);
  EXPECT_EQ(contact_springs(m).shear, 7.0);
  EXPECT_EQ(contact_springs(m).shear_over_young, 0.0);
}

TEST(ReadModel, OneBlockNeedsNoLaw) {
  const std::string head = "[materials.rock]\ndensity = 1\nyoung = 1\npoisson = 0\n";
  const std::string tail = "[solver]\nduration = 1\n";
  const Model block = read(head + "[[block]]\npolygon = [[0, 0], [1, 0], [0, 1]]\n" + tail);
  EXPECT_EQ(block.contact.joint, none);
  read(head +
       "[domain]\noutline = [[0, 0], [1, 0], [0, 1]]\n[[opening]]\n"
       "polygon = [[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]]\n" +
       tail);
}

TEST(ReadModel, SeveralLawsAllNamedNeedNoDefault) {
  const Model m = read(
      "[materials.rock]\ndensity = 1\nyoung = 1\npoisson = 0\n"
      "[joints]\na.friction_angle = 1\nb.friction_angle = 2\n"
      "[domain]\noutline = [[0, 0], [1, 0], [0, 1]]\n"
      "[[trace]]\npoints = [[0, 0], [1, 1]]\njoint = \"b\"\n"
      "[solver]\nduration = 1\n");
  EXPECT_EQ(m.contact.joint, none);
  EXPECT_EQ(m.traces[0].joint, 1);
}

TEST(ReadModel, SidesWithoutADomain) {
  const Model m = read(
      "[materials.rock]\ndensity = 1\nyoung = 1\npoisson = 0\n"
      "[[block]]\npolygon = [[0, 0], [0, 1], [1, 0]]\n"
      "[[boundary]]\nsides = [\"left\", \"bottom\"]\ntype = \"roller\"\n"
      "[solver]\nduration = 1\n");
  EXPECT_EQ(m.boundaries[0].sides, (std::vector<std::string>{"left", "bottom"}));
  EXPECT_EQ(m.boundaries[0].type, BoundaryType::roller);
  EXPECT_LT(signed_area(m.blocks[0].polygon), 0.0) << "the orientation is kept as written";
}

TEST(ReadModel, WindowsLineEndsAndByteOrderMark) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : base_model) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(text).blocks.size(), 2U);
  const auto bad = read_model_text(text + "x = 1\r\n", "m.toml");
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.faults()[0].where.line, 42);
}

TEST(ReadModel, BlockEstimateCountsCellsOfAGrid) {
  Domain domain;
  domain.outline = {{0, 0}, {100, 0}, {100, 50}, {0, 50}};
  JointSet level, upright;
  level.spacing = 1.0;
  upright.angle = 90.0;
  upright.spacing = 2.0;
  EXPECT_NEAR(estimated_blocks(domain, {level}), 51.0, 1e-9);
  EXPECT_NEAR(estimated_blocks(domain, {level, upright}), 51.0 * 51.0, 1e-6);
  EXPECT_NEAR(estimated_blocks(domain, {level, level}), 101.0, 1e-9)
      << "parallel sets do not cross";
  level.region = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  upright.region = {{50, 0}, {60, 0}, {60, 10}, {50, 10}};
  EXPECT_NEAR(estimated_blocks(domain, {level, upright}), 1 + 10 + 5, 1e-6);
}

class ModelFile : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return folder.at(name);
  }
  static Fault only_fault(const std::string& path) {
    const Result<Model> result = read_model(path);
    EXPECT_FALSE(result.ok());
    if (result.ok()) return {};
    EXPECT_EQ(result.faults().size(), 1U);
    EXPECT_EQ(result.faults()[0].where.file, path);
    EXPECT_FALSE(result.faults()[0].remedy.empty());
    return result.faults()[0];
  }

  ScratchFolder folder;
};

TEST_F(ModelFile, IsRead) {
  const std::string path = write("good.toml", base_model);
  const Result<Model> result = read_model(path, {"solver.duration=0.5"});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().file, path);
  EXPECT_EQ(result.value().solver.duration, 0.5);
}

TEST_F(ModelFile, CannotBeRead) {
  EXPECT_EQ(only_fault(folder.at("none.toml")).problem, "no such file");
  EXPECT_EQ(only_fault("").problem, "no such file");
  EXPECT_EQ(only_fault(folder.path().string()).problem, "is a folder, not a file");
  EXPECT_EQ(only_fault(write("empty.toml", "")).problem, "is empty");
  EXPECT_EQ(only_fault(write("large.toml", std::string((64U << 20U) + 1, '\n'))).problem,
            "is larger than 64 MiB");
}

}  // namespace
}  // namespace edda::read_model_test
