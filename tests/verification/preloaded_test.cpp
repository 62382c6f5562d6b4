// Ramps that start from their settled state: validation.md rows 2 and 3. Settled with strong mass
// damping, which a test takes away when it begins.
#include <algorithm>

#include "verification/models.hpp"

namespace edda {
namespace {

/// Damping near the critical one of the block's own vibrations settles it soonest.
/// `contact`: a [contact] table.
Simulation settled_ramp(double alpha, double phi, const std::string& young, double settle_time,
                        const std::string& contact = {}) {
  const double settle_damping = 1e4 * std::sqrt(std::stod(young) / 20e9);
  Simulation sim = scene(ramp(alpha, phi, young, 1,
                              "damping = { mass = " + number(settle_damping) + " }\n" + contact));
  sim.start(settle_time);
  while (sim.state.time < settle_time) {
    const auto failure = sim.step();
    EXPECT_FALSE(failure.has_value());
  }
  sim.model.solver.damping.mass = 0.0;
  return sim;
}

Vec2 velocity(const Simulation& sim) {
  return centroid(sim.state.vx, sim.state.vy, sim.blocks.size() - 1);
}

struct Slide {
  double error;    ///< of the way, against v0 t + a t^2/2
  double drift;    ///< of the ledger
  double largest;  ///< sum of the normal forces over its static value
};

/// The slide of `duration` s after settling. While the block is damped it slides at a constant
/// speed: mass damping pulls as inertia will, so that every force is that of the sliding state.
Slide slide(double alpha, double phi, const std::string& young, double settle_time, double duration,
            const std::string& contact = {}) {
  Simulation sim = settled_ramp(alpha, phi, young, settle_time, contact);
  const double a = radians(alpha), start = slid(sim, alpha), t0 = sim.state.time;
  const double normal = 2.0 * 2750.0 * 9.8 * std::cos(a);
  const Vec2 v_before = velocity(sim);
  Slide result{0.0, 0.0, 0.0};
  Vec2 v0;
  bool first = true;
  sim.start_energy = {};
  sim.ledger();
  sim.aim_at(t0 + duration);
  while (sim.state.time < t0 + duration) {
    const auto failure = sim.step();
    EXPECT_FALSE(failure.has_value());
    if (first) v0 = 0.5 * (v_before + velocity(sim));
    first = false;
    double sum = 0.0;
    for (std::size_t k = 0; k < sim.contacts.size(); ++k)
      sum += sim.contacts.share[k] * sim.contacts.normal[k];
    result.largest = std::max(result.largest, sum / normal);
  }
  const double speed = v0.x * std::cos(a) - v0.y * std::sin(a);
  const double exact = sliding(alpha, phi, duration);
  result.error = (slid(sim, alpha) - start - speed * duration) / exact - 1.0;
  result.drift = sim.ledger().drift;
  return result;
}

/// Row 2: nothing is left of the ramp's error when it starts stressed.
TEST(PreloadedRamp, SlidesAsAnalytic) {
  for (const auto& [alpha, phi] : {std::pair{30.0, 10.0}, std::pair{30.0, 15.0},
                                   std::pair{45.0, 10.0}, std::pair{45.0, 15.0}}) {
    for (const char* young : {"200e6", "20e9"}) {
      const Slide s = slide(alpha, phi, young, 0.02 * std::sqrt(20e9 / std::stod(young)), 0.1);
      RecordProperty("error_" + std::to_string(static_cast<int>(alpha + phi)) + "_" + young,
                     number(s.error));
      EXPECT_NEAR(s.error, 0.0, 1e-4) << alpha << ' ' << phi << ' ' << young;
      EXPECT_LT(std::abs(s.drift), 1e-5);
      EXPECT_LT(s.largest, 1.001);
    }
  }
}

/// Beyond 21 degrees of friction and with contacts ten times as stiff as the rock, steady sliding
/// of this block is unstable (flutter_test.cpp): contacts as stiff as the rock, then, where it is
/// not.
constexpr const char* contact_as_rock = "[contact]\nnormal_stiffness = 2e10\n";

/// Row 3, below the threshold: slides as row 1.
TEST(StickThreshold, ATenthOfADegreeLessSlides) {
  for (const double alpha : {30.0, 45.0}) {
    const Slide s = slide(alpha, alpha - 0.1, "20e9", 0.5, 0.5, contact_as_rock);
    RecordProperty("error_" + std::to_string(static_cast<int>(alpha)), number(s.error));
    EXPECT_NEAR(s.error, 0.0, 1e-2) << alpha;
  }
}

/// Row 3, above it: holds for good. The uphill corner has slipped to its limit; the spring of the
/// other has what is left, (W sin a - N_up tan phi)/k_t, N_up = W cos a/2 - W sin a/4 for 2 x 1 m.
TEST(StickThreshold, ATenthOfADegreeMoreHolds) {
  for (const double alpha : {30.0, 45.0}) {
    const double phi = alpha + 0.1, a = radians(alpha), weight = 2.0 * 2750.0 * 9.8, kt = 2e10;
    Simulation sim = settled_ramp(alpha, phi, "20e9", 0.1, contact_as_rock);
    const Id lower = sim.blocks.vertex_begin[1] + 1;  // the downhill corner of the base
    const auto along = [&] {
      const double ux = sim.pose.x[lower] - sim.blocks.vertex_x[lower];
      const double uy = sim.pose.y[lower] - sim.blocks.vertex_y[lower];
      return ux * std::cos(a) - uy * std::sin(a);
    };
    const double up = weight * (0.5 * std::cos(a) - 0.25 * std::sin(a));
    const double offset = (weight * std::sin(a) - up * std::tan(radians(phi))) / kt;
    EXPECT_NEAR(along() / offset, 1.0, 2e-2) << alpha;
    const double end = sim.state.time + 2.0, start = along();
    double most = 0.0, kinetic = 0.0;
    sim.aim_at(end);
    while (sim.state.time < end) {
      ASSERT_FALSE(sim.step().has_value());
      most = std::max(most, std::abs(along() - start));
      if (sim.state.steps % 256 == 0) kinetic = std::max(kinetic, sim.ledger().kinetic);
    }
    RecordProperty("moved_" + std::to_string(static_cast<int>(alpha)), number(most / offset));
    EXPECT_LT(most, 1e-3 * offset) << alpha;
    EXPECT_LT(kinetic, 1e-6 * weight * offset) << alpha;
  }
}

}  // namespace
}  // namespace edda
