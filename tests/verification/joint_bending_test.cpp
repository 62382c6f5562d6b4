// Joints of a given stiffness in bending: glued, dry, under a tilted column, between the blocks of
// a swaying one.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

#include "verification/record.hpp"
#include "verification/settled.hpp"

namespace edda::joint_bending_test {
namespace {

/// Rotation of the first edge of block i, rad.
double turned(const Simulation& sim, std::size_t i) {
  const Id v = sim.scene->blocks.vertex_begin[i], w = sim.scene->blocks.next[v];
  return std::atan2(sim.motion.pose.y[w] - sim.motion.pose.y[v],
                    sim.motion.pose.x[w] - sim.motion.pose.x[v]);
}

/// Rotation in equilibrium of a block on a joint of this law, loaded at `part` of its width off its
/// middle.
double turn_under_load(double part, double load, double kn, double width, const std::string& law) {
  const PreparedRun r = settled(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 2e10\npoisson = 0.2\n"
      "[joints.j]\nkn = " +
      number(kn) + "\nks = " + number(kn) + "\n" + law +
      "[[block]]\nfixed = true\npolygon = " + rectangle(-2.0 * width, -1, 2.0 * width, 0) +
      "\n[[block]]\npolygon = " + rectangle(-0.5 * width, 0, 0.5 * width, 0.5) +
      "\n[[load]]\npoint = [" + number(part * width) + ", 0.01]\nforce = [0, " + number(-load) +
      "]\n[[stage]]\nuntil = 'equilibrium'\nratio = 2e-8\n");
  return -turned(r.sim, 1);
}

/// M/(k L^3/12), with every joint stiffness and every eccentricity, beyond the middle third, too.
TEST(GluedJoint, TurnsByMomentOverItsBendingStiffness) {
  const double load = 1e3, width = 2.0;
  for (const double kn : {1e9, 1e11}) {
    for (const double part : {0.05, 0.3, 0.5}) {
      const double exact = load * part * width / (kn * std::pow(width, 3) / 12.0);
      expect_relative({58, "glued, e = " + brief(part) + " L, kn " + brief(kn), "rotation", ""},
                      turn_under_load(part, load, kn, width, "type = 'glued'\n"), exact, 1e-6);
    }
  }
}

/// Rotation of a joint without tension, of bending stiffness k L^3/12 as long as all of it is
/// closed, under a force N at e off its middle; beyond e = L/6 the closed length a = 3 (L/2 - e)
/// carries a triangle up to 2 N/a: 2 N/(k a^2).
double dry_turn(double normal, double e, double kn, double width) {
  const double part = e / width;
  if (part <= 1.0 / 6.0) return normal * e / (kn * std::pow(width, 3) / 12.0);
  const double closed = 3.0 * (0.5 * width - e);
  return 2.0 * normal / (kn * closed * closed);
}

TEST(DryJoint, TurnsAsItGapes) {
  const double load = 1e3, width = 2.0, kn = 1e9;
  for (const double part : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45}) {
    const double exact = dry_turn(load, part * width, kn, width);
    expect_relative({58, "dry, e = " + brief(part) + " L", "rotation", ""},
                    turn_under_load(part, load, kn, width, "friction_angle = 30\n"), exact, 1e-5);
  }
}

struct Column {
  int blocks;
  double width, height, kn;  ///< of one block, m; Pa/m
  static constexpr double density = 2600.0, g = 9.81;

  double weight() const { return density * g * width * height; }  // of one
  std::string toml(const std::string& law, const std::string& rest) const {
    // The formulas know the bending of joints, and not that of blocks.
    std::string text =
        "deformation = 'uniform'\n[materials.rock]\ndensity = " + number(density) +
        "\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n" + law + "kn = " + number(kn) +
        "\nks = " + number(kn) + "\n" + rest +
        "[[block]]\nfixed = true\npolygon = " + rectangle(-2.0 * width, -1, 2.0 * width, 0) + "\n";
    for (int i = 0; i < blocks; ++i) {
      text += "[[block]]\npolygon = " +
              rectangle(-0.5 * width, i * height, 0.5 * width, (i + 1) * height) + "\n";
    }
    return text;
  }
};

/// Tilt of the ground that belongs to a rotation psi of the top block: each joint, from the top
/// down, has N = W_above cos psi and e = M/N about its middle, and rotates by dry_turn(N, e); what
/// remains after the lowest is the tilt of the ground. None where a resultant would lie beyond the
/// edge of a joint.
std::optional<double> ground_tilt(const Column& c, double psi) {
  Vec2 centre{};  // of all blocks above, from the middle of the joint; its x down the slope
  double count = 0.0;
  for (int i = 0; i < c.blocks; ++i) {
    const Vec2 along{std::sin(psi), std::cos(psi)};
    centre = (count * (centre + c.height * along) + 0.5 * c.height * along) / (count + 1.0);
    count += 1.0;
    const double normal = count * c.weight() * std::cos(psi), e = centre.x / std::cos(psi);
    if (e >= 0.5 * c.width) return {};
    psi -= dry_turn(normal, e, c.kn, c.width);
  }
  return psi;
}

/// The steepest ground on which the column can stand: the largest tilt over all psi; of one block
/// max[atan(2 e/H) - 2 N/(9 k (B/2 - e)^2)], less than the rigid B/H.
struct Limit {
  double tilt, psi;
};
Limit overturning(const Column& c) {
  Limit limit{0.0, 0.0};
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    const double psi = i * (0.5 * std::numbers::pi / steps);
    const auto tilt = ground_tilt(c, psi);
    if (!tilt) break;
    if (*tilt > limit.tilt) limit = {*tilt, psi};
  }
  return limit;
}

/// Rotation of the top block at this tilt of the ground, below the limit.
double lean(const Column& c, double tilt) {
  double low = 0.0, high = overturning(c).psi;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (*ground_tilt(c, middle) < tilt ? low : high) = middle;
  }
  return low;
}

/// Rotation of the top block after the ground has been tilted slowly and the tilt has been kept.
double lean_on(const Column& c, double tilt, double time) {
  Simulation sim = scene(c.toml(
      "friction_angle = 70\n",
      "[solver]\nduration = " + number(2.0 * time) +
          "\ndamping = { mass = 1.0 }\n[output]\nhistory_every = " + number(0.1 * time) + "\n"));
  run(
      sim, [](Simulation&) {},
      [&](Simulation& s) {
        const double part = std::min(s.motion.state.time / time, 1.0);
        const double now = tilt * (1.0 - (1.0 - part) * (1.0 - part));
        s.scene.edit().model.gravity = {Column::g * std::sin(now), -Column::g * std::cos(now)};
      });
  return tilt - turned(sim, sim.scene->blocks.size() - 1);
}

std::string label_of(const Column& c) {
  return std::to_string(c.blocks) + " of " + brief(c.width) + " x " + brief(c.height) + ", kn " +
         brief(c.kn);
}

TEST(Column, OverturnsAsItsSoftJointsSay) {
  for (const Column& c :
       {Column{1, 1.0, 4.0, 1e8}, {1, 1.0, 4.0, 1e9}, {3, 1.0, 1.5, 1e8}, {3, 1.0, 1.5, 1e9}}) {
    const std::string label = label_of(c);
    const Limit limit = overturning(c);
    EXPECT_LT(limit.tilt, 0.9 * std::atan(c.width / (c.blocks * c.height))) << label;
    const double below = 0.9 * limit.tilt;
    expect_relative({59, label + ", 0.9 of the limit", "rotation against the ground", ""},
                    lean_on(c, below, 8.0) - below, lean(c, below) - below, 6e-3);
    expect_at_most({59, label + ", 0.99 of the limit", "lean over that at the limit", ""},
                   lean_on(c, 0.99 * limit.tilt, 8.0) / limit.psi, 1.0);
    expect_at_least({59, label + ", 1.01 of the limit", "lean over that at the limit", ""},
                    std::abs(lean_on(c, 1.01 * limit.tilt, 8.0)) / limit.psi, 3.0);
  }
}

/// Sway of n blocks on glued joints: of each the displacement u of its centre, the rotation phi of
/// its horizontal edges and omega of its vertical ones, which differ by its shear strain. With m
/// its mass,
///   2 T = m (u'^2 + H^2 omega'^2/12 + B^2 phi'^2/12),
///   2 U = G B H (phi - omega)^2 + ks B (jump of u at the joint)^2 + kn B^3/12 (jump of phi)^2.
struct Sway {
  double frequency;  ///< rad/s, the lowest
  Eigen::VectorXd mode;
};
Sway sway(const Column& c) {
  const double shear = 20e9 / 2.4, mass = c.density * c.width * c.height;
  const Eigen::Index n = 3 * c.blocks;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n), k = m;
  for (Eigen::Index i = 0; i < n; i += 3) {
    m.diagonal().segment(i, 3) << mass, mass * c.height * c.height / 12.0,
        mass * c.width * c.width / 12.0;
    const auto add = [&](double spring, const Eigen::VectorXd& jump) {
      k += spring * jump * jump.transpose();
    };
    // Zero for the fixed base below the lowest block.
    const auto unit_of = [&](Eigen::Index at) -> Eigen::VectorXd {
      if (at < 0) return Eigen::VectorXd::Zero(n);
      return Eigen::VectorXd::Unit(n, at);
    };
    add(shear * c.width * c.height, unit_of(i + 2) - unit_of(i + 1));
    add(c.kn * c.width, unit_of(i) + 0.5 * c.height * unit_of(i + 1) - unit_of(i - 3) +
                            0.5 * c.height * unit_of(i == 0 ? -1 : i - 2));
    add(c.kn * std::pow(c.width, 3) / 12.0, unit_of(i + 2) - unit_of(i - 1));
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, m);
  return {std::sqrt(solver.eigenvalues()[0]), solver.eigenvectors().col(0)};
}

TEST(Column, SwaysAsItsBondedJointsSay) {
  for (const Column& c : {Column{1, 1.0, 2.0, 1e8},
                          {1, 1.0, 2.0, 1e9},
                          {2, 1.0, 1.0, 1e9},
                          {4, 0.5, 1.0, 1e9},
                          {4, 1.0, 1.0, 1e10}}) {
    const Sway exact = sway(c);
    const double period = 2.0 * std::numbers::pi / exact.frequency;
    std::string text = c.toml("type = 'glued'\n",
                              "[solver]\nduration = " + number(5.3 * period) +
                                  "\n[output]\nhistory_every = " + number(5.3 * period) + "\n");
    text.insert(text.find("[joints.j]"), "damping = 0\n");
    Simulation sim = scene("gravity = [0, 0]\n" + text);
    const double scale = 1e-5 / std::abs(exact.mode[exact.mode.size() - 3]);
    for (std::size_t i = 1; i < sim.scene->blocks.size(); ++i) {
      const auto q = static_cast<Eigen::Index>(3 * (i - 1));
      for (std::size_t node = 0; node < 3; ++node) {
        const double x = sim.motion.state.position.x[node][i] - sim.scene->blocks.centroid_x[i];
        const double y = sim.motion.state.position.y[node][i] - sim.scene->blocks.centroid_y[i];
        sim.motion.state.velocity.x[node][i] = scale * (exact.mode[q] - exact.mode[q + 1] * y);
        sim.motion.state.velocity.y[node][i] = scale * exact.mode[q + 2] * x;
      }
    }
    double before = 0.0, first = 0.0, last = 0.0;
    int crossings = 0;
    const auto crossing = [&](Simulation& s) {
      const double u = displacement(s, s.scene->blocks.size() - 1).x;
      if (before * u < 0.0) {
        last = s.motion.state.time - s.motion.state.step * u / (u - before);
        if (++crossings == 1) first = last;
      }
      before = u;
    };
    run(
        sim, [](Simulation&) {}, crossing);
    ASSERT_EQ(crossings, 10);
    const double frequency = std::numbers::pi * (crossings - 1) / (last - first);
    expect_relative({59, label_of(c) + ", glued", "frequency of its sway", "1/s"}, frequency,
                    exact.frequency, 1e-5);
  }
}

}  // namespace
}  // namespace edda::joint_bending_test
