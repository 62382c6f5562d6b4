// Joints that change gradually (ramps of `change`, `over`), and that lose strength with time
// (decay_time).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contacts/face_reading.hpp"
#include "run/prepared.hpp"
#include "step/law_progress.hpp"
#include "verification/factor_of.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::law_progress_test {
namespace {

using testing::prepared;
using testing::Ran;
using testing::ran;

constexpr double slope = 30.0, g = 9.8, density = 2500.0, day = 86400.0;

double tangent(double degrees) {
  return std::tan(radians(degrees));
}

/// A block of 2 x 1 m on a plane of 30 degrees that falls to the right, or mirrored.
std::string on_plane(const std::string& joints, const std::string& stages, bool mirrored = false) {
  const auto box = [&](double u0, double u1, double v0, double v1) {
    std::string text;
    for (const auto& [u, v] : {Vec2{u0, v0}, Vec2{u1, v0}, Vec2{u1, v1}, Vec2{u0, v1}}) {
      const double a = radians(slope);
      const double x = u * std::cos(a) + v * std::sin(a), y = v * std::cos(a) - u * std::sin(a);
      text += fmt::format("{}[{:.17g}, {:.17g}]", text.empty() ? "" : ", ", mirrored ? -x : x, y);
    }
    return '[' + text + ']';
  };
  return "gravity = [0, -9.8]\n[materials.rock]\ndensity = 2500\nyoung = 5e9\npoisson = 0.2\n" +
         joints +
         "[contact]\njoint = 'fresh'\n[[block]]\nfixed = true\npolygon = " + box(-9, 9, -1, 0) +
         "\n[[block]]\nname = 'slider'\npolygon = " + box(-1, 1, 0, 1) +
         "\n[[stage]]\nuntil = 'equilibrium'\n" + stages;
}

std::string law(const char* name, double friction, double cohesion, const std::string& more = {}) {
  return fmt::format("[joints.{}]\nfriction_angle = {}\ncohesion = {}\n{}", name, friction,
                     cohesion, more);
}

const std::string ramped_change =
    "[[stage]]\nuntil = 'collapse'\nchange = [{ joints = 'fresh', to = 'worn' }]\n"
    "ramp = { change = [0, 1], steps = 50 }\n";

/// The increment in which it fails is the one of the exact value.
void expect_between(const Ran& r, const Quantity& q, double exact, double increment) {
  ASSERT_EQ(r.outcome.ramps.size(), 1u) << r.outcome.message;
  const RampOutcome& found = r.outcome.ramps[0];
  ASSERT_TRUE(found.holds && found.fails) << r.outcome.message;
  EXPECT_NEAR(*found.fails - *found.holds, increment, 1e-9 * increment);
  EXPECT_LT(*found.holds, exact) << q.which;
  EXPECT_GT(*found.fails, exact) << q.which;
  expect_relative(q, 0.5 * (*found.holds + *found.fails), exact, 0.5 * increment / exact);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6) << q.which;
}

/// The part f of the change at which (1 - f) (c1 A + N tan phi1) + f (c2 A + N tan phi2) is the
/// weight along the plane.
TEST(LawProgress, AChangeThatComesGraduallyFailsAtItsPart) {
  const double weight = density * g * 2.0, along = weight * std::sin(radians(slope)),
               normal = weight * std::cos(radians(slope));
  struct Case {
    const char* which;
    double friction, cohesion, to_friction, to_cohesion;
  };
  for (const Case& c : {Case{"friction from 40 to 20 deg", 40.0, 0.0, 20.0, 0.0},
                        Case{"friction from 35 to 25 deg", 35.0, 0.0, 25.0, 0.0},
                        Case{"cohesion from 30 to 2 kPa", 0.0, 3e4, 0.0, 2e3},
                        Case{"from cohesion of 30 kPa to friction of 20 deg", 0.0, 3e4, 20.0, 0.0}})
    for (const bool mirrored : {false, true}) {
      const double from = c.cohesion * 2.0 + normal * tangent(c.friction),
                   to = c.to_cohesion * 2.0 + normal * tangent(c.to_friction);
      const Ran r = ran(
          on_plane(law("fresh", c.friction, c.cohesion) + law("worn", c.to_friction, c.to_cohesion),
                   ramped_change, mirrored));
      expect_between(r, {101, c.which + std::string(mirrored ? ", mirrored" : ""), "part", ""},
                     (from - along) / (from - to), 0.02);
    }
}

std::string decaying(double friction, double residual, const std::string& time) {
  return law(
      "fresh", friction, 0.0,
      fmt::format("residual = {{ friction_angle = {} }}\ndecay_time = '{}'\n", residual, time));
}

/// t = T ln((tan phi - tan phi_r)/(tan i - tan phi_r))
TEST(LawProgress, AJointFailsWhenItsStrengthHasDecayed) {
  for (const auto& [friction, residual] : {std::pair{40.0, 20.0}, {35.0, 28.0}})
    for (const bool mirrored : {false, true}) {
      const double exact =
          30.0 * day *
          std::log((tangent(friction) - tangent(residual)) / (tangent(slope) - tangent(residual)));
      const Ran r =
          ran(on_plane(decaying(friction, residual, "30 d"),
                       "[[stage]]\nuntil = 'collapse'\nramp = { time = ['0 d', '100 d'], steps = "
                       "50 }\n",
                       mirrored));
      expect_between(
          r,
          {102,
           fmt::format("from {} to {} deg{}", friction, residual, mirrored ? ", mirrored" : ""),
           "time", "s"},
          exact, 2.0 * day);
      EXPECT_NE(r.outcome.message.find(" s and fails at time = "), std::string::npos)
          << r.outcome.message;
    }
}

/// In a stage with a duration it begins to slide then, with the residual friction of a broken
/// joint.
TEST(LawProgress, StrengthDecaysInTheTimeOfAStage) {
  const double duration = 1.0, decay = 0.8, a = radians(slope);
  const Ran r = ran(on_plane(decaying(40.0, 20.0, "0.8 s"),
                             "[[stage]]\nreset_displacements = true\nduration = 1.0\n"));
  const double begins =
      decay * std::log((tangent(40.0) - tangent(20.0)) / (tangent(slope) - tangent(20.0)));
  const Simulation& sim = r.ready.sim;
  const Vec2 u = centroid(sim.motion.state.position, 1) - centroid(sim.motion.state.reference, 1);
  const double exact = 0.5 * g * (std::sin(a) - tangent(20.0) * std::cos(a)) * (duration - begins) *
                       (duration - begins);
  expect_relative({102, "in time, 0.8 s", "distance slid", "m"}, norm(u), exact, 1e-2);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
}

/// Friction that falls evenly: the acceleration grows with the time since tan phi was tan i.
TEST(LawProgress, AChangeOverATime) {
  const double a = radians(slope), over = 1.0, rate = (tangent(40.0) - tangent(20.0)) / over;
  const Ran r =
      ran(on_plane(law("fresh", 40, 0) + law("worn", 20, 0),
                   "[[stage]]\nreset_displacements = true\nduration = 1.0\nchange = [{ joints = "
                   "'fresh', to = 'worn', over = '1 s' }]\n"));
  const double slides = over - (tangent(40.0) - tangent(slope)) / rate;
  const Simulation& sim = r.ready.sim;
  const Vec2 u = centroid(sim.motion.state.position, 1) - centroid(sim.motion.state.reference, 1);
  const double exact = g * std::cos(a) * rate * slides * slides * slides / 6.0;
  expect_relative({101, "over a second", "distance slid", "m"}, norm(u), exact, 1e-2);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
}

/// A block that hangs from a fixed one, by tensile strength of 100 kPa that falls to a tenth of
/// what its weight needs; by a change and by decay. One that is grouted to it meanwhile carries it.
std::string hanging(const std::string& joints, const std::string& stages) {
  return "gravity = [0, -10]\n[materials.rock]\ndensity = 2000\nyoung = 1e10\npoisson = 0\n" +
         joints +
         "[contact]\njoint = 'fresh'\n[[block]]\nfixed = true\npolygon = [[-1, 1], [2, 1], [2, 2], "
         "[-1, 2]]\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n" +
         stages;
}

TEST(LawProgress, ABondInTensionFailsAtItsStrength) {
  const double needs = 2e4, whole = 1e5, left = 2e3;
  const std::string strong = law("fresh", 30, 1e6, "tensile_strength = 1e5\n"),
                    first = "[[stage]]\nuntil = 'equilibrium'\n";
  const Ran change = ran(
      hanging(strong + law("worn", 30, 1e6, "tensile_strength = 2e3\n"), first + ramped_change));
  expect_between(change, {101, "tensile strength from 100 to 2 kPa", "part", ""},
                 (whole - needs) / (whole - left), 0.02);
  const Ran decay = ran(hanging(
      law("fresh", 30, 1e6,
          "tensile_strength = 1e5\nresidual = { friction_angle = 30, tensile_strength = 2e3 }\n"
          "decay_time = '10 d'\n"),
      first + "[[stage]]\nuntil = 'collapse'\nramp = { time = ['0 d', '40 d'], steps = 80 }\n"));
  expect_between(decay, {102, "tensile strength from 100 to 2 kPa", "time", "s"},
                 10.0 * day * std::log((whole - left) / (needs - left)), 0.5 * day);
}

/// Tensile strength that a joint gets gradually carries as much as it has by then.
TEST(LawProgress, GroutThatHardensCarries) {
  const std::string prop =
      "[[load]]\nname = 'prop'\npoint = [0.5, 0]\nforce = [0, 4e4]\n[[stage]]\nuntil = "
      "'equilibrium'\n[[stage]]\nchange = [{ joints = 'fresh', to = 'grouted' }]\n"
      "ramp = { change = [0, 1], steps = 4 }\n[[stage]]\nuntil = 'equilibrium'\n"
      "reset_displacements = true\notherwise = 'stop'\ndeactivate = ['prop']\n";
  for (const double strength : {1e4, 4e4}) {
    const Ran r =
        ran(hanging(law("fresh", 30, 0) +
                        law("grouted", 30, 1e6, fmt::format("tensile_strength = {}\n", strength)),
                    prop));
    EXPECT_EQ(r.outcome.status == Status::equilibrium, strength > 2e4) << r.outcome.message;
  }
}

/// Of two slabs on a gable whose joints have one law only that of the set that changes slides.
TEST(LawProgress, OnlyTheJointsOfASetChange) {
  const std::string gable =
      "gravity = [0, -9.8]\n[materials.rock]\ndensity = 2500\nyoung = 5e9\n"
      "poisson = 0.2\n" +
      law("fresh", 40, 0) + law("worn", 20, 0) + law("seam", 30, 0) + R"(
[domain]
outline = [[-6, 0], [6, 0], [6, 1], [0, 4.5], [-6, 1]]
joint = 'fresh'
[[joint_set]]
name = 'left'
angle = 30.2564
spacing = 50
origin = [0, 3.9]
region = [[-7, 0], [0, 0], [0, 5], [-7, 5]]
[[joint_set]]
name = 'right'
angle = -30.2564
spacing = 50
origin = [0, 3.9]
region = [[0, 0], [7, 0], [7, 5], [0, 5]]
[[trace]]
points = [[0, 3.9], [0, 4.5]]
joint = 'seam'
[[fixed]]
point = [0, 0.5]
[[stage]]
until = 'equilibrium'
[[stage]]
reset_displacements = true
)";
  for (const char* set : {"left", "right"}) {
    const Ran r = ran(gable + "duration = 0.3\nchange = [{ joints = 'fresh', to = 'worn', set = '" +
                      set + "' }]\n");
    const Simulation& sim = r.ready.sim;
    ASSERT_EQ(sim.scene->blocks.size(), 3u);
    for (std::size_t i = 1; i < 3; ++i) {
      const Vec2 u =
          centroid(sim.motion.state.position, i) - centroid(sim.motion.state.reference, i);
      const bool is_left = sim.scene->blocks.centroid_x[i] < sim.scene->blocks.centroid_x[3 - i];
      if (is_left == (std::string(set) == "left")) {
        EXPECT_GT(norm(u), 0.05) << set;
      } else {
        EXPECT_LT(norm(u), 1e-4) << set;
      }
    }
  }
}

/// Two blocks on a floor, pressed, whose joints become softer by and by.
std::string column(const std::string& stages) {
  return "gravity = [0, -10]\n[materials.rock]\ndensity = 2000\nyoung = 1e12\npoisson = 0\n" +
         law("fresh", 30, 0, "kn = 1e9\nks = 5e8\n") + law("worn", 30, 0, "kn = 1e8\nks = 5e7\n") +
         R"([contact]
joint = 'fresh'
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[load]]
name = 'more'
point = [0.5, 1.9]
force = [1e3, -5e4]
[[stage]]
until = 'equilibrium'
ratio = 1e-9
[[stage]]
ratio = 1e-9
reset_displacements = true
)" + stages +
         "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-9\nactivate = ['more']\n";
}

/// Nothing moves by it; what comes after it meets the stiffness that it has reached.
TEST(LawProgress, AStiffnessThatChangesMovesNothing) {
  const std::string change = "change = [{ joints = 'fresh', to = 'worn'";
  for (const auto& [stages, part] :
       {std::pair<std::string, double>{change + " }]\nramp = { change = [0, 1], steps = 5 }\n",
                                       1.0},
        {change + " }]\nramp = { change = [0, 0.5], steps = 5 }\n", 0.5},
        {change + ", over = 0.05 }]\nduration = 0.06\n", 1.0}}) {
    PreparedRun ready = prepared(column(stages));
    double moved = 0.0;
    const Simulation& sim = ready.sim;
    RunOptions options;
    options.after_step = [&] {
      if (sim.attached.loads.intervals.loads[0].acts() || sim.motion.law_course.stage != 1)
        return false;
      for (std::size_t i = 1; i < 3; ++i)
        moved = std::max(moved, norm(centroid(sim.motion.state.position, i) -
                                     centroid(sim.motion.state.reference, i)));
      return false;
    };
    const Result<Outcome> outcome = run_model(ready, options);
    ASSERT_TRUE(outcome.ok());
    EXPECT_EQ(outcome.value().status, Status::equilibrium) << outcome.value().message;
    EXPECT_LT(outcome.value().largest_energy_error, 1e-6);
    EXPECT_LT(moved, 1e-7) << stages;
    const Vec2 u = centroid(sim.motion.state.position, 2) - centroid(sim.motion.state.reference, 2);
    expect_relative(
        {101, fmt::format("{} of kn from 1 to 0.1 GPa/m", part), "settlement after it", "m"}, -u.y,
        2.0 * 5e4 / (1e9 - part * 9e8), 1e-3);
  }
}

/// The strength after a time is that of the law at this time, however many increments lead to it,
/// and the factor of safety counts it.
TEST(LawProgress, StrengthFollowsFromTheTimeAlone) {
  const double exact = tangent(20.0) + (tangent(40.0) - tangent(20.0)) * std::exp(-15.0 / 30.0);
  const auto model = [](const std::string& ramps) {
    return on_plane(decaying(40.0, 20.0, "30 d"), ramps);
  };
  for (const char* ramps :
       {"[[stage]]\nramp = { time = ['0 d', '15 d'], steps = 1 }\n",
        "[[stage]]\nramp = { time = ['0 d', '15 d'], steps = 7 }\n",
        "[[stage]]\nramp = { time = ['0 d', '5 d'], steps = 2 }\n[[stage]]\nuntil = "
        "'equilibrium'\n[[stage]]\nramp = { time = ['5 d', '15 d'], steps = 3 }\n"}) {
    const Ran r = ran(model(ramps));
    EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
    EXPECT_NEAR(r.ready.sim.motion.laws.rows[0].peak_friction / exact, 1.0, 1e-12);
  }
  const FosResult found = find_factor_of(
      model("[[stage]]\nramp = { time = ['0 d', '15 d'], steps = 3 }\n"), "tolerance = 0.005\n");
  ASSERT_TRUE(found.factor.has_value()) << found.message;
  EXPECT_NEAR(*found.factor / (exact / tangent(slope)), 1.0, 0.005);
}

/// Joints that change to a law that decays have its strength whole then.
TEST(LawProgress, DecayBeginsWithTheChange) {
  const double exact = tangent(20.0) + (tangent(40.0) - tangent(20.0)) * std::exp(-10.0 / 30.0);
  const std::string worn = law("worn", 40, 0,
                               "residual = { friction_angle = 20 }\ndecay_time = '30 d'\n"),
                    ten = "ramp = { time = ['0 d', '10 d'], steps = 2 }\n",
                    ten_more = "ramp = { time = ['10 d', '20 d'], steps = 2 }\n";
  const Ran r =
      ran(on_plane(law("fresh", 45, 0) + worn,
                   "[[stage]]\n" + ten +
                       "[[stage]]\nchange = [{ joints = 'fresh', to = 'worn' }]\n" + ten_more));
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& sim = r.ready.sim;
  ASSERT_GT(sim.motion.contacts.size(), 0u);
  const Law& in_force = sim.motion.laws.rows[sim.motion.contacts.law[0]];
  EXPECT_NEAR(in_force.peak_friction / exact, 1.0, 1e-12);
}

/// Changes there and back count on from what has been reached.
TEST(LawProgress, ChangesFollowEachOther) {
  const std::string
      half = "ramp = { change = [0, 0.5], steps = 2 }\n",
      there = "[[stage]]\nuntil = 'equilibrium'\nchange = [{ joints = 'fresh', to = 'worn' }]\n",
      back = "[[stage]]\nuntil = 'equilibrium'\nchange = [{ joints = 'worn', to = 'fresh' }]\n";
  const std::string laws = law("fresh", 40, 0) + law("worn", 31, 0);
  const double a = tangent(40.0), b = tangent(31.0), m = 0.5 * (a + b);
  for (const auto& [stages, exact] : {std::pair<std::string, double>{there + half, m},
                                      {there + half + back + half, 0.5 * (m + a)},
                                      {there + half + back, a},
                                      {there + half + back + there, b}}) {
    const Ran r = ran(on_plane(laws, stages));
    EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
    const Simulation& sim = r.ready.sim;
    EXPECT_NEAR(sim.motion.laws.rows[sim.motion.contacts.law[0]].peak_friction / exact, 1.0, 1e-12)
        << stages;
  }
}

}  // namespace
}  // namespace edda::law_progress_test
