// Contacts of awkward shapes: reentrant corners, hinges, block boundaries; validation.md rows 12
// and 15.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::shape_test {
namespace {

std::string header(double duration, double damping, double friction = 30.0) {
  return "[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = " +
         number(friction) + "\n[solver]\nduration = " + number(duration) +
         "\ndamping = { mass = " + number(damping) + " }\n[output]\nhistory_every = 0.01\n";
}

/// A square in the inner corner of an L must be carried by both of its legs, and not tilt.
TEST(ReentrantCorner, CarriesOnBothSides) {
  // Gravity is inclined towards the corner: the square presses on the floor and on the wall.
  std::string toml =
      "gravity = [-5.0, -8.0]\n" + header(0.2, 500.0, 0.0) +
      "[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[0,0],[0,3],[-1,3]]\n"
      "[[block]]\npolygon = " +
      rectangle(0, 0, 1, 1) + "\n";
  Simulation sim = scene(toml);
  run(sim, [](Simulation&) {});
  Vec2 reaction{0, 0};
  int carrying = 0;
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
    const bool moved_faces = block_of_facing(sim.scene->blocks, sim.motion.contacts, k) == 1;
    reaction += (moved_faces ? 1.0 : -1.0) * force_on_facing(face_row(sim, k));
    if (normal_force(face_row(sim, k)) > 1.0) ++carrying;
  }
  EXPECT_NEAR(reaction.x, 2600.0 * 5.0, 5.0);
  EXPECT_NEAR(reaction.y, 2600.0 * 8.0, 5.0);
  EXPECT_EQ(carrying, 2);  // the floor and the wall
  EXPECT_LT(norm(displacement(sim, 1)), 1e-6);
  const Rotation r = rotation(deformation(sim.scene->blocks, sim.motion.state.position, 1));
  EXPECT_LT(std::abs(r.s), 1e-6);
}

/// A key in a slot: supported on three sides by one non-convex block.
TEST(Slot, KeyStaysInIt) {
  std::string toml =
      header(0.5, 50.0) +
      "[[block]]\nfixed = true\npolygon = [[-2,-2],[3,-2],[3,1],[1,1],[1,0],[0,0],[0,1],[-2,1]]\n"
      "[[block]]\npolygon = " +
      rectangle(0, 0, 1, 2) + "\n";
  Simulation sim = scene(toml);
  run(sim, [](Simulation&) {});
  EXPECT_LT(norm(displacement(sim, 1)), 1e-5);
}

/// A square sliding over boundaries between fixed blocks, tilted a little, its leading corner down:
/// it must neither catch nor sink where base blocks meet.
TEST(BlockBoundaries, NeitherStopNorSink) {
  std::string toml = header(0.6, 0.0, 0.0) + "[contact]\nnormal_stiffness = 2e9\n";
  for (int i = 0; i < 12; ++i) {
    toml +=
        "[[block]]\nfixed = true\npolygon = " + rectangle(-1 + 0.25 * i, -1, -0.75 + 0.25 * i, 0) +
        "\n";
  }
  toml += "[[block]]\npolygon = " + rectangle(-0.9, 0, -0.4, 0.5) + "\nvelocity = [3.0, 0.0]\n";
  Simulation sim = scene(toml);
  double lowest = 0.0, error = 0.0;
  run(sim, [&](Simulation& s) {
    lowest = std::min(lowest, displacement(s, 12).y);
    keep_largest(error, account_energy(s).error);
  });
  EXPECT_NEAR(displacement(sim, 12).x, 1.8, 2e-3);
  const double static_closure = 2600.0 * 0.25 * 9.81 / (2.0 * 2e9);
  EXPECT_GT(lowest, -4.0 * static_closure);
  EXPECT_LT(error, 1e-5);
}

/// Row 15: the harmonic overhang of four bricks stands at 0.99 of 1.0417 L and falls at 1.01.
TEST(Overhang, HarmonicLimit) {
  for (const double factor : {0.99, 1.01}) {
    std::string toml = header(3.0, 2.0, 35.0) +
                       "[[block]]\nfixed = true\npolygon = " + rectangle(-3, -1, 0, 0) + "\n";
    // Brick i from the top overhangs the one below by L/(2 i).
    double x = 0.0;
    std::vector<double> left(4);
    for (int i = 4; i >= 1; --i) {
      x += factor * 1.0 / (2.0 * i);
      left[static_cast<std::size_t>(4 - i)] = x - 1.0;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const double y = 0.25 * static_cast<double>(i);
      toml += "[[block]]\npolygon = " + rectangle(left[i], y, left[i] + 1.0, y + 0.25) + "\n";
    }
    Simulation sim = scene(toml);
    const std::string label = brief(factor) + " of the limit";
    Series sinking(15, label, {"time", "computed"});
    bool fallen = false;
    run(sim, [&](Simulation& s) {
      const double down = -displacement(s, 4).y;
      sinking.add({s.motion.state.time, down});
      if (down > 0.2 && !fallen) record_model(15, label, s);
      fallen = fallen || down > 0.2;
    });
    const Quantity sunk{15, label, "sinking of the top brick", "m"};
    if (factor < 1.0) {
      expect_at_most(sunk, -displacement(sim, 4).y, 1e-4);
    } else {
      expect_at_least(sunk, -displacement(sim, 4).y, 0.05);
    }
    if (!fallen) record_model(15, label, sim);
  }
}

/// Row 12: snap-through of a three-hinged beam at W = 16 K t^3/(3 sqrt3 S^2), K = 2 p_n/3.
TEST(Hinge, SnapThrough) {
  // Two rigid halves between fixed abutments; the load is raised by raising gravity slowly.
  const double span = 4.0, t = 0.15, p = 2e8, density = 2500.0;
  std::string toml =
      "[materials.rock]\ndensity = 2500.0\nyoung = 2e12\npoisson = 0.0\n[joints.j]\n"
      "friction_angle = 80\n[contact]\nnormal_stiffness = 2e8\nshear_stiffness = 4e9\n"
      "[solver]\nduration = 16.0\ndamping = { mass = 5 }\n"
      "[output]\nhistory_every = 0.01\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(-1, -1, 0, 1) + "\n";
  toml += "[[block]]\nfixed = true\npolygon = " + rectangle(span, -1, span + 1, 1) + "\n";
  toml += "[[block]]\npolygon = " + rectangle(0, 0, span / 2, t) + "\n";
  toml += "[[block]]\npolygon = " + rectangle(span / 2, 0, span, t) + "\n";
  Simulation sim = scene(toml);
  const double exact = 16.0 * (2.0 * p / 3.0) * t * t * t / (3.0 * std::sqrt(3.0) * span * span);
  const double weight_per_g = density * span * t;
  const double g_exact = exact / weight_per_g;
  // In equilibrium H (t - sag) = W S/8 and H = (p/3) 2 (t^2 - (t - sag)^2)/S: three springs in a
  // row.
  Series balance(12, "balance", {"sag", "exact"});
  for (int i = 0; i <= 100; ++i) {
    const double rise = t * (1.0 - 0.01 * i);
    balance.add({t - rise, 16.0 * p / 3.0 * rise * (t * t - rise * rise) / (span * span)});
  }
  Series path(12, "load and sag", {"sag", "computed"});
  double snapped = 0.0;
  sim.scene.edit().model.gravity = {0.0, 0.0};
  run(
      sim,
      [&](Simulation& s) {
        const double sag = -displacement(s, 2).y * 2.0;
        if (sag < t) path.add({sag, -s.scene->model.gravity.y * weight_per_g});
      },
      [&](Simulation& s) {
        // Quickly to 0.85 of the load, then slowly, so that inertia and damping delay the
        // snap-through only a little.
        const double part = s.motion.state.time / s.scene->model.solver.duration;
        const double load = part < 0.3 ? 0.85 * part / 0.3 : 0.85 + 0.25 * (part - 0.3) / 0.7;
        s.scene.edit().model.gravity.y = -load * g_exact;
        const double sag = -displacement(s, 2).y * 2.0;
        if (snapped == 0.0 && sag > 0.8 * t) snapped = -s.scene->model.gravity.y;
      });
  expect_relative({12, "", "weight at which it snaps through", "N"}, snapped * weight_per_g, exact,
                  3e-2);
  record_model(12, "", sim);
}

}  // namespace
}  // namespace edda::shape_test
