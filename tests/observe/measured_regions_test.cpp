// Mean stress and strain of a region: of motions whose strain is known, whatever the blocks.
#include "observe/measured_regions.hpp"

#include <gtest/gtest.h>

#include "run/prepared.hpp"
#include "step/changes.hpp"

namespace edda::measured_regions_test {
namespace {

using testing::prepared;

const std::string ground = R"(gravity = [0, 0]
[materials.rock]
density = 2600
young = 1e10
poisson = 0.25
[joints.j]
friction_angle = 40
[domain]
outline = [[100, 0], [110, 0], [110, 8], [100, 8]]
joint = 'j'
[initial_stress]
stress = [-3e6, -5e6, 0.5e6]
[[measurement]]
name = 'sample'
)";
// Clockwise, oblique to all joints; its sides cross whatever lies in the middle.
const std::string polygon = "polygon = [[101, 4], [105, 7], [109, 3.5], [105, 0.5]]\n";
const std::string sets =
    "[[joint_set]]\nangle = 10\nspacing = 1.3\n[[joint_set]]\nangle = 75\nspacing = 0.9\n";

struct Scene {
  explicit Scene(const std::string& toml, const std::string& when = "[solver]\nduration = 0.1\n")
      : run(prepared(ground + toml + when)) {}
  Simulation& sim() { return run.sim; }
  /// Displaces every node of every block by u(place).
  template <class Field>
  void displace(const Field& u) {
    const Vec2 origin = sim().scene->blocks.origin;
    BodyVectors& at = sim().motion.state.position;
    for (std::size_t i = 0; i < sim().scene->blocks.size(); ++i) {
      NodeVectors nodes = vectors_of(at, i);
      for (Vec2& p : nodes) p += u(i, p + origin);
      store(nodes, at, i);
    }
  }
  MeanState mean() {
    Instant at;
    observe(sim(), at);
    return mean_state(sim(), at, run.gauges.measurements.at(0));
  }
  PreparedRun run;
};

/// u = (2 x - 3 y, 5 x + 7 y) 1e-4.
Vec2 affine(std::size_t, Vec2 p) {
  return 1e-4 * Vec2{2.0 * p.x - 3.0 * p.y, 5.0 * p.x + 7.0 * p.y};
}

void expect_affine(const Tensor& strain) {
  EXPECT_NEAR(strain.xx, 2e-4, 1e-11);
  EXPECT_NEAR(strain.yy, 7e-4, 1e-11);
  EXPECT_NEAR(strain.xy, 1e-4, 1e-11);
}

TEST(MeasuredRegion, HasTheStrainOfAnAffineMotionHoweverTheRockIsCut) {
  const std::string hole =
      "[[opening]]\nname = 'o'\nshape = { kind = 'circle', at = [103, 5.5], width = 1 }\n";
  const std::string zones = "[zones]\nsize = 0.7\n";
  for (const std::string& rock : {std::string(), sets, hole, sets + hole, zones, zones + hole}) {
    Scene scene(polygon + rock);
    scene.displace(affine);
    SCOPED_TRACE(rock);
    expect_affine(scene.mean().strain);
  }
}

TEST(MeasuredRegion, HasTheStrainOfAnAffineMotionOnTheOutlineOfTheRock) {
  Scene scene("polygon = [[100, 0], [110, 0], [110, 8], [100, 8]]\n" + sets);
  scene.displace(affine);
  expect_affine(scene.mean().strain);
}

TEST(MeasuredRegion, HasTheStressByArea) {
  for (const std::string& rock : {sets, std::string("[zones]\nsize = 0.7\n")}) {
    const BlockStress whole = Scene(polygon + rock).mean().stress;
    EXPECT_NEAR(whole.xx, -3e6, 1.0);
    EXPECT_NEAR(whole.yy, -5e6, 1.0);
    EXPECT_NEAR(whole.zz, -2e6, 1.0);  // nu (xx + yy)
    EXPECT_NEAR(whole.xy, 0.5e6, 1.0);
  }
}

TEST(MeasuredRegion, VoidsCountWithoutStress) {
  // A square of 2 by 2 in the region, whose area is 26.
  const std::string square =
      "[[opening]]\nname = 'o'\npolygon = [[104, 3], [106, 3], [106, 5], [104, 5]]\n";
  const BlockStress open = Scene(polygon + sets + square).mean().stress;
  EXPECT_NEAR(open.yy, -5e6 * (26.0 - 4.0) / 26.0, 1.0);
}

TEST(MeasuredRegion, JointsOpenAndSlipInItsStrain) {
  // Two blocks: the upper one moves by (slip, opening).
  Scene scene(
      "polygon = [[102, 2], [108, 2], [108, 7], [102, 7]]\n"
      "[[trace]]\npoints = [[100, 4], [110, 4]]\n");
  const Vec2 centre = scene.sim().scene->blocks.origin;
  const BlockSet& b = scene.sim().scene->blocks;
  scene.displace([&](std::size_t i, Vec2) {
    return b.centroid_y[i] + centre.y > 4.0 ? Vec2{3e-3, 1e-3} : Vec2{};
  });
  const Tensor strain = scene.mean().strain;
  EXPECT_NEAR(strain.xx, 0.0, 1e-12);
  EXPECT_NEAR(strain.yy, 1e-3 / 5.0, 1e-12);
  EXPECT_NEAR(strain.xy, 0.5 * 3e-3 / 5.0, 1e-12);
}

TEST(MeasuredRegion, ExcavatedBlocksCarryNothingAndAreBridged) {
  Scene scene("polygon = [[102, 2], [108, 2], [108, 7], [102, 7]]\n" + sets +
                  "[[opening]]\nname = 'o'\npolygon = [[107, 6], [110, 6], [110, 8], [107, 8]]\n",
              "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\n"
              "excavate = ['o']\n");
  excavate(scene.sim(), {0});
  BodyVectors& at = scene.sim().motion.state.position;
  scene.displace(affine);
  const BlockSet& b = scene.sim().scene->blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!scene.sim().motion.state.alive[i]) store(NodeVectors{}, at, i);  // wherever they are
  }
  const MeanState mean = scene.mean();
  expect_affine(mean.strain);
  // One of thirty square metres is gone; what is left has the stress of that strain more.
  const double lame = 4e9, shear = 4e9;
  EXPECT_NEAR(mean.stress.yy, 29.0 / 30.0 * (-5e6 + lame * 9e-4 + 2.0 * shear * 7e-4), 2e4);
}

TEST(MeasuredRegion, OutsideTheRockIsAFault) {
  Result<Model> model = read_model_text(
      ground + "polygon = [[101, 1], [105, 1], [105, 20]]\n[solver]\nduration = 0.1\n", "m.toml",
      {});
  ASSERT_TRUE(model.ok());
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  ASSERT_FALSE(run.ok());
  EXPECT_EQ(run.faults()[0].where.key, "measurement.sample.polygon[2]");
}

}  // namespace
}  // namespace edda::measured_regions_test
