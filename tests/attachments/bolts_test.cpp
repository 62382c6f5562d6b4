#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "attachments/bolted_blocks.hpp"
#include "attachments/dashpots.hpp"

namespace edda::bolts_test {
namespace {

using test::Bolted;
using test::grouted;

/// Through two blocks, a gap and a third with a notch: bonded where there is rock, two nodes at
/// every face, a dowel from block to block only.
TEST(Bolts, SitInTheBlocksTheyGoThrough) {
  Bolted m;
  m.add({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  m.add({{0, 1}, {2, 1}, {2, 2}, {0, 2}});
  m.add({{0, 2.5}, {2, 2.5}, {2, 4}, {0, 4}, {0, 3.5}, {1.5, 3.25}, {0, 3}});
  m.build();
  m.model.bolts = {grouted({1, 0.2}, {1, 3.9})};
  m.attach();
  ASSERT_TRUE(m.faults.empty());
  const Bolts& b = m.bolts;
  const double low = 3.0 + 0.25 / 1.5, high = 3.5 - 0.25 / 1.5;
  EXPECT_NEAR(std::accumulate(b.bonded.begin(), b.bonded.end(), 0.0),
              0.8 + 1.0 + (low - 2.5) + (3.9 - high), 1e-9);
  std::vector<double> crossings, dowels;
  for (std::size_t k = 0; k + 1 < b.size(); ++k) {
    const Vec2 p = node_place(b, m.blocks, m.state, k) + m.blocks.origin;
    EXPECT_NEAR(p.x, 1.0, 1e-12);
    EXPECT_NEAR(p.y, 0.2 + b.distance[k], 1e-12);
    EXPECT_NEAR(b.distance[k + 1] - b.distance[k], b.length[k], 1e-12);
    EXPECT_LT(b.length[k], b.crossing[k] != 0 ? 0.6 : 0.2 * std::sqrt(200e9 * M_PI * 1e-4 / 1e9));
    if (b.crossing[k] != 0) crossings.push_back(p.y);
    if (b.dowels.stiffness[k] > 0.0) dowels.push_back(p.y);
  }
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_NEAR(crossings[0], 1.0, 1e-9);
  EXPECT_NEAR(crossings[1], 2.0, 1e-9);
  EXPECT_NEAR(crossings[2], low, 1e-9);
  EXPECT_EQ(dowels.size(), 2u);
  EXPECT_EQ(b.slipped, 0.0);
}

/// Put into blocks that have moved, turned and stretched, a bolt is as straight and free of force
/// as in any.
TEST(Bolts, GoInWhereBlocksAreNow) {
  Bolted m;
  m.add({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  m.add({{0, 1}, {2, 1}, {2, 2}, {0, 2}});
  m.build();
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p =
          rotated({1.01 * m.state.position.x[k][i], m.state.position.y[k][i]}, i == 0 ? 0.1 : 0.3);
      m.state.position.x[k][i] = p.x + 0.2;
      m.state.position.y[k][i] = p.y;
    }
  }
  for (Id v = 0; v < m.blocks.vertex_count(); ++v) {
    const Vec2 p = corner_at(m.blocks, m.state.position, v);
    m.blocks.vertex_x[v] = p.x;
    m.blocks.vertex_y[v] = p.y;
  }
  const Vec2 from = centroid(m.state.position, 0), to = centroid(m.state.position, 1);
  m.model.bolts = {grouted(m.blocks.origin + from + Vec2{0.1, 0.2}, m.blocks.origin + to)};
  m.attach();
  ASSERT_TRUE(m.faults.empty()) << to_string(m.faults[0]);
  EXPECT_GT(m.bolts.size(), 10u);
  EXPECT_EQ(std::count(m.bolts.crossing.begin(), m.bolts.crossing.end(), 1), 1);
  for (std::size_t k = 0; k < m.bolts.size(); ++k) {
    EXPECT_NEAR(m.bolts.bars.force[k], 0.0, 1e-3);
    EXPECT_NEAR(m.bolts.bonds.force[k], 0.0, 1e-3);
  }
}

TEST(Bolts, PatternStandsRoundItsOpening) {
  Model model;
  Opening opening;
  opening.name = "o";
  opening.polygon = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  model.openings = {opening};
  BoltPattern pattern;
  pattern.name = "p";
  pattern.opening = "o";
  pattern.from_angle = 0.0;
  pattern.to_angle = 180.0;
  pattern.count = 3;
  pattern.length = 1.5;
  model.bolt_patterns = {pattern};
  std::vector<Bolt> bolts = all_bolts(model);
  ASSERT_EQ(bolts.size(), 3u);
  EXPECT_EQ(bolts[1].name, "p.1");
  const std::vector<Vec2> from{{4, 1}, {2, 2}, {0, 1}}, to{{5.5, 1}, {2, 3.5}, {-1.5, 1}};
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(norm(bolts[q].from - from[q]), 0.0, 1e-12);
    EXPECT_NEAR(norm(bolts[q].to - to[q]), 0.0, 1e-12);
  }
  // All the way round, no bolt stands where the first one does.
  model.bolt_patterns[0].to_angle = 360.0;
  model.bolt_patterns[0].count = 4;
  bolts = all_bolts(model);
  EXPECT_NEAR(norm(bolts[3].from - Vec2{2, 0}), 0.0, 1e-12);
}

/// Of a whole edge that moves as one: rho c L along and across, however the edge lies; half of it
/// where the boundary covers half. In a meshed block all act on its corners.
void expect_impedance_of_rock(bool meshed) {
  Bolted m;
  if (meshed) {
    m.model.deformation = BlockDeformation::zones;
    m.model.zones = ZoneInputs{0.9, {}, {}};
  }
  m.add({{0, 0}, {1, 0.75}, {4, 3}, {1, 7}});
  m.model.thickness = 2.0;
  for (const double part : {1.0, 0.5}) {
    m.model.boundaries = {test::boundary_along(BoundaryType::viscous, {0, 0}, part * Vec2{4, 3})};
    if (part == 1.0) m.build();
    const Result<Dashpots> found = attach_dashpots(m.model, m.blocks);
    ASSERT_TRUE(found.ok());
    double xx = 0.0, yy = 0.0, xy = 0.0, moment = 0.0;
    for (const Dashpot& d : found.value().points) {
      EXPECT_EQ(d.node != no_id, meshed);
      if (meshed) {
        EXPECT_EQ(d.weight[1], m.blocks.weight[1][d.node]);
        EXPECT_NEAR(cross(d.middle + m.blocks.origin, {0.8, 0.6}), 0.0, 1e-9);
      }
      moment +=
          d.length * dot(weighted(d.weight, m.blocks.node_x, m.blocks.node_y, 0) + m.blocks.origin,
                         {0.8, 0.6});
      xx += d.cxx;
      yy += d.cyy;
      xy += d.cxy;
    }
    const double mu = 1e9 / 2.4, lambda = 1e9 * 0.2 / (1.2 * 0.6), length = 2.0 * 5.0 * part;
    const double cn = std::sqrt(2600.0 * (lambda + 2.0 * mu)) * length,
                 ct = std::sqrt(2600.0 * mu) * length;
    const Vec2 t{0.8, 0.6}, n{0.6, -0.8};
    EXPECT_NEAR(moment, 0.5 * std::pow(5.0 * part, 2), 1e-9);
    EXPECT_NEAR(xx, cn * n.x * n.x + ct * t.x * t.x, 1e-9 * cn);
    EXPECT_NEAR(yy, cn * n.y * n.y + ct * t.y * t.y, 1e-9 * cn);
    EXPECT_NEAR(xy, cn * n.x * n.y + ct * t.x * t.y, 1e-9 * cn);
  }
}

TEST(Dashpots, HaveTheImpedanceOfTheRock) {
  for (const bool meshed : {false, true}) expect_impedance_of_rock(meshed);
}

}  // namespace
}  // namespace edda::bolts_test
