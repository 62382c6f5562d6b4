// Forces of blocks that bend, against the energy that they stand for.
#include "forces/bending_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "attachments/drawn_blocks.hpp"
#include "forces/elastic.hpp"

namespace edda::bending_forces_test {
namespace {

/// A block that is turned, strained and bent by some percent.
struct Bent : test::DrawnBlocks {
  State state;
  BodyVectors forces;
  ModeVectors locked;

  explicit Bent(double turn = 0.0) {
    model.deformation = BlockDeformation::corners;
    add({{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}});
    build_all();
    state = initial_state(blocks, set);
    const double more[3] = {0.02, -0.03, 0.01};
    const auto turned = [turn](Vec2 p) {
      return Vec2{std::cos(turn) * p.x - std::sin(turn) * p.y,
                  std::sin(turn) * p.x + std::cos(turn) * p.y};
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p =
          turned({state.position.x[k][0] + more[k], state.position.y[k][0] + more[(k + 1) % 3]});
      state.position.x[k][0] = p.x;
      state.position.y[k][0] = p.y;
    }
    locked.assign(blocks.bending.modes(), 0.0);
    for (std::size_t a = 0; a < 2; ++a) {
      const double by = 1.0 + static_cast<double>(a);
      state.position.modes.set(place(a), turned({0.03 / by, -0.05 * by}));
      locked.set(place(a), {4e6 * by, -2e6});
    }
  }
  std::size_t place(std::size_t a) const { return blocks.modes(0)[a]; }
  double energy() const { return stored_energy(blocks, state, {&locked}, 0.0, 0); }
  void gather() {
    Pose pose{blocks.vertex_x, blocks.vertex_y, blocks.vertex_x, blocks.vertex_y};
    BoundarySprings none;
    none.block_begin = {0, 0};
    gather_forces(forces = zero_vectors(blocks), blocks, state, pose, zero_vectors(blocks), none,
                  {}, {}, {&locked});
  }
};

TEST(BendingForces, AreTheGradientOfTheEnergy) {
  for (const double turn : {0.0, 2.1}) {
    Bent o(turn);
    o.gather();
    const double d = 1e-6;
    const auto check = [&](double& place, double force, const char* what) {
      const double at = place;
      place = at + d;
      const double up = o.energy();
      place = at - d;
      const double down = o.energy();
      place = at;
      EXPECT_NEAR(force, (down - up) / (2.0 * d), 2e-7 * 1e8) << what;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      check(o.state.position.x[k][0], o.forces.x[k][0], "x of a node");
      check(o.state.position.y[k][0], o.forces.y[k][0], "y of a node");
    }
    for (std::size_t a = 0; a < 2; ++a) {
      const std::size_t m = o.place(a);
      check(o.state.position.modes.x[m], o.forces.modes.x[m], "x of a mode");
      check(o.state.position.modes.y[m], o.forces.modes.y[m], "y of a mode");
    }
  }
}

TEST(BendingForces, HaveNoResultantAndNoMoment) {
  Bent o(0.4);
  o.gather();
  Vec2 sum;
  double moment = 0.0, couples = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 f{o.forces.x[k][0], o.forces.y[k][0]},
        x{o.state.position.x[k][0], o.state.position.y[k][0]};
    sum += f;
    moment += cross(x, f);
  }
  for (std::size_t a = 0; a < 2; ++a) {
    moment += cross(o.state.position.modes[o.place(a)], o.forces.modes[o.place(a)]);
    couples += cross(o.state.position.modes[o.place(a)], o.forces.modes[o.place(a)]);
  }
  EXPECT_GT(std::abs(couples), 1e5);
  EXPECT_NEAR(norm(sum), 0.0, 1e-6);
  EXPECT_NEAR(moment, 0.0, 1e-9 * std::abs(couples));
}

/// A block that turns as a whole stores as much and has the same forces in its own frame.
TEST(BendingForces, TurnWithTheBlock) {
  Bent straight(0.0), turned(2.1);
  straight.gather();
  turned.gather();
  EXPECT_NEAR(turned.energy(), straight.energy(), 1e-12 * straight.energy());
  for (std::size_t a = 0; a < 2; ++a) {
    const Vec2 f = straight.forces.modes[straight.place(a)],
               g = turned.forces.modes[turned.place(a)];
    const Vec2 carried{std::cos(2.1) * f.x - std::sin(2.1) * f.y,
                       std::sin(2.1) * f.x + std::cos(2.1) * f.y};
    EXPECT_NEAR(norm(g - carried), 0.0, 1e-9 * norm(f));
  }
}

}  // namespace
}  // namespace edda::bending_forces_test
