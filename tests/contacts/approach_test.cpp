// How long a list of possible contacts holds, against the distances of all edges.
#include "contacts/approach.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "blocks/build_blocks.hpp"

namespace edda::approach_test {
namespace {

constexpr int columns = 16, rows = 12;
constexpr double reach = 0.08;

struct Rectangle {
  Vec2 low;
  double width = 1.0, height = 1.0;
};

/// Squares of side 1 in a wall with gaps, some of them low, and one long block below.
std::vector<Rectangle> wall_with_gaps(std::mt19937& rng) {
  std::uniform_real_distribution<double> gap(0.0, 0.2);
  std::vector<Rectangle> all{{{-5.0, -2.0}, columns * 1.2 + 10.0, 1.95}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i)
      all.push_back({{1.2 * i + gap(rng), 1.2 * j + gap(rng)}, 1.0, i % 5 == 0 ? 0.3 : 1.0});
  }
  return all;
}

BlockSet blocks_of(const std::vector<Rectangle>& rectangles) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  PolygonSet set;
  for (const auto& [low, width, height] : rectangles) {
    BlockPolygon p;
    p.rings = {{low, low + Vec2{width, 0}, low + Vec2{width, height}, low + Vec2{0, height}}};
    p.joint = {std::vector<Index>(4, none)};
    p.material = 0;
    set.blocks.push_back(p);
  }
  return build_blocks(model, set);
}

struct Moved {
  BlockSet blocks;
  State state;
  Pose pose;
  FaceSet list;
  NeighbourGroups groups;

  explicit Moved(const std::vector<Rectangle>& rectangles) : blocks(blocks_of(rectangles)) {
    state.alive.assign(blocks.size(), 1);
    pose.x = list.built_x = blocks.vertex_x;
    pose.y = list.built_y = blocks.vertex_y;
    list.reach = reach;
    list.rebuilds = 1;
  }
  explicit Moved(std::mt19937& rng) : Moved(wall_with_gaps(rng)) {}

  double approach() { return largest_approach(groups, blocks, state, pose, origin_of(list)); }

  void shift(Id block, Vec2 by) {
    for (Id v = blocks.vertex_begin[block]; v < blocks.vertex_begin[block + 1]; ++v) {
      pose.x[v] = list.built_x[v] + by.x;
      pose.y[v] = list.built_y[v] + by.y;
    }
  }
};

double distance_of(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double s = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
  return norm(p - (a + s * u));
}

/// Least distance now of a vertex and an edge that were `reach` apart or more when the list was
/// made.
double least_unlisted(const Moved& m) {
  const BlockSet& b = m.blocks;
  double least = std::numeric_limits<double>::infinity();
  for (Id v = 0; v < b.vertex_count(); ++v) {
    for (Id e = 0; e < b.vertex_count(); ++e) {
      if (b.vertex_block[v] == b.vertex_block[e]) continue;
      const auto distance = [&](const std::vector<double>& x, const std::vector<double>& y) {
        return distance_of(at(x, y, v), at(x, y, e), at(x, y, b.next[e]));
      };
      if (distance(m.list.built_x, m.list.built_y) >= reach)
        least = std::min(least, distance(m.pose.x, m.pose.y));
    }
  }
  return least;
}

/// Moves everything by `together`, each block by up to `apart` (m) and `turn` (rad).
void move(Moved& m, std::mt19937& rng, Vec2 together, double apart, double turn, double shear) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const BlockSet& b = m.blocks;
  for (Id i = 0; i < b.size(); ++i) {
    const Id first = b.vertex_begin[i];
    const Vec2 pivot = at(m.list.built_x, m.list.built_y, first);
    const Vec2 by = together + apart * Vec2{u(rng), u(rng)} + Vec2{shear * pivot.y, 0.0};
    const double angle = turn * u(rng);
    for (Id v = first; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 arm = at(m.list.built_x, m.list.built_y, v) - pivot;
      const Vec2 p = pivot + by + std::cos(angle) * arm + std::sin(angle) * perp(arm);
      m.pose.x[v] = p.x;
      m.pose.y[v] = p.y;
    }
  }
}

TEST(Approach, NoUnlistedPairIsNearerThanItSays) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int nearly_reached = 0;
  for (int k = 0; k < 30; ++k) {
    Moved m(rng);
    const double apart = 0.03 * u(rng), turn = k % 3 == 0 ? 0.02 * u(rng) : 0.0;
    const double shear = k % 2 == 0 ? 0.01 * u(rng) : 0.0;
    move(m, rng, {50.0 * u(rng), -20.0 * u(rng)}, apart, turn, shear);
    const double approach = m.approach(), least = least_unlisted(m);
    EXPECT_GE(least, reach - approach - 1e-12) << k;
    if (least < reach - 0.2 * approach) ++nearly_reached;
  }
  EXPECT_GT(nearly_reached, 5) << "the bound is too wide to test anything";
}

/// Two blocks in different groups, with a gap of 0.5 m or of many blocks between them: each may
/// move up to the other, and no farther.
TEST(Approach, BlocksThatStoodApartMayApproachByTheGap) {
  for (const double gap : {0.5, 10.0}) {
    for (const bool right : {false, true}) {
      Moved m({{{2.0, 0.0}}, {{3.0 + gap, 0.0}}});
      for (const double part : {0.0, 0.3, 0.9, 0.99, 1.0}) {
        const double by = part * gap;
        m.shift(right ? 0 : 1, {right ? by : -by, 0.0});
        EXPECT_NEAR(least_unlisted(m), gap - by, 1e-12);
        EXPECT_GE(gap - by, reach - m.approach() - 1e-12) << gap << " " << part;
      }
      EXPECT_GE(m.approach(), reach - 1e-12) << "they touch, which no list says";
    }
  }
}

/// Of two blocks beside each other either moves towards the other, wherever a third one puts the
/// borders of their groups, and whichever group begins farther left.
TEST(Approach, IsSeenFromBothSides) {
  for (int k = 0; k < 144; ++k) {
    const Vec2 third{0.5 * (k % 12) - 4.6, 0.5 * (k / 12) - 6.1};
    Moved m({{third}, {{1.9, 1.95}}, {{0.5, 2.7}}});
    m.shift(2, {0.39, 0.0});
    EXPECT_GE(m.approach(), reach - 0.01) << k;
    m.shift(2, {});
    m.shift(1, {-0.39, 0.0});
    EXPECT_GE(m.approach(), reach - 0.01) << k;
  }
}

TEST(Approach, IsThatOfNeighboursAndNotOfTheFastest) {
  std::mt19937 rng(7);
  Moved m(rng);
  move(m, rng, {1000.0, -300.0}, 0.0, 0.0, 0.0);
  EXPECT_LT(m.approach(), 1e-9);
  // A shear over rows 1.2 m high: groups are some three rows high.
  constexpr double shear = 0.01;
  move(m, rng, {}, 0.0, 0.0, shear);
  const double fastest = shear * 1.2 * (rows - 1);
  EXPECT_LT(m.approach(), 0.75 * fastest);
  EXPECT_GT(m.approach(), shear * 1.2);
}

TEST(Approach, OfABlockThatTurnsIsThatOfItsCorners) {
  std::mt19937 rng(8);
  Moved m(rng);
  const BlockSet& b = m.blocks;
  const Id first = b.vertex_begin[0], last = b.vertex_begin[1];
  for (Id v = first; v < last; ++v) m.pose.y[v] += 1e-3 * (m.list.built_x[v] + 5.0);
  EXPECT_GE(m.approach(), 1e-3 * (columns * 1.2 + 10.0));
}

TEST(Approach, IsNotANumberWhereAPositionIsNot) {
  std::mt19937 rng(9);
  Moved m(rng);
  m.pose.y[40] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(m.approach()));
}

TEST(Approach, LeavesOutExcavatedBlocks) {
  std::mt19937 rng(10);
  Moved m(rng);
  m.state.alive[20] = 0;
  for (Id v = m.blocks.vertex_begin[20]; v < m.blocks.vertex_begin[21]; ++v) m.pose.x[v] += 3.0;
  EXPECT_LT(m.approach(), 1e-12);
}

TEST(Approach, TakesTheGroupsOfTheListAnew) {
  std::mt19937 rng(11);
  Moved m(rng);
  move(m, rng, {}, 0.02, 0.0, 0.0);
  EXPECT_GT(m.approach(), 0.01);
  m.list.built_x = m.pose.x;
  m.list.built_y = m.pose.y;
  ++m.list.rebuilds;
  EXPECT_LT(m.approach(), 1e-12);
}

}  // namespace
}  // namespace edda::approach_test
