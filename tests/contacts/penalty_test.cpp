// The stiffness of joints that give none (theory, section 4.2).
#include <gtest/gtest.h>

#include <string>

#include "blocks/build_blocks.hpp"
#include "contacts/laws.hpp"
#include "cutting/build_polygons.hpp"
#include "model/read_model.hpp"

namespace edda::penalty_test {
namespace {

/// A fixed block, a slab of 4 m x 0.5 m, a column of 0.5 m x 2 m of rock half as stiff, and a
/// square of 0.1 m; on each of them the lowest edge is the first.
struct Scene {
  BlockSet blocks;
  LawTable laws;

  explicit Scene(const std::string& contact) {
    const auto block = [](const std::string& more, const std::string& polygon) {
      return "[[block]]\n" + more + "polygon = " + polygon + "\n";
    };
    Result<Model> read = read_model_text(
        "[materials.hard]\ndensity = 2500\nyoung = 10e9\npoisson = 0.2\n[materials.soft]\n"
        "density = 2500\nyoung = 5e9\npoisson = 0.2\n[joints.j]\nfriction_angle = 30\n[contact]\n"
        "joint = 'j'\n" +
            contact +
            block("material = 'hard'\nfixed = true\n", "[[0, 0], [10, 0], [10, 7], [0, 7]]") +
            block("material = 'hard'\n", "[[20, 0], [24, 0], [24, 0.5], [20, 0.5]]") +
            block("material = 'soft'\n", "[[30, 0], [30.5, 0], [30.5, 2], [30, 2]]") +
            block("material = 'hard'\n", "[[40, 0], [40.1, 0], [40.1, 0.1], [40, 0.1]]") +
            "[solver]\nduration = 1\n",
        "penalty.toml", {});
    EXPECT_TRUE(read.ok()) << to_string(read.faults()[0]);
    const Result<PolygonSet> cut = build_polygons(read.value());
    blocks = build_blocks(read.value(), cut.value());
    laws = build_laws(read.value());
  }
  double stiffness(std::size_t i, std::size_t j) const {
    return laws.normal_stiffness(laws.rows[0],
                                 sides_of(blocks, blocks.vertex_begin[i], blocks.vertex_begin[j]));
  }
};

TEST(Penalty, FollowsFromTheBlocksBehindIt) {
  const Scene s("");
  const double slab = 0.5 / 10e9, column = 2.0 / 5e9, grain = 0.1 / 10e9;
  const auto expect = [&](std::size_t i, std::size_t j, double k) {
    EXPECT_NEAR(s.stiffness(i, j), k, 1e-9 * k) << i << ' ' << j;
    EXPECT_NEAR(s.stiffness(j, i), k, 1e-9 * k) << i << ' ' << j;
  };
  expect(1, 1, 20.0 / slab);
  expect(3, 1, 20.0 / (0.5 * (grain + slab)));
  expect(1, 2, 20.0 / (4.0 * slab));  // of blocks so different, four times the smaller
  expect(3, 2, 20.0 / (4.0 * grain));
  expect(0, 1, 20.0 / slab);  // a fixed block counts as the other
  expect(0, 2, 20.0 / column);
  const Id e = s.blocks.vertex_begin[1];
  EXPECT_NEAR(s.laws.normal_stiffness(s.laws.rows[0], beside_much_larger(s.blocks, e)),
              20.0 / (4.0 * slab), 1e-9 * 20.0 / slab);
  EXPECT_NEAR(
      s.laws.shear_stiffness(s.laws.rows[0], sides_of(s.blocks, e, s.blocks.vertex_begin[3])),
      20.0 / (0.5 * (grain + slab)), 1e-9 * 20.0 / slab);
}

/// A given spring stands at each end of the shorter edge.
TEST(Penalty, AsGiven) {
  const Scene s("normal_stiffness = 3e9\n");
  EXPECT_NEAR(s.stiffness(1, 2), 2.0 * 3e9 / 0.5, 1.0);
  EXPECT_NEAR(s.stiffness(0, 1), 2.0 * 3e9 / 4.0, 1.0);
}

}  // namespace
}  // namespace edda::penalty_test
