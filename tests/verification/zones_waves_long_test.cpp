// Waves in meshed blocks: out through a viscous boundary, in through one, up to a free surface,
// across a change of rock, and beside free-field sides.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/scene.hpp"

namespace edda::zones_waves_test {
namespace {

constexpr double height = 120.0, density = 2500.0, young = 1e10, poisson = 0.2;
constexpr double width = 8.0, hump_at = 40.5;  // m

/// Speed of plane waves in rock of this modulus, m/s.
double speed(bool shear, double modulus = young) {
  const double mu = modulus / (2.0 * (1.0 + poisson));
  return std::sqrt((shear ? mu : 2.0 * mu * (1.0 - poisson) / (1.0 - 2.0 * poisson)) / density);
}

double component(Vec2 v, bool shear) {
  return shear ? v.x : v.y;
}

/// A column 1 m wide of meshed layers, which end at these heights, with glued joints. All that
/// holds it are springs of its sides across the direction of the motion.
Simulation column(bool shear, const std::vector<double>& ends, double soft,
                  const std::string& more) {
  std::string toml =
      "gravity = [0, 0]\n[joints.j]\ntype = 'glued'\n[contact]\nnormal_stiffness = 5e11\n";
  double from = 0.0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const std::string name = "rock" + std::to_string(k);
    toml += "[materials." + name + "]\ndensity = 2500\npoisson = 0.2\ndamping = 0\nyoung = " +
            number(k + 1 == ends.size() ? young : soft) + "\n[[block]]\nmaterial = '" + name +
            "'\npolygon = " + rectangle(0, from, 1, ends[k]) + "\n";
    from = ends[k];
  }
  Simulation sim = scene(toml +
                         "[[boundary]]\nsides = ['left', 'right']\ntype = 'fixed'\nstiffness = "
                         "1e12\n[zones]\nsize = 1.0\n" +
                         more);
  BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    (shear ? s.kxx : s.kyy)[q] = 0.0;
    s.acting_k[q] = {s.kxx[q], s.kyy[q], 0.0};
  }
  return sim;
}

std::string viscous_base(const std::string& more, double end) {
  return "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'viscous'\n" + more +
         "[output]\nhistory_every = " + number(0.1 * end) +
         "\n[solver]\nduration = " + number(end) + "\n";
}

/// Velocity of the column at this height, the mean of all mesh nodes there.
double velocity_at(const Simulation& sim, bool shear, double y) {
  const BlockSet& b = sim.scene->blocks;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t j = b.meshes.begin[i]; j < b.meshes.begin[i + 1]; ++j) {
      const double of_node = b.centroid_y[i] + b.meshes.arm_y[j] + b.origin.y;
      if (std::abs(of_node - y) > 1e-6) continue;
      sum += component(mesh_node_at(b, sim.motion.state.velocity, i, j), shear);
      count += 1.0;
    }
  }
  EXPECT_GT(count, 0.0);
  return sum / count;
}

/// Every fourth step.
bool is_looked_at(const Simulation& sim) {
  return sim.motion.state.steps % 4 == 0;
}

/// A velocity pulse of 20 mm/s about y = centre, as deviations of the mesh nodes and their affine
/// part.
void start_hump(Simulation& sim, bool shear, double centre) {
  const BlockSet& b = sim.scene->blocks;
  const Masses& masses = sim.motion.masses;
  for (std::size_t i = 0; i < b.size(); ++i) {
    // Impulses that make this velocity; lumped masses miss the affine part by little.
    BlockForces on{b, i};
    for (std::size_t j = b.meshes.begin[i]; j < b.meshes.begin[i + 1]; ++j) {
      const double from = b.centroid_y[i] + b.meshes.arm_y[j] + b.origin.y - centre;
      const double v = 0.02 * std::exp(-0.5 * from * from / (width * width));
      const Vec2 impulse = b.mass[i] * b.meshes.share[j] * (shear ? Vec2{v, 0.0} : Vec2{0.0, v});
      spread(on.sum.nodes, weights_of_arm(b, i, {b.meshes.arm_x[j], b.meshes.arm_y[j]}), impulse);
      on.sum.modes.set(j - b.meshes.begin[i], impulse);
    }
    store(accelerations(masses, b, i, on.sum), b, sim.motion.state.velocity, i);
  }
}

/// Part of a pulse travelling down that returns from the base through y = 30 m.
double reflected(bool shear, const std::vector<double>& layers) {
  const double c = speed(shear), end = 105.0 / c;
  Simulation sim = column(shear, layers, young, viscous_base("", end));
  start_hump(sim, shear, hump_at);
  double back = 0.0, error = 0.0, dissipated = 0.0;
  run(
      sim,
      [&](Simulation& s) {
        const EnergyBalance l = account_energy(s);
        keep_largest(error, l.error);
        EXPECT_GE(l.damping, dissipated);
        dissipated = l.damping;
      },
      [&](Simulation& s) {
        if (s.motion.state.time > 42.0 / c && is_looked_at(s))
          keep_largest(back, velocity_at(s, shear, 30.0));
      });
  EXPECT_LT(error, 1e-5);
  const EnergyBalance l = account_energy(sim);
  EXPECT_NEAR(l.damping / (l.damping + l.kinetic + l.strain + l.contact), 0.5, 5e-3);
  return back / 0.01;
}

TEST(ZonesWaves, LeaveThroughAViscousBase) {
  for (const bool shear : {false, true}) {
    EXPECT_LT(reflected(shear, {height}), 0.003) << "one block, shear " << shear;
    EXPECT_LT(reflected(shear, {23.0, 70.0, height}), 0.003) << "layers, shear " << shear;
  }
}

/// A pulse that comes down onto softer or stiffer rock: (Z2 - Z1)/(Z2 + Z1) of it returns, of
/// either sign.
TEST(ZonesWaves, AreReflectedByImpedances) {
  for (const bool shear : {false, true}) {
    for (const double other : {0.25 * young, 4.0 * young}) {
      const double c = speed(shear), c2 = speed(shear, other), end = 90.0 / c;
      Simulation sim = column(shear, {50.0, 150.0}, other, viscous_base("", end));
      start_hump(sim, shear, 90.0);
      double back = 0.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            if (!is_looked_at(s)) return;
            // The half that goes down has passed, the one that goes up is not yet back.
            const double v = velocity_at(s, shear, 70.0);
            if (s.motion.state.time > 44.0 / c && std::abs(v) > std::abs(back)) back = v;
          });
      EXPECT_NEAR(back / (0.01 * (c - c2) / (c + c2)), 1.0, 0.02) << other << " shear " << shear;
    }
  }
}

/// A wave that enters through the base has twice its amplitude at the free surface.
TEST(ZonesWaves, ArriveDoubledAtAFreeSurface) {
  for (const bool shear : {false, true}) {
    const double c = speed(shear), frequency = 10.0, end = height / c + 1.0 / frequency;
    Simulation sim =
        column(shear, {height}, young,
               "[[shaking]]\napply = 'upgoing'\nacceleration = { amplitude = 2.0, frequency = "
               "10.0, direction = " +
                   std::string(shear ? "[1, 0]" : "[0, 1]") + " }\n" + viscous_base("", end));
    double error = 0.0, top = 0.0, middle = 0.0;
    run(
        sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); },
        [&](Simulation& s) {
          if (!is_looked_at(s)) return;
          keep_largest(top, velocity_at(s, shear, height));
          if (s.motion.state.time < 0.5 * end) keep_largest(middle, velocity_at(s, shear, 10.0));
        });
    const double upgoing = 2.0 / (std::numbers::pi * frequency);
    EXPECT_NEAR(middle / upgoing, 1.0, 5e-3) << shear;
    EXPECT_NEAR(top / (2.0 * upgoing), 1.0, 5e-3) << shear;
    EXPECT_LT(error, 1e-6);
  }
}

/// A square of meshed ground of one block moves as the columns beside it over its whole width.
TEST(ZonesWaves, SidesMoveAsTheGroundBeyond) {
  const double side = 24.0, frequency = 6.0, soft = 1e9;
  for (const bool shear : {false, true}) {
    const double end = side / speed(shear, soft) + 1.5 / frequency;
    Simulation sim = scene(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
        "damping = 0\n"
        "[joints.j]\ntype = 'glued'\n[[block]]\npolygon = " +
        rectangle(0, 0, side, side) +
        "\n[zones]\nsize = 3.0\n[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = "
        "'viscous'\n[[boundary]]\nsides = ['left', 'right']\ntype = 'free-field'\n[[shaking]]\n"
        "apply = 'upgoing'\nboundary = 'base'\nacceleration = { amplitude = 2.0, frequency = " +
        number(frequency) + ", direction = " + std::string(shear ? "[1, 0]" : "[0, 1]") +
        " }\n[solver]\nduration = " + number(end) +
        "\n[output]\nhistory_every = " + number(0.25 * end) + "\n");
    const BlockSet& b = sim.scene->blocks;
    const auto corner_near = [&](Vec2 p) {
      Id nearest = 0;
      for (Id v = 0; v < b.vertex_count(); ++v)
        if (norm(b.vertex(v) + b.origin - p) < norm(b.vertex(nearest) + b.origin - p)) nearest = v;
      return nearest;
    };
    const Id left = corner_near({0.0, side}), middle = corner_near({0.5 * side, side});
    double at_left = 0.0, at_middle = 0.0, across = 0.0, error = 0.0;
    run(
        sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); },
        [&](Simulation& s) {
          const Vec2 l = corner_at(b, s.motion.state.velocity, left),
                     m = corner_at(b, s.motion.state.velocity, middle);
          keep_largest(at_left, component(l, shear));
          keep_largest(at_middle, component(m, shear));
          keep_largest(across, component(l, !shear));
        });
    const double twice = 2.0 * 2.0 / (std::numbers::pi * frequency);
    EXPECT_NEAR(at_middle / twice, 1.0, 0.01) << shear;
    EXPECT_NEAR(at_left / twice, 1.0, 0.01) << shear;
    EXPECT_LT(across, 0.01 * twice) << shear;
    EXPECT_LT(error, 1e-6);
  }
}

}  // namespace
}  // namespace edda::zones_waves_test
