// Eight pairs of zones at once are what each is by itself.
#include "zones/pair_lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace edda::pair_lanes_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
const IsotropicElasticity elastic{6e9, 4e9};

using Corners = std::array<std::array<Vec2, 3>, 2>;

/// Eight pairs in any state and at any place; the last is a zone by itself.
struct Group {
  std::mt19937 rng;
  std::array<std::array<ZoneShape, 2>, pairs_at_once> shape{};
  std::array<std::array<ZoneState, 2>, pairs_at_once> state;
  std::array<Corners, pairs_at_once> x;
  PairShapes shapes;
  PairInputs inputs;
  PairResults results;

  double any(double by) { return std::uniform_real_distribution<double>(-by, by)(rng); }
  Group(unsigned seed, double strain, double turn) : rng(seed) {
    for (std::size_t p = 0; p < pairs_at_once; ++p) {
      std::array<Vec2, 4> at{Vec2{0, 0}, Vec2{1.1, 0.1}, Vec2{1.0, 0.9}, Vec2{-0.1, 1.2}};
      const Vec2 middle{any(100.0), any(100.0)};
      for (Vec2& v : at) v += middle + Vec2{any(0.2), any(0.2)};
      const Corners c{{{at[0], at[1], at[2]}, {at[0], at[2], at[3]}}};
      const double angle = any(turn);
      for (std::size_t q = 0; q < (p + 1 < pairs_at_once ? 2 : 1); ++q)
        shape[p][q] = zone_shape(c[q][0], c[q][1], c[q][2], 1.3);
      for (Vec2& v : at) {
        const Vec2 u = v - middle + Vec2{any(strain), any(strain)};
        v = middle + Vec2{std::cos(angle) * u.x - std::sin(angle) * u.y,
                          std::sin(angle) * u.x + std::cos(angle) * u.y};
      }
      x[p] = {{{at[0], at[1], at[2]}, {at[0], at[2], at[3]}}};
      for (ZoneState& s : state[p]) {
        s.plastic_inverse = {1.0 + any(strain), any(strain), any(strain), 1.0 + any(strain)};
        s.elastic_zz = any(strain);
        s.locked = any(1e7);
      }
      if (p + 1 == pairs_at_once) {
        x[p][1] = x[p][0];
        state[p][1] = state[p][0];
      }
      set_shape(shapes, p, shape[p], elastic);
      set_inputs(inputs, p, x[p], {&state[p][0], &state[p][1]});
    }
    evaluate_pairs(shapes, inputs, results);
  }
};

/// Of stresses of about 1e8 Pa.
constexpr double rounding = 1e-12 * 1e9;

TEST(PairLanes, AreWhatEachPairIs) {
  const ZoneMaterial rock{elastic};
  for (unsigned seed = 0; seed < 200; ++seed) {
    Group g(seed, 0.012, 3.0);
    const PairResults& r = g.results;
    for (std::size_t p = 0; p < pairs_at_once; ++p) {
      ASSERT_EQ(r.within[p], 1.0);
      const auto exact = evaluate_zones(g.shape[p], rock, g.x[p], g.state[p]);
      double stored = 0.0;
      for (std::size_t q = 0; q < (p + 1 < pairs_at_once ? 2 : 1); ++q) {
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(r.force_x[q][k][p], exact[q].force[k].x, 10 * rounding);
          EXPECT_NEAR(r.force_y[q][k][p], exact[q].force[k].y, 10 * rounding);
        }
        for (std::size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(r.stress[q][c][p], exact[q].stress[c], 10 * rounding);
          EXPECT_NEAR(r.remembered[q][c][p], g.state[p][q].stress[c], 10 * rounding);
        }
        const auto [xx, yy, zz, xy] = g.state[p][q].stress;
        EXPECT_NEAR(r.mean[q][p], 0.5 * (xx + yy), 10 * rounding);
        EXPECT_NEAR(std::sqrt(r.square[q][p]), std::hypot(0.5 * (xx - yy), xy), 10 * rounding);
        EXPECT_NEAR(r.out_of_plane[q][p], zz, 10 * rounding);
        stored += exact[q].stored;
      }
      EXPECT_NEAR(r.stored[p], stored, 10 * rounding);
    }
  }
}

/// Rock that yields where its pairs do; none else is taken for elastic.
TEST(PairLanes, NothingThatFlowsIsTakenForElastic) {
  ZoneMaterial softening = rock_that_yields(elastic, {35 * degree, 0.0, 20e6, 10e6});
  softening.residual = surface_of(MohrCoulomb{30 * degree, 0.0, 10e6, 5e6});
  softening.slip = 1e-3;
  const std::vector<ZoneMaterial> rocks{
      ZoneMaterial{elastic}, rock_that_yields(elastic, {30 * degree, 10 * degree, 20e6, 10e6}),
      softening, ZoneMaterial{elastic, HoekBrown{100e6, 8.0, 0.5, 0.51, 0.0, 6e6}},
      ZoneMaterial{elastic, HoekBrown{100e6, 8.0, 0.5, 0.65, 0.0, 6e6, 1.5}}};
  for (const ZoneMaterial& rock : rocks) {
    int elastic_ones = 0, flowing = 0, in_vain = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
      Group g(seed, 0.003, 3.0);
      for (std::size_t p = 0; p + 1 < pairs_at_once; ++p) {
        bool may = false;
        for (std::size_t q = 0; q < 2; ++q) {
          const double slip = std::max(0.0, 1e-3 + g.any(2e-3));  // none, some or all of it
          g.state[p][q].plastic_shear = slip / g.shape[p][q].width;
          may = may || may_flow(g.results, p, q, rock, slip);
        }
        const auto exact = evaluate_zones(g.shape[p], rock, g.x[p], g.state[p]);
        const bool flows =
            exact[0].yielding != Yielding::nowhere || exact[1].yielding != Yielding::nowhere;
        EXPECT_LE(flows, may);
        elastic_ones += !may;
        flowing += flows;
        in_vain += may && !flows;
      }
    }
    EXPECT_GT(elastic_ones, 50);
    EXPECT_EQ(flowing > 50, yields(rock.peak));
    EXPECT_EQ(in_vain, 0);
  }
}

/// Large strains are for each pair by itself.
TEST(PairLanes, SayWhereTheirSeriesEnd) {
  int within = 0, beyond = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const ZoneMaterial rock{elastic};
    Group g(seed, 0.08, 3.0);
    for (std::size_t p = 0; p < pairs_at_once; ++p) {
      if (g.results.within[p] == 0.0) {
        ++beyond;
        continue;
      }
      ++within;
      const auto exact = evaluate_zones(g.shape[p], rock, g.x[p], g.state[p]);
      EXPECT_NEAR(g.results.force_x[0][1][p], exact[0].force[1].x, 20 * rounding);
    }
  }
  EXPECT_GT(within, 20);
  EXPECT_GT(beyond, 20);
}

}  // namespace
}  // namespace edda::pair_lanes_test
