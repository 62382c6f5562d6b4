// Ramps that start from their stressed state: validation.md rows 2 and 3. Strong mass damping
// brings them to it; it is removed when a test begins.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"

namespace edda::preloaded_test {
namespace {

/// Damping near the critical one of the block's own vibrations reaches the stressed state soonest.
Simulation stressed_ramp(double alpha, double phi, const std::string& young, double damped_time) {
  const double mass_damping = 1e4 * std::sqrt(std::stod(young) / 20e9);
  Simulation sim =
      scene(ramp(alpha, phi, young, 1, "damping = { mass = " + number(mass_damping) + " }\n"));
  start(sim, damped_time);
  while (sim.motion.state.time < damped_time) {
    const auto failure = step(sim);
    EXPECT_FALSE(failure.has_value());
  }
  sim.motion.damping.mass = 0.0;
  return sim;
}

Vec2 velocity(const Simulation& sim) {
  return centroid(sim.motion.state.velocity, sim.scene->blocks.size() - 1);
}

struct Slide {
  double way;      ///< m, less v0 t
  double error;    ///< of the energy balance
  double largest;  ///< sum of the normal forces over its static value
};

/// The slide of `duration` s from the stressed state. While the block is damped it slides at a
/// constant speed: the force of mass damping equals the later inertia force, so that all other
/// forces are those of the sliding state.
Slide slide(int row, double alpha, double phi, const std::string& young, double damped_time,
            double duration) {
  const std::string label = ramp_label(alpha, phi, young);
  Series ways(row, label, {"time", "exact", "computed"});
  Simulation sim = stressed_ramp(alpha, phi, young, damped_time);
  const double a = radians(alpha), start = slip_so_far(sim, alpha), t0 = sim.motion.state.time;
  const double normal = 2.0 * 2750.0 * 9.8 * std::cos(a);
  const Vec2 v_before = velocity(sim);
  Slide result{0.0, 0.0, 0.0};
  Vec2 v0;
  bool first = true;
  sim.accounts.start_energy = {};
  account_energy(sim);
  fit_step_to(sim, t0 + duration);
  while (sim.motion.state.time < t0 + duration) {
    const auto failure = step(sim);
    EXPECT_FALSE(failure.has_value());
    if (first) v0 = 0.5 * (v_before + velocity(sim));
    first = false;
    if (sim.motion.state.steps % 8 == 0) {
      const double t = sim.motion.state.time - t0, speed = v0.x * std::cos(a) - v0.y * std::sin(a);
      ways.add({t, sliding(alpha, phi, t), slip_so_far(sim, alpha) - start - speed * t});
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k)
      sum += normal_force(face_row(sim, k));
    result.largest = std::max(result.largest, sum / normal);
  }
  const double speed = v0.x * std::cos(a) - v0.y * std::sin(a);
  result.way = slip_so_far(sim, alpha) - start - speed * duration;
  result.error = account_energy(sim).error;
  record_model(row, label, sim);
  return result;
}

/// Row 2: a ramp that starts stressed does not have the error of a sudden start.
TEST(PreloadedRamp, SlidesAsAnalytic) {
  for (const auto& [alpha, phi] :
       {std::pair{30.0, 10.0}, std::pair{30.0, 15.0}, std::pair{45.0, 10.0}, std::pair{45.0, 15.0},
        std::pair{30.0, 20.0}, std::pair{30.0, 25.0}, std::pair{45.0, 30.0},
        std::pair{45.0, 40.0}}) {
    for (const char* young : {"200e6", "20e9"}) {
      const Slide s = slide(2, alpha, phi, young, 0.02 * std::sqrt(20e9 / std::stod(young)), 0.1);
      expect_relative({2, ramp_label(alpha, phi, young), "distance slid, less v0 t", "m"}, s.way,
                      sliding(alpha, phi, 0.1), 1e-4);
      EXPECT_LT(std::abs(s.error), 1e-5);
      EXPECT_LT(s.largest, 1.001);
    }
  }
}

/// Row 3, below the threshold: slides as row 1.
TEST(StickThreshold, ATenthOfADegreeLessSlides) {
  for (const double alpha : {20.0, 30.0, 45.0}) {
    const Slide s = slide(3, alpha, alpha - 0.1, "20e9", 0.5, 0.5);
    expect_relative({3, ramp_label(alpha, alpha - 0.1, "20e9"), "distance slid, less v0 t", "m"},
                    s.way, sliding(alpha, alpha - 0.1, 0.5), 1e-2);
  }
}

/// Row 3, above it: sticks permanently. The uphill corner has slipped to its limit; the spring of
/// the other carries the rest, (W sin a - N_up tan phi)/k_t, N_up = W cos a/2 - W sin a/4 for 2 x 1
/// m.
TEST(StickThreshold, ATenthOfADegreeMoreHolds) {
  for (const double alpha : {30.0, 45.0}) {
    const double phi = alpha + 0.1, a = radians(alpha), weight = 2.0 * 2750.0 * 9.8, kt = 4e11;
    Simulation sim = stressed_ramp(alpha, phi, "20e9", 0.1);
    const Id lower = sim.scene->blocks.vertex_begin[1] + 1;  // the downhill corner of the base
    const auto along = [&] {
      const double ux = sim.motion.pose.x[lower] - sim.scene->blocks.vertex_x[lower];
      const double uy = sim.motion.pose.y[lower] - sim.scene->blocks.vertex_y[lower];
      return ux * std::cos(a) - uy * std::sin(a);
    };
    const double up = weight * (0.5 * std::cos(a) - 0.25 * std::sin(a));
    const double offset = (weight * std::sin(a) - up * std::tan(radians(phi))) / kt;
    const std::string label = ramp_label(alpha, phi, "20e9");
    expect_relative({3, label, "offset of the downhill corner", "m"}, along(), offset, 2e-2);
    Series offsets(3, label, {"time", "exact", "computed"});
    const double begin = sim.motion.state.time;
    const double end = sim.motion.state.time + 2.0, start = along();
    double most = 0.0, kinetic = 0.0;
    fit_step_to(sim, end);
    while (sim.motion.state.time < end) {
      ASSERT_FALSE(step(sim).has_value());
      most = std::max(most, std::abs(along() - start));
      if (sim.motion.state.steps % 256 == 0) {
        kinetic = std::max(kinetic, account_energy(sim).kinetic);
        offsets.add({sim.motion.state.time - begin, offset, along()});
      }
    }
    record_model(3, label, sim);
    expect_at_most({3, label, "moves in the next 2 s, over the offset", ""}, most / offset, 1e-3);
    EXPECT_LT(kinetic, 1e-6 * weight * offset) << alpha;
  }
}

}  // namespace
}  // namespace edda::preloaded_test
