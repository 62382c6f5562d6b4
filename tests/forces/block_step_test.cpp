// What decides the step of a block: its matrices, and the bound that follows from them.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "attachments/bolted_blocks.hpp"
#include "contacts/moved_blocks.hpp"
#include "forces/block_matrices.hpp"
#include "forces/bolt_matrix.hpp"
#include "forces/mass_scaling.hpp"
#include "forces/step_bound.hpp"
#include "forces/viscosity.hpp"

namespace edda::block_step_test {
namespace {

using test::MovedBlocks;

StepBound bound_of(const MovedBlocks& m, const Damping& damping = {}) {
  BoundarySprings none;
  none.block_begin.assign(m.blocks.size() + 1, 0);
  return step_bound({m.blocks, m.masses, m.state, m.faces, none, m.laws, damping});
}

/// Two squares of 1 m one over the other, the lower one held or not.
MovedBlocks two_squares(bool held) {
  MovedBlocks m;
  m.model.joints = {test::rough_joint(30.0)};
  m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e6;
  m.add({{0, -1}, {1, -1}, {1, 0}, {0, 0}}, held);
  m.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  m.start();
  return m;
}

/// The uniform displacement d of the whole block.
NodalVector moved(Vec2 d) {
  NodalVector u;
  u << d.x, d.y, d.x, d.y, d.x, d.y;
  return u;
}

/// A joint far stiffer than all else: Int k (1 - s/l) ds = k l/2 at either corner of the edge,
/// twice that against a block that is free, too; 2/w of M^-1 K.
TEST(StepBound, OfAStiffJointIsThatOfItsSpringsAtTheCorners) {
  for (const bool held : {true, false}) {
    MovedBlocks m = two_squares(held);
    const double k = 1e16;
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
      const bool between = m.blocks.vertex(m.faces.edge[f]).y == 0.0 &&
                           m.blocks.vertex(m.faces.edge_end[f]).y == 0.0 &&
                           m.blocks.vertex(m.faces.facing[f]).y == 0.0 &&
                           m.blocks.vertex(m.faces.facing_end[f]).y == 0.0;
      if (between) m.faces.stiffness[f] = k;
    }
    NodalMatrix stiffness = NodalMatrix::Zero();
    for (const Id v : {m.blocks.vertex_begin[1], m.blocks.vertex_begin[1] + 1}) {
      ASSERT_EQ(m.blocks.vertex(v).y, 0.0);
      const NodalVector up = along(weights_of(m.blocks.weight, v), {0.0, 1.0});
      stiffness += (held ? 1.0 : 2.0) * 0.5 * k * up * up.transpose();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<NodalMatrix> solver(stiffness,
                                                                       mass_matrix(m.masses, 1));
    EXPECT_NEAR(bound_of(m).critical_step, 2.0 / std::sqrt(solver.eigenvalues()[5]),
                1e-3 * bound_of(m).critical_step)
        << held;
  }
}

/// beta of local damping makes springs look (1 + beta) times as stiff.
TEST(StepBound, LocalDampingShortensIt) {
  const MovedBlocks m = two_squares(false);
  const double whole = bound_of(m).critical_step;
  for (const double beta : {0.3, 0.8}) {
    Damping damping;
    damping.local = beta;
    EXPECT_NEAR(bound_of(m, damping).critical_step, whole / std::sqrt(1.0 + beta), 1e-9 * whole);
  }
  Damping dragged;
  dragged.mass = 4.0 / whole;
  EXPECT_NEAR(bound_of(m, dragged).critical_step, 0.25 * whole, 1e-9 * whole);
}

/// h^2 k/4 + h (c - d)/2 = m: dashpots of contacts shorten it, viscous rock makes it longer.
TEST(StepBound, DashpotsShortenItAndViscousRockMakesItLonger) {
  MovedBlocks m = two_squares(false);
  const double whole = bound_of(m).critical_step;
  Damping damping;
  damping.contact = 5.0;
  EXPECT_LT(bound_of(m, damping).critical_step, (1.0 - 1e-3) * whole);
  m.blocks.damping.assign(2, 0.5);
  fill_viscosity(m.masses, m.blocks, {});
  EXPECT_GT(bound_of(m).critical_step, 1.1 * whole);
}

/// Steps with what is known of blocks, and with nothing.
struct TwiceAsked {
  MovedBlocks m;
  BoundarySprings springs;
  Damping damping;
  StepCache known;
  double last = 0.0;

  StiffnessInputs inputs() const {
    return {m.blocks, m.masses, m.state, m.faces, springs, m.laws, damping};
  }
  double critical(StepCache* of) const { return step_bound(inputs(), of).critical_step; }
  std::vector<double> of_blocks(double limit, StepCache* of) const {
    return steps_of_blocks(inputs(), limit, of);
  }
  /// What has changed changes the step, and it is the same to the bit.
  void changes(const char* what) {
    const double anew = critical(nullptr);
    EXPECT_NE(anew, last) << what;
    for (int again = 0; again < 2; ++again) {
      EXPECT_EQ(critical(&known), anew) << what;
      EXPECT_EQ(of_blocks(2.0 * anew, &known), of_blocks(2.0 * anew, nullptr)) << what;
    }
    last = anew;
  }
};

TEST(StepCache, GoWithAllThatAStepIsMadeOf) {
  TwiceAsked t{two_squares(false), {}, {}, {}};
  MovedBlocks& m = t.m;
  m.add({{5, 0}, {6, 0}, {6, 1}, {5, 1}});
  m.start();
  t.springs.block_begin.assign(4, 0);
  m.blocks.damping.assign(3, 0.3);
  fill_viscosity(m.masses, m.blocks, {});
  t.changes("as it was");
  for (std::size_t k = 0; k < m.faces.size(); ++k) m.faces.stiffness[k] *= 8.0;
  t.changes("normal stiffness of faces");
  for (std::size_t k = 0; k < m.faces.size(); ++k) m.faces.shear_stiffness[k] *= 8.0;
  t.changes("shear stiffness of faces");
  t.damping.contact = 0.5;
  t.changes("dashpots");
  m.laws.rows[0].shear_damping = 0.5;
  t.changes("dashpots along faces");
  t.damping.local = 0.5;
  t.changes("local damping");
  for (double& viscosity : m.masses.viscosity) viscosity *= 0.5;
  t.changes("viscosity");
  for (auto& mass : m.masses.node) {
    for (double& kg : mass) kg *= 3.0;
  }
  t.changes("mass");
  m.blocks.fixed[0] = 1;
  t.changes("a block that is held");
  m.faces = FaceSet{};
  m.state.alive[0] = 0;
  find_faces(m.faces, m.blocks, m.state, m.pose, m.laws, {0.1}, m.near, {});
  t.changes("no faces");
  m.laws.penalty.normal *= 1e3;
  m.laws.penalty.shear *= 1e3;
  t.changes("stiffness of bare edges");
  m.blocks.fixed[2] = 1;
  t.changes("one that moves alone");
  for (auto* lame : {&m.blocks.lame_lambda, &m.blocks.lame_mu}) {
    for (double& pascal : *lame) pascal *= 100.0;
  }
  t.changes("stiffness of rock");
  t.damping.mass = 4.0 / t.last;
  t.changes("drag");
}

/// Edges of 2 m and 1 m: a face of the one has the numbers of the other alone.
TEST(StepCache, GoWithTheEdgeThatHasAFace) {
  TwiceAsked t;
  MovedBlocks& m = t.m;
  m.model.joints = {test::rough_joint(30.0)};
  m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e12;
  m.add({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  m.add({{0.5, -1}, {1.5, -1}, {1.5, 0}, {0.5, 0}});
  m.start();
  t.springs.block_begin.assign(3, 0);
  const auto own = [&](StepCache* of) {
    return t.of_blocks(std::numeric_limits<double>::infinity(), of)[0];
  };
  double last = 0.0;
  for (const Vec2 to : {Vec2{0.0, 0.0}, Vec2{1.5, 1.3}, Vec2{0.0, 0.0}}) {
    m.put(1, {to});
    m.faces = FaceSet{};
    find_faces(m.faces, m.blocks, m.state, m.pose, m.laws, {0.03}, m.near, {});
    ASSERT_EQ(m.faces.size(), 1u);
    EXPECT_NE(own(nullptr), last);
    last = own(nullptr);
    EXPECT_EQ(own(&t.known), last);
  }
}

/// What boundaries do to a block goes with how it has turned.
TEST(StepCache, AreNotThoseOfBlocksAtBoundaries) {
  TwiceAsked t;
  MovedBlocks& m = t.m;
  m.model.joints = {test::rough_joint(30.0)};
  m.model.boundaries = {test::boundary_along(BoundaryType::roller, {0, 0}, {2, 1}, 1e13)};
  m.add({{0, 0}, {2, 1}, {1, 2}});
  m.start();
  t.springs = attach_boundaries(m.model, m.blocks).value();
  t.changes("as drawn");
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 p = rotated({m.state.position.x[k][0], m.state.position.y[k][0]}, 0.7);
    m.state.position.x[k][0] = p.x;
    m.state.position.y[k][0] = p.y;
  }
  t.changes("turned");
}

/// A square of 1 m: its softest vibrations are shear and a stretch that leaves its area, both at
/// w^2 = 24 G/rho.
TEST(Viscosity, IsTheFractionOfTheSoftestVibration) {
  MovedBlocks m = two_squares(true);
  const double frequency = std::sqrt(24.0 * m.blocks.lame_mu[1] / 2600.0);
  EXPECT_NEAR(lowest_frequency(m.blocks, m.masses, 1), frequency, 1e-9 * frequency);
  m.blocks.damping.assign(2, 0.25);
  fill_viscosity(m.masses, m.blocks, {});
  EXPECT_NEAR(m.masses.viscosity[1], 2.0 * 0.25 / frequency, 1e-9 / frequency);
}

/// Seen from the frame of a block that has turned, a slanted roller holds it across its line.
TEST(BlockMatrices, BoundarySpringsStandInSpaceAndNotInTheBlock) {
  MovedBlocks m;
  m.model.joints = {test::rough_joint(30.0)};
  m.model.boundaries = {test::boundary_along(BoundaryType::roller, {0, 0}, {2, 1}, 3.0)};
  m.add({{0, 0}, {2, 1}, {1, 2}});
  m.start();
  const BoundarySprings springs = attach_boundaries(m.model, m.blocks).value();
  ASSERT_EQ(springs.size(), 2u);
  const double turn = 0.7;
  const NodalMatrix k =
      boundary_matrix(m.blocks, springs, {std::cos(turn), std::sin(turn), 2.0, 0.5}, 0);
  const Vec2 n = perp(unit(Vec2{2, 1}));
  for (const Vec2 d : {Vec2{1, 0}, Vec2{0, 1}, Vec2{0.6, -0.8}}) {
    const NodalVector u = moved(rotated(d, -turn));
    EXPECT_NEAR(u.dot(k * u), 2.0 * 3.0 * dot(n, d) * dot(n, d), 1e-12);
  }
}

/// Grouted: the bonds, along the bolt. With ends: the bar along it, and its pull over its length
/// across, each twice, as the other block is free.
TEST(BoltMatrix, HasTheSpringsOfABolt) {
  test::Bolted m;
  m.add({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  m.add({{0, 2.5}, {4, 2.5}, {4, 4.5}, {0, 4.5}});
  m.build();
  Bolt bolt = test::grouted({2, 1}, {2, 4});
  m.model.bolts = {bolt};
  m.attach();
  ASSERT_TRUE(m.faults.empty());
  const NodalVector up = moved({0, 1}), across = moved({1, 0});
  const NodalMatrix bonds = bolt_matrix(m.bolts, m.blocks, m.state, 0);
  EXPECT_NEAR(up.dot(bonds * up), 1e9 * 1.0, 1e-3 * 1e9);   // 1 m of it in the block
  EXPECT_NEAR(across.dot(bonds * across), 2.0 * 1e7, 1.0);  // its dowel
  bolt.type = BoltType::end;
  bolt.pretension = 6e4;
  bolt.yield_stress = 400e6;
  m.model.bolts = {bolt};
  m.attach();
  ASSERT_TRUE(m.faults.empty());
  const NodalMatrix ends = bolt_matrix(m.bolts, m.blocks, m.state, 0);
  const double area = 0.25 * std::numbers::pi * 4e-4, stiffness = bolt.young * area / 3.0;
  EXPECT_NEAR(up.dot(ends * up), 2.0 * stiffness, 1e-6 * stiffness);
  // At most its yield, which a strain of 0.01 is beyond.
  EXPECT_NEAR(across.dot(ends * across), 2.0 * 400e6 * area / 3.0, 1e-6 * stiffness);
}

/// Energy of a link that has turned by half a radian, within its strength and beyond it and on hard
/// and soft foundations, of any displacements of both blocks, and of those across the bolt alone:
/// the bound of the blocks is never less.
TEST(BoltMatrix, BoundsALinkThatHasTurned) {
  for (const auto& [yield, foundation] :
       {std::pair{400e6, 20e9}, {40e9, 20e9}, {400e6, 1e7}, {40e9, 1e7}}) {
    test::Bolted m;
    m.add({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
    m.add({{0, 2}, {4, 2}, {4, 4}, {0, 4}});
    m.build();
    Bolt bolt = test::grouted({1.5, 0.5}, {2.5, 3.5});
    bolt.yield_stress = yield;
    bolt.dowel = BoltDowel{{}, {}, yield / 8.0, foundation};
    m.model.bolts = {bolt};
    m.attach();
    ASSERT_TRUE(m.faults.empty());
    const auto move = [&](State& state, std::size_t i, const NodalVector& u) {
      for (std::size_t k = 0; k < 3; ++k) {
        state.position.x[k][i] += u[static_cast<Eigen::Index>(2 * k)];
        state.position.y[k][i] += u[static_cast<Eigen::Index>(2 * k + 1)];
      }
    };
    for (int n = 0; n < 400; ++n) {
      move(m.state, 1, moved({1e-4, 0.0}));
      update_bolts(m.bolts, m.blocks, m.state);
    }
    const auto forces = [&](const NodalVector& low, const NodalVector& high) {
      Bolts bolts = m.bolts;
      State state = m.state;
      move(state, 0, low);
      move(state, 1, high);
      update_bolts(bolts, m.blocks, state);
      std::array<NodalVector, 2> f;
      for (std::size_t i = 0; i < 2; ++i) {
        BlockForces on{m.blocks, i};
        add_bolts(on, bolts);
        for (std::size_t k = 0; k < 3; ++k) {
          f[i][static_cast<Eigen::Index>(2 * k)] = on.sum.nodes[k].x;
          f[i][static_cast<Eigen::Index>(2 * k + 1)] = on.sum.nodes[k].y;
        }
      }
      return f;
    };
    const std::array<NodalMatrix, 2> bound{bolt_matrix(m.bolts, m.blocks, m.state, 0),
                                           bolt_matrix(m.bolts, m.blocks, m.state, 1)};
    double largest = 0.0;
    std::srand(1);
    for (int n = 0; n < 300; ++n) {
      const bool across = n % 10 == 0;
      const NodalVector low = across ? moved({3.0, -1.0}) : NodalVector::Random(),
                        high = across ? NodalVector(-low) : NodalVector::Random();
      const double h = 1e-8;
      const auto more = forces(h * low, h * high), less = forces(-h * low, -h * high);
      const double energy =
          ((less[0] - more[0]).dot(low) + (less[1] - more[1]).dot(high)) / 2.0 / h;
      const double most = low.dot(bound[0] * low) + high.dot(bound[1] * high);
      largest = std::max(largest, energy / most);
    }
    EXPECT_LT(largest, 1.0);
    EXPECT_GT(largest, 0.02);
  }
}

/// A block that needs a step of 1 s takes three times its mass more to bear one of 2 s.
TEST(MassScaling, AddsByTheSquareOfTheSteps) {
  MovedBlocks m = two_squares(false);
  const double mass = m.blocks.mass[0];
  const double step = step_that_adds(m.blocks, {1.0, 3.0}, 3.0 * mass);
  EXPECT_NEAR(step, 2.0, 1e-9);
}

/// h^2 p/4 + h c/2 = m of a stiff joint against a held block, c = 2 zeta sqrt(p m) at each corner,
/// m the mass that the corner feels.
TEST(StepBound, OfAStiffJointWithDashpots) {
  MovedBlocks m = two_squares(true);
  const double k = 1e16, p = 0.5 * k, zeta = 0.4;
  const Id first = m.blocks.vertex_begin[1];
  for (std::size_t f = 0; f < m.faces.size(); ++f) {
    if (m.faces.facing[f] == first && m.blocks.vertex(m.faces.edge[f]).y == 0.0 &&
        m.blocks.vertex(m.faces.edge_end[f]).y == 0.0) {
      m.faces.stiffness[f] = k;
    }
  }
  NodalMatrix unit_springs = NodalMatrix::Zero();
  for (const Id v : {first, first + 1}) {
    const NodalVector up = along(weights_of(m.blocks.weight, v), {0.0, 1.0});
    unit_springs += up * up.transpose();
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<NodalMatrix> solver(unit_springs,
                                                                     mass_matrix(m.masses, 1));
  const double mass = 1.0 / solver.eigenvalues()[5];
  const double c = 2.0 * zeta * std::sqrt(p / m.masses.point_inverse[first]);
  Damping damping;
  damping.contact = zeta;
  const double h = 2.0 * (std::sqrt(0.25 * c * c + p * mass) - 0.5 * c) / p;
  EXPECT_NEAR(bound_of(m, damping).critical_step, h, 2e-3 * h);
}

TEST(BlockMatrices, TurnWithTheBlock) {
  MovedBlocks m = two_squares(true);
  const double turn = 0.7;
  const NodalMatrix own = elastic_matrix(m.blocks, 1),
                    seen = edda::rotated(own, {std::cos(turn), std::sin(turn), 2.0, 0.5});
  NodalVector u, back;
  u << 0.3, -0.2, 0.5, 0.1, -0.4, 0.6;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec2 v = rotated({u[2 * k], u[2 * k + 1]}, -turn);
    back[2 * k] = v.x;
    back[2 * k + 1] = v.y;
  }
  EXPECT_NEAR(u.dot(seen * u), back.dot(own * back), 1e-9 * back.dot(own * back));
}

/// Of rock that is not strained, eta times the elastic one.
TEST(BlockMatrices, ViscousIsElasticTimesItsViscosity) {
  MovedBlocks m;
  m.model.joints = {test::rough_joint(30.0)};
  m.add({{0, 0}, {3, 0}, {3, 2}, {0, 1}});
  m.start();
  m.masses.viscosity = {2e-3};
  const NodalMatrix elastic = elastic_matrix(m.blocks, 0),
                    viscous = viscous_matrix(m.blocks, m.masses, 0, {1.0, 0.0, 0.0, 1.0});
  EXPECT_LT((viscous - 2e-3 * elastic).norm(), 1e-9 * viscous.norm());
}

/// Whose step is made twice as long has four times the inertia, and the same part of critical
/// damping.
TEST(MassScaling, KeepsThePartOfCriticalDamping) {
  for (const MassKind kind : {MassKind::matched, MassKind::consistent}) {
    MovedBlocks m;
    m.model.solver.mass = kind;
    m.model.joints = {test::rough_joint(30.0)};
    m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e6;
    m.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    m.start();
    const double inverse = m.masses.inverse[0].empty() ? 0.0 : m.masses.inverse[0][0];
    m.blocks.damping = {0.25};
    BoundarySprings none;
    none.block_begin.assign(2, 0);
    const double step = 2.0 * bound_of(m).critical_step;
    const std::vector<double> factors = scale_block_masses(
        m.masses, {m.blocks, m.masses, m.state, m.faces, none, m.laws, {}}, step);
    ASSERT_EQ(factors.size(), 1u);
    EXPECT_NEAR(factors[0], 4.0, 1e-6);
    EXPECT_NEAR(bound_of(m).critical_step, step, 1e-6 * step);
    if (inverse > 0.0) {
      EXPECT_NEAR(m.masses.inverse[0][0], 0.25 * inverse, 1e-6 * inverse);
    }
    fill_viscosity(m.masses, m.blocks, {});
    const double viscosity = m.masses.viscosity[0];
    scale_block_masses(m.masses, {m.blocks, m.masses, m.state, m.faces, none, m.laws, {}},
                       3.0 * step);
    const double raised = m.masses.viscosity[0];
    fill_viscosity(m.masses, m.blocks, {});
    EXPECT_GT(raised, 1.1 * viscosity);
    EXPECT_NEAR(raised, m.masses.viscosity[0], 1e-6 * raised);
  }
}

}  // namespace
}  // namespace edda::block_step_test
