// Models of the verification problems that more than one test runs. `solver`: more lines of their
// [solver] table.
#pragma once

#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda {

inline Tensor stress_of(const Simulation& sim, std::size_t i) {
  const Deformation f = deformation(sim.scene->blocks, sim.motion.state.position, i);
  return cauchy(stress_in(sim.scene->blocks, i, f), f);
}

/// validation.md row 1: the paper's ramp; pieces > 1 cuts the ramp itself into that many blocks
/// (row 17).
inline std::string ramp(double alpha, double phi, const std::string& young, int pieces = 1,
                        const std::string& solver = {}) {
  std::string toml = "gravity = [0.0, -9.8]\n[materials.rock]\ndensity = 2750.0\nyoung = " + young +
                     "\npoisson = 0.25\n[joints.ramp]\nfriction_angle = " + number(phi) +
                     "\n[solver]\nduration = 0.1\n" + solver + "[output]\nhistory_every = 0.001\n";
  auto box = [&](double u0, double u1, double v0, double v1) {
    return "[" + on_slope(alpha, u0, v0) + "," + on_slope(alpha, u1, v0) + "," +
           on_slope(alpha, u1, v1) + "," + on_slope(alpha, u0, v1) + "]";
  };
  const double from = -4.0, to = 6.0;
  for (int p = 0; p < pieces; ++p) {
    const double a = from + (to - from) * p / pieces, b = from + (to - from) * (p + 1) / pieces;
    toml += "[[block]]\nname = 'ramp" + std::to_string(p) +
            "'\nfixed = true\npolygon = " + box(a, b, -1.0, 0.0) + "\n";
  }
  toml += "[[block]]\nname = 'slider'\npolygon = " + box(0.0, 2.0, 0.0, 1.0) + "\n";
  return toml;
}

/// Row 1: distance that the block has slid after t s.
inline double sliding(double alpha, double phi, double t) {
  const double a = radians(alpha);
  return 0.5 * 9.8 * t * t * (std::sin(a) - std::tan(radians(phi)) * std::cos(a));
}

inline double slip_so_far(const Simulation& sim, double alpha) {
  const Vec2 u = displacement(sim, sim.scene->blocks.size() - 1);
  return u.x * std::cos(radians(alpha)) - u.y * std::sin(radians(alpha));
}

/// "30/15, E 200 MPa": slope, friction and Young's modulus of a ramp.
inline std::string ramp_label(double alpha, double phi, const std::string& young) {
  const double e = std::stod(young);
  return brief(alpha) + "/" + brief(phi) + ", E " +
         (e < 1e9 ? brief(e / 1e6) + " MPa" : brief(e / 1e9) + " GPa");
}

/// Row 1: runs to the end and compares the distance slid with the exact one, within the relative
/// `bound`. Returns the largest energy balance error.
inline double expect_slides(Simulation& sim, int row, const std::string& label, double alpha,
                            double phi, double bound, const Look& each = {}) {
  Series way(row, label, {"time", "exact", "computed"});
  double error = 0.0;
  run(
      sim,
      [&](Simulation& s) {
        keep_largest(error, account_energy(s).error);
        way.add(
            {s.motion.state.time, sliding(alpha, phi, s.motion.state.time), slip_so_far(s, alpha)});
      },
      each);
  expect_relative({row, label, "distance slid", "m"}, slip_so_far(sim, alpha),
                  sliding(alpha, phi, sim.motion.state.time), bound);
  record_model(row, label, sim);
  return error;
}

/// Row 9: ten blocks under their own weight, frictionless.
inline std::string column(const std::string& solver) {
  std::string toml = R"(
plane = "stress"
[materials.rock]
density = 2600.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 0.0
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[output]
history_every = 0.1
[solver]
)" + solver;
  for (int i = 0; i < 10; ++i) toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
  return toml;
}

/// Row 9: stress -rho g depth in every block, settlement by the shortening of blocks and springs.
inline void expect_at_rest(const Simulation& column, const std::string& label) {
  const double density = 2600.0, young = 1e9, p = 1e10, g = 9.81;
  const int n = 10;
  Series stresses(9, label, {"depth", "exact", "computed"});
  FurthestOff furthest;
  double springs = 0.0;
  for (int i = 0; i < n; ++i) {
    const double depth = n - i - 0.5, exact = -density * g * depth;
    const double stress = stress_of(column, static_cast<std::size_t>(i + 1)).yy;
    stresses.add({depth, exact, stress});
    furthest.see(stress, exact);
    springs += density * g * (n - i) / (2.0 * p);
  }
  furthest.expect({9, label, "stress, block furthest off", "Pa"}, 1e-3);
  const std::size_t top = column.scene->blocks.vertex_begin[n] + 2;
  const double settled = column.scene->blocks.vertex_y[top] - column.motion.pose.y[top];
  expect_relative({9, label, "settlement of the top", "m"}, settled,
                  density * g * n * n / (2.0 * young) + springs, 1e-3);
  record_model(9, label, column);
}

/// Row 13: semicircular arch of 16 equal voussoirs, thickness over radius given.
inline std::string arch(double ratio,
                        const std::string& solver = "duration = 4.0\ndamping = { mass = 0.5 }\n",
                        double young = 20e9) {
  const int n = 16;
  const double radius = 5.0, t = ratio * radius;
  std::string toml = "[materials.stone]\nyoung = " + number(young) + R"(
density = 2400.0
poisson = 0.2
[joints.j]
friction_angle = 40.0
[output]
history_every = 0.01
[solver]
)" + solver;
  auto at_angle = [&](double r, double a) {
    return "[" + number(r * std::cos(a)) + "," + number(r * std::sin(a)) + "]";
  };
  const double inner = radius - t / 2, outer = radius + t / 2;
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(inner - 1, -1, outer + 1, 0) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-outer - 1, -1, -inner + 1, 0) + "\n";
  for (int i = 0; i < n; ++i) {
    const double a = std::numbers::pi * i / n, b = std::numbers::pi * (i + 1) / n;
    toml += "[[block]]\npolygon = [" + at_angle(inner, a) + "," + at_angle(outer, a) + "," +
            at_angle(outer, b) + "," + at_angle(inner, b) + "]\n";
  }
  return toml;
}

/// Row 13: whether the arch of this thickness over radius stands or falls, judged by the settlement
/// of its voussoirs.
inline void expect_arch(double ratio, bool stands, Simulation& arch, const std::string& method) {
  const std::string label = "t/R = " + brief(ratio) + method;
  Series sinking(13, label, {"time", "computed"});
  double most = 0.0;
  bool fallen = false;
  run(arch, [&](Simulation& s) {
    for (std::size_t i = 2; i < s.scene->blocks.size(); ++i)
      most = std::max(most, -displacement(s, i).y);
    sinking.add({s.motion.state.time, most});
    if (most > 0.5 && !fallen) record_model(13, label, s);
    fallen = fallen || most > 0.5;
  });
  const Quantity sunk{13, label, "largest sinking of a voussoir", "m"};
  if (stands) {
    expect_at_most(sunk, most, 0.01);
  } else {
    expect_at_least(sunk, most, 0.5);
  }
  if (!fallen) record_model(13, label, arch);
}

}  // namespace edda
