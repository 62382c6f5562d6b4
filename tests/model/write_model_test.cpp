// Written models, read again; and the table of all keys.
#include "model/write_model.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "model/base_model.hpp"
#include "model/every_key.hpp"
#include "model/read_or_fail.hpp"
#include "model/table/keys.hpp"

namespace edda::write_model_test {
namespace {

using testing::every_key;
using testing::every_slope_key;
using testing::every_weight_key;
using testing::every_zones_key;
using testing::read_or_fail;

TEST(WriteModel, SlopeComesBack) {
  std::string text(every_key);
  const std::string outline = "outline = [[10, 0], [20, 0], [20, 10], [10, 10]]\n";
  text.erase(text.find(outline), outline.size());
  const Model second = read_or_fail(to_toml(read_or_fail(text + every_slope_key)));
  EXPECT_EQ(second.slope->toe, (Vec2{12, 2}));
  EXPECT_EQ(second.slope->height, 6.0);
  EXPECT_EQ(second.slope->face_angle, 80.0);
  EXPECT_EQ(second.slope->base_y, 0.5);
  EXPECT_EQ(second.slope->extent, (Vec2{10, 20}));
  EXPECT_EQ(second.slope->benches, 2);
  EXPECT_EQ(second.slope->bench_width, 1.5);
  EXPECT_EQ(second.domain->outline.size(), 8U);
}

TEST(WriteModel, WeightOfTheRockComesBack) {
  std::string text(every_key);
  const std::size_t from = text.find("[initial_stress]");
  text.replace(from, text.find("[[boundary]]") - from, every_weight_key);
  const Model second = read_or_fail(to_toml(read_or_fail(text)));
  ASSERT_TRUE(second.initial_stress);
  EXPECT_EQ(second.initial_stress->k0, 1.2);
  EXPECT_EQ(second.initial_stress->k0_out, 0.9);
  EXPECT_EQ(second.initial_stress->surface_y, 150.0);
  EXPECT_EQ(second.initial_stress->surface, SurfaceKind::level);
  EXPECT_FALSE(second.initial_stress->stress);
}

TEST(WriteModel, ImplicitMethodComesBack) {
  std::string text(every_key);
  text.replace(text.find("method = \"edda\""), 15, "method = \"dda\"");
  text.replace(text.find("dynamic = true"), 14, "dynamic = false");
  text.replace(text.find("local = 0.1"), 11, "local = 0.0");
  // Keys of the explicit method alone.
  const std::size_t laws = text.find("[joints.weak]");
  text.erase(laws, text.find("[contact]") - laws);
  const std::size_t driven = text.find("[[boundary]]\nname = \"far\"");
  text.erase(driven, text.find("[[load]]") - driven);
  const std::size_t flow = text.find("[[water]]\nlevel");
  text.erase(flow, text.find("[[shaking]]\nname") - flow);
  const std::size_t wave = text.find("[[shaking]]\nacceleration");
  text.erase(wave, text.find("[[monitor]]") - wave);
  text.erase(text.find("restitution = 0.4\n"), 18);
  const std::string install = "install = [\"round\", \"shell\", \"second\"]\n";
  text.erase(text.find(install), install.size());
  const std::string fill = "fill = [\"paste\", \"bund\"]\n";
  text.erase(text.find(fill), fill.size());
  const std::size_t change = text.find("change = ");
  text.erase(change, text.find('\n', change) + 1 - change);
  const std::size_t push = text.find("[[stage]]\nname = \"push\"");
  text.erase(push, text.find("[solver]") - push);
  text.replace(text.find("duration = \"125.1 s\""), 20, "duration = 120.0");
  const Model second = read_or_fail(to_toml(read_or_fail(text)));
  EXPECT_EQ(second.solver.method, Method::dda);
  EXPECT_FALSE(second.solver.dynamic);
}

TEST(WriteModel, RockThatYieldsComesBack) {
  const Model first = read_or_fail(every_zones_key);
  const std::string written = to_toml(first);
  const Model second = read_or_fail(written);
  EXPECT_EQ(to_toml(second), written);
  ASSERT_TRUE(second.zones);
  EXPECT_EQ(second.zones->size, 0.5);
  EXPECT_EQ(second.zones->growth, 0.2);
  const Material& rock = second.materials[0];
  EXPECT_EQ(rock.zone_size, 0.4);
  ASSERT_TRUE(rock.yield);
  EXPECT_EQ(rock.yield->peak.friction_angle, 35.0);
  EXPECT_EQ(rock.yield->peak.cohesion, 1e6);
  EXPECT_EQ(rock.yield->peak.tensile_strength, 2e5);
  EXPECT_EQ(rock.yield->peak.dilation_angle, 5.0);
  EXPECT_EQ(rock.yield->slip_distance, 0.008);
  EXPECT_EQ(rock.yield->residual->friction_angle, 30.0);
  EXPECT_FALSE(rock.yield->residual->tensile_strength);
  EXPECT_EQ(rock.foliation->angle, 20.0);
  EXPECT_EQ(second.materials[1].yield->peak.gsi, 45.0);
  EXPECT_EQ(second.materials[2].yield->peak.m, 0.9);
  EXPECT_EQ(second.materials[3].foliation->shear_modulus, 8e9);
  ASSERT_EQ(second.stages.size(), 1U);
  ASSERT_EQ(second.stages[0].change.size(), 1U);
  EXPECT_EQ(second.stages[0].change[0].joints, none);
  EXPECT_EQ(second.stages[0].change[0].opening, none);
  EXPECT_EQ(second.stages[0].change[0].material, 1);
  EXPECT_EQ(second.stages[0].change[0].row, 2);
}

TEST(WriteModel, EveryKeyOfTheTableIsInTheTest) {
  for (const Section& section : sections()) {
    for (const Key& key : section.keys) {
      const std::string start = std::string(key.name) + " = ";
      const std::string all = every_key + every_slope_key + every_weight_key + every_zones_key;
      EXPECT_TRUE(all.starts_with(start) || all.find('\n' + start) != std::string::npos)
          << section.name << '.' << key.name;
    }
  }
}

TEST(WriteModel, DefaultsComeBack) {
  const Model first = read_or_fail(testing::base_model);
  const std::string written = to_toml(first);
  const Model second = read_or_fail(written);
  EXPECT_EQ(to_toml(second), written);
  EXPECT_EQ(second.output.history_every, first.output.history_every);
  EXPECT_EQ(second.domain->snap, first.domain->snap);
  EXPECT_NE(written.find("time_step = \"auto\""), std::string::npos);
  EXPECT_NE(written.find("normal_stiffness = \"auto\""), std::string::npos);
}

TEST(Keys, AreWellFormed) {
  std::set<std::string_view> section_names;
  for (const Section& section : sections()) {
    EXPECT_TRUE(section_names.insert(section.name).second) << section.name;
    EXPECT_TRUE(section.meaning.ends_with('.')) << section.name;
    std::set<std::string_view> names;
    for (const Key& key : section.keys) {
      EXPECT_TRUE(names.insert(key.name).second) << section.name << '.' << key.name;
      EXPECT_TRUE(key.meaning.ends_with('.')) << section.name << '.' << key.name;
      EXPECT_FALSE(key.otherwise.required && !key.otherwise.text.empty());
      EXPECT_FALSE(expected(key).empty());
    }
  }
}

/// Only values that follow from a duration are left out where there is none; a wrong number is
/// still reported.
TEST(WriteModel, LeavesOutWhatADurationWouldGiveAlone) {
  const auto text = testing::base_with("duration = 0.1\n", "");
  auto model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
  ASSERT_TRUE(model.ok());
  Model m = model.value();
  EXPECT_EQ(to_toml(m).find("duration = "), std::string::npos);
  EXPECT_EQ(to_toml(m).find("\nhistory_every = "), std::string::npos);
  m.solver.safety = 0.0;
  EXPECT_NE(to_toml(m).find("safety = 0.0"), std::string::npos);
}

}  // namespace
}  // namespace edda::write_model_test
