// The paper's contacts, from known answers of single vertices on edges.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/build_blocks.hpp"
#include "cutting/build_polygons.hpp"
#include "model/read_model.hpp"
#include "paper/points.hpp"

namespace edda::points_test {
namespace {

/// Blocks, fixed or free, and their contacts as drawn.
struct Scene {
  BlockSet blocks;
  State state;
  Pose pose;
  LawTable laws;
  PointSet points;
  BodyVectors on;  ///< those of the contacts

  explicit Scene(const std::string& shapes, double friction = 30.0) {
    Result<Model> model = read_model_text(
        "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = " +
            std::to_string(friction) +
            "\n[contact]\nmodel = \"points\"\nnormal_stiffness = 1e8\nshear_stiffness = 4e7\n" +
            shapes + "[solver]\nduration = 1\n",
        "m.toml", {});
    EXPECT_TRUE(model.ok()) << to_string(model.faults()[0]);
    const Result<PolygonSet> cut = build_polygons(model.value());
    EXPECT_TRUE(cut.ok());
    blocks = build_blocks(model.value(), cut.value());
    state = initial_state(blocks, cut.value());
    laws = build_laws(model.value());
    pose.x.resize(blocks.vertex_count());
    pose.y = pose.x;
    for (std::size_t i = 0; i < blocks.size(); ++i)
      place_vertices(blocks, state.position, i, pose.x, pose.y);
    find_points(points, blocks, state, pose, laws, 0.1);
    move();
  }
  void move() {
    move_points(points, blocks, pose, laws);
    on = zero_vectors(blocks);
    sum_points(on, blocks, points, pose);
  }
  /// Moves block i as a whole.
  void shift(Id i, Vec2 by) {
    for (Id v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
      pose.x[v] += by.x;
      pose.y[v] += by.y;
    }
    move();
  }
  Vec2 force_on(std::size_t i) const {
    const NodeVectors f = vectors_of(on, i);
    return f[0] + f[1] + f[2];
  }
  /// Moment about the origin of the blocks' coordinates, N m; the nodes as drawn.
  double moment_on(std::size_t i) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += cross({state.position.x[k][i], state.position.y[k][i]}, {on.x[k][i], on.y[k][i]});
    return sum;
  }
  /// The only contact.
  std::size_t closed() const {
    EXPECT_EQ(closed_points(points), 1u);
    std::size_t k = 0;
    while (k < points.size() && points.closed[k] == 0.0) ++k;
    return k;
  }
};

std::string block(const std::string& polygon, const char* more = "") {
  return "[[block]]\npolygon = " + polygon + "\n" + more;
}

/// A wedge whose tip is `depth` inside a fixed block.
std::string wedge(double depth) {
  const auto at = [](double x, double y) {
    return "[" + std::to_string(x) + "," + std::to_string(y) + "]";
  };
  return block("[[-2,-1],[2,-1],[2,0],[-2,0]]", "fixed = true\n") +
         block("[" + at(0.5, -depth) + "," + at(1.5, 1.0) + "," + at(-0.5, 1.0) + "]");
}

TEST(Points, PressByDepth) {
  const Scene s(wedge(0.001));
  const std::size_t k = s.closed();
  EXPECT_NEAR(s.points.normal[k], 1e8 * 0.001, 1e-6);
  EXPECT_EQ(s.points.shear[k], 0.0);
  EXPECT_NEAR(norm(s.force_on(1) - Vec2{0.0, 1e5}), 0.0, 1e-5);
  EXPECT_NEAR(norm(s.force_on(0) + s.force_on(1)), 0.0, 1e-5);
}

TEST(Points, NothingWhereNothingIsEntered) {
  Scene s(wedge(-0.001));
  EXPECT_EQ(closed_points(s.points), 0u);
  EXPECT_EQ(norm(s.force_on(1)), 0.0);
  s.shift(1, {0.0, -0.002});
  EXPECT_EQ(closed_points(s.points), 1u);
  s.shift(1, {0.0, 0.002});
  EXPECT_EQ(closed_points(s.points), 0u);
  EXPECT_EQ(norm(s.force_on(1)), 0.0);
}

TEST(Points, StickUpToFrictionAndSlideBeyond) {
  Scene s(wedge(0.001));
  const std::size_t k = s.closed();
  s.shift(1, {0.0005, 0.0});
  EXPECT_NEAR(norm(s.force_on(1) - Vec2{-4e7 * 0.0005, 1e5}), 0.0, 1e-5);
  EXPECT_EQ(s.points.slides[k], 0.0);
  const double limit = 1e5 * std::tan(30.0 * std::acos(-1.0) / 180.0);
  s.shift(1, {0.01, 0.0});
  EXPECT_NEAR(norm(s.force_on(1) - Vec2{-limit, 1e5}), 0.0, 1e-5);
  EXPECT_EQ(s.points.slides[k], 1.0);
  // In the reverse direction it sticks at once at the point to which it slid.
  s.shift(1, {-0.0001, 0.0});
  EXPECT_NEAR(s.force_on(1).x, -limit + 4e7 * 0.0001, 1e-5);
  EXPECT_EQ(s.points.slides[k], 0.0);
  EXPECT_EQ(s.points.slipped[k], 1.0);
}

TEST(Points, FrictionTakesItsForceTimesTheWay) {
  Scene s(wedge(0.001));
  const double limit = 1e5 * std::tan(30.0 * std::acos(-1.0) / 180.0);
  s.shift(1, {limit / 4e7, 0.0});
  EXPECT_NEAR(s.points.friction + s.points.due, 0.0, 1e-9 * limit);
  for (int n = 0; n < 10; ++n) s.shift(1, {1e-4, 0.0});
  EXPECT_NEAR(s.points.friction + s.points.due, limit * 1e-3, 1e-9 * limit);
  for (int n = 0; n < 2; ++n) s.shift(1, {-limit / 4e7, 0.0});  // in reverse, by springs alone
  EXPECT_NEAR(s.points.friction + s.points.due, limit * 1e-3, 1e-9 * limit);
}

/// Eq. 30 with Eq. 31 makes no moment; Eq. 34 with Eq. 35 one of T times the depth, as printed.
TEST(Points, MomentIsThatOfEquation35) {
  Scene s(wedge(0.001));
  EXPECT_NEAR(s.moment_on(0) + s.moment_on(1), 0.0, 1e-5);
  s.shift(1, {0.0005, 0.0});
  s.state.position.x[0][1] += 0.0005;
  s.state.position.x[1][1] += 0.0005;
  s.state.position.x[2][1] += 0.0005;
  EXPECT_NEAR(norm(s.force_on(0) + s.force_on(1)), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(s.moment_on(0) + s.moment_on(1)), 4e7 * 0.0005 * 0.001, 1e-5);
}

/// First entrance: a corner is in contact with the edge that it penetrates less, and keeps it.
TEST(Points, KeepTheEdgeEntered) {
  // The lower right corner of the upper block, beside the upper left one of the other.
  Scene s(block("[[0,0],[1,0],[1,1],[0,1]]", "fixed = true\n") +
          block("[[-1.003,1.001],[0.003,1.001],[0.003,2],[-1.003,2]]"));
  EXPECT_EQ(closed_points(s.points), 0u);
  s.shift(1, {0.0, -0.002});
  double normal = 0.0;
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    if (s.points.closed[k] == 0.0) continue;
    EXPECT_NEAR(std::abs(s.points.normal[k]), 1e5, 1e-3);
    normal += s.points.normal[k];
  }
  EXPECT_NEAR(normal, 2e5, 1e-2);  // the corner of the one, and that of the other
  EXPECT_NEAR(s.force_on(1).y, 2e5, 1e-2);
  s.shift(1, {-0.0025, 0.0});  // penetration is now less sideways
  EXPECT_NEAR(s.force_on(1).y, 2e5, 1e-2);
}

TEST(Points, MemoryOutlivesASearch) {
  Scene s(wedge(0.001));
  s.shift(1, {0.0005, 0.0});
  const Vec2 before = s.force_on(1);
  find_points(s.points, s.blocks, s.state, s.pose, s.laws, 0.3);
  EXPECT_EQ(s.force_on(1), before);
  s.move();
  EXPECT_EQ(s.force_on(1), before);
}

}  // namespace
}  // namespace edda::points_test
