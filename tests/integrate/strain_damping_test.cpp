// Viscous strain of a block: the stress that its new rate of strain makes, and the energy it takes.
#include "integrate/strain_damping.hpp"

#include <gtest/gtest.h>

#include "blocks/build_blocks.hpp"
#include "integrate/leapfrog.hpp"

namespace edda::strain_damping_test {
namespace {

constexpr double viscosity = 3e-4, h = 1e-4;

struct Strained {
  BlockSet blocks;
  Masses masses;
  State state;
  BodyVectors none, old_velocity;
  StrainDamping damping;
  double before = 0.0, after = 0.0;  ///< kinetic energy, J

  /// A block that strains and turns, and one step of it without any force.
  explicit Strained(MassKind kind, double h_old, double h_new) {
    Model model;
    model.solver.mass = kind;
    model.materials.push_back({"rock", 1000.0, 1e9, 0.3, {}});
    PolygonSet set;
    BlockPolygon p;
    p.rings = {{{0, 0}, {2, 0}, {2.2, 1}, {0, 1.3}}};
    p.joint = {std::vector<Index>(4, none_)};
    p.material = 0;
    set.blocks.push_back(p);
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
    masses.viscosity = {viscosity};
    state = initial_state(blocks, set);
    const double vx[3] = {0.1, -0.2, 0.05}, vy[3] = {0.03, 0.1, -0.15};
    for (std::size_t k = 0; k < 3; ++k) {
      state.velocity.x[k][0] = vx[k];
      state.velocity.y[k][0] = vy[k];
    }
    none = zero_vectors(blocks);
    old_velocity = state.velocity;
    before = kinetic_energy(masses, blocks, state.velocity, 0);
    prepare(damping, blocks, masses, 0.5 * (h_old + h_new));
    const StepDamping of_step{0.0, 0.0, nullptr, &damping};
    advance(state, {blocks, masses, none, old_velocity, h_old, h_new, of_step});
    after = kinetic_energy(masses, blocks, state.velocity, 0);
  }
  StrainTerms rate(const BodyVectors& velocity) const {
    return strain_rate(strain_frame({1.0, 0.0, 0.0, 1.0}), deformation(blocks, velocity, 0));
  }

 private:
  static constexpr Index none_ = edda::none;
};

TEST(StrainDamping, StressIsThatOfTheNewRateOfStrain) {
  for (MassKind kind : {MassKind::matched, MassKind::consistent}) {
    const Strained o(kind, h, h);
    const StrainTerms rate = o.rate(o.state.velocity);
    const double lambda = o.blocks.lame_lambda[0], mu = o.blocks.lame_mu[0];
    const double whole = viscosity * o.blocks.volume[0], size = whole * mu * 0.1;
    EXPECT_NEAR(o.damping.stress[0][0], whole * (lambda * (rate.xx + rate.yy) + 2.0 * mu * rate.xx),
                1e-3 * size);
    EXPECT_NEAR(o.damping.stress[1][0], whole * (lambda * (rate.xx + rate.yy) + 2.0 * mu * rate.yy),
                1e-3 * size);
    EXPECT_NEAR(o.damping.stress[2][0], whole * mu * rate.xy, 1e-3 * size);
  }
}

TEST(StrainDamping, TakesTheEnergyThatItBooks) {
  for (MassKind kind : {MassKind::matched, MassKind::consistent}) {
    const Strained o(kind, h, h);
    EXPECT_LT(o.after, 0.95 * o.before);
    const double booked = o.damping.work[0];
    EXPECT_NEAR(booked, o.before - o.after, 1e-3 * booked);
    // A motion as a whole is left alone.
    const Vec2 was = centroid(o.old_velocity, 0), is = centroid(o.state.velocity, 0);
    EXPECT_NEAR(norm(is - was), 0.0, 1e-12);
  }
}

/// s . (h_old dU/dt- + h_new dU/dt+)/2.
double work_of_step(const Strained& o, double h_old, double h_new) {
  const StrainTerms was = o.rate(o.old_velocity), is = o.rate(o.state.velocity);
  const double moved[3] = {h_old * was.xx + h_new * is.xx, h_old * was.yy + h_new * is.yy,
                           h_old * was.xy + h_new * is.xy};
  double work = 0.0;
  for (std::size_t q = 0; q < 3; ++q) work += 0.5 * o.damping.stress[q][0] * moved[q];
  return work;
}

TEST(StrainDamping, BooksBothStepsWhereTheyDiffer) {
  const double h_new = 3.0 * h;
  const Strained o(MassKind::matched, h, h_new);
  const double expected = work_of_step(o, h, h_new);
  EXPECT_NEAR(o.damping.work[0], expected, 1e-3 * expected);
}

TEST(StrainDamping, BooksWhatAChangeOfTheVelocitiesLeaves) {
  const double h_new = 3.0 * h;
  for (MassKind kind : {MassKind::matched, MassKind::consistent}) {
    Strained o(kind, h, h_new);
    const double without = o.damping.work[0];
    const NodeVectors change{Vec2{0.2, 0.1}, Vec2{-0.1, 0.3}, Vec2{-0.2, -0.1}};
    const NodeVectors remains = damped_change(o.damping, o.blocks, o.masses, o.state,
                                              {o.old_velocity, h, h_new}, 0, change);
    add(remains, o.state.velocity, 0);
    const double expected = work_of_step(o, h, h_new);
    EXPECT_GT(std::abs(expected - without), 0.01 * std::abs(without));
    EXPECT_NEAR(o.damping.work[0], expected, 1e-3 * std::abs(expected));
  }
}

TEST(StrainDamping, BooksNothingForWhatIsExcavated) {
  for (MassKind kind : {MassKind::matched, MassKind::consistent}) {
    Strained o(kind, h, h);
    EXPECT_GT(o.damping.work[0], 0.0);
    o.state.alive[0] = 0;
    o.state.velocity = o.old_velocity = zero_vectors(o.blocks);
    const StepDamping of_step{0.0, 0.0, nullptr, &o.damping};
    advance(o.state, {o.blocks, o.masses, o.none, o.old_velocity, h, h, of_step});
    EXPECT_EQ(o.damping.work[0], 0.0);
  }
}

/// A block that flies is spared by the mass damping for which W was computed.
TEST(StrainDamping, BooksTheEnergyOfABlockThatFlies) {
  constexpr double strong = 1.0 / h;
  Strained o(MassKind::matched, h, h);
  o.state.velocity = o.old_velocity;
  o.state.position.x = o.blocks.node_x;
  o.state.position.y = o.blocks.node_y;
  BlockKicks kicks{{0.0}, {}, {}};
  set_kicks(kicks, h);
  prepare(o.damping, o.blocks, o.masses, kicks.h);
  const StepDamping of_step{strong, 0.0, nullptr, &o.damping, nullptr, &kicks};
  advance(o.state, {o.blocks, o.masses, o.none, o.old_velocity, h, h, of_step});
  const double lost = o.before - kinetic_energy(o.masses, o.blocks, o.state.velocity, 0);
  EXPECT_GT(lost, 0.02 * o.before);
  EXPECT_NEAR(o.damping.work[0], lost, 1e-3 * lost);
}

/// The loop that adds forces, kicks, damps and moves does what these do one after another.
TEST(StrainDamping, DampsAsItDoesStepByStep) {
  Strained one(MassKind::matched, h, h), all(MassKind::matched, h, h);
  const auto forces = [&](double first_x, double first_y) {
    BodyVectors f = zero_vectors(one.blocks);
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      f.x[k][0] = first_x * (1.0 + static_cast<double>(k));
      f.y[k][0] = first_y * (1.0 + static_cast<double>(k));
    }
    return f;
  };
  const BodyVectors on = forces(3e3, -2e3);
  const auto step = [&](Strained& o, bool at_once) {
    BodyVectors all_forces = forces(-1e3, 5e3);
    const BodyVectors before = o.state.velocity;
    const StepDamping of_step{0.0, 0.0, nullptr, &o.damping};
    const Leap leap{o.blocks, o.masses, all_forces, before, h, h, of_step};
    if (at_once) {
      add_and_advance(o.state, leap, {on, all_forces}, 0, 1);
    } else {
      add_to_free(o.blocks, o.state, {on, all_forces}, 0, 1);
      advance(o.state, leap, 0, 1);
    }
    EXPECT_EQ(all_forces.x[1][0], 2.0 * 2e3);
  };
  step(all, true);
  step(one, false);
  EXPECT_EQ(all.state.position.x, one.state.position.x);
  EXPECT_EQ(all.state.position.y, one.state.position.y);
  EXPECT_EQ(all.state.velocity.x, one.state.velocity.x);
  EXPECT_EQ(all.damping.work, one.damping.work);
  EXPECT_GT(all.damping.work[0], 0.0);
}

}  // namespace
}  // namespace edda::strain_damping_test
