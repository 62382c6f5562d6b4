// Pieces of linings: forces are gradients of what is stored, turns change nothing, and chains of
// them are the beams of books.
#include "zones/beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "zones/lining_pieces.hpp"

namespace edda::beam_test {
namespace {

using std::numbers::pi;

constexpr double thick = 0.3, deep = 1.0;
const BeamSection section{30e9, 12e9, deep* thick, deep* thick* thick* thick / 12.0};
constexpr double mass = 100.0;

/// A chain of pieces between sections, whose outer and inner corners are at 2 k and 2 k + 1.
struct Chain {
  std::vector<Vec2> x;
  std::vector<BeamShape> shape;
  std::vector<BeamState> state;

  explicit Chain(std::vector<Vec2> corners) : x(std::move(corners)) {
    for (std::size_t p = 0; 2 * p + 2 < x.size(); ++p) {
      shape.push_back(beam_shape(section, corners_of(p), mass));
      state.push_back(beam_at_start(corners_of(p)));
    }
  }
  BeamCorners corners_of(std::size_t p) const {
    return {x[2 * p], x[2 * p + 2], x[2 * p + 3], x[2 * p + 1]};
  }
  std::vector<Vec2> forces() const {
    std::vector<Vec2> f(x.size());
    for (std::size_t p = 0; p < shape.size(); ++p) {
      BeamState now = state[p];
      const BeamResult r = evaluate_beam(shape[p], {}, corners_of(p), now);
      const std::array<std::size_t, 4> at{2 * p, 2 * p + 2, 2 * p + 3, 2 * p + 1};
      for (std::size_t k = 0; k < 4; ++k) f[at[k]] += r.force[k];
    }
    return f;
  }
  /// Equilibrium under these loads with the first section held, by Newton's method.
  void load(const std::function<std::vector<Vec2>(const std::vector<Vec2>&)>& loads) {
    const auto free = static_cast<Eigen::Index>(2 * x.size() - 4);
    const auto rest = [&](std::vector<Vec2> at) {
      std::swap(x, at);
      const std::vector<Vec2> f = forces(), p = loads(x);
      std::swap(x, at);
      Eigen::VectorXd r(free);
      for (std::size_t j = 2; j < at.size(); ++j) {
        r[static_cast<Eigen::Index>(2 * j - 4)] = f[j].x + p[j].x;
        r[static_cast<Eigen::Index>(2 * j - 3)] = f[j].y + p[j].y;
      }
      return r;
    };
    const auto component = [](std::vector<Vec2>& at, Eigen::Index c) -> double& {
      Vec2& p = at[static_cast<std::size_t>(c / 2 + 2)];
      return c % 2 == 0 ? p.x : p.y;
    };
    for (int n = 0; n < 30; ++n) {
      const Eigen::VectorXd r = rest(x);
      Eigen::MatrixXd k(free, free);
      constexpr double d = 1e-6;
      for (Eigen::Index c = 0; c < free; ++c) {
        std::vector<Vec2> less = x, more = x;
        component(less, c) -= d;
        component(more, c) += d;
        k.col(c) = (rest(less) - rest(more)) / (2.0 * d);
      }
      const Eigen::VectorXd by = k.partialPivLu().solve(r);
      for (Eigen::Index c = 0; c < free; ++c) component(x, c) += by[c];
      if (by.norm() < 1e-9) return;
    }
    ADD_FAILURE() << "no equilibrium";
  }
  BeamForces forces_in(std::size_t p) const {
    BeamState now = state[p];
    evaluate_beam(shape[p], {}, corners_of(p), now);
    return now.forces;
  }
  Vec2 end() const { return 0.5 * (x[x.size() - 2] + x[x.size() - 1]); }
};

/// Along +x from the origin: the outer side is below.
Chain straight(double length, int pieces) {
  std::vector<Vec2> x;
  for (int k = 0; k <= pieces; ++k) {
    const double at = length * k / pieces;
    x.insert(x.end(), {{at, -0.5 * thick}, {at, 0.5 * thick}});
  }
  return Chain(x);
}
/// A quarter circle about the origin from +x on.
Chain quarter(double radius, int pieces) {
  std::vector<Vec2> x;
  for (int k = 0; k <= pieces; ++k) {
    const double a = 0.5 * pi * k / pieces;
    const Vec2 out{std::cos(a), std::sin(a)};
    x.insert(x.end(), {(radius + 0.5 * thick) * out, (radius - 0.5 * thick) * out});
  }
  return Chain(x);
}
std::vector<Vec2> at_the_end(const std::vector<Vec2>& x, Vec2 force) {
  std::vector<Vec2> p(x.size());
  p[x.size() - 2] = p[x.size() - 1] = 0.5 * force;
  return p;
}
/// A couple on the last section, counter-clockwise, N m.
std::vector<Vec2> couple_at_the_end(const std::vector<Vec2>& x, double couple) {
  std::vector<Vec2> p(x.size());
  const Vec2 d = x.back() - x[x.size() - 2];
  p[x.size() - 1] = (couple / dot(d, d)) * perp(d);
  p[x.size() - 2] = -p[x.size() - 1];
  return p;
}

BeamCorners moved(unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  BeamCorners x{Vec2{0, 0}, Vec2{0.8, 0.1}, Vec2{0.75, 0.4}, Vec2{0, 0.3}};
  for (Vec2& p : x) p += Vec2{any(rng), any(rng)};
  return x;
}
BeamResult at(const BeamCorners& x) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0.1}, Vec2{0.75, 0.4}, Vec2{0, 0.3}};
  BeamState state = beam_at_start(drawn);
  return evaluate_beam(beam_shape(section, drawn, mass), {}, x, state);
}

TEST(Beam, ForcesAreTheGradientOfWhatIsStored) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const BeamCorners x = moved(seed);
    const BeamResult r = at(x);
    const auto stored = [&](std::size_t k, Vec2 by) {
      BeamCorners y = x;
      y[k] += by;
      return at(y).stored;
    };
    constexpr double d = 1e-6;
    for (std::size_t k = 0; k < 4; ++k) {
      const double f = norm(r.force[k]);
      EXPECT_GT(f, 1e6);
      EXPECT_NEAR(r.force[k].x, -(stored(k, {d, 0}) - stored(k, {-d, 0})) / (2 * d), 1e-6 * f);
      EXPECT_NEAR(r.force[k].y, -(stored(k, {0, d}) - stored(k, {0, -d})) / (2 * d), 1e-6 * f);
    }
  }
}

TEST(Beam, ForcesHaveNoResultantAndNoMomentAndTurnWithThePiece) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const BeamCorners x = moved(seed);
    const BeamResult r = at(x);
    BeamCorners turned = x;
    const double by = 0.4 * seed;
    for (Vec2& p : turned) p = rotated(p, by) + Vec2{3, -2};
    const BeamResult of_turned = at(turned);
    Vec2 sum;
    double moment = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += r.force[k];
      moment += cross(x[k], r.force[k]);
      EXPECT_LT(norm(rotated(r.force[k], by) - of_turned.force[k]), 1e-7 * norm(r.force[k]));
    }
    EXPECT_LT(norm(sum), 1e-12 * norm(r.force[0]));
    EXPECT_LT(std::abs(moment), 1e-11 * norm(r.force[0]));
    EXPECT_NEAR(of_turned.stored, r.stored, 1e-9 * r.stored);
  }
}

/// What the square of the highest frequency promises: no motion stores more.
TEST(Beam, NoMotionIsStifferThanTheHighestFrequency) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0.1}, Vec2{0.75, 0.4}, Vec2{0, 0.3}};
  const BeamShape shape = beam_shape(section, drawn, mass);
  const double square = highest_square(shape, drawn, mass);
  double most = 0.0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    BeamCorners x = moved(seed);
    double moved_square = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 u = 1e-5 * (x[k] - drawn[k]);
      x[k] = drawn[k] + u;
      moved_square += mass * dot(u, u);
    }
    most = std::max(most, 2.0 * at(x).stored / moved_square);
  }
  EXPECT_LT(most, (1.0 + 1e-3) * square);
  EXPECT_GT(most, 0.5 * square);
  // The thickness does not govern.
  BeamShape open = shape;
  open.across = 0.0;
  EXPECT_LT(square, 1.2 * highest_square(open, drawn, mass));
}

TEST(Beam, StraightCantileverIsExactWithAnyNumberOfPieces) {
  constexpr double length = 2.0, load = 1e3;
  const double ei = section.young * section.inertia,
               shear = 5.0 / 6.0 * section.shear_modulus * section.area;
  for (const int pieces : {1, 2, 5}) {
    Chain c = straight(length, pieces);
    c.load([&](const auto& x) { return at_the_end(x, {0.0, load}); });
    EXPECT_NEAR(c.end().y, load * (std::pow(length, 3) / (3.0 * ei) + length / shear),
                1e-6 * c.end().y);
    const BeamForces of = c.forces_in(0);
    EXPECT_NEAR(of.moment[0], load * length, 1e-5 * load * length);
    EXPECT_NEAR(of.shear(length / pieces), -load, 1e-5 * load);
    EXPECT_NEAR(of.axial, 0.0, 1e-4 * load);
  }
}

/// M = -P r sin a and N = P sin a do no work on N + M/r, which stretches the middle (Winkler).
TEST(Beam, QuarterCircleUnderARadialLoad) {
  constexpr double radius = 3.0, load = 1e3;
  const double ei = section.young * section.inertia,
               shear = 5.0 / 6.0 * section.shear_modulus * section.area;
  const double exact = load * (pi / 4.0) * (std::pow(radius, 3) / ei + radius / shear);
  Chain c = quarter(radius, 32);
  const Vec2 before = c.end();
  c.load([&](const auto& x) { return at_the_end(x, {0.0, load}); });
  EXPECT_NEAR(c.end().y - before.y, exact, 1e-3 * exact);
  // Its clamped section: the moment of the load about it, and no thrust.
  const BeamForces of = c.forces_in(0);
  EXPECT_NEAR(of.moment[0], -load * radius, 2e-3 * load * radius);
}

/// A couple 2 pi EI/L makes a cantilever a circle (Simo and Vu-Quoc 1986).
TEST(Beam, ACantileverRollsUp) {
  constexpr double length = 10.0;
  const double couple = 2.0 * pi * section.young * section.inertia / length;
  Chain c = straight(length, 24);
  for (int n = 1; n <= 24; ++n)
    c.load([&](const auto& x) { return couple_at_the_end(x, couple * n / 24); });
  EXPECT_LT(norm(c.end()), 1e-6 * length);
}

/// What a rectangle can carry lies within its tangents, and not far.
TEST(Beam, StrengthOfARectangle) {
  constexpr double compressive = 30e6, tensile = 3e6, area = 0.3;
  const SectionStrength s = rectangle_strength(compressive, tensile, area, thick);
  EXPECT_NEAR(utilisation(s, -compressive * area, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(utilisation(s, tensile * area, 0.0), 1.0, 1e-12);
  for (double x = 0.02; x < 1.0; x += 0.03) {
    const double n = area * (tensile * x - compressive * (1.0 - x)),
                 m = 0.5 * (compressive + tensile) * area * thick * x * (1.0 - x);
    EXPECT_LE(utilisation(s, n, m), 1.0 + 1e-12);
    EXPECT_GT(utilisation(s, n, m), 0.99);
    EXPECT_NEAR(utilisation(s, n, -m), utilisation(s, n, m), 1e-12);
  }
  // Half in tension, half in compression: f A t/4.
  EXPECT_NEAR(utilisation(rectangle_strength(2e8, 2e8, area, thick), 0.0, 2e8 * area * thick / 4),
              1.0, 1e-12);
}

/// All of its corners are at the limit, and the first and last are those of thrust alone.
TEST(Beam, OutlineOfAStrength) {
  constexpr double compressive = 20e6, tensile = 2e6, area = deep * thick;
  const SectionStrength s = rectangle_strength(compressive, tensile, area, thick);
  const std::vector<Vec2> corners = outline_of(s);
  ASSERT_EQ(corners.size(), s.size() + 1);
  EXPECT_NEAR(corners.front().x, -compressive * area, 1.0);
  EXPECT_NEAR(corners.back().x, tensile * area, 1.0);
  double largest = 0.0;
  for (const Vec2 c : corners) {
    EXPECT_NEAR(utilisation(s, c.x, c.y), 1.0, 1e-9);
    largest = std::max(largest, c.y);
  }
  const double exact = 0.125 * (compressive + tensile) * area * thick;
  EXPECT_GE(largest, exact);
  EXPECT_LT(largest, 1.01 * exact);
  EXPECT_TRUE(outline_of({}).empty());
}

/// A piece that becomes stiffer carries what it has carried, and stores less by what its forces had
/// stretched it.
TEST(Beam, AnotherShapeCarriesOn) {
  const double r = 4.0;
  const BeamCorners at{Vec2{r, 0.0}, Vec2{r * std::cos(0.2), r * std::sin(0.2)},
                       Vec2{(r - thick) * std::cos(0.2), (r - thick) * std::sin(0.2)},
                       Vec2{r - thick, 0.0}};
  BeamSection stiffer = section;
  stiffer.young *= 3.0;
  stiffer.shear_modulus *= 2.0;
  const BeamShape from = beam_shape(section, at, mass), to = beam_shape(stiffer, at, mass);
  BeamCorners x = at;
  for (std::size_t c = 0; c < x.size(); ++c)
    x[c] += 1e-4 * Vec2{std::sin(1.0 + 3.0 * double(c)), std::cos(2.0 * double(c))};
  BeamState state = beam_at_start(at);
  const BeamResult before = evaluate_beam(from, {}, x, state);
  const double more = change_shape(from, to, x, state);
  const BeamResult after = evaluate_beam(to, {}, x, state);
  for (std::size_t c = 0; c < x.size(); ++c)
    EXPECT_LT(norm(after.force[c] - before.force[c]), 1e-6 * norm(before.force[c])) << c;
  EXPECT_NEAR(after.stored, before.stored + more, 1e-9 * before.stored);
  EXPECT_LT(after.stored, 0.6 * before.stored);
}

/// On any path forces stay within the strength, and what is put in is stored or dissipated.
TEST(Beam, HingesKeepToTheStrengthAndDissipate) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0}, Vec2{0.8, 0.3}, Vec2{0, 0.3}};
  const BeamShape shape = beam_shape(section, drawn, mass);
  const SectionStrength strength = rectangle_strength(30e6, 3e6, section.area, thick);
  BeamState state = beam_at_start(drawn);
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> any(-2e-3, 2e-3);
  BeamCorners x = drawn, target = drawn;
  BeamResult r = evaluate_beam(shape, strength, x, state);
  double work = 0.0, dissipated = 0.0, most = 0.0;
  for (int n = 0; n < 4000; ++n) {
    if (n % 400 == 0)
      for (std::size_t k = 0; k < 4; ++k) target[k] = drawn[k] + Vec2{any(rng), any(rng)};
    const BeamCorners before = x;
    const BeamResult last = r;
    for (std::size_t k = 0; k < 4; ++k) x[k] += 0.01 * (target[k] - x[k]);
    r = evaluate_beam(shape, strength, x, state);
    for (std::size_t k = 0; k < 4; ++k)
      work -= 0.5 * dot(last.force[k] + r.force[k], x[k] - before[k]);
    EXPECT_GE(r.dissipated, -1e-6);
    dissipated += r.dissipated;
    for (const double m : state.forces.moment)
      most = std::max(most, utilisation(strength, state.forces.axial, m));
  }
  EXPECT_LT(most, 1.0 + 1e-6);
  EXPECT_GT(most, 1.0 - 1e-6);
  EXPECT_GT(dissipated, 1e3);
  EXPECT_NEAR(r.stored + dissipated, work, 2e-3 * work);
}

/// A cantilever of one piece under a growing moment at its end: M stays at M_p, the end turns.
TEST(Beam, PlasticMoment) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0}, Vec2{0.8, 0.3}, Vec2{0, 0.3}};
  const BeamShape shape = beam_shape(section, drawn, mass);
  constexpr double yield = 250e6;
  const SectionStrength strength = rectangle_strength(yield, yield, section.area, thick);
  const double plastic = yield * section.area * thick / 4.0;
  BeamState state = beam_at_start(drawn);
  for (int n = 0; n <= 100; ++n) {
    BeamCorners x = drawn;
    const Vec2 middle{0.8, 0.15};
    for (const std::size_t k : {1u, 2u}) x[k] = middle + rotated(x[k] - middle, 1e-3 * n);
    evaluate_beam(shape, strength, x, state);
  }
  EXPECT_NEAR(state.forces.moment[1], plastic, 1e-6 * plastic);
  EXPECT_GT(state.hinge[1], 0.0);
}

/// Viscous forces are eta times the rate of the elastic ones, also of a curved piece that has
/// turned.
TEST(Beam, ViscousForcesGrowAsElasticOnesDo) {
  constexpr double r = 4.0, eta = 2e-4, small = 1e-7;
  BeamCorners x{Vec2{r, 0.0}, Vec2{r * std::cos(0.2), r * std::sin(0.2)},
                Vec2{(r - thick) * std::cos(0.2), (r - thick) * std::sin(0.2)},
                Vec2{r - thick, 0.0}};
  for (Vec2& at : x) at = rotated(at, 1.1);
  const BeamShape shape = beam_shape(section, x, mass);
  const BeamCorners v{Vec2{0.3, -0.2}, Vec2{-0.1, 0.5}, Vec2{0.7, 0.2}, Vec2{-0.4, -0.6}};
  BeamState state = beam_at_start(x);
  const BeamCorners rate = viscous_forces(shape, state, x, v, eta);
  BeamCorners moved = x, spin = x;
  for (std::size_t c = 0; c < x.size(); ++c) {
    moved[c] += small * v[c];
    spin[c] = perp(x[c]);
  }
  const BeamCorners none = viscous_forces(shape, state, x, spin, eta);
  const BeamResult after = evaluate_beam(shape, {}, moved, state);
  for (std::size_t c = 0; c < x.size(); ++c) {
    EXPECT_LT(norm(rate[c] - (eta / small) * after.force[c]), 1e-4 * norm(rate[c]));
    EXPECT_LT(norm(none[c]), 1e-9 * norm(rate[c]));
  }
}

/// A bar that is pulled breaks at its tensile strength and keeps the residual one, by which it is
/// unloaded and loaded again; what is put in is stored or dissipated.
TEST(Beam, BarInTensionKeepsItsResidualStrength) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0}, Vec2{0.8, thick}, Vec2{0, thick}};
  const BeamShape shape = beam_shape(section, drawn, mass);
  const SectionStrength peak = rectangle_strength(30e6, 3e6, section.area, thick),
                        after = rectangle_strength(20e6, 0.5e6, section.area, thick);
  BeamState state = beam_at_start(drawn);
  const double yields_at = 3e6 / section.young * 0.8;  // m
  double most = 0.0, work = 0.0, dissipated = 0.0, moved = 0.0, stored = 0.0;
  BeamResult r = evaluate_beam(shape, peak, drawn, state, after);
  const auto pull_to = [&](double to) {
    for (int n = 0; n < 100; ++n) {
      const double step = (to - moved) / (100 - n);
      const BeamResult last = r;
      BeamCorners x = drawn;
      for (const std::size_t k : {1u, 2u}) x[k].x += moved + step;
      r = evaluate_beam(shape, peak, x, state, after);
      for (const std::size_t k : {1u, 2u}) work -= 0.5 * step * (last.force[k].x + r.force[k].x);
      moved += step;
      dissipated += r.dissipated;
      stored = r.stored;
      most = std::max(most, state.forces.axial);
    }
    return state.forces.axial;
  };
  EXPECT_NEAR(pull_to(0.9 * yields_at), 0.9 * 3e6 * section.area, 1.0);
  EXPECT_EQ(state.yielded[0] + state.yielded[1], 0.0);
  EXPECT_NEAR(pull_to(3.0 * yields_at), 0.5e6 * section.area, 1.0);
  EXPECT_EQ(state.yielded[0] + state.yielded[1], 2.0);
  EXPECT_NEAR(most, 3e6 * section.area, 0.03 * 3e6 * section.area);
  pull_to(2.9 * yields_at);
  EXPECT_NEAR(pull_to(4.0 * yields_at), 0.5e6 * section.area, 1.0);
  EXPECT_NEAR(utilisation(strength_at(state, 0, peak, after), state.forces.axial, 0.0), 1.0, 1e-9);
  EXPECT_NEAR(work, stored + dissipated, 1e-3 * work);
  EXPECT_NEAR(pull_to(-80.0 * yields_at), -20e6 * section.area,
              20.0);  // crushed, as crushed concrete
}

/// One end bends beyond its strength: it alone softens, to the moment of the residual strengths.
TEST(Beam, OnlyTheEndThatYieldsSoftens) {
  const BeamCorners drawn{Vec2{0, 0}, Vec2{0.8, 0}, Vec2{0.8, thick}, Vec2{0, thick}};
  const BeamShape shape = beam_shape(section, drawn, mass);
  const SectionStrength peak = rectangle_strength(20e6, 20e6, section.area, thick),
                        after = rectangle_strength(5e6, 5e6, section.area, thick);
  const double whole = 20e6 * section.area * thick / 4.0;
  // The other end is held where it has 0.6 of the moment, as under a shear force.
  BeamState state = beam_at_start(drawn);
  double most = 0.0;
  for (int n = 0; n <= 200; ++n) {
    BeamCorners x = drawn;
    const Vec2 middle{0.8, 0.5 * thick + 1e-5 * n};
    for (const std::size_t k : {1u, 2u})
      x[k] = middle + rotated(drawn[k] - Vec2{0.8, 0.5 * thick}, 5e-5 * n);
    evaluate_beam(shape, peak, x, state, after);
    most = std::max(most, std::abs(state.forces.moment[1]));
    if (state.yielded[1] != 0.0 && state.yielded[0] == 0.0 && n > 150) break;
  }
  EXPECT_EQ(state.yielded[1], 1.0);
  EXPECT_NEAR(most, whole, 0.03 * whole);
  EXPECT_LE(std::abs(state.forces.moment[1]), 0.25 * whole * (1.0 + 1e-6));
  EXPECT_EQ(state.yielded[0], 0.0);
  EXPECT_GT(std::abs(state.forces.moment[0]), 0.0);
}

/// Young concrete that has cracked has no more strength than before.
TEST(LiningStrength, NeverGrowsByYielding) {
  Model model;
  Lining lining;
  lining.thickness = 0.2;
  lining.residual = LiningResidual{4e6, 1e6};
  Material young, old;
  young.strength = RockStrength{2e6, 1.5e6};
  old.strength = RockStrength{20e6, 3e6};
  const auto thrust = [&](const Material& m, bool residual) {
    return outline_of(strength_of(model, lining, m, residual)).front().x;
  };
  EXPECT_DOUBLE_EQ(thrust(young, false), -2e6 * 0.2);
  EXPECT_DOUBLE_EQ(thrust(young, true), -2e6 * 0.2);
  EXPECT_DOUBLE_EQ(thrust(old, true), -4e6 * 0.2);
  EXPECT_DOUBLE_EQ(outline_of(strength_of(model, lining, young, true)).back().x, 1e6 * 0.2);
}

}  // namespace
}  // namespace edda::beam_test
