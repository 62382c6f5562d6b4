// A bar bedded on either side of a joint, against a beam in finite elements, a search over
// mechanisms, and the definitions of what it does beyond its strength.
#include "attachments/dowel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace edda::dowel_test {
namespace {

constexpr DowelBar bar{0.025, 200e9, 500e6};
constexpr double bending = 200e9 * std::numbers::pi * 0.025 * 0.025 * 0.025 * 0.025 / 64.0;
constexpr double moment = 500e6 * 0.025 * 0.025 * 0.025 / 6.0;

/// Force over offset of a bar of `half` on either side of the gap, in beam elements of 4 mm (or of
/// a 20th of the gap). The left foundation stays, the right one moves by 1.
double stiffness_in_elements(const Foundation& left, const Foundation& right, double gap) {
  constexpr double half = 0.32, size = 4e-3;
  std::vector<double> lengths, moduli, moved;
  const auto add = [&](double length, double piece, double modulus, double by) {
    const auto n = static_cast<std::size_t>(std::lround(length / piece));
    lengths.insert(lengths.end(), n, length / static_cast<double>(n));
    moduli.insert(moduli.end(), n, modulus);
    moved.insert(moved.end(), n, by);
  };
  add(half, size, left.modulus, 0.0);
  if (gap > 0.0) add(gap, gap / 20.0, 0.0, 0.0);
  add(half, size, right.modulus, 1.0);
  const auto size_of = static_cast<Eigen::Index>(2 * lengths.size() + 2);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size_of, size_of);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size_of);
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    const double h = lengths[e];
    Eigen::Matrix4d stiff, bed;
    stiff << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h,
        6 * h, 2 * h * h, -6 * h, 4 * h * h;
    bed << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54, 13 * h, 156,
        -22 * h, -13 * h, -3 * h * h, -22 * h, 4 * h * h;
    bed *= moduli[e] * h / 420.0;
    const auto at = static_cast<Eigen::Index>(2 * e);
    k.block<4, 4>(at, at) += bending / (h * h * h) * stiff + bed;
    f.segment<4>(at) += bed * Eigen::Vector4d(moved[e], 0.0, moved[e], 0.0);
  }
  const Eigen::VectorXd w = k.ldlt().solve(f);
  double force = 0.0;  // of the left foundation on the bar
  for (std::size_t e = 0; e < lengths.size() && moved[e] == 0.0; ++e) {
    const auto at = static_cast<Eigen::Index>(2 * e);
    const double h = lengths[e];
    force += moduli[e] * h * (0.5 * (w[at] + w[at + 2]) + h / 12.0 * (w[at + 1] - w[at + 3]));
  }
  return force;
}

TEST(Dowel, IsTwoBeamsOnTheirFoundations) {
  const Foundation rock{20e9, 50e6}, soft{1e9, 5e6};
  for (const double gap : {0.0, 0.02, 0.1}) {
    for (const auto& [left, right] : {std::pair{rock, rock}, {soft, soft}, {rock, soft}}) {
      const double exact = stiffness_in_elements(left, right, gap);
      EXPECT_NEAR(dowel_action(bar, left, right, gap).stiffness / exact, 1.0, 1e-3) << gap;
    }
  }
  // The same foundation on both sides: E I beta^3.
  const double beta = std::pow(rock.modulus / (4.0 * bending), 0.25);
  EXPECT_NEAR(dowel_action(bar, rock, rock, 0.0).stiffness / (bending * beta * beta * beta), 1.0,
              1e-12);
}

/// Least work of all mechanisms with a hinge on either side, over the offset.
double least_of_mechanisms(double left, double right, double gap) {
  double least = 1e300;
  for (double a = 1e-3; a < 0.4; a *= 1.01) {
    for (double b = 1e-3; b < 0.4; b *= 1.01) {
      const double work = 2.0 * moment + 0.5 * bar.diameter * (left * a * a + right * b * b);
      least = std::min(least, work / (a + gap + b));
    }
  }
  return least;
}

TEST(Dowel, CollapsesByTheWeakestMechanism) {
  for (const double gap : {0.0, 0.03}) {
    for (const auto& [left, right] : {std::pair{50e6, 50e6}, {5e6, 5e6}, {100e6, 10e6}}) {
      const double least = least_of_mechanisms(left, right, gap);
      const DowelAction dowel = dowel_action(bar, {20e9, left}, {20e9, right}, gap);
      EXPECT_NEAR(dowel.strength / least, 1.0, 1e-3) << gap << ' ' << right;
    }
  }
  const DowelAction dowel = dowel_action(bar, {20e9, 50e6}, {20e9, 50e6}, 0.0);
  EXPECT_NEAR(dowel.strength / std::sqrt(2.0 * moment * 50e6 * bar.diameter), 1.0, 1e-12);
  EXPECT_NEAR(dowel.hinges / (2.0 * dowel.strength / (50e6 * bar.diameter)), 1.0, 1e-12);
  // In rock that does not give way the bar is sheared off.
  EXPECT_NEAR(dowel_action(bar, {20e9, 1e12}, {20e9, 1e12}, 0.0).strength /
                  (0.25 * std::numbers::pi * bar.diameter * bar.diameter * 500e6 / std::sqrt(3.0)),
              1.0, 1e-12);
}

constexpr LinkPair stiffness{3e9, 2e7}, strength{2.5e5, 4e4};

double in_energy(const LinkPair& a, const LinkPair& b) {
  return 0.5 * (std::pow(a.axial - b.axial, 2) / stiffness.axial +
                std::pow(a.shear - b.shear, 2) / stiffness.shear);
}

/// Of a thousand points on the strength surface none is closer; the energy, which its derivative
/// is tested for, is stored and dissipated.
TEST(Dowel, FlowsToTheClosestForces) {
  for (const LinkPair& trial :
       {LinkPair{3e5, 0.0}, {0.0, -6e4}, {2e5, 4e4}, {-8e6, 5e4}, {1e5, 9e5}, {3e7, -1e6}}) {
    const LinkForces f = link_forces(trial, stiffness, strength, 0.0);
    EXPECT_TRUE(f.flows);
    EXPECT_NEAR(std::hypot(f.force.axial / strength.axial, f.force.shear / strength.shear), 1.0,
                1e-12);
    const double distance = in_energy(trial, f.force);
    for (int k = 0; k < 1000; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 1000.0;
      const LinkPair other{strength.axial * std::cos(angle), strength.shear * std::sin(angle)};
      EXPECT_GE(in_energy(trial, other), distance * (1.0 - 1e-9));
    }
    const double dissipated = f.force.axial * (trial.axial - f.force.axial) / stiffness.axial +
                              f.force.shear * (trial.shear - f.force.shear) / stiffness.shear;
    EXPECT_GT(dissipated, 0.0);
  }
  EXPECT_FALSE(link_forces({2e5, 2e4}, stiffness, strength, 1e-4).flows);
  EXPECT_EQ(link_forces({2e5, 2e4}, stiffness, strength, 1e-4).force.axial, 2e5);
}

/// Forces are the derivatives of the energy by the strains, slopes those of the forces; of the link
/// in its joint, too.
TEST(Dowel, ForcesAndSlopesAreDerivatives) {
  const auto at = [](double longer, double shear) {
    return link_forces({stiffness.axial * longer, stiffness.shear * shear}, stiffness, strength,
                       1e-4);
  };
  for (const auto& [longer, shear] :
       {std::pair{5e-5, 1e-3}, {2e-4, 5e-3}, {-1e-4, 1e-2}, {1e-5, -3e-3}}) {
    const LinkForces f = at(longer, shear);
    const double e = 1e-9, s = 1e-7;
    EXPECT_NEAR((at(longer + e, shear).energy - at(longer - e, shear).energy) / (2.0 * e),
                f.force.axial, 1e-5 * strength.axial);
    EXPECT_NEAR((at(longer, shear + s).energy - at(longer, shear - s).energy) / (2.0 * s),
                f.force.shear, 1e-5 * strength.shear);
    const double axial =
        (at(longer + e, shear).force.axial - at(longer - e, shear).force.axial) / (2.0 * e);
    EXPECT_NEAR(axial, f.axial_slope, 1e-4 * stiffness.axial);
    const double across =
        (at(longer, shear + s).force.shear - at(longer, shear - s).force.shear) / (2.0 * s);
    EXPECT_NEAR(across, f.shear_slope, 1e-4 * stiffness.shear);
    const double mixed =
        (at(longer, shear + s).force.axial - at(longer, shear - s).force.axial) / (2.0 * s);
    EXPECT_NEAR(mixed, f.mixed_slope, 1e-4 * std::sqrt(stiffness.axial * stiffness.shear));
  }
  const LinkPair pair{2e5, 3e4};
  const auto work = [&](double e, double d) {
    const BarLink link = link_at(0.08, e, d);
    return pair.axial * link.longer + pair.shear * link.shear;
  };
  for (const auto& [e, d] : {std::pair{0.0, 0.0}, {0.01, 0.03}, {-0.005, -0.1}}) {
    const Vec2 pull = link_at(0.08, e, d).pull(pair);
    EXPECT_NEAR((work(e + 1e-7, d) - work(e - 1e-7, d)) / 2e-7, pull.x, 1e-2);
    EXPECT_NEAR((work(e, d + 1e-7) - work(e, d - 1e-7)) / 2e-7, pull.y, 1e-2);
  }
}

}  // namespace
}  // namespace edda::dowel_test
