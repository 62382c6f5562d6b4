// Models that are too large to be run.
#include "run/size_limits.hpp"

#include <gtest/gtest.h>

#include <string>

#include "model/read_model.hpp"
#include "run/run_model.hpp"

namespace edda::size_limits_test {
namespace {

const std::string head = R"([materials.rock]
density = 2600
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 30
[solver]
duration = 1
)";

Model model_of(const std::string& text) {
  Result<Model> model = read_model_text(head + text, "m.toml");
  return model.ok() ? std::move(model.value()) : Model{};
}

TEST(SizeLimits, WallsThatMemoryCannotHoldAreRefused) {
  const Model model = model_of("[[brick_wall]]\ncolumns = 1000\nrows = 500\nbrick = [1, 0.5]\n");
  ASSERT_EQ(model.walls.size(), 1U);
  EXPECT_FALSE(beyond_memory(model, 4e9));
  const auto fault = beyond_memory(model, 1e9);
  ASSERT_TRUE(fault);
  EXPECT_EQ(to_string(*fault),
            "m.toml:9:1: brick_wall.0.columns: 5e+05 blocks and more need at least 2 GB, and this "
            "machine has 1 GB: give fewer columns or rows");
}

TEST(SizeLimits, CutBlocksAreCountedByHalf) {
  const Model model = model_of(
      "[domain]\noutline = [[0, 0], [100, 0], [100, 100], [0, 100]]\n"
      "[[joint_set]]\nangle = 0\nspacing = 0.5\n[[joint_set]]\nangle = 90\nspacing = 0.5\n");
  ASSERT_TRUE(model.domain);
  EXPECT_FALSE(beyond_memory(model, 0.09e9));  // 40,401 blocks
  const auto fault = beyond_memory(model, 0.08e9);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->where.key, "domain.max_blocks");
}

TEST(SizeLimits, FilesWithoutEndAreRefused) {
  Result<PreparedRun> run =
      prepare_run(model_of("[[brick_wall]]\nrows = 50\nbrick = [1, 0.5]\ncolumns = 50\n"));
  ASSERT_TRUE(run.ok());
  Simulation& sim = run.value().sim;
  EXPECT_FALSE(beyond_disks(sim));
  sim.scene.edit().model.output.every = 1e-8;
  const auto frames = beyond_disks(sim);
  ASSERT_TRUE(frames);
  EXPECT_EQ(to_string(*frames),
            "m.toml: output.every: the files would take at least 1.51e+05 GB: give more time "
            "between frames");
  sim.scene.edit().model.output.every = 1.0;
  sim.scene.edit().model.output.history_every = 1e-12;
  const auto rows = beyond_disks(sim);
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->where.key, "output.history_every");
}

}  // namespace
}  // namespace edda::size_limits_test
