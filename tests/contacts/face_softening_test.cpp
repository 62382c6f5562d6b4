// A joint with fracture energy, opened and sheared in a prescribed way: its strength, the energy
// that its crack takes, and unloading (theory, section 5.9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "contacts/face_softening.hpp"
#include "contacts/moved_blocks.hpp"
#include "contacts/strength.hpp"

namespace edda::face_softening_test {
namespace {

using test::MovedBlocks;
using test::rough_joint;
using test::square_on_base;

constexpr double thickness = 2.0, kn = 2e9, ks = 1e9;  // Pa/m
constexpr double tension = 2e5, cohesion = 1e6, g1 = 40.0, g2 = 1000.0;
constexpr double opening = 2.0 * g1 / tension, slip = 2.0 * g2 / cohesion;  // w_c and s_c

JointLaw cohesive_joint(bool given_stiffness = false) {
  JointLaw joint = rough_joint(30.0, cohesion, tension);
  joint.residual = {30.0, 0.0, 0.0};
  joint.fracture_energy = g1;
  joint.shear_fracture_energy = g2;
  if (given_stiffness) {
    joint.kn = kn;
    joint.ks = ks;
  }
  return joint;
}

struct Joint : MovedBlocks {
  std::size_t k = 0;

  explicit Joint(bool given_stiffness = false)
      : MovedBlocks(square_on_base(cohesive_joint(given_stiffness), thickness)) {
    start();
    bond();
    evaluate();
    while (k < faces.size() && !faces.bonded(k)) ++k;
  }
  /// Normal stress, Pa, tension positive, and shear stress that act on the square.
  double pull() const { return -force_on(1).y / thickness; }
  double shear() const { return -force_on(1).x / thickness; }
  FaceEnds damage() const { return damage_of(faces, laws, k); }
  /// Work that drives the square, J; each(t) gives its place, t from 0 to 1.
  double drive(const std::function<test::Place(double)>& at, int steps,
               const std::function<void()>& each = {}) {
    const double before = work;
    for (int n = 1; n <= steps; ++n) {
      go(1, at(double(n) / steps));
      if (each) each();
    }
    return before - work;
  }
};

test::Place lifted(double by) {
  return {{0.0, by}};
}

/// In tension alone: peak T, then a straight line down to 0 at w_c; the crack takes G_I.
TEST(FaceSoftening, TakesItsFractureEnergyInTension) {
  for (const bool given : {false, true}) {
    Joint j(given);
    ASSERT_LT(j.k, j.faces.size());
    double peak = 0.0, off = 0.0;
    const double last = 1.2 * opening;
    double lifted_by = 0.0;
    const double done =
        j.drive([&](double t) { return lifted(lifted_by = t * last); }, 6000,
                [&] {
                  peak = std::max(peak, j.pull());
                  // The opening is that of the spring and of the crack.
                  const double crack = (lifted_by - tension / kn) / (1.0 - tension / kn / opening);
                  const double exact = lifted_by < tension / kn
                                           ? kn * lifted_by
                                           : tension * std::max(1.0 - crack / opening, 0.0);
                  off = std::max(off, std::abs(j.pull() - exact) / tension);
                  const bool cracked = crack > 0.01 * opening, broken = crack > 1.01 * opening;
                  if (std::abs(crack) > 0.01 * opening && !broken) {
                    EXPECT_EQ(j.faces.is(FaceFlag::opened, j.k), cracked) << crack / opening;
                  }
                  if (std::abs(crack / opening - 1.0) > 0.01) {
                    EXPECT_EQ(j.faces.holds(j.k), !broken) << crack / opening;
                  }
                });
    EXPECT_NEAR(peak / tension, 1.0, 1e-3) << given;
    EXPECT_LT(off, 1e-3) << given;
    EXPECT_NEAR(done / (g1 * thickness), 1.0, 1e-3) << given;
    EXPECT_NEAR(j.fracture() / (g1 * thickness), 1.0, 1e-3) << given;
    EXPECT_FALSE(j.faces.carries_tension(j.k));
    j.go(1, lifted(last));
    EXPECT_EQ(j.faces.cracks_tension, 1u);
    EXPECT_EQ(j.faces.cracks_shear, 0u);
    EXPECT_EQ(j.faces.broken, 1u);
    EXPECT_EQ(j.faces.locked_closure_a[j.k], 0.0);
  }
}

/// What the square is given, by work in the leapfrog's terms, is stored or dissipated.
TEST(FaceSoftening, ClosesItsEnergyBalance) {
  for (const bool given : {false, true}) {
    Joint j(given);
    // Opens, closes, slips and turns, several times and farther each time.
    const auto at = [&](double t) {
      const double phase = 40.0 * t;
      return test::Place{{1.2 * slip * t * std::sin(0.7 * phase), opening * t * std::sin(phase)},
                         0.5 * opening * t * std::sin(1.3 * phase)};
    };
    const double before = j.balance();
    double off = 0.0, fracture = 0.0;
    const double start_work = j.work;
    j.drive(at, 20000, [&] {
      off = std::max(off, std::abs(j.balance() - before + j.work - start_work));
      EXPECT_GE(j.fracture(), fracture - 1e-12 * g1);
      fracture = j.fracture();
    });
    // Between the end of a step and the next one half a step's work is due.
    EXPECT_LT(off, 2e-3 * g1 * thickness) << given;
    EXPECT_GT(j.fracture(), 0.2 * g1 * thickness) << given;
  }
}

/// The crack closes and opens again without force, on a spring that is as stiff as it was.
TEST(FaceSoftening, UnloadsElastically) {
  for (const bool given : {false, true}) {
    Joint j(given);
    const double half = 0.5 * opening;
    j.drive([&](double t) { return lifted(t * half); }, 2000);
    const double left = j.pull(), spent = j.fracture(), crack = j.faces.parted_a[j.k];
    EXPECT_NEAR(left, tension * (1.0 - crack / opening), 1e-3 * tension);
    EXPECT_NEAR(crack, half - left / kn, 1e-9 * opening);
    const double at_ease = half - left / kn;
    const auto go_to = [&](double from, double to) {
      j.drive([&](double t) { return lifted(from + t * (to - from)); }, 500);
    };
    go_to(half, at_ease + 0.5 * left / kn);
    EXPECT_NEAR(j.pull(), 0.5 * left, 1e-6 * tension);
    go_to(at_ease + 0.5 * left / kn, 0.5 * at_ease);
    EXPECT_NEAR(j.pull(), 0.0, 2e-6 * tension);
    go_to(0.5 * at_ease, -0.1 * opening);
    EXPECT_NEAR(j.pull(), -0.1 * opening * kn, 1e-6 * tension);
    go_to(-0.1 * opening, 0.5 * at_ease);
    EXPECT_NEAR(j.pull(), 0.0, 2e-6 * tension);
    go_to(0.5 * at_ease, half);
    EXPECT_NEAR(j.pull(), left, 1e-6 * tension);
    EXPECT_NEAR(j.faces.parted_a[j.k], crack, 1e-9 * opening);
    EXPECT_NEAR(j.fracture(), spent, 1e-3 * spent);
  }
}

/// A crack that opens and closes many times in coarse steps, and never farther, spends nothing.
TEST(FaceSoftening, RattlingSpendsNothing) {
  Joint j;
  const double half = 0.5 * opening;
  j.drive([&](double t) { return lifted(t * half); }, 2000);
  const double spent = j.fracture(), crack = j.faces.parted_a[j.k];
  for (int n = 0; n < 200; ++n) {
    j.go(1, lifted(-0.2 * opening));
    j.go(1, lifted(0.3 * opening));
  }
  EXPECT_EQ(j.faces.parted_a[j.k], crack);
  EXPECT_EQ(j.fracture(), spent);
}

/// In shear without normal stress: peak c, a straight line down to 0 at s_c; the crack takes G_II.
/// Friction takes what it takes beside.
TEST(FaceSoftening, TakesItsFractureEnergyInShear) {
  for (const double pressed : {0.0, 1e-4}) {
    Joint j;
    const double friction = std::tan(30.0 * 3.14159265358979 / 180.0) * kn * pressed;
    j.put_still(1, lifted(-pressed));
    double peak = 0.0;
    const double last = 1.2 * slip;
    j.drive(
        [&](double t) {
          return test::Place{{t * last, -pressed}};
        },
        6000, [&] { peak = std::max(peak, std::abs(j.shear())); });
    EXPECT_NEAR(peak / (cohesion + friction), 1.0, 1e-3) << pressed;
    EXPECT_NEAR(std::abs(j.shear()) / cohesion, friction / cohesion, 1e-3) << pressed;
    j.go(1, {{last, -pressed}});
    EXPECT_NEAR(j.fracture() / (g2 * thickness), 1.0, 2e-3) << pressed;
    EXPECT_EQ(j.faces.cracks_shear, 1u) << pressed;
    EXPECT_EQ(j.faces.cracks_tension, 0u) << pressed;
    EXPECT_NEAR(j.friction() / thickness, friction * (last - friction / ks), 2e-3 * g2) << pressed;
  }
}

/// Opening and slip together use up the strength: half of each energy, or what the way gives.
TEST(FaceSoftening, SharesItsStrengthBetweenOpeningAndSlip) {
  Joint j;
  const double half = 0.5 * slip;
  j.drive([&](double t) { return test::Place{{t * (half + 0.5 * cohesion / ks), 0.0}}; }, 4000);
  const FaceEnds damage = j.damage();
  EXPECT_NEAR(damage.a, 0.5, 1e-2);
  EXPECT_NEAR(damage.b, damage.a, 1e-9);
  // Back to where the shear spring is at ease, and up.
  const double at_ease = half + 0.5 * cohesion / ks - j.shear() / ks;
  j.drive(
      [&](double t) {
        return test::Place{
            {half + 0.5 * cohesion / ks + t * (at_ease - half - 0.5 * cohesion / ks), 0.0}};
      },
      500);
  const double before = j.fracture();
  double peak = 0.0;
  j.drive(
      [&](double t) {
        return test::Place{{at_ease, t * opening}};
      },
      4000, [&] { peak = std::max(peak, j.pull()); });
  const double left = 1.0 - damage.a;
  EXPECT_NEAR(peak / tension, left, 1e-2);
  EXPECT_NEAR((j.fracture() - before) / (g1 * thickness), left * left, 1e-2);
}

/// A model whose strength is divided has its damage at the same openings and slips.
TEST(FaceSoftening, KeepsItsOpeningsAsStrengthIsDivided) {
  Joint j;
  const LawTable divided = divided_laws(j.model, std::vector<double>(2, 2.0));
  EXPECT_EQ(divided.rows[0].crack_opening, j.laws.rows[0].crack_opening);
  EXPECT_EQ(divided.rows[0].crack_slip, j.laws.rows[0].crack_slip);
  EXPECT_NEAR(
      strength_of(divided, 0, BondState::unbonded, {.parted = {0.5 * opening, 0.0}}).cohesion,
      0.5 * 0.75 * cohesion * thickness, 1e-6 * cohesion);
}

}  // namespace
}  // namespace edda::face_softening_test
