// What bolts do while their blocks are moved by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "attachments/bolted_blocks.hpp"
#include "attachments/stored_in_bolts.hpp"

namespace edda::bolt_chain_test {
namespace {

using testing::stored;

using test::Bolted;
using test::grouted;

constexpr double young = 200e9, diameter = 0.02;
const double steel = young * 0.25 * std::numbers::pi * diameter * diameter;

/// Two blocks of 4 m x 2 m, one over the other, 0.5 m apart.
Bolted two_blocks(const Bolt& bolt) {
  Bolted m;
  m.add({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  m.add({{0, 2.5}, {4, 2.5}, {4, 4.5}, {0, 4.5}});
  m.build();
  m.model.bolts = {bolt};
  m.attach();
  EXPECT_TRUE(m.faults.empty());
  return m;
}

Bolt with_ends(Vec2 from, Vec2 to) {
  Bolt b;
  b.type = BoltType::end;
  b.from = from;
  b.to = to;
  b.diameter = diameter;
  b.young = young;
  return b;
}

std::array<Vec2, 3> on_block(const Bolted& m, std::size_t i) {
  BlockForces f{m.blocks, i};
  add_bolts(f, m.bolts);
  return f.sum.nodes;
}
Vec2 whole(const std::array<Vec2, 3>& f) {
  return f[0] + f[1] + f[2];
}

void shift_upper(Bolted& m, Vec2 by) {
  for (std::size_t k = 0; k < 3; ++k) {
    m.state.position.x[k][1] += by.x;
    m.state.position.y[k][1] += by.y;
  }
  update_bolts(m.bolts, m.blocks, m.state);
}

/// Whatever way the blocks have turned and deformed; and they have neither resultant nor moment.
void expect_gradients(Bolt bolt) {
  bolt.pretension = 2e4;
  Bolted m = two_blocks(bolt);
  const double angle[2] = {0.5, 0.53};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p =
          rotated({1.001 * m.state.position.x[k][i], m.state.position.y[k][i]}, angle[i]);
      m.state.position.x[k][i] = p.x + 0.01 * static_cast<double>(i);
      m.state.position.y[k][i] = p.y + 0.02 * static_cast<double>(i);
    }
  }
  const auto energy = [&] {
    update_bolts(m.bolts, m.blocks, m.state);
    return stored(m.bolts);
  };
  energy();
  const std::array<std::array<Vec2, 3>, 2> f{on_block(m, 0), on_block(m, 1)};
  double scale = 0.0, torque = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      scale = std::max(scale, norm(f[i][k]));
      torque += cross({m.state.position.x[k][i], m.state.position.y[k][i]}, f[i][k]);
    }
  }
  EXPECT_GT(scale, 1e4);
  EXPECT_LT(norm(whole(f[0]) + whole(f[1])), 1e-9 * scale);
  EXPECT_LT(std::abs(torque), 1e-8 * scale);
  const double d = 1e-6;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (auto* place : {&m.state.position.x[k][i], &m.state.position.y[k][i]}) {
        const double at = *place;
        *place = at + d;
        const double more = energy();
        *place = at - d;
        const double less = energy();
        *place = at;
        const double force = place == &m.state.position.x[k][i] ? f[i][k].x : f[i][k].y;
        EXPECT_NEAR((less - more) / (2.0 * d), force, 2e-5 * scale);
      }
    }
  }
}

TEST(BoltChain, ForcesAreGradientsOfTheStoredEnergy) {
  Bolt bolt = grouted({1, 0.1}, {2, 4});
  bolt.bond = {1e8, 1e12};
  bolt.dowel = {1e7, 1e12};
  expect_gradients(bolt);
  expect_gradients(with_ends({1, 1}, {2, 4}));
}

/// A bolt within its strength is linear: one increment of Newton's method solves it.
TEST(BoltChain, ElasticOneIsSolvedAtOnce) {
  Bolted m = two_blocks(grouted({1, 0.1}, {2, 4}));
  for (const Vec2 by : {Vec2{0.0, 1e-6}, Vec2{1e-6, 0.0}, Vec2{-1e-6, 1e-6}}) {
    shift_upper(m, by);
    EXPECT_EQ(m.bolts.most_increments, 1);
  }
}

/// What the pull has done is stored, or has gone into slip, yield and rupture.
TEST(BoltChain, BooksEveryJoule) {
  Bolt bolt = grouted({2, 0.1}, {2, 4.4});
  bolt.bond = {1e9, 4e5};
  bolt.yield_stress = 500e6;
  bolt.rupture_strain = 0.02;
  Bolted m = two_blocks(bolt);
  double work = 0.0, opening = 0.0, broke_at = 0.0;
  Vec2 before = whole(on_block(m, 1));
  for (int n = 0; n < 4000; ++n) {
    const double way = n > 600 && n < 700 ? -1.0 : 1.0;
    shift_upper(m, {0.0, way * 5e-6});
    const Vec2 now = whole(on_block(m, 1));
    work -= 0.5 * (before + now).y * way * 5e-6;
    before = now;
    opening += way * 5e-6;
    if (broke_at == 0.0 && m.bolts.bars.broken != std::vector<std::uint8_t>(m.bolts.size(), 0)) {
      broke_at = opening;
    }
  }
  const Bolts& b = m.bolts;
  // Ten diameters stretch beyond yield, and not the half metre of it between the blocks.
  const double plastic = (0.02 - 500e6 / young) * 10.0 * diameter;
  EXPECT_GT(broke_at, plastic);
  EXPECT_LT(broke_at, plastic + 5e-3);
  EXPECT_NEAR(before.y, 0.0, 1e-6);  // it has broken
  EXPECT_GT(b.fractured, 1.0);
  EXPECT_GT(b.slipped, 1.0);
  const double spent = b.slipped + b.pending_friction + b.fractured + b.pending_fracture;
  EXPECT_NEAR((stored(b) + spent) / work, 1.0, 2e-3);
  // In the leapfrog's terms: what is booked by now, and F_{n-1} F_n/2k.
  EXPECT_NEAR((bolt_energy(b) + b.slipped + b.fractured) / work, 1.0, 2e-3);
}

/// Of the whole rupture strain, pretension takes its part.
TEST(BoltChain, BreaksAtItsRuptureStrainHoweverItIsTensioned) {
  const double rupture = 1e-3, length = 3.0;
  for (const double part : {0.0, 0.5}) {
    Bolt bolt = with_ends({2, 1}, {2, 4});
    bolt.rupture_strain = rupture;
    bolt.pretension = part * rupture * steel;
    Bolted m = two_blocks(bolt);
    EXPECT_NEAR(m.bolts.bars.force[0], bolt.pretension, 1e-6 * steel * rupture);
    shift_upper(m, {0.0, (0.99 - part) * rupture * length});
    EXPECT_EQ(m.bolts.bars.broken[0], 0);
    EXPECT_NEAR(-whole(on_block(m, 1)).y, 0.99 * rupture * steel, 1e-6 * steel * rupture);
    shift_upper(m, {0.0, 0.02 * rupture * length});
    EXPECT_EQ(m.bolts.bars.broken[0], 1);
  }
}

TEST(BoltChain, OneWithEndsGoesSlack) {
  Bolted m = two_blocks(with_ends({2, 1}, {2, 4}));
  shift_upper(m, {0.0, 1e-4});
  EXPECT_NEAR(-whole(on_block(m, 1)).y, steel * 1e-4 / 3.0, 1e-6 * steel * 1e-4);
  EXPECT_NEAR(whole(on_block(m, 0)).y, steel * 1e-4 / 3.0, 1e-6 * steel * 1e-4);
  shift_upper(m, {0.0, -2e-4});
  EXPECT_EQ(whole(on_block(m, 1)).y, 0.0);
  shift_upper(m, {0.0, 2e-4});
  EXPECT_NEAR(-whole(on_block(m, 1)).y, steel * 1e-4 / 3.0, 1e-6 * steel * 1e-4);
}

}  // namespace
}  // namespace edda::bolt_chain_test
