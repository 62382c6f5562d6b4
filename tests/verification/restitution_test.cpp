// Joints with a restitution: dropped blocks rebound with the required fraction of their velocity,
// rocking blocks lose Housner's fraction of their energy at each impact.
#include <algorithm>
#include <array>
#include <numbers>

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
    const Vec2 at = centroid(sim.motion.state.position, 1) + sim.scene->blocks.origin;
    const double now = at.x - 0.5;
    if (now * side < 0.0) {
      // The median: small impacts just after the last one do not count.
      const auto middle = row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2);
      std::nth_element(row.begin(), middle, row.end());
      energies.push_back(*middle);
      row.clear();
    }
    side = now;
    row.push_back(
        kinetic_energy(sim.motion.masses, sim.scene->blocks, sim.motion.state.velocity, 1) +
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
                      energies[n + 1] / energies[n], left * left, 1.1e-2);
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
  return centroid(sim.motion.state.velocity, 1).y / speed;
}

TEST(Restitution, FlatImpactsLeaveThePartAskedFor) {
  for (const double part : {0.0, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    for (const auto& [w, h] : {std::pair{1.0, 1.0}, {0.3, 0.3}, {2.0, 1.0}, {1.0, 2.0}}) {
      const double left = left_of_drop(w, h, "restitution = " + number(part), "");
      const std::string which =
          "drop, " + brief(w) + " x " + brief(h) + ", asked for " + brief(part);
      expect_at_most({55, which, "error of the remaining part of the velocity", ""},
                     std::abs(left - part),
                     part == 0.0 ? 0.1
                     : w == h    ? 0.015
                                 : 0.03);
    }
  }
  EXPECT_LT(left_of_drop(1.0, 1.0, "", ""), 0.5) << "what the rock's own damping leaves";
}

std::string ring_of(const std::vector<Vec2>& corners) {
  std::string text;
  for (const Vec2 p : corners)
    text += (text.empty() ? "[[" : "],[") + number(p.x) + "," + number(p.y);
  return text + "]]";
}

/// A regular polygon of n sides with an edge below, or a corner, that touches y = 0.
std::vector<Vec2> regular(int n, bool on_corner) {
  constexpr double pi = std::numbers::pi, radius = 0.7;
  std::vector<Vec2> corners;
  double lowest = 0.0;
  for (int k = 0; k < n; ++k) {
    const double angle = -0.5 * pi + 2.0 * pi * (k + (on_corner ? 0.0 : 0.5)) / n;
    corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    lowest = std::min(lowest, corners.back().y);
  }
  for (Vec2& p : corners) p.y -= lowest;
  return corners;
}
/// A square of 2 m without its corners.
std::vector<Vec2> chamfered(double by) {
  return {{-1.0 + by, 0.0}, {1.0 - by, 0.0},  {1.0, by},        {1.0, 2.0 - by},
          {1.0 - by, 2.0},  {-1.0 + by, 2.0}, {-1.0, 2.0 - by}, {-1.0, by}};
}
std::vector<Vec2> mirrored(std::vector<Vec2> ring) {
  std::reverse(ring.begin(), ring.end());
  for (Vec2& p : ring) p.y = -p.y;
  return ring;
}
std::vector<Vec2> raised(std::vector<Vec2> ring, double by, double scale = 1.0) {
  for (Vec2& p : ring) p = scale * p + Vec2{0.0, by};
  return ring;
}

/// Part of the relative velocity that remains where `upper` strikes `lower`, or the ground where
/// that is empty, straight down. `more`: keys of the joint.
double left_of_impact(const std::vector<Vec2>& upper, const std::vector<Vec2>& lower, double part,
                      const std::string& more = "") {
  constexpr double speed = 0.5;
  const std::string falls = "\nvelocity = [0, " + number(-speed) + "]\n";
  std::string text =
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.25\n"
      "[joints.j]\nfriction_angle = 30\nrestitution = " +
      number(part) + "\n" + more + "[[block]]\npolygon = " + ring_of(raised(upper, 1e-4)) + falls;
  text += lower.empty() ? "[[block]]\nfixed = true\npolygon = " + rectangle(-3.0, -1.0, 3.0, 0.0)
                        : "[[block]]\npolygon = " + ring_of(lower);
  Simulation sim = scene(text + "\n[solver]\nduration = 0.1\n[output]\nhistory_every = 0.1\n");
  run(sim, [](Simulation&) {});
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
  const auto speed_of = [&](std::size_t i) {
    return sim.scene->blocks.fixed[i] != 0 ? 0.0 : centroid(sim.motion.state.velocity, i).y;
  };
  return std::abs(speed_of(0) - speed_of(1)) / speed;
}

/// However many edges meet where a block strikes, whatever its shape and the masses of the two. An
/// edge that is short against its block bends more than that of the square to which it is fitted.
TEST(Restitution, EveryShapeKeepsThePartAskedFor) {
  const auto expect = [](const std::string& which, double left, double part) {
    const double most = part == 0.0 ? 0.1 : part <= 0.2 ? 0.045 : std::max(0.03 * part, 0.015);
    expect_at_most({55, which + ", asked for " + brief(part),
                    "error of the remaining part of the velocity", ""},
                   std::abs(left - part), most);
  };
  for (const double part : {0.0, 0.1, 0.2, 0.5, 0.8}) {
    for (int n = 3; n <= 12; ++n) {
      for (const bool on_corner : {false, true}) {
        expect(std::to_string(n) + (on_corner ? "-gon on a corner" : "-gon, flat"),
               left_of_impact(regular(n, on_corner), {}, part), part);
      }
    }
    for (const double by : {0.02, 0.1, 0.4}) {
      expect("square without corners of " + brief(by) + " m",
             left_of_impact(chamfered(by), {}, part), part);
    }
    for (const double scale : {0.25, 0.5, 1.0, 4.0}) {
      expect(
          "hexagon on one of " + brief(scale) + " times its size",
          left_of_impact(regular(6, false), mirrored(raised(regular(6, false), 0.0, scale)), part),
          part);
    }
    for (const bool on_corner : {false, true}) {
      if (part < 0.2) break;  // 0.016 off, and 0 is refused
      expect(std::string("hexagon ") + (on_corner ? "on a corner" : "flat") + ", measured kn",
             left_of_impact(regular(6, on_corner), {}, part, "kn = 1e9\n"), part);
    }
    expect("square on the corner of a square",
           left_of_impact(regular(4, false), mirrored(regular(4, true)), part), part);
  }
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
          const FaceRow face = face_row(s, k);
          const double limit = shear_strength(face);
          over = std::max(over, std::abs(shear_force(face)) - limit * (1.0 + 1e-9));
        }
      });
  EXPECT_GT(damping, 100.0);
  EXPECT_FALSE(falls);
  EXPECT_LT(over, 1e-6);
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
}

}  // namespace
}  // namespace edda::restitution_test
