// Problems at rest: validation.md rows 9, 11, 13, 20.
#include <algorithm>

#include "verification/scene.hpp"

namespace edda {
namespace {

Tensor stress_of(const Simulation& sim, std::size_t i) {
  const Deformation f = deformation(sim.blocks, sim.state.x, sim.state.y, i);
  return cauchy(piola(f, rotation(f), sim.blocks.lame_lambda[i], sim.blocks.lame_mu[i]), f);
}

/// Row 9: a column of ten blocks under its own weight.
TEST(Column, StressAndSettlement) {
  const double density = 2600.0, young = 1e9, p = 1e10, g = 9.81;
  const int n = 10;
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
[solver]
duration = 3.0
damping = { mass = 20.0 }
[output]
history_every = 0.1
)";
  for (int i = 0; i < n; ++i) toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
  Simulation sim = scene(toml);
  run(sim, [](Simulation&) {});
  double springs = 0.0;
  for (int i = 0; i < n; ++i) {
    const double depth = n - i - 0.5;
    EXPECT_NEAR(stress_of(sim, static_cast<std::size_t>(i + 1)).yy / (-density * g * depth), 1.0,
                1e-3);
    springs += density * g * (n - i) / (2.0 * p);
  }
  // The top face sinks by the blocks' shortening and the springs'.
  const std::size_t top = sim.blocks.vertex_begin[n] + 2;
  const double settled = sim.blocks.vertex_y[top] - sim.pose.y[top];
  EXPECT_NEAR(settled / (density * g * n * n / (2.0 * young) + springs), 1.0, 1e-3);
}

/// Row 11: the critical step of a column of 200 blocks, L/(c0 sqrt(3 (1 + kappa))).
TEST(Column, CriticalStep) {
  for (const double p : {1e9, 1e10, 1e11}) {
    std::string toml =
        "plane = 'stress'\n[materials.rock]\ndensity = 2500.0\nyoung = 1e10\n"
        "poisson = 0.0\n[joints.j]\nfriction_angle = 30\n[contact]\n"
        "normal_stiffness = " +
        number(p) + "\n[solver]\nduration = 1.0\n";
    for (int i = 0; i < 200; ++i)
      toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
    const Simulation sim = scene(toml);
    const double kappa = 2.0 * p * 1.0 / (1e10 * 1.0), c0 = std::sqrt(1e10 / 2500.0);
    const double exact = 1.0 / (c0 * std::sqrt(3.0 * (1.0 + kappa)));
    EXPECT_LE(sim.bound.critical_step, exact * (1.0 + 1e-9));
    EXPECT_GE(sim.bound.critical_step, 0.7 * exact);
  }
}

std::string arch(double ratio) {
  const int n = 16;
  const double radius = 5.0, t = ratio * radius;
  std::string toml = R"(
[materials.stone]
density = 2400.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 40.0
[solver]
duration = 4.0
damping = { mass = 0.5 }
[output]
history_every = 0.01
)";
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

/// Row 13: the limit of a semicircular arch of 16 voussoirs is t/R = 0.1072.
TEST(Arch, StandsAndFalls) {
  for (const auto& [ratio, stands] : {std::pair{0.112, true}, std::pair{0.100, false}}) {
    Simulation sim = scene(arch(ratio));
    double sunk = 0.0;
    run(sim, [&](Simulation& s) {
      for (std::size_t i = 2; i < s.blocks.size(); ++i) {
        sunk = std::max(sunk, -displacement(s, i).y);
      }
      if (sunk > 1.0) s.model.solver.duration = s.state.time;
    });
    if (stands) {
      EXPECT_LT(sunk, 0.01);
    } else {
      EXPECT_GT(sunk, 0.5);
    }
  }
}

/// Row 20: four blocks that meet at a point, squeezed in a held box.
TEST(LoadPath, FourBlocksInABox) {
  const double dx = 1e-4, dy = 0.6e-4, young = 20e9, nu = 0.2, p = 2e11;
  std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 0.0
[solver]
duration = 0.2
damping = { mass = 500.0 }
[output]
history_every = 0.01
)";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, -1.5, -1 + dx, 1.5) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(1 - dx, -1.5, 1.5, 1.5) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, -1.5, 1.5, -1 + dy) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1.5, 1 - dy, 1.5, 1.5) + "\n";
  for (const auto& [x, y] :
       {std::pair{-1, -1}, std::pair{0, -1}, std::pair{-1, 0}, std::pair{0, 0}}) {
    toml += "[[block]]\npolygon = " + rectangle(x, y, x + 1, y + 1) + "\n";
  }
  Simulation sim = scene(toml);
  run(sim, [](Simulation&) {});
  // Along x: two blocks and three interfaces of 2 p share the closure 2 dx; plane strain couples x
  // and y.
  const double c11 = (1 - nu * nu) / young, c12 = -nu * (1 + nu) / young, spring = 3.0 / (2.0 * p);
  const double a = 2 * c11 + spring, b = 2 * c12;
  const double sx = -(a * 2 * dx - b * 2 * dy) / (a * a - b * b);
  const double sy = -(a * 2 * dy - b * 2 * dx) / (a * a - b * b);
  for (std::size_t i = 4; i < 8; ++i) {
    const Tensor s = stress_of(sim, i);
    EXPECT_NEAR(s.xx / sx, 1.0, 1e-4);
    EXPECT_NEAR(s.yy / sy, 1.0, 1e-4);
    EXPECT_NEAR(s.xy / sx, 0.0, 1e-6);
  }
  double diagonal = 0.0;
  int joint_contacts = 0;
  for (std::size_t k = 0; k < sim.contacts.size(); ++k) {
    const Id i = std::min(sim.contacts.block_i[k], sim.contacts.block_j[k]);
    const Id j = std::max(sim.contacts.block_i[k], sim.contacts.block_j[k]);
    const double force = sim.contacts.share[k] * sim.contacts.normal[k];
    if ((i == 4 && j == 7) || (i == 5 && j == 6)) diagonal = std::max(diagonal, std::abs(force));
    if (i == 4 && j == 5 && force > 0.0) ++joint_contacts;
  }
  EXPECT_LE(diagonal, 1e-9 * std::abs(sx));
  EXPECT_EQ(joint_contacts, 4);  // two ends, each shared by two corners
}

}  // namespace
}  // namespace edda
