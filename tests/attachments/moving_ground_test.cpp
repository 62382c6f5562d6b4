// Ground that moves: the columns of a free field, and the ground itself.
#include <gtest/gtest.h>

#include "attachments/drawn_blocks.hpp"
#include "attachments/free_field.hpp"
#include "attachments/ground.hpp"

namespace edda::moving_ground_test {
namespace {

constexpr double density = 2000.0, lambda = 3e8, mu = 2e8, cell = 0.5;
constexpr std::size_t cells = 8;

FreeFieldColumn column() {
  FreeFieldColumn c;
  c.cell = cell;
  c.density.assign(cells, density);
  c.lambda.assign(cells, lambda);
  c.mu.assign(cells, mu);
  c.moved.assign(cells + 1, {});
  c.velocity.assign(cells + 1, {});
  return c;
}

/// Strained along a parabola, rho a = mu u'' and (lambda + 2 mu) u''; at the free top the stress
/// below pulls half of a cell's mass.
TEST(FreeFieldColumn, IsPulledByTheStressBelowAndAbove) {
  FreeFieldColumn c = column();
  const Vec2 curved{1e-3, 2e-3};
  for (std::size_t k = 0; k <= cells; ++k) {
    const double y = cell * static_cast<double>(k);
    c.moved[k] = 0.5 * y * y * curved;
  }
  const double h = 1e-4;
  const FreeFieldColumn next = next_columns({c}, {}, h, h)[0];
  for (std::size_t k = 1; k < cells; ++k) {
    EXPECT_NEAR(next.velocity[k].x, h * mu * curved.x / density, 1e-12);
    EXPECT_NEAR(next.velocity[k].y, h * (lambda + 2.0 * mu) * curved.y / density, 1e-12);
  }
  const double slope = cell * (static_cast<double>(cells) - 0.5);
  EXPECT_NEAR(next.velocity[cells].x, -h * mu * slope * curved.x / (0.5 * density * cell), 1e-12);
}

/// Stretched upwards it presses against either side; sheared, it drags them opposite ways.
TEST(FreeFieldColumn, HasTheTractionOfItsSide) {
  FreeFieldColumn c = column();
  const Vec2 strain{1e-4, 3e-4};
  for (std::size_t k = 0; k <= cells; ++k) c.moved[k] = cell * static_cast<double>(k) * strain;
  for (const double outward : {1.0, -1.0}) {
    c.outward = outward;
    const Vec2 t = c.traction(c.moved, 1.3);
    EXPECT_NEAR(t.x, outward * lambda * strain.y, 1e-6);
    EXPECT_NEAR(t.y, outward * mu * strain.x, 1e-6);
  }
}

/// A wave that comes up doubles what the dashpot at the bottom has taken: at rest it is pushed by
/// rho c 2 v.
TEST(FreeFieldColumn, LetsWavesIn) {
  FreeFieldDrive drive;
  drive.lets_waves_in = true;
  drive.twice_incoming = {0.2, 0.0};
  const double h = 1e-4, mass = 0.5 * density * cell, damper = std::sqrt(density * mu);
  const FreeFieldColumn next = next_columns({column()}, drive, h, h)[0];
  EXPECT_NEAR(next.velocity[0].x, h * damper * 0.2 / mass / (1.0 + 0.5 * h * damper / mass), 1e-12);
}

/// v_{n+1/2} = v_{n-1/2} + a (h_old + h_new)/2 is the velocity at half of every step.
TEST(Ground, KeepsItsParabolaWhenTheStepChanges) {
  Model model;
  Shaking shaking;
  shaking.acceleration.file = "given";
  shaking.record.time = {0.0, 10.0};
  shaking.record.acceleration = {{2.0, -1.0}, {2.0, -1.0}};
  shaking.record.velocity = {{0.0, 0.0}, {20.0, -10.0}};
  model.shakings = {shaking};
  Loads loads;
  loads.intervals.shakings = {{0.0}};
  Ground ground;
  double time = 1.0, h = 0.01;
  ground.velocity = (time - 0.5 * h) * Vec2{2.0, -1.0};
  for (int n = 0; n < 20; ++n) {
    const double next = n % 3 == 0 ? 0.5 * h : n % 3 == 1 ? 2.0 * h : h;
    const GroundStep step = next_ground(model, loads, ground, {}, time, h, next);
    EXPECT_NEAR(step.velocity.x, 2.0 * (time + 0.5 * next), 1e-12);
    EXPECT_NEAR(step.velocity.y, -(time + 0.5 * next), 1e-12);
    ground.velocity = step.velocity;
    time += next;
    h = next;
  }
}

TEST(Ground, CarriesHeldBlocksAlong) {
  test::DrawnBlocks m;
  m.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true);
  m.build_all();
  BodyVectors at{m.blocks.node_x, m.blocks.node_y, {}};
  place_fixed(m.blocks, find_ground(m.model, m.blocks), {0.3, -0.2}, at);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(at.x[k][0], m.blocks.node_x[k][0] + 0.3);
    EXPECT_EQ(at.y[k][0], m.blocks.node_y[k][0] - 0.2);
  }
}

/// As high as the side beside which it stands.
void expect_whole_side(bool meshed) {
  test::DrawnBlocks m;
  if (meshed) {
    m.model.deformation = BlockDeformation::zones;
    m.model.zones = ZoneInputs{0.5, {}, {}};
  }
  m.add({{0, 0}, {1, 0}, {1, 2}, {0, 2}, {0, 1.5}, {0, 1}, {0, 0.5}});
  Boundary side;
  side.name = "b";
  side.type = BoundaryType::free_field;
  side.along = {{0, 0}, {0, 2}};
  m.model.boundaries = {side};
  m.build_all();
  const Dashpots dashpots = attach_dashpots(m.model, m.blocks).value();
  const FreeField field = attach_free_field(m.model, m.blocks, dashpots, 1e-5);
  ASSERT_EQ(field.columns.size(), 1u);
  const FreeFieldColumn& c = field.columns[0];
  EXPECT_NEAR(c.bottom + m.blocks.origin.y, 0.0, 1e-12);
  EXPECT_NEAR(c.cell * static_cast<double>(c.density.size()), 2.0, 1e-12);
  EXPECT_EQ(c.outward, -1.0);
  EXPECT_NEAR(c.cell, 0.5, 1e-12);
  double face = 0.0, moment = 0.0;
  for (std::size_t p = 0; p < field.face.size(); ++p) {
    face += field.face[p];
    moment += field.face[p] * (field.middle[p] + m.blocks.origin.y);
  }
  EXPECT_NEAR(face, 2.0, 1e-12);
  EXPECT_NEAR(moment, 2.0, 1e-12);
}

TEST(FreeFieldColumn, StandsBesideItsWholeSide) {
  for (const bool meshed : {false, true}) expect_whole_side(meshed);
}

}  // namespace
}  // namespace edda::moving_ground_test
