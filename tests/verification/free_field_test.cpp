// Sides that move as the ground beyond them would: a model of rock as wide as it is high, with an
// upgoing wave from below, moves like a column over its whole width.
#include <algorithm>

#include "attachments/free_field.hpp"
#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::free_field_test {
namespace {

constexpr double density = 2500.0, young = 1e9, poisson = 0.25, height = 24.0, frequency = 6.0;

/// A square of rock of eight by eight blocks with glued joints.
std::string ground(const std::string& sides, bool shear, double end) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.25\n"
         "damping = 0\n[joints.j]\ntype = 'glued'\n[contact]\nnormal_stiffness = 5e10\n"
         "[domain]\noutline = [[0, 0], [24, 0], [24, 24], [0, 24]]\n"
         "[[joint_set]]\nangle = 0\nspacing = 3\n[[joint_set]]\nangle = 90\nspacing = 3\n"
         "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'viscous'\n" +
         sides +
         "[[shaking]]\napply = 'upgoing'\nboundary = 'base'\nacceleration = { amplitude = 2.0, "
         "frequency = " +
         number(frequency) + ", direction = " + std::string(shear ? "[1, 0]" : "[0, 1]") +
         " }\n[solver]\nduration = " + number(end) +
         "\n[output]\nhistory_every = " + number(0.25 * end) + "\n";
}

double component(Vec2 v, bool shear) {
  return shear ? v.x : v.y;
}

struct Surface {
  double left = 0.0, middle = 0.0, across = 0.0;  ///< largest velocities, m/s
  double error = 0.0;
};

/// Largest velocities of the surface until the wave has acted there for one period.
Surface shaken(const std::string& sides, bool shear) {
  const double mu = young / (2.0 * (1.0 + poisson));
  const double p_modulus = mu * 2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson);
  const double c = std::sqrt((shear ? mu : p_modulus) / density);
  Simulation sim = scene(ground(sides, shear, height / c + 1.5 / frequency));
  Id left = no_id, middle = no_id;
  for (Id v = 0; v < sim.scene->blocks.vertex_count(); ++v) {
    const Vec2 p = Vec2{sim.scene->blocks.vertex_x[v], sim.scene->blocks.vertex_y[v]} +
                   sim.scene->blocks.origin;
    if (norm(p - Vec2{0.0, 24.0}) < 1e-6) left = v;
    if (norm(p - Vec2{12.0, 24.0}) < 1e-6) middle = v;
  }
  Surface most;
  run(
      sim, [&](Simulation& s) { keep_largest(most.error, account_energy(s).error); },
      [&](Simulation& s) {
        Vec2 l = corner_at(s.scene->blocks, s.motion.state.velocity, left);
        Vec2 m = corner_at(s.scene->blocks, s.motion.state.velocity, middle);
        keep_largest(most.left, component(l, shear));
        keep_largest(most.middle, component(m, shear));
        keep_largest(most.across, component(l, !shear));
      });
  return most;
}

TEST(FreeField, SidesMoveAsTheGroundBeyond) {
  const std::string free_field = "[[boundary]]\nsides = ['left', 'right']\ntype = 'free-field'\n";
  for (const bool shear : {false, true}) {
    const double twice = 2.0 * 2.0 / (std::numbers::pi * frequency);
    const Surface s = shaken(free_field, shear);
    const std::string wave = shear ? "S" : "P";
    expect_relative({36, wave, "largest velocity in the middle of the surface", "m/s"}, s.middle,
                    twice, 2e-2);
    expect_relative({36, wave, "largest velocity at its left end", "m/s"}, s.left, twice, 2e-2);
    EXPECT_LT(s.across, 0.03 * twice) << "no motion across the wave";
    EXPECT_LT(s.error, 1e-6);
    // Dashpots alone retard the sides, and free sides are not supported.
    const Surface viscous =
        shaken("[[boundary]]\nsides = ['left', 'right']\ntype = 'viscous'\n", shear);
    EXPECT_LT(viscous.left, 0.8 * twice) << wave;
  }
}

/// A column alone is a chain of springs: at its top the wave has twice its amplitude, and no motion
/// remains after it.
TEST(FreeField, ColumnAlone) {
  FreeFieldColumn column;
  column.cell = 0.5;
  const std::size_t cells = 200;
  column.density.assign(cells, density);
  column.lambda.assign(cells, 4e8);
  column.mu.assign(cells, 4e8);
  column.moved.assign(cells + 1, {});
  column.velocity.assign(cells + 1, {});
  std::vector<FreeFieldColumn> columns{column};
  const double c = std::sqrt(4e8 / density), h = 0.5 * 0.5 / std::sqrt(12e8 / density);
  const double hump = 0.1;
  FreeFieldDrive drive;
  drive.lets_waves_in = true;
  double top = 0.0;
  for (double t = 0.0; t < 2.0 * 100.0 / c + 4.0 * hump; t += h) {
    const double x = (t - hump) / (0.3 * hump);
    drive.twice_incoming = {2.0 * std::exp(-x * x), 0.0};
    columns = next_columns(columns, drive, h, h);
    top = std::max(top, columns[0].velocity.back().x);
  }
  EXPECT_NEAR(top, 2.0, 0.01);
  for (const Vec2 v : columns[0].velocity) EXPECT_LT(norm(v), 1e-3);
}

/// A column on ground at rest has the viscosity and the damping in proportion to mass of the block
/// beside it: sin(pi y/2L) decays by (a/w + eta w)/2 of critical, whatever the step would say.
TEST(FreeField, ColumnIsDampedAsTheRockBesideIt) {
  constexpr double modulus = 4e8, a = 0.4, eta = 1e-3, tall = 100.0;
  const std::size_t cells = 100;
  FreeFieldColumn column;
  column.cell = 1.0;
  column.density.assign(cells, density);
  column.lambda.assign(cells, modulus);
  column.mu.assign(cells, modulus);
  column.block.assign(cells, 1);
  column.softer.assign(cells, {1.0, 1.0});
  column.moved.assign(cells + 1, {});
  for (std::size_t k = 0; k <= cells; ++k)
    column.velocity.push_back({std::sin(0.5 * std::numbers::pi * double(k) / double(cells)), 0.0});
  const std::vector<double> decay{9.0, a}, viscosity{9.0, eta};
  FreeFieldDrive drive;
  drive.decay = &decay;
  drive.viscosity = &viscosity;
  const double w = 0.5 * std::numbers::pi / tall * std::sqrt(modulus / density), h = 5e-4;
  std::vector<FreeFieldColumn> columns{column};
  std::vector<double> extremes;
  double before = 0.0, slope = 0.0;
  for (double t = 0.0; t < 6.0 * std::numbers::pi / w; t += h) {
    columns = next_columns(columns, drive, h, h);
    const double now = columns[0].moved.back().x;
    if (slope * (now - before) < 0.0) extremes.push_back(before);
    slope = now - before;
    before = now;
  }
  ASSERT_GE(extremes.size(), 5u);
  const double swings = double(extremes.size() - 1),
               fraction = std::log(std::abs(extremes.front() / extremes.back())) /
                          (swings * std::numbers::pi);
  EXPECT_NEAR(fraction, 0.5 * (a / w + eta * w), 0.02 * 0.5 * (a / w + eta * w));
}

}  // namespace
}  // namespace edda::free_field_test
