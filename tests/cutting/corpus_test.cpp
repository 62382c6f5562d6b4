// Every geometry that ever failed, and model files with random damage, through reader and cut.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"
#include "model/read_model.hpp"

namespace edda::corpus_test {
namespace {

using namespace test;

std::size_t count_in(const std::string& title) {
  return std::stoul(title.substr(title.rfind(':') + 1));
}

TEST(Corpus, IsCutSoundlyInAllDirections) {
  int models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(EDDA_SOURCE_DIR "/tests/corpus")) {
    if (entry.path().extension() != ".toml") continue;
    ++models;
    SCOPED_TRACE(entry.path().filename());
    const auto model = read_model(entry.path().string());
    ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
    const auto result = build_polygons(model.value());
    expect_sound(result, model.value().domain->snap, 2e-8);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result.value().blocks.size(), count_in(model.value().title));
    for (double angle = 5.0; angle < 360.0; angle += 23.7) {
      const auto turned_too = build_polygons(turned(model.value(), angle));
      expect_sound(turned_too, model.value().domain->snap, 2e-8);
    }
  }
  EXPECT_GE(models, 4);
}

constexpr const char* small_model = R"(
[materials.rock]
density = 2700.0
young = 20e9
poisson = 0.25
[joints.rough]
friction_angle = 30.0
[[block]]
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
fixed = true
[[block]]
polygon = [[1, 1], [2, 1], [2, 2], [1, 2]]
[domain]
outline = [[10, 0], [20, 0], [20, 10], [10, 10]]
max_blocks = 2000
[[joint_set]]
angle = 45.0
spacing = 2.0
region = [[11, 2], [18, 2], [18, 9]]
[[trace]]
points = [[11, 1], [12, 5], [21, 7]]
[[opening]]
polygon = [[14, 4], [16, 4], [16, 6], [14, 6]]
[[fixed]]
point = [15, 1]
[[brick_wall]]
origin = [30, 0]
columns = 4
rows = 3
brick = [1.0, 0.5]
[solver]
duration = 0.1
)";

TEST(Corpus, DamagedNumbersGiveASoundCutOrFaultsWithAPlace) {
  std::mt19937 random(7);
  const std::string digits = "0123456789.-e";
  int cut = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string text = small_model;
    const std::size_t begin = text.find("[[block]]"), end = text.find("[solver]");
    for (int k = 0; k <= i % 4; ++k) {
      std::size_t at = begin + random() % (end - begin);
      while (digits.find(text[at]) == std::string::npos) at = begin + random() % (end - begin);
      text[at] = digits[random() % digits.size()];
    }
    const auto model = read_model_text(text, "m.toml");
    if (!model.ok() || !model.value().domain) continue;
    if (model.value().walls.size() == 1 && model.value().walls[0].columns > 1000) continue;
    SCOPED_TRACE(text);
    const auto result = build_polygons(model.value());
    if (result.ok()) {
      ++cut;
      double area = 0.0;
      const auto& blocks = result.value().blocks;
      const std::size_t given =
          blocks.size() - static_cast<std::size_t>(result.value().report.cut_blocks);
      for (std::size_t b = given; b < blocks.size(); ++b) area += moments(blocks[b].rings).area;
      const double area_in = result.value().report.area_in;
      ASSERT_NEAR(area, area_in, 2e-8 * area_in);
    } else {
      ++refused;
      for (const Fault& fault : result.faults()) {
        ASSERT_GT(fault.where.line, 0) << to_string(fault);
        ASSERT_FALSE(fault.problem.empty() || fault.remedy.empty()) << to_string(fault);
      }
    }
  }
  EXPECT_GT(cut, 300);
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace edda::corpus_test
