// The implicit method: validation.md rows 1, 9 and 13, the damping of its time integration, and
// what must hold at any step.
#include <algorithm>
#include <complex>

#include "run/observe.hpp"
#include "verification/models.hpp"

namespace edda::implicit_test {
namespace {

std::string dda(double step) {
  return "method = 'dda'\ntime_step = " + number(step) + "\n";
}

class ImplicitRamp : public testing::TestWithParam<std::pair<double, double>> {};

/// Row 1.
TEST_P(ImplicitRamp, SlidesAsAnalytic) {
  const auto [alpha, phi] = GetParam();
  for (const auto& [young, bound] : {std::pair{"200e6", 2e-2}, std::pair{"20e9", 2e-3}}) {
    Simulation sim = scene(ramp(alpha, phi, young, 1, dda(1e-4)));
    const std::string label = ramp_label(alpha, phi, young) + ", implicit";
    EXPECT_LT(expect_slides(sim, 1, label, alpha, phi, bound), 1e-4);
    EXPECT_EQ(sim.steps.redone, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(PaperPairs, ImplicitRamp,
                         testing::Values(std::pair{30.0, 10.0}, std::pair{30.0, 15.0},
                                         std::pair{45.0, 10.0}, std::pair{45.0, 15.0}));

/// Row 9, by its own damping, by mass damping, and without dynamics.
TEST(ImplicitColumn, StressAndSettlement) {
  for (const auto& [label, how] :
       {std::pair{"implicit, static", "dynamic = false\ntime_step = 0.1\n"},
        std::pair{"implicit, mass damping", "damping = { mass = 20.0 }\ntime_step = 0.01\n"},
        std::pair{"implicit, its own damping", "time_step = 0.05\n"}}) {
    Simulation sim = scene(column(std::string("method = 'dda'\nduration = 3.0\n") + how));
    run(sim, [](Simulation&) {});
    expect_at_rest(sim, label);
  }
}

/// Row 13.
TEST(ImplicitArch, StandsAndFalls) {
  for (const auto& [ratio, stands] : {std::pair{0.112, true}, std::pair{0.100, false}}) {
    Simulation sim = scene(arch(ratio, "duration = 4.0\n" + dda(2e-3)));
    expect_arch(ratio, stands, sim, ", implicit");
  }
}

/// Block on boundary springs, w = sqrt(sum k/m), set going at 1 m/s; the time step gives w h.
std::string oscillator(const std::string& solver) {
  return R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 1e13
poisson = 0.0
[joints.j]
friction_angle = 0.0
[[block]]
velocity = [1e-4, 0.0]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[boundary]]
name = "below"
sides = ["bottom", "top"]
type = "fixed"
stiffness = 2.5e7
[output]
history_every = 1.0
[solver]
duration = 1.0
)" + solver;
}

/// Newmark with beta = 1/2, gamma = 1: amplitude per step (1 + w^2 h^2/2)^(-1/2) while w h < 4.
TEST(ImplicitOscillator, AlgorithmicDampingIsThatOfTheory) {
  const double omega = std::sqrt(4.0 * 2.5e7 / 2500.0);
  for (const double wh : {0.05, 0.3, 1.0, 2.0, 3.0, 3.9}) {
    const double h = wh / omega;
    Simulation sim = scene(oscillator(dda(h) + "max_displacement_ratio = 1.0\n"));
    sim.start(1e9 * h);
    // Both eigenvalues of the step have this modulus: so has the ratio of x^2-like forms taken over
    // whole turns of their phase, and the determinant of two neighbouring pairs (x, v) at once.
    double x[3], v[3];
    for (int n = 0; n < 3; ++n) {
      sim.step();
      x[n] = displacement(sim, 0).x;
      v[n] = centroid(sim.state.vx, sim.state.vy, 0).x;
    }
    const double before = x[0] * v[1] - x[1] * v[0], after = x[1] * v[2] - x[2] * v[1];
    const double measured = std::sqrt(after / before),
                 theory = 1.0 / std::sqrt(1.0 + 0.5 * wh * wh);
    RecordProperty("ratio_" + number(wh), number(measured / theory));
    EXPECT_NEAR(measured / theory, 1.0, 1e-2) << wh;
  }
}

/// The same count of periods with the leapfrog loses nothing.
TEST(ImplicitOscillator, ExplicitShowsNoDamping) {
  Simulation sim = scene(oscillator("time_step = 2e-7\n"));
  const double period = 2.0 * std::numbers::pi / std::sqrt(4.0 * 2.5e7 / 2500.0);
  sim.start(10.0 * period);
  double first = 0.0, last = 0.0;
  while (sim.state.time < 3.0 * period) {
    ASSERT_FALSE(sim.step());
    const double x = std::abs(displacement(sim, 0).x);
    (sim.state.time < period ? first : last) = std::max(sim.state.time < period         ? first
                                                        : sim.state.time > 2.0 * period ? last
                                                                                        : 0.0,
                                                        x);
  }
  EXPECT_NEAR(last / first, 1.0, 1e-6);
}

/// Without contacts in play the scheme follows a parabola exactly, at any step.
TEST(ImplicitFlight, FollowsTheParabola) {
  std::string toml = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-50, -101], [50, -101], [50, -100], [-50, -100]]
[[block]]
velocity = [3.0, 2.0]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
history_every = 0.5
[solver]
duration = 0.5
max_displacement_ratio = 1.0
)";
  Simulation sim = scene(toml + dda(0.01));
  run(sim, [](Simulation&) {});
  const Vec2 u = displacement(sim, 1);
  EXPECT_NEAR(u.x, 1.5, 1e-9);
  EXPECT_NEAR(u.y, 1.0 - 0.5 * 9.81 * 0.25, 1e-9);
}

/// Positions are total and each step's equations are solved until forces balance: a block that
/// turns keeps its area, where codes that add up linear increments see it grow.
TEST(ImplicitSpin, KeepsItsArea) {
  const std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 1e10
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
angular_velocity = 6.283185307179586
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
history_every = 0.1
[solver]
duration = 1.0
max_displacement_ratio = 1.0
)";
  Simulation sim = scene(toml + dda(1e-3));
  run(sim, [](Simulation& s) {
    const Deformation f = deformation(s.blocks, s.state.x, s.state.y, 0);
    EXPECT_NEAR(f.xx * f.yy - f.xy * f.yx, 1.0, 1e-4);
  });
}

/// Ten turns of a free block that spins as it flies, at the step that is chosen by default.
TEST(ImplicitSpin, IsKeptFromTurnToTurn) {
  for (const char* mass : {"matched", "covering", "consistent"}) {
    for (const double rate : {1.0, 10.0, 100.0}) {
      const double turn = 2.0 * std::numbers::pi / rate;
      Simulation sim = scene(R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
polygon = [[0, 0], [1.2, 0], [1, 1], [0, 0.8]]
velocity = [0.3, -0.2]
angular_velocity = )" + number(rate) +
                             "\n[solver]\nmethod = 'dda'\nmass = '" + mass +
                             "'\nduration = " + number(10.0 * turn) +
                             "\n[output]\nhistory_every = " + number(turn) + "\n");
      std::vector<double> energy, balance;
      run(sim, [&](Simulation& s) {
        const Ledger l = s.ledger();
        energy.push_back(l.kinetic + l.strain);
        balance.push_back(l.balance());
      });
      ASSERT_EQ(energy.size(), 11U);
      for (std::size_t k = 1; k < energy.size(); ++k) {
        EXPECT_NEAR(energy[k], energy[k - 1], 1e-3 * energy[0]) << mass << ' ' << rate << ' ' << k;
        EXPECT_NEAR(balance[k], balance[0], 1e-4 * energy[0]) << mass << ' ' << rate << ' ' << k;
      }
      const Vec2 u = displacement(sim, 0);
      EXPECT_NEAR(u.x, 0.3 * 10.0 * turn, 1e-6 * 10.0 * turn);
      EXPECT_NEAR(u.y, -0.2 * 10.0 * turn, 1e-6 * 10.0 * turn);
    }
  }
}

/// A limit of displacements is one of the model, however it is turned: a wide low wall upright
/// takes the same steps.
TEST(DisplacementLimit, DoesNotDependOnHowTheModelIsTurned) {
  for (const char* method : {"edda", "dda"}) {
    const auto limit = [&](double angle) {
      std::string toml =
          "[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
          "friction_angle = 30.0\n[solver]\nduration = 1\nmax_displacement_ratio = 0.001\nmethod = "
          "'" +
          std::string(method) + "'\n";
      for (int i = 0; i < 12; ++i) {
        toml += "[[block]]\npolygon = [" + on_slope(angle, i, 0) + "," + on_slope(angle, i + 1, 0) +
                "," + on_slope(angle, i + 1, 2) + "," + on_slope(angle, i, 2) + "]\n";
      }
      return scene(toml).displacement_limit;
    };
    EXPECT_NEAR(limit(0.0), 1e-3, 1e-15);
    for (const double angle : {30.0, 90.0, 137.0}) EXPECT_NEAR(limit(angle), 1e-3, 1e-12) << method;
  }
}

std::string heap(const std::string& solver) {
  std::string toml = R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 25.0
[[block]]
fixed = true
polygon = [[-20, -1], [20, -1], [20, 0], [-20, 0]]
[output]
history_every = 0.02
[solver]
duration = 0.6
)" + solver;
  for (int i = 0; i < 6; ++i) {
    const double x = 0.35 * (i % 3), y = 0.1 + 1.15 * i, t = 0.2 * i;
    toml += "[[block]]\npolygon = [";
    for (int c = 0; c < 5; ++c) {
      const double a = t + 2.0 * std::numbers::pi * c / 5;
      toml += (c ? ", [" : "[") + number(x + 0.55 * std::cos(a)) + ", " +
              number(y + 0.55 + 0.55 * std::sin(a)) + "]";
    }
    toml += "]\n";
  }
  return toml;
}

/// Six pentagons fall on each other: the ledger closes, and nothing that dissipates ever gives
/// back.
TEST(ImplicitHeap, LedgerClosesAndDissipates) {
  Simulation sim = scene(heap(dda(5e-4)));
  double drift = 0.0, friction = 0.0, damping = 0.0, scale = 0.0;
  run(sim, [&](Simulation& s) {
    const Ledger l = s.ledger();
    scale = std::max(scale, l.scale());
    keep_largest(drift, l.drift);
    EXPECT_GE(l.friction, friction - 1e-4 * scale) << s.state.time;
    EXPECT_GE(l.damping, damping - 1e-4 * scale) << s.state.time;
    friction = l.friction;
    damping = l.damping;
  });
  EXPECT_GT(friction, 0.0);
  EXPECT_GT(damping, 0.0);
  EXPECT_LT(drift, 2e-4);
  EXPECT_GT(sim.open_close.switched, 10u);
}

/// Momentum changes by external forces alone: two blocks collide, off centre and with friction. It
/// is kept as well as the equations are solved: to the last digits where a factor of the matrix
/// serves, as without damping, and else to the tolerance of the solve.
TEST(ImplicitCollision, KeepsMomentum) {
  const std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
DAMPING
[joints.j]
friction_angle = 25.0
[[block]]
velocity = [1.0, 0.1]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
velocity = [-1.0, 0.0]
polygon = [[1.02, 0.5], [2.02, 0.6], [2.0, 1.6], [1.1, 1.4]]
[output]
history_every = 0.05
[solver]
duration = 0.05
)";
  auto momentum = [](const Simulation& s) {
    Vec2 p;
    double turning = 0.0;
    for (std::size_t i = 0; i < s.blocks.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double m = s.blocks.node_mass[k][i];
        const Vec2 x{s.state.x[k][i], s.state.y[k][i]}, v{s.state.vx[k][i], s.state.vy[k][i]};
        p += m * v;
        turning += m * cross(x, v);
      }
    }
    return std::array{p.x, p.y, turning};
  };
  for (const auto& [damping, bound] : {std::pair{"damping = 0", 1e-4}, {"", 1e-4}}) {
    std::string model = toml + dda(2e-4);
    model.replace(model.find("DAMPING"), 7, damping);
    Simulation sim = scene(model);
    const auto before = momentum(sim);
    run(sim, [](Simulation&) {});
    EXPECT_GT(sim.open_close.switched, 0u);
    const auto after = momentum(sim);
    EXPECT_NEAR(after[0], before[0], bound * 2500.0);
    EXPECT_NEAR(after[1], before[1], bound * 2500.0);
    EXPECT_NEAR(after[2], before[2], 1e-4 * 2500.0);
  }
}

/// Row 4: bonds hold and break in the implicit method, too.
TEST(ImplicitBond, HoldsAboveAndGoesBelowTheCriticalCohesion) {
  for (const auto& [factor, holds] : {std::pair{1.01, true}, std::pair{0.99, false}}) {
    std::string toml = ramp(30.0, 15.0, "20e9", 1, "dynamic = false\n" + dda(2e-5));
    const std::string law = "friction_angle = 15";
    const auto at = toml.find(law);
    ASSERT_NE(at, std::string::npos);
    toml.replace(at, law.size(), "cohesion = " + number(7221.2 * factor) + "\n" + law);
    Simulation sim = scene(toml);
    run(sim, [](Simulation&) {});
    EXPECT_EQ(bonded_faces(sim), holds ? 1u : 0u);
    if (holds) {
      EXPECT_LT(slid(sim, 30.0), 1e-5);
    } else {
      EXPECT_GT(sim.ledger().fracture, 0.0);
    }
  }
}

/// The explicit and the implicit method agree on a smooth problem as the steps shrink.
TEST(ImplicitAndExplicit, AgreeAtSmallSteps) {
  Simulation a = scene(ramp(30.0, 15.0, "200e6", 1, "time_step = 5e-6\n"));
  Simulation b = scene(ramp(30.0, 15.0, "200e6", 1, dda(5e-6)));
  run(a, [](Simulation&) {});
  run(b, [](Simulation&) {});
  EXPECT_NEAR(slid(a, 30.0) / slid(b, 30.0), 1.0, 2e-3);
}

/// A step far too long is cut until blocks no longer pass through each other, and grows again.
TEST(ImplicitStep, IsCutAndGrowsAgain) {
  Simulation sim = scene(heap(dda(0.05)));
  double smallest = 1.0, grown = 0.0;
  run(
      sim, [](Simulation&) {},
      [&](Simulation& s) {
        smallest = std::min(smallest, s.state.step);
        grown = std::max(grown, s.state.step / smallest);
      });
  EXPECT_GT(sim.steps.redone, 0u);
  EXPECT_LT(sim.max_penetration, 0.05);
  EXPECT_GT(grown, 1.9);
}

std::string falling(const std::string& block, const std::string& solver) {
  return R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-4, -1], [0, -1], [0, 0], [-4, 0]]
[[block]]
)" + block +
         "\n[output]\nhistory_every = 0.14\n[solver]\nduration = 0.28\n" + solver;
}

/// A step that goes from above the floor to far below it is no way round the contact, be it the
/// first one and wider than the skin of the search at rest.
TEST(ImplicitStep, DoesNotFallThroughTheFloorInTheFirstStep) {
  for (const char* how : {"", "dynamic = false\n"}) {
    for (const double gap : {0.055, 0.06, 0.07, 0.09}) {
      Simulation sim =
          scene(falling("polygon = " + rectangle(-3, gap, -2, gap + 1), how + dda(0.14)));
      double lowest = 0.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) { lowest = std::min(lowest, displacement(s, 1).y + gap); });
      EXPECT_GT(lowest, -1e-3) << how << gap;
    }
  }
}

/// A corner that comes down on the end of a block, further in one step than it overlaps sideways,
/// has crossed the top and not the side.
TEST(ImplicitStep, CornerLandsOnTheTopItHasCrossed) {
  for (const double step : {0.01, 0.005, 0.002, 0.001}) {
    for (int drop = 0; drop < 8; ++drop) {
      const double y = 0.5 + 0.008 * drop;
      const std::string block = "velocity = [0, -7]\npolygon = [[-0.02, " + number(y) +
                                "], [1.0, " + number(y + 0.5) + "], [-0.02, " + number(y + 1.0) +
                                "]]";
      Simulation sim = scene(falling(block, dda(step)));
      double lowest = 1.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            const Id corner = s.blocks.vertex_begin[1];
            if (s.pose.x[corner] + s.blocks.origin.x < -1e-3) {
              lowest = std::min(lowest, s.pose.y[corner] + s.blocks.origin.y);
            }
          });
      EXPECT_GT(lowest, -0.01) << step << ' ' << drop;
    }
  }
}

}  // namespace
}  // namespace edda::implicit_test
