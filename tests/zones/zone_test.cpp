// Zones: forces are gradients of the stored energy, rotations change nothing, energy balances.
#include "zones/zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace edda::zone_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
const ZoneMaterial elastic{{6e9, 4e9}};
ZoneMaterial foliated(std::optional<FoliationStrength> strength, bool deforms) {
  ZoneMaterial m = elastic;
  m.foliation = Foliation{{std::cos(0.4), std::sin(0.4)}, {}, strength};
  if (deforms) m.foliation->elastic = transverse_elasticity(10e9, 0.25, 4e9, 0.15, 1.5e9);
  return m;
}
const ZoneMaterial transverse = foliated({}, true);
const FoliationStrength weak{std::tan(20 * degree), std::tan(5 * degree), 3e5, 1e5};
ZoneMaterial softening() {
  ZoneMaterial m = rock_that_yields({6e9, 4e9}, {35 * degree, 10 * degree, 1e6, 5e5});
  m.residual = surface_of(MohrCoulomb{30 * degree, 0.0, 1e5, 1e5});
  m.slip = 2e-3;
  return m;
}
const ZoneMaterial hoek_brown{{6e9, 4e9}, HoekBrown{30e6, 1.0, 1e-3, 0.51, 5 * degree, 3e4}};
ZoneMaterial both() {
  ZoneMaterial m = foliated(weak, false);
  m.peak = surface_of(MohrCoulomb{30 * degree, 10 * degree, 5e5, 2e5});
  return m;
}
const ZoneMaterial yielding = rock_that_yields({6e9, 4e9}, {30 * degree, 10 * degree, 1e6, 5e5});

/// All that dissipates.
std::vector<ZoneMaterial> rocks_that_yield() {
  return {yielding, softening(), hoek_brown, foliated(weak, false), foliated(weak, true), both()};
}

using Corners = std::array<std::array<Vec2, 3>, 2>;
/// A quadrilateral of two triangles that share the edge from corner 0 to 2.
struct Pair {
  std::array<Vec2, 4> at{Vec2{0, 0}, Vec2{1.1, 0.1}, Vec2{1.0, 0.9}, Vec2{-0.1, 1.2}};
  std::array<ZoneShape, 2> shape;
  std::array<ZoneState, 2> state;

  explicit Pair(const std::array<double, 4>& initial = {}, const ZoneMaterial& m = elastic) {
    const Corners c = corners(at);
    for (std::size_t q = 0; q < 2; ++q) {
      shape[q] = zone_shape(c[q][0], c[q][1], c[q][2], 1.3);
      state[q] = zone_at_start(m, initial);
    }
  }
  static Corners corners(const std::array<Vec2, 4>& p) {
    return {{{p[0], p[1], p[2]}, {p[0], p[2], p[3]}}};
  }
  std::array<ZoneResult, 2> at_corners(const ZoneMaterial& m, const std::array<Vec2, 4>& p) {
    return evaluate_zones(shape, m, corners(p), state);
  }
  static std::array<Vec2, 4> forces(const std::array<ZoneResult, 2>& r) {
    return {r[0].force[0] + r[1].force[0], r[0].force[1], r[0].force[2] + r[1].force[1],
            r[1].force[2]};
  }
};
std::array<Vec2, 4> moved(const Pair& p, double by, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(-by, by);
  std::array<Vec2, 4> x = p.at;
  for (Vec2& v : x) v += Vec2{any(rng), any(rng)};
  return x;
}

TEST(Zone, ForcesAreTheGradientOfTheEnergy) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ZoneMaterial& rock = seed % 2 == 0 ? elastic : transverse;
    Pair p({-2e7, -5e7, -3e7, 1e7}, rock);
    const std::array<Vec2, 4> x = moved(p, 0.05, seed);
    const std::array<Vec2, 4> f = Pair::forces(p.at_corners(rock, x));
    const auto energy = [&](std::size_t k, Vec2 by) {
      std::array<Vec2, 4> y = x;
      y[k] += by;
      const auto r = p.at_corners(rock, y);
      return r[0].stored + r[1].stored;
    };
    constexpr double d = 1e-6;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(f[k].x, -(energy(k, {d, 0}) - energy(k, {-d, 0})) / (2.0 * d), 2e3) << seed;
      EXPECT_NEAR(f[k].y, -(energy(k, {0, d}) - energy(k, {0, -d})) / (2.0 * d), 2e3) << seed;
    }
    EXPECT_GT(norm(f[1]), 1e7);
  }
}

TEST(Zone, ForcesHaveNoResultantAndNoMoment) {
  for (const ZoneMaterial& m : {elastic, transverse, yielding, both()}) {
    Pair p({-2e7, -5e7, -3e7, 1e7}, m);
    const std::array<Vec2, 4> x = moved(p, 0.05, 3);
    const std::array<Vec2, 4> f = Pair::forces(p.at_corners(m, x));
    double moment = 0.0;
    for (std::size_t k = 0; k < 4; ++k) moment += cross(x[k], f[k]);
    EXPECT_NEAR(norm(f[0] + f[1] + f[2] + f[3]), 0.0, 1e-6);
    EXPECT_NEAR(moment, 0.0, 1e-5);
  }
}

/// The same motion seen from a frame that turns: forces turn with it, energies are the same, also
/// on a path on which the rock yields.
TEST(Zone, RotationsChangeNothing) {
  for (const ZoneMaterial& rock : rocks_that_yield()) {
    Pair still({-2e5, -5e5, -3e5, 1e5}, rock), turning = still;
    std::array<Vec2, 4> x = still.at;
    double yielded = 0.0;
    for (int n = 1; n <= 40; ++n) {
      const std::array<Vec2, 4> target = moved(still, 2e-3, static_cast<unsigned>(n / 8));
      for (std::size_t k = 0; k < 4; ++k) x[k] += 0.2 * (target[k] - x[k]);
      std::array<Vec2, 4> y = x;
      for (Vec2& v : y) v = rotated(v, 0.3 * n) + Vec2{5, 7};
      const auto a = still.at_corners(rock, x), b = turning.at_corners(rock, y);
      for (std::size_t q = 0; q < 2; ++q) {
        EXPECT_NEAR(a[q].stored, b[q].stored, 1e-6 * a[q].stored + 1e-9);
        EXPECT_NEAR(a[q].dissipated, b[q].dissipated, 1e-4);
        yielded += a[q].dissipated;
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(norm(rotated(a[q].force[k], 0.3 * n) - b[q].force[k]), 0.0, 5.0) << n;
      }
    }
    EXPECT_GT(yielded, 100.0);
  }
}

/// At an undeformed zone the initial stress acts, and the response is Hooke's.
TEST(Zone, InitialStressAndSmallStrains) {
  const std::array<double, 4> initial{-2e6, -5e6, -3e6, 1e6};
  Pair p(initial);
  auto r = p.at_corners(elastic, p.at);
  for (std::size_t q = 0; q < 2; ++q) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(r[q].stress[k], initial[k], 1e-4);
  }
  const double exx = 3e-6, eyy = -2e-6, exy = 1e-6;
  std::array<Vec2, 4> x = p.at;
  for (Vec2& v : x) v = {v.x + exx * v.x + exy * v.y, v.y + exy * v.x + eyy * v.y};
  r = p.at_corners(elastic, x);
  const double lambda = elastic.elastic.lambda, mu = elastic.elastic.mu, trace = exx + eyy;
  for (std::size_t q = 0; q < 2; ++q) {
    EXPECT_NEAR(r[q].stress[0] - initial[0], lambda * trace + 2.0 * mu * exx, 40.0);
    EXPECT_NEAR(r[q].stress[1] - initial[1], lambda * trace + 2.0 * mu * eyy, 40.0);
    EXPECT_NEAR(r[q].stress[2] - initial[2], lambda * trace, 40.0);
    EXPECT_NEAR(r[q].stress[3] - initial[3], 2.0 * mu * exy, 40.0);
  }
}

/// Work of the forces against the motion = stored + dissipated, along a path in small steps.
TEST(Zone, EnergyBalances) {
  for (const ZoneMaterial& rock : rocks_that_yield()) {
    Pair p({-2e5, -5e5, -3e5, 1e5}, rock);
    std::array<Vec2, 4> x = p.at;
    auto now = p.at_corners(rock, x);
    const double start = now[0].stored + now[1].stored;
    double work = 0.0, dissipated = 0.0;
    for (int n = 1; n <= 4000; ++n) {
      const std::array<Vec2, 4> target = moved(p, 2e-3, static_cast<unsigned>(n / 500));
      const std::array<Vec2, 4> before = x, f = Pair::forces(now);
      for (std::size_t k = 0; k < 4; ++k) x[k] += 0.01 * (target[k] - x[k]);
      now = p.at_corners(rock, x);
      const std::array<Vec2, 4> g = Pair::forces(now);
      for (std::size_t k = 0; k < 4; ++k) work -= dot(0.5 * (f[k] + g[k]), x[k] - before[k]);
      dissipated += now[0].dissipated + now[1].dissipated;
    }
    const double stored = now[0].stored + now[1].stored - start;
    EXPECT_GT(dissipated, 1000.0);
    // Elastic strains of a foliation that slips are not quite in its axes.
    EXPECT_NEAR(work, stored + dissipated, (rock.foliation ? 2e-3 : 1e-4) * dissipated);
  }
}

/// A state that is evaluated twice is the same, but where rock dilates: the plastic volume that a
/// pair shares leaves its stresses beside the strength, to which the next evaluations bring them.
TEST(Zone, EvaluatingAgainChangesNothing) {
  const ZoneMaterial crushed = rock_that_yields({6e9, 4e9}, {30 * degree, 0.0, 1e6, 1e9});
  for (const ZoneMaterial& rock : {crushed, yielding}) {
    Pair p;
    const std::array<Vec2, 4> x = moved(p, 2e-3, 5);
    auto once = p.at_corners(rock, x);
    EXPECT_GT(once[0].dissipated + once[1].dissipated, 10.0);
    const bool dilates = std::get<MohrCoulombSurface>(rock.peak).rock.dilation > 0.0;
    for (int n = 0; dilates && n < 60; ++n) once = p.at_corners(rock, x);
    const auto twice = p.at_corners(rock, x);
    for (std::size_t q = 0; q < 2; ++q) {
      EXPECT_NEAR(twice[q].dissipated, 0.0, 1e-5);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(norm(once[q].force[k] - twice[q].force[k]), 0.0, 1.0);
    }
  }
}

/// Both zones of a pair share their plastic volume strain: they dilate as their mean does, however
/// they shear.
TEST(Zone, APairDilatesAsItsMean) {
  Pair p;
  std::array<Vec2, 4> x = p.at;
  for (int n = 1; n <= 200; ++n) {
    x[2] = p.at[2] + Vec2{2e-5 * n, -1e-5 * n};
    p.at_corners(yielding, x);
  }
  const auto volume = [](const ZoneState& s) {
    const Matrix2& m = s.plastic_inverse;
    return -std::log(m.xx * m.yy - m.xy * m.yx) - s.elastic_zz;
  };
  EXPECT_GT(volume(p.state[0]), 1e-4);
  EXPECT_NEAR(volume(p.state[1]) / volume(p.state[0]), 1.0, 1e-9);
  EXPECT_GT(std::abs(p.state[1].plastic_shear / p.state[0].plastic_shear - 1.0), 0.05);
}

/// Uniaxial compression in plane strain yields at the strength and stays there.
TEST(Zone, HasTheStrengthOfItsRock) {
  Pair p;
  const double sine = std::sin(30 * degree), strength = 2e6 * std::cos(30 * degree) / (1.0 - sine);
  // Lateral strain such that the lateral stress vanishes, by secant steps.
  double exx = 0.0, largest = 0.0;
  for (int n = 1; n <= 200; ++n) {
    const double eyy = -2e-5 * n;
    const auto stress = [&](double e, bool keep) {
      const auto saved = p.state;
      std::array<Vec2, 4> x = p.at;
      for (Vec2& v : x) v = {v.x * std::exp(e), v.y * std::exp(eyy)};
      const auto r = p.at_corners(yielding, x);
      if (!keep) p.state = saved;
      return r[0].stress;
    };
    for (int k = 0; k < 60; ++k) {
      const double here = stress(exx, false)[0], there = stress(exx + 1e-9, false)[0];
      if (std::abs(here) < 1.0 || there == here) break;
      exx -= here * 1e-9 / (there - here);
    }
    largest = std::max(largest, -stress(exx, true)[1]);
  }
  EXPECT_NEAR(largest / strength, 1.0, 5e-3);
}

/// In a motion that shears rock without dilation, and in one that pulls a pair apart.
TEST(Zone, TheStrengthFactorIsOneWhereItYields) {
  const ZoneMaterial m = rock_that_yields({6e9, 4e9}, {30 * degree, 0.0, 1e6, 5e5});
  for (const double across : {-1e-4, 4e-4}) {
    Pair p;
    for (int n = 1; n <= 50; ++n) {
      std::array<Vec2, 4> x = p.at;
      for (Vec2& v : x) v = {v.x + 2e-5 * n * v.y, v.y * (1.0 + 0.02 * across * n)};
      const auto r = p.at_corners(m, x);
      for (std::size_t q = 0; q < 2; ++q) {
        const double factor = strength_factor(m, 0.0, p.state[q].stress);
        if (r[q].yielding == Yielding::nowhere) {
          EXPECT_GT(factor, 1.0);
        } else {
          EXPECT_NEAR(factor, 1.0, 1e-9);
        }
        if (n == 50) {
          EXPECT_EQ(r[q].yielding, across > 0.0 ? Yielding::in_tension : Yielding::in_shear);
        }
      }
    }
  }
}

/// A stress along and across a foliation strains the rock by the moduli given for them.
TEST(Zone, AFoliationHasItsModuli) {
  for (const double across : {0.0, 1.0}) {
    const ZoneMaterial& m = transverse;
    const Vec2 t = m.foliation->along, q = perp(t), d = across > 0.0 ? q : t;
    const double s = -2e4;
    Pair p({s * d.x * d.x, s * d.y * d.y, 0.0, s * d.x * d.y}, m);
    const std::array<double, 3> e =
        strains_of(*m.foliation->elastic, (1.0 - across) * s, across * s, 0.0);
    EXPECT_NEAR(e[0], across > 0.0 ? -0.15 * s / 4e9 : s / 10e9, 1e-12);
    EXPECT_NEAR(e[1], across > 0.0 ? s / 4e9 : -0.15 * s / 4e9, 1e-12);
    EXPECT_NEAR(e[2], across > 0.0 ? -0.15 * s / 4e9 : -0.25 * s / 10e9, 1e-12);
    // Strained back by as much, it has no stress left but out of plane.
    std::array<Vec2, 4> x = p.at;
    for (Vec2& v : x) v += -e[0] * dot(t, v) * t - e[1] * dot(q, v) * q;
    for (const ZoneResult& r : p.at_corners(m, x)) {
      const TransverseElasticity& c = *m.foliation->elastic;
      EXPECT_NEAR(r.stress[0], -c.tz * -e[2] * t.x * t.x - c.nz * -e[2] * q.x * q.x, 5.0);
      EXPECT_NEAR(r.stress[2], c.zz * e[2], 5.0);
    }
  }
}

/// Simple shear of one of the two rows of zones that make a band: the strength falls with the slip
/// of the band, however wide the zones.
TEST(Zone, TheStrengthFallsWithSlipWhateverTheSizeOfZones) {
  ZoneMaterial m = rock_that_yields({6e9, 4e9}, {0.0, 0.0, 1e6, 1e9});
  m.residual = surface_of(MohrCoulomb{0.0, 0.0, 2e5, 1e9});
  m.slip = 4e-3;
  std::vector<double> halfway;
  for (const double size : {0.1, 1.0}) {
    const std::array<Vec2, 4> square{Vec2{0, 0}, Vec2{size, 0}, Vec2{size, size}, Vec2{0, size}};
    const Corners c = Pair::corners(square);
    std::array<ZoneShape, 2> shape;
    std::array<ZoneState, 2> state;
    for (std::size_t q = 0; q < 2; ++q) {
      shape[q] = zone_shape(c[q][0], c[q][1], c[q][2], 1.0);
      EXPECT_NEAR(shape[q].width, 2.0 * size, 1e-12);
    }
    constexpr double step = 1e-6;
    for (int n = 1; n <= 6000; ++n) {
      std::array<Vec2, 4> x = square;
      for (std::size_t k = 2; k < 4; ++k) x[k].x += 0.5 * n * step;
      const double shear = evaluate_zones(shape, m, Pair::corners(x), state)[0].stress[3];
      if (n == 2200) halfway.push_back(shear);
      if (n == 6000) {
        EXPECT_NEAR(shear, 2e5, 2e3) << size;
      }
    }
  }
  const double expected = 1e6 - 8e5 * (2.2e-3 - 0.2 * 0.56e6 / 4e9) / 4e-3;
  EXPECT_NEAR(halfway[0], expected, 0.01 * 1e6);
  EXPECT_NEAR(halfway[1], halfway[0], 0.08 * 1e6);  // its elastic shear takes more of the motion
}

/// Beyond the apex of a strength whose tension exceeds it, stresses return to the apex.
TEST(Zone, AFoliationOpensAtItsApex) {
  const FoliationStrength s{std::tan(25 * degree), 0.0, 0.3e6, 0.9e6};
  const double apex = s.cohesion / s.friction;
  for (const double along : {0.0, 1e5}) {
    const FoliationSlip slip = slip_to(s, 10e9, 4e9, 1.5e6, along);
    EXPECT_TRUE(slip.opens);
    EXPECT_NEAR(1.5e6 - 10e9 * slip.opening, apex, 1.0);
    EXPECT_NEAR(along - 4e9 * slip.slip, 0.0, 1.0);
  }
}

/// Jaeger's strength of rock with a plane of weakness at beta from the larger stress.
TEST(Zone, AFoliationHasItsStrength) {
  for (const double tilt : {0.3, 0.6, 0.9}) {
    ZoneMaterial m = foliated(FoliationStrength{std::tan(20 * degree), 0.0, 3e5, 1e5}, false);
    m.foliation->along = {std::sin(tilt), std::cos(tilt)};  // `tilt` from y
    const double p3 = 5e5;
    Pair p({-p3, -p3, -p3, 0.0}, m);
    // s1 - s3 = 2 (c + s3 tan phi)/((1 - tan phi tan beta) sin 2 beta), beta of the normal to s1.
    const double beta = 0.5 * std::numbers::pi - tilt, tangent = std::tan(20 * degree);
    const double strength =
        2.0 * (3e5 + p3 * tangent) / ((1.0 - tangent / std::tan(beta)) * std::sin(2.0 * beta));
    double last = 0.0;
    Vec2 sum;  // strains xx and xy that keep xx and xy stresses
    for (int n = 1; n <= 400; ++n) {
      const double eyy = -2e-6 * n;
      for (int k = 0; k < 40; ++k) {
        auto trial = p.state;
        std::array<Vec2, 4> x = p.at;
        for (Vec2& v : x) v = {v.x + sum.x * v.x + sum.y * v.y, v.y + eyy * v.y};
        const auto r = evaluate_zones(p.shape, m, Pair::corners(x), trial);
        sum.x -= (r[0].stress[0] + p3) / 30e9;
        sum.y -= r[0].stress[3] / 10e9;
        last = -r[0].stress[1];
        if (k == 39) p.state = trial;
      }
    }
    EXPECT_NEAR((last - p3) / strength, 1.0, 0.01) << tilt;
  }
}

/// Viscous forces are eta times the rate of the elastic ones, and take energy from any motion.
TEST(Zone, ViscousForcesGrowAsElasticOnesDo) {
  constexpr double eta = 3e-4, small = 1e-6;
  for (const ZoneMaterial& m : {elastic, transverse}) {
    for (const bool alone : {false, true}) {
      Pair pair({}, m);
      if (alone) pair.shape[1] = {};
      const std::array<Vec2, 4> v{Vec2{0.3, -0.2}, Vec2{-0.1, 0.5}, Vec2{0.7, 0.2},
                                  Vec2{-0.4, -0.6}};
      std::array<Vec2, 4> moved = pair.at;
      for (std::size_t k = 0; k < 4; ++k) moved[k] += small * v[k];
      const auto rate =
          viscous_forces(pair.shape, m, Pair::corners(pair.at), Pair::corners(v), eta);
      const std::array<ZoneResult, 2> after = pair.at_corners(m, moved);
      double power = 0.0;
      for (std::size_t q = 0; q < (alone ? 1u : 2u); ++q) {
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_LT(norm(rate[q][k] - (eta / small) * after[q].force[k]), 1e-4 * norm(rate[q][k]));
          power += dot(rate[q][k], Pair::corners(v)[q][k]);
        }
      }
      EXPECT_LT(power, 0.0);
    }
  }
}

/// A zone that turns has none; turned by any angle, it has the same ones, turned.
TEST(Zone, ViscousForcesTurnWithTheZone) {
  for (const ZoneMaterial& m : {elastic, transverse}) {
    const Pair pair({}, m);
    const std::array<Vec2, 4> v{Vec2{0.3, -0.2}, Vec2{-0.1, 0.5}, Vec2{0.7, 0.2}, Vec2{-0.4, -0.6}};
    std::array<Vec2, 4> spin, turned, turned_v;
    for (std::size_t k = 0; k < 4; ++k) {
      spin[k] = perp(pair.at[k]);
      turned[k] = rotated(pair.at[k], 0.9);
      turned_v[k] = rotated(v[k], 0.9) + 7.0 * perp(turned[k]);
    }
    const auto f = viscous_forces(pair.shape, m, Pair::corners(pair.at), Pair::corners(v), 1e-4),
               none =
                   viscous_forces(pair.shape, m, Pair::corners(pair.at), Pair::corners(spin), 1e-4),
               g = viscous_forces(pair.shape, m, Pair::corners(turned), Pair::corners(turned_v),
                                  1e-4);
    for (std::size_t q = 0; q < 2; ++q) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LT(norm(none[q][k]), 1e-9 * norm(f[q][k]));
        EXPECT_LT(norm(g[q][k] - rotated(f[q][k], 0.9)), 1e-9 * norm(f[q][k]));
      }
    }
  }
}

}  // namespace
}  // namespace edda::zone_test
