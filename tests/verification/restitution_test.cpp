// Joints with a restitution: dropped blocks rebound with the required fraction of their velocity,
// rocking blocks lose Housner's fraction of their energy at each impact.
#include <algorithm>
#include <array>

#include "blocks/state.hpp"
#include "model/read_model.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::restitution_test {
namespace {

constexpr double gravity = 9.81, density = 2500.0;

std::string rock_and_joint(const std::string& joint, const std::string& material = "") {
  return "[materials.rock]\ndensity = " + number(density) + "\nyoung = 20e9\npoisson = 0.2\n" +
         material + "[joints.j]\nfriction_angle = 60\n" + joint +
         "\n[[block]]\nname = \"ground\"\nfixed = true\npolygon = " +
         rectangle(-6.0, -1.0, 7.0, 0.0) + "\n";
}

/// Energies of a block of 1 x h between its impacts: tilted by half of the angle at which it would
/// topple and released, until it has made `impacts` impacts.
std::vector<double> rocking(double h, const std::string& joint, std::size_t impacts,
                            double* error = nullptr) {
  const double alpha = std::atan2(1.0, h), c = std::cos(-0.5 * alpha), s = std::sin(-0.5 * alpha);
  std::string ring;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, h}, {0.0, h}}) {
    ring += (ring.empty() ? "[[" : "],[") + number(1.0 + c * (x - 1.0) - s * y) + "," +
            number(s * (x - 1.0) + c * y);
  }
  Simulation sim = scene(rock_and_joint(joint) + "[[block]]\npolygon = " + ring +
                         "]]\n[solver]\nduration = 20\n[output]\nhistory_every = 0.002\n");
  const double weight = density * h * gravity;
  std::vector<double> energies, row;
  double side = 0.0;
  start(sim, 0.002);
  for (int n = 1; energies.size() <= impacts; ++n) {
    fit_step_to(sim, 0.002 * n);
    while (sim.motion.state.time < 0.002 * n) {
      if (step(sim)) return {};
    }
    const Vec2 at = centroid(sim.motion.state.x, sim.motion.state.y, 1) + sim.scene->blocks.origin;
    const double now = at.x - 0.5;
    if (now * side < 0.0) {
      // The median: small impacts just after the last one do not count.
      const auto middle = row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2);
      std::nth_element(row.begin(), middle, row.end());
      energies.push_back(*middle);
      row.clear();
    }
    side = now;
    row.push_back(kinetic_energy(sim.motion.masses, sim.motion.state.vx, sim.motion.state.vy, 1) +
                  weight * (at.y - 0.5 * h));
  }
  if (error != nullptr) *error = account_energy(sim).error;
  return energies;
}

TEST(Restitution, RockingLosesHousnersPart) {
  for (const double h : {2.0, 2.5, 3.0, 4.0, 6.0}) {
    double error = 0.0;
    const std::vector<double> energies = rocking(h, "restitution = \"housner\"", 3, &error);
    ASSERT_EQ(energies.size(), 4u);
    const double sine = 1.0 / std::hypot(1.0, h), left = 1.0 - 1.5 * sine * sine;
    for (std::size_t n = 0; n + 1 < energies.size(); ++n) {
      expect_relative({55, "1 : " + brief(h), "energy left by impact " + std::to_string(n + 1), ""},
                      energies[n + 1] / energies[n], left * left, 1e-2);
    }
    EXPECT_LT(std::abs(error), 1e-5);
  }
}

/// Fraction of its speed with which a block of w x h rebounds from a flat impact.
double left_of_drop(double w, double h, const std::string& joint, const std::string& material,
                    double speed = 0.5) {
  Simulation sim =
      scene("gravity = [0, 0]\n" + rock_and_joint(joint, material) +
            "[[block]]\npolygon = " + rectangle(0.0, 1e-4, w, h + 1e-4) + "\nvelocity = [0, " +
            number(-speed) + "]\n[solver]\nduration = 0.2\n[output]\nhistory_every = 0.1\n");
  run(sim, [](Simulation&) {});
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
  return centroid(sim.motion.state.vx, sim.motion.state.vy, 1).y / speed;
}

TEST(Restitution, FlatImpactsLeaveThePartAskedFor) {
  for (const double part : {0.0, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    for (const auto& [w, h] : {std::pair{1.0, 1.0}, {0.3, 0.3}, {2.0, 1.0}, {1.0, 2.0}}) {
      const double left = left_of_drop(w, h, "restitution = " + number(part), "");
      const std::string which =
          "drop, " + brief(w) + " x " + brief(h) + ", asked for " + brief(part);
      expect_at_most({55, which, "error of the remaining part of the velocity", ""},
                     std::abs(left - part),
                     part == 0.0 ? 0.06
                     : w == h    ? 0.015
                                 : 0.03);
    }
  }
  EXPECT_LT(left_of_drop(1.0, 1.0, "", ""), 0.5) << "what the rock's own damping leaves";
}

TEST(Restitution, PartsOutOfReachAreRefused) {
  const auto faults_of = [](const std::string& joint, const std::string& material) {
    const std::string text = rock_and_joint(joint, material) +
                             "[[block]]\npolygon = " + rectangle(0.0, 0.0, 1.0, 1.0) +
                             "\n[solver]\nduration = 0.1\n";
    Result<Model> model = read_model_text(text, EDDA_SOURCE_DIR "/scene.toml", {});
    if (!model.ok()) return to_string(model.faults().front());
    const Result<Simulation> made = Simulation::create(std::move(model.value()));
    return made.ok() ? std::string() : to_string(made.faults().front());
  };
  const std::string stiff = faults_of("kn = 1e12\nrestitution = 0.9", "");
  for (const char* part : {"joints.j.restitution", "is more than the 0.", "kn = 1e+12",
                           "materials.rock.damping = 0.5", "leave out kn"}) {
    EXPECT_NE(stiff.find(part), std::string::npos) << stiff;
  }
  EXPECT_EQ(faults_of("kn = 1e9\nrestitution = 0.9", ""), "");
  EXPECT_NE(faults_of("kn = 1e11\nrestitution = 'housner'", "").find("give at most 4e+09 Pa/m"),
            std::string::npos);
  EXPECT_EQ(faults_of("kn = 3e9\nrestitution = 'housner'", ""), "");
  EXPECT_NE(faults_of("kn = 1e12\nrestitution = 0.1", "").find("is less than the 0."),
            std::string::npos);
}

/// For every impact the dissipation of dashpots is in the energy balance, and their force stays
/// within Coulomb's limit.
TEST(Restitution, ForcesStayWithinFriction) {
  Simulation sim = scene(rock_and_joint("restitution = \"housner\"") +
                         "[[block]]\npolygon = [[0, 0.5], [1, 0.2], [1.4, 1.1], [0.3, 1.4]]\n"
                         "velocity = [2, -1]\nangular_velocity = 1.5\n[[block]]\npolygon = " +
                         rectangle(1.5, 0.001, 2.3, 0.8) +
                         "\n[solver]\nduration = 1\n[output]\nhistory_every = 0.01\n");
  double damping = 0.0, over = 0.0;
  bool falls = false;
  run(
      sim,
      [&](Simulation& s) {
        const EnergyBalance l = account_energy(s);
        falls = falls || l.damping < damping * (1.0 - 1e-9);
        damping = l.damping;
      },
      [&](Simulation& s) {
        const FaceSet& c = s.motion.contacts;
        for (std::size_t k = 0; k < c.size(); ++k) {
          const double limit = shear_strength(c, k);
          over = std::max(over, std::abs(shear_force(c, k)) - limit * (1.0 + 1e-9));
        }
      });
  EXPECT_GT(damping, 100.0);
  EXPECT_FALSE(falls);
  EXPECT_LT(over, 1e-6);
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
}

}  // namespace
}  // namespace edda::restitution_test
