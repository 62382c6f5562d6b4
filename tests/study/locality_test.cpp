// What is far away does not matter: the verdict of a run until equilibrium and the factor of safety
// stay the same however large, stiff and free the ground is, whatever else stands on it, and when
// the model is mirrored, scaled and renumbered. tools/study-verdicts does this for many models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "run/prepared.hpp"
#include "run/run_model.hpp"
#include "study/sliding_block.hpp"

namespace edda::locality_test {
namespace {

using testing::found;
using testing::model_of;

constexpr double degree = std::numbers::pi / 180.0;

using Polygon = std::vector<Vec2>;

struct Scene {
  const char* name;
  std::vector<Polygon> blocks;
  Polygon profile;  ///< of the ground, from the left to the right
  double friction;  ///< degrees
  double factor;
  bool by_kh = false;
};

struct Change {
  const char* name;
  bool is_fixed = false, beside = false, backwards = false;
  double wider = 0.0, stiffer = 1.0;
  std::function<Vec2(Vec2)> place = [](Vec2 p) { return p; };
};

Scene slab(double slope, double factor) {
  const double c = std::cos(slope * degree), s = std::sin(slope * degree);
  const auto at = [&](double u, double v) { return Vec2{u * c - v * s, u * s + v * c}; };
  return {"slab",
          {{at(20, 0), at(23, 0), at(23, 0.8), at(20, 0.8)}},
          {{-50, 0}, {0, 0}, at(60, 0), {100, 60 * s}},
          std::atan(factor * std::tan(slope * degree)) / degree,
          factor};
}

Scene stack(double width, double height, int count, double friction) {
  Scene scene{"stack", {}, {{-50, 0}, {100, 0}}, friction, 0.0, true};
  for (int k = 0; k < count; ++k) {
    scene.blocks.push_back(
        {{0, k * height}, {width, k * height}, {width, (k + 1) * height}, {0, (k + 1) * height}});
  }
  scene.factor = std::min(std::tan(friction * degree), width / (count * height));
  return scene;
}

std::string polygon(Polygon points, const Change& change, const std::string& keys) {
  for (Vec2& p : points) p = change.place(p);
  double area = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
    area += cross(points[k], points[(k + 1) % points.size()]);
  if (area < 0.0) std::reverse(points.begin(), points.end());
  std::string text = "[[block]]\n" + keys + "polygon = [";
  for (const Vec2 p : points)
    text += "[" + fmt::format("{}", p.x) + "," + fmt::format("{}", p.y) + "],";
  return text + "]\n";
}

std::string model(const Scene& scene, const Change& change) {
  Polygon ground = scene.profile;
  const double depth = 50.0 + change.wider;
  ground.front().x -= change.wider;
  ground.back().x += change.wider;
  ground.push_back({ground.back().x, -depth});
  ground.push_back({ground.front().x, -depth});
  std::vector<std::string> all{polygon(ground, change, change.is_fixed ? "fixed = true\n" : "")};
  for (const Polygon& block : scene.blocks) all.push_back(polygon(block, change, ""));
  if (change.beside) {
    all.push_back(polygon({{300, 0}, {400, 0}, {400, 1}, {300, 1}}, change, "fixed = true\n"));
    for (int k = 0; k < 30; ++k) {
      const double x = 301.0 + 3.0 * k;
      all.push_back(polygon({{x, 1}, {x + 2, 1}, {x + 2, 1.4}, {x, 1.4}}, change, ""));
    }
  }
  if (change.backwards) std::reverse(all.begin(), all.end());
  std::string text = fmt::format(
      "[materials.rock]\ndensity = 2600\nyoung = {}\npoisson = 0.25\n[joints.j]\nfriction_angle = "
      "{}\n[[stage]]\nuntil = 'equilibrium'\n[fos]\ntolerance = 0.004\nvary = '{}'\n",
      5e9 * change.stiffer, scene.friction, scene.by_kh ? "kh" : "strength");
  for (const std::string& block : all) text += block;
  if (change.is_fixed) return text;
  const auto along = [&](Vec2 p, Vec2 q) {
    p = change.place(p);
    q = change.place(q);
    return fmt::format("[[boundary]]\nalong = [[{}, {}], [{}, {}]]\n", p.x, p.y, q.x, q.y);
  };
  const Vec2 left = ground.front(), right = scene.profile.back() + Vec2{change.wider, 0.0};
  text += along({left.x, -depth}, {right.x, -depth}) + "type = 'fixed'\n";
  text += along({left.x, -depth}, left) + "type = 'roller'\n";
  return text + along({right.x, -depth}, right) + "type = 'roller'\n";
}

std::vector<Change> changes(bool by_kh) {
  std::vector<Change> all(8);
  all[0].name = "as it is";
  all[1].name = "fixed";
  all[1].is_fixed = true;
  all[2].name = "ground ten times larger";
  all[2].wider = 450.0;
  all[3].name = "softer";
  all[3].stiffer = 0.1;
  all[4].name = "stiffer";
  all[4].stiffer = 10.0;
  all[5].name = "beside others at rest";
  all[5].beside = true;
  all[6].name = "renumbered";
  all[6].backwards = true;
  all[7].name = by_kh ? "larger" : "mirrored and larger";
  all[7].stiffer = 10.0;
  all[7].place = [by_kh](Vec2 p) { return Vec2{by_kh ? 10.0 * p.x : -10.0 * p.x, 10.0 * p.y}; };
  return all;
}

TEST(Locality, WhatIsFarAwayChangesNeitherVerdictNorFactor) {
  const std::vector<Scene> scenes{slab(25.0, 0.9), slab(38.0, 1.1), stack(1.0, 0.6, 3, 30.0),
                                  stack(1.2, 0.5, 2, 26.0)};
  for (const Scene& scene : scenes) {
    for (const Change& change : changes(scene.by_kh)) {
      SCOPED_TRACE(fmt::format("{} of {:.3g}, {}", scene.name, scene.factor, change.name));
      const std::string text = model(scene, change);
      const FosResult r = found(text);
      ASSERT_TRUE(r.factor) << r.message;
      EXPECT_NEAR(*r.factor / scene.factor, 1.0, 0.007);
      Result<PreparedRun> run = prepare_run(model_of(text));
      ASSERT_TRUE(run.ok());
      const Result<Outcome> outcome = run_model(run.value(), {});
      ASSERT_TRUE(outcome.ok());
      const bool stands =
          outcome.value().status == Status::equilibrium && outcome.value().failed_checks.empty();
      EXPECT_EQ(stands, scene.by_kh || scene.factor > 1.0) << outcome.value().message;
    }
  }
}

const char* const until_equilibrium = "[[stage]]\nuntil = 'equilibrium'\n";

/// A wedge in the roof of a tunnel, a twentieth of the size of the ground beside it: its faces are
/// 35 degrees off the vertical, so that no stress holds it with less friction than that.
TEST(Locality, ASmallWedgeFallsOutOfALargeRoof) {
  const std::string text =
      "[materials.rock]\ndensity = 2600\nyoung = 2e10\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 25\n[domain]\noutline = [[-30, -30], [30, -30], [30, 30], [-30, 30]]\n"
      "[[trace]]\npoints = [[-1.2, 5], [16.3051884552, 30]]\n"
      "[[trace]]\npoints = [[1.2, 5], [-16.3051884552, 30]]\n[[opening]]\nname = 't'\n"
      "shape = { kind = 'rectangle', at = [0, 0], width = 6, height = 5 }\n"
      "[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n[[boundary]]\n"
      "sides = ['bottom']\ntype = 'fixed'\n[initial_stress]\nk0 = 0.5\nsurface_y = 30\n"
      "[[stage]]\nname = 'in situ'\nuntil = 'equilibrium'\n[[stage]]\nname = 'dig'\n"
      "until = 'equilibrium'\nexcavate = ['t']\n";
  const testing::Ran run = testing::ran(text);
  const BlockSet& blocks = run.ready.sim.scene->blocks;
  std::size_t wedge = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks.area[i] < blocks.area[wedge]) wedge = i;
  EXPECT_LT(blocks.area[wedge], 2.1);
  EXPECT_EQ(run.outcome.loose, 1U) << run.outcome.message;
  const std::string name = fmt::format("come loose: block {} (moved", wedge);
  EXPECT_NE(run.outcome.message.find(name), std::string::npos) << run.outcome.message;
  ASSERT_EQ(run.outcome.failed_checks.size(), 1U);
  EXPECT_TRUE(
      run.outcome.failed_checks[0].starts_with("number of blocks that have come loose is 1"))
      << run.outcome.failed_checks[0];
  const FosResult r = found(text);
  ASSERT_TRUE(r.factor && r.mechanism) << r.message;
  EXPECT_LT(*r.factor, 1.005 * std::tan(25.0 * degree) / std::tan(35.0 * degree));
  EXPECT_GT(*r.factor, 0.5);
  ASSERT_EQ(r.mechanism->blocks.size(), 1U);
  EXPECT_EQ(r.mechanism->blocks[0].id, static_cast<Id>(wedge));
}

/// A dry wall on level ground of this stiffness, which settles by millimetres to centimetres.
std::string wall_on_ground(double young) {
  return "[materials.brick]\ndensity = 2000\nyoung = 5e9\npoisson = 0.2\n[materials.soil]\n"
         "density = 2000\nyoung = " +
         fmt::format("{}", young) +
         "\npoisson = 0.3\n[joints.j]\nfriction_angle = 35\n[[block]]\nmaterial = 'soil'\n"
         "polygon = [[-20, -40], [22.5, -40], [22.5, 0], [-20, 0]]\n[[boundary]]\n"
         "sides = ['bottom']\ntype = 'fixed'\n[[boundary]]\nalong = [[-20, -40], [-20, 0]]\n"
         "type = 'roller'\n[[boundary]]\nalong = [[22.5, -40], [22.5, 0]]\ntype = 'roller'\n"
         "[[brick_wall]]\ncolumns = 5\nrows = 6\nbrick = [0.5, 0.25]\n"
         "material = 'brick'\n";
}

TEST(Locality, AWallStandsOnSoftGround) {
  for (const double young : {0.5e9, 5e9}) {
    const testing::Ran run = testing::ran(wall_on_ground(young) + until_equilibrium);
    EXPECT_EQ(run.outcome.status, Status::equilibrium) << run.outcome.message;
    EXPECT_TRUE(run.outcome.failed_checks.empty()) << run.outcome.failed_checks[0];
    EXPECT_EQ(run.outcome.loose, 0U);
  }
}

/// Its limit is 0.616 as rigid blocks, 0.583 where joints slide without dilating.
TEST(Locality, AWallOnSoftGroundYieldsAtTheLimitOfRigidBlocks) {
  const FosResult r = found(wall_on_ground(0.5e9) +
                            "[fos]\nvary = 'kh'\nbracket = [0.575, 0.62]\ntolerance = 0.1\n");
  ASSERT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_EQ(*r.holds, 0.575) << r.message;
  EXPECT_EQ(*r.fails, 0.62) << r.message;
}

}  // namespace
}  // namespace edda::locality_test
