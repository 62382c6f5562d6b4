// What bolts do while their blocks are moved by hand.
#include <gtest/gtest.h>

#include <algorithm>
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
  bolt.dowel = BoltDowel{1e7, 1e12};
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

/// Two blocks with a closed joint, as wide as asked, and a bolt of 2 m at `angle` from its normal,
/// whose dowel follows from it; all turned by `turn`, and mirrored if asked. The upper block may be
/// several, the lowest of the height `cut`.
struct Sheared {
  Bolted m;
  double angle, turn, mirrored;

  Sheared(double angle_, double turn_ = 0.0, bool mirror = false, double half_width = 2.0,
          const Bolt& more = {}, double cut = 2.0)
      : angle(angle_), turn(turn_), mirrored(mirror ? -1.0 : 1.0) {
    const auto ring = [&](double low, double high) {
      Ring r;
      for (const Vec2 p : {Vec2{-half_width, low}, Vec2{half_width, low}, Vec2{half_width, high},
                           Vec2{-half_width, high}})
        r.push_back(placed(p));
      if (mirror) std::reverse(r.begin(), r.end());
      return r;
    };
    m.add(ring(-2, 0));
    m.add(ring(0, cut));
    for (double low = cut; low < 2.0; low += 0.5) m.add(ring(low, std::min(low + 0.5, 2.0)));
    m.build();
    const Vec2 along{std::sin(angle), std::cos(angle)};
    Bolt bolt = grouted(placed(-1.0 * along), placed(along));
    bolt.bond = {1e9, 4e5};
    bolt.yield_stress = 500e6;
    bolt.rupture_strain = more.rupture_strain;
    bolt.dowel = BoltDowel{{}, {}, 40e6, 12e9};
    m.model.bolts = {bolt};
    m.attach();
    EXPECT_TRUE(m.faults.empty());
  }
  Vec2 placed(Vec2 p) const { return rotated({mirrored * p.x, p.y}, turn); }
  /// Moves the upper block by u along the joint and v off it.
  void shift(double u, double v = 0.0) {
    const Vec2 by = placed({u, v});
    for (std::size_t i = 1; i < m.blocks.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        m.state.position.x[k][i] += by.x;
        m.state.position.y[k][i] += by.y;
      }
    }
    update_bolts(m.bolts, m.blocks, m.state);
  }
  /// Resistance to shear along the joint and to its opening.
  Vec2 resistance() const {
    Vec2 f;
    for (std::size_t i = 1; i < m.blocks.size(); ++i) f += rotated(whole(on_block(m, i)), -turn);
    return {-mirrored * f.x, -f.y};
  }
  const Bolts& bolts() const { return m.bolts; }
  std::size_t link() const {
    const auto& h = m.bolts.hinges;
    return static_cast<std::size_t>(
        std::find_if(h.begin(), h.end(), [](double x) { return x > 0.0; }) - h.begin());
  }
};

const double area = 0.25 * std::numbers::pi * diameter * diameter;
const double collapse = std::sqrt(2.0 * 500e6 * std::pow(diameter, 3) / 6.0 * 40e6 * diameter);

/// At a right angle to the joint: E I beta^3, then the collapse load, while offsets are small.
TEST(BoltDowel, ResistsAsItsBarInItsFoundation) {
  Sheared s(0.0);
  const double bending = young * std::numbers::pi * std::pow(diameter, 4) / 64.0;
  const double beta = std::pow(12e9 / (4.0 * bending), 0.25);
  s.shift(1e-6);
  EXPECT_NEAR(s.resistance().x / (bending * std::pow(beta, 3) * 1e-6), 1.0, 1e-3);
  for (int n = 0; n < 700; ++n) s.shift(1e-6);
  EXPECT_NEAR(s.resistance().x / collapse, 1.0, 1e-2);
  EXPECT_EQ(s.bolts().dowels.yielded[s.link()], 1);
}

/// Far into the joint the bar is stretched until it yields, and its tension acts along the joint:
/// shear and axial force stay on their ellipse, and the resultant turns with the bar.
TEST(BoltDowel, TurnsIntoTheJoint) {
  Sheared s(0.0);
  for (int n = 0; n < 3000; ++n) s.shift(1e-5);
  const std::size_t k = s.link();
  const double n = s.bolts().bars.force[k] / (500e6 * area),
               v = std::abs(s.bolts().dowels.force[k]) / collapse;
  EXPECT_NEAR(std::hypot(n, v), 1.0, 1e-3);
  EXPECT_GT(n, 0.8);
  const double hinges = s.bolts().hinges[k];
  const double theta = std::atan2(0.03, hinges);
  const double part = hinges / std::hypot(0.03, hinges);
  const double axial = n * 500e6 * area, across = v * collapse * part;
  EXPECT_NEAR(s.resistance().x / (axial * std::sin(theta) + across * std::cos(theta)), 1.0, 2e-2);
  EXPECT_NEAR(s.resistance().y / (axial * std::cos(theta) - across * std::sin(theta)), 1.0, 2e-2);
  EXPECT_GT(s.resistance().x, 1.5 * collapse);
  EXPECT_LE(s.bolts().most_increments, 12);
}

/// A way to and fro through yield, and on to rupture: the work is stored or spent, and what is
/// spent never falls.
TEST(BoltDowel, BooksEveryJoule) {
  Bolt weak;
  weak.rupture_strain = 0.03;
  Sheared s(0.4, 0.0, false, 2.0, weak);
  double work = 0.0, spent = 0.0;
  Vec2 before = s.resistance();
  for (int n = 0; n < 12000; ++n) {
    const double way = n > 3000 && n < 5000 ? -1.0 : 1.0, v = 0.3 * way;
    s.shift(way * 2e-6, v * 2e-6);
    const Vec2 now = s.resistance();
    work += 0.5 * dot(before + now, Vec2{way, v} * 2e-6);
    before = now;
    const Bolts& b = s.bolts();
    const double all = b.slipped + b.pending_friction + b.fractured + b.pending_fracture;
    EXPECT_GE(all, spent - 1e-9 * work);
    spent = all;
    ASSERT_NEAR(stored(b) + spent, work, 3e-3 * work + 1e-6) << n;
  }
  EXPECT_GT(s.bolts().slipped, 100.0);
  EXPECT_GT(s.bolts().fractured, 1.0);
  EXPECT_NEAR(norm(s.resistance()), 0.0, 1e-6);
}

/// Whatever way the model lies, and however large its blocks are.
TEST(BoltDowel, KnowsNoDirectionAndNoBlockSize) {
  Sheared as_drawn(0.5), turned(0.5, 1.1), mirrored(0.5, 0.3, true), wide(0.5, 0.0, false, 8.0);
  for (int n = 0; n < 2000; ++n) {
    for (Sheared* s : {&as_drawn, &turned, &mirrored, &wide}) s->shift(1e-5, 2e-6);
  }
  const Vec2 r = as_drawn.resistance();
  EXPECT_GT(norm(r), 1e5);
  for (const Sheared* s : {&turned, &mirrored, &wide})
    EXPECT_LT(norm(s->resistance() - r), 1e-6 * norm(r));
  // Joints that do not move take nothing; the nodes of the bolt are other ones.
  for (const double cut : {0.4, 0.1}) {
    Sheared in_pieces(0.5, 0.0, false, 2.0, {}, cut);
    EXPECT_GT(in_pieces.m.blocks.size(), 4u);
    for (int n = 0; n < 2000; ++n) in_pieces.shift(1e-5, 2e-6);
    EXPECT_LT(norm(in_pieces.resistance() - r), 2e-3 * norm(r));
  }
}

TEST(BoltDowel, ForcesAreGradientsOfTheStoredEnergy) {
  Bolt bolt = grouted({1, 0.1}, {2, 4});
  bolt.bond = {1e8, 1e12};
  bolt.yield_stress = 1e15;
  bolt.dowel = BoltDowel{{}, {}, 1e14, 1e9};
  expect_gradients(bolt);
}

}  // namespace
}  // namespace edda::bolt_chain_test
