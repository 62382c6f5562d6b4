// Contacts in motion: validation.md rows 16, 19 and 21.
#include <algorithm>
#include <random>

#include "step/contact_resultant.hpp"
#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::contact_test {
namespace {

constexpr const char* materials = R"(
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
)";

std::string polygon_text(const Ring& ring) {
  std::string text = "[[block]]\npolygon = [";
  for (Vec2 p : ring) text += "[" + number(p.x) + "," + number(p.y) + "],";
  return text + "]\n";
}

struct CornerDrop {
  std::vector<Vec2> path;   ///< of the centroid, m
  double worst_jump = 0.0;  ///< change of contact force per step over p v h
};

/// Row 16: a square dropped corner on corner.
CornerDrop drop_on_corner(double offset) {
  const double d = std::sqrt(0.5), p = 2e10, height = 0.02;
  Simulation sim = scene(std::string(materials) + R"(
[joints.j]
friction_angle = 20.0
[contact]
normal_stiffness = 2e10
[solver]
duration = 0.25
time_step = 2e-5
[output]
history_every = 0.001
)" + "[[block]]\nfixed = true\npolygon = [[0," +
                         number(-2 * d) + "],[" + number(d) + "," + number(-d) + "],[0,0],[" +
                         number(-d) + "," + number(-d) + "]]\n" +
                         polygon_text({{offset, height},
                                       {offset + d, height + d},
                                       {offset, height + 2 * d},
                                       {offset - d, height + d}}));
  CornerDrop result;
  const std::string side = offset > 0.0 ? "right" : "left";
  Series path(16, "path, " + side, {"time", "x", "y"});
  Series jumps(16, "change of force, " + side, {"time", "computed"});
  Vec2 force{0.0, 0.0};
  run(
      sim,
      [&](Simulation& s) {
        result.path.push_back(displacement(s, 1));
        path.add({s.motion.state.time, result.path.back().x, result.path.back().y});
      },
      [&](Simulation& s) {
        const Vec2 now = contact_resultant(s, 1);
        double speed = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          speed = std::max(
              speed, norm(Vec2{s.motion.state.velocity.x[k][1], s.motion.state.velocity.y[k][1]}));
        }
        const double jump = norm(now - force) / (p * speed * s.motion.state.step);
        result.worst_jump = std::max(result.worst_jump, jump);
        if (jump > 0.0) jumps.add({s.motion.state.time, jump});
        force = now;
      });
  record_model(16, side, sim);
  return result;
}

TEST(CornerOnCorner, MirrorAndNoJump) {
  const CornerDrop right = drop_on_corner(1e-9), left = drop_on_corner(-1e-9);
  ASSERT_EQ(right.path.size(), left.path.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < right.path.size(); ++i) {
    worst = std::max({worst, std::abs(right.path[i].x + left.path[i].x),
                      std::abs(right.path[i].y - left.path[i].y)});
  }
  expect_at_most({16, "", "largest distance of one path from the other's mirror image", "m"}, worst,
                 1e-6);
  expect_at_most({16, "", "largest change of force per step over p v h", ""},
                 std::max(right.worst_jump, left.worst_jump), 1.5);
}

/// Twenty tumbling polygons without gravity, thrown at each other.
struct Heap {
  std::vector<Ring> rings;
  std::vector<Vec2> velocity;
  std::vector<double> spin;
};

Heap random_heap(unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Heap heap;
  for (int i = 0; i < 20; ++i) {
    const Vec2 c{1.6 * (i % 5) + 0.2 * u(rng), 1.6 * (i / 5) + 0.2 * u(rng)};
    const int n = 3 + static_cast<int>(4.0 * u(rng));
    Ring ring;
    const double turn = 6.0 * u(rng);
    for (int k = 0; k < n; ++k) {
      const double a = turn + 2.0 * std::numbers::pi * (k + 0.3 * u(rng)) / n;
      ring.push_back(c + (0.45 + 0.2 * u(rng)) * Vec2{std::cos(a), std::sin(a)});
    }
    heap.rings.push_back(ring);
    heap.velocity.push_back(1.5 * (Vec2{3.2, 2.4} - c) + Vec2{u(rng), u(rng)});
    heap.spin.push_back(6.0 * u(rng) - 3.0);
  }
  return heap;
}

Simulation heap_scene(const Heap& heap, const std::string& solver, double friction) {
  std::string toml = "gravity = [0.0, 0.0]\n" + std::string(materials) +
                     "[joints.j]\nfriction_angle = " + number(friction) + "\n" + solver;
  for (std::size_t i = 0; i < heap.rings.size(); ++i) {
    toml += polygon_text(heap.rings[i]) + "velocity = [" + number(heap.velocity[i].x) + "," +
            number(heap.velocity[i].y) + "]\nangular_velocity = " + number(heap.spin[i]) + "\n";
  }
  return scene(toml);
}

struct Momentum {
  Vec2 linear;
  double angular = 0.0;
  double scale = 0.0, angular_scale = 0.0;
};

/// In the leapfrog's terms: v at n - 1/2, x halfway between n - 1 and n.
Momentum momentum(const Simulation& s) {
  Momentum m;
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    if (s.scene->blocks.fixed[i]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 v{s.motion.state.velocity.x[k][i], s.motion.state.velocity.y[k][i]};
      const Vec2 x = Vec2{s.motion.state.position.x[k][i], s.motion.state.position.y[k][i]} -
                     0.5 * s.motion.state.step * v;
      const double mass = s.motion.masses.node[k][i];
      m.linear += mass * v;
      m.angular += mass * cross(x, v);
      m.scale += mass * norm(v);
      m.angular_scale += mass * norm(x) * norm(v);
    }
    const BlockModes modes = s.scene->blocks.modes(i);
    for (std::size_t a = 0; a < modes.count; ++a) {
      const Vec2 v = s.motion.state.velocity.modes[modes[a]];
      const Vec2 q = s.motion.state.position.modes[modes[a]] - 0.5 * s.motion.state.step * v;
      m.angular += cross(q, v) / s.motion.masses.mode_inverse[i];
    }
  }
  return m;
}

/// Row 19: frictional collisions keep linear and angular momentum.
TEST(Heap, MomentumInCollisions) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Simulation sim = heap_scene(random_heap(seed),
                                "[solver]\nduration = 0.5\n[output]\nhistory_every = 0.01\n", 30.0);
    const std::string label = "heap " + std::to_string(seed);
    Series changes(19, label, {"time", "linear", "angular"});
    Momentum first;
    bool started = false;
    double linear = 0.0, angular = 0.0;
    run(sim, [&](Simulation& s) {
      const Momentum m = momentum(s);
      if (!started) first = m;
      started = true;
      const double pushed = norm(m.linear - first.linear) / first.scale;
      const double turned = std::abs(m.angular - first.angular) / first.angular_scale;
      changes.add({s.motion.state.time, pushed, turned});
      linear = std::max(linear, pushed);
      angular = std::max(angular, turned);
    });
    expect_at_most({19, label, "largest change of momentum over the sum of m v", ""}, linear, 1e-9);
    expect_at_most({19, label, "largest change of angular momentum over the sum of m r v", ""},
                   angular, 1e-9);
    EXPECT_GT(sim.accounts.open_close.switched, 20u);
  }
}

std::vector<Vec2> positions(const Simulation& s) {
  std::vector<Vec2> p;
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
    p.push_back(centroid(s.motion.state.position, i) + s.scene->blocks.origin);
  }
  return p;
}

constexpr const char* two_impacts =
    "[solver]\nduration = 0.26\ntime_step = 1e-5\n[output]\nhistory_every = 0.01\n";

double farthest(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, norm(a[i] - b[i]));
  return worst;
}

/// Where the blocks are at every row.
std::vector<std::vector<Vec2>> paths(Simulation& sim) {
  std::vector<std::vector<Vec2>> rows;
  run(sim, [&](Simulation& s) { rows.push_back(positions(s)); });
  return rows;
}

/// Row 19: a model rotated, mirrored or renumbered gives the same motion. `back` undoes the change
/// in the positions of one row.
void expect_same_motion(const Heap& heap, const std::vector<std::vector<Vec2>>& expected,
                        const std::string& label,
                        const std::function<void(std::vector<Vec2>&)>& back) {
  Simulation sim = heap_scene(heap, two_impacts, 25.0);
  std::vector<std::vector<Vec2>> rows = paths(sim);
  ASSERT_EQ(rows.size(), expected.size());
  Series apart(19, label, {"time", "computed"});
  double worst = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    back(rows[n]);
    const double now = farthest(rows[n], expected[n]);
    worst = std::max(worst, now);
    apart.add({0.01 * static_cast<double>(n), now});
  }
  expect_at_most({19, label, "largest distance apart of a block", "m"}, worst, 1e-9);
}

TEST(Heap, IndifferentToTurnMirrorAndNumbering) {
  const Heap heap = random_heap(4);
  Simulation reference = heap_scene(heap, two_impacts, 25.0);
  const std::vector<std::vector<Vec2>> expected = paths(reference);
  ASSERT_GT(reference.accounts.open_close.switched, 4u);
  record_model(19, "", reference);

  const double angle = 0.7;
  Heap turned = heap;
  for (Ring& r : turned.rings) {
    for (Vec2& p : r) p = rotated(p, angle);
  }
  for (Vec2& v : turned.velocity) v = rotated(v, angle);
  expect_same_motion(turned, expected, "turned", [&](std::vector<Vec2>& row) {
    for (Vec2& p : row) p = rotated(p, -angle);
  });

  Heap mirrored = heap;
  for (Ring& r : mirrored.rings) {
    for (Vec2& p : r) p.x = -p.x;
  }
  for (Vec2& v : mirrored.velocity) v.x = -v.x;
  for (double& w : mirrored.spin) w = -w;
  expect_same_motion(mirrored, expected, "mirrored", [](std::vector<Vec2>& row) {
    for (Vec2& p : row) p.x = -p.x;
  });

  Heap renumbered;
  const auto place = [&](std::size_t i) { return (7 * i + 3) % heap.rings.size(); };
  for (std::size_t i = 0; i < heap.rings.size(); ++i) {
    renumbered.rings.push_back(heap.rings[place(i)]);
    renumbered.velocity.push_back(heap.velocity[place(i)]);
    renumbered.spin.push_back(heap.spin[place(i)]);
  }
  expect_same_motion(renumbered, expected, "renumbered", [&](std::vector<Vec2>& row) {
    const std::vector<Vec2> shuffled = row;
    for (std::size_t i = 0; i < row.size(); ++i) row[place(i)] = shuffled[i];
  });
}

/// `consistent` is `matched` in another basis.
TEST(Heap, ConsistentAndMatchedMassesAgree) {
  const Heap heap = random_heap(5);
  std::vector<std::vector<Vec2>> ends;
  for (const char* mass : {"matched", "consistent"}) {
    Simulation sim = heap_scene(heap,
                                std::string("[solver]\nduration = 0.3\ntime_step = 3e-4\n"
                                            "allow_unstable = true\nmass = '") +
                                    mass +
                                    "'\n[output]\nhistory_every = 0.03\n[contact]\n"
                                    "normal_stiffness = 1e8\n",
                                30.0);
    sim.scene.edit().blocks.lame_lambda.assign(sim.scene->blocks.size(), 1e8);
    sim.scene.edit().blocks.lame_mu.assign(sim.scene->blocks.size(), 1e8);
    run(sim, [](Simulation&) {});
    EXPECT_EQ(sim.motion.state.steps, 1000u);
    EXPECT_GT(sim.accounts.open_close.switched, 4u);
    ends.push_back(positions(sim));
  }
  EXPECT_LT(farthest(ends[0], ends[1]), 1e-8 * 8.0);
}

/// Row 21: energy dissipated by friction and damping never returns.
TEST(Dissipation, NeverFalls) {
  for (const auto& [label, damping_table] :
       {std::pair{"friction alone", ""},
        std::pair{"with mass damping", "damping = { mass = 2.0 }\n"},
        std::pair{"with local damping", "damping = { local = 0.3 }\n"},
        std::pair{"with contact damping", "damping = { contact = 0.2 }\n"}}) {
    std::string toml = std::string(materials) +
                       "[joints.j]\nfriction_angle = 30\n[solver]\nduration = 1.0\n" +
                       damping_table +
                       "[output]\nhistory_every = 0.01\n[[block]]\nfixed = true\npolygon = "
                       "[[-6,-1],[8,-1],[8,0],[-6,0]]\n";
    for (int i = 0; i < 6; ++i) {
      Ring ring;
      for (Vec2 q : {Vec2{-.5, -.5}, Vec2{.5, -.5}, Vec2{.5, .5}, Vec2{-.5, .5}}) {
        ring.push_back(rotated(q, 0.13 * i) + Vec2{0.1 * i, 0.8 + 1.45 * i});
      }
      toml += polygon_text(ring);
    }
    Simulation sim = scene(toml);
    Series taken(21, label, {"time", "friction", "damping"});
    double error = 0.0, friction = 0.0, damping = 0.0, worst_fall = 0.0;
    run(sim, [&](Simulation& s) {
      const EnergyBalance l = account_energy(s);
      keep_largest(error, l.error);
      worst_fall = std::max({worst_fall, friction - l.friction, damping - l.damping});
      friction = l.friction;
      damping = l.damping;
      taken.add({s.motion.state.time, friction, damping});
    });
    expect_at_most({21, label, "largest decrease of a term over the largest energy", ""},
                   worst_fall / sim.accounts.largest_energy, 1e-6);
    expect_at_most({21, label, "largest energy balance error", ""}, error, 1e-5);
    record_model(21, label, sim);
    EXPECT_GT(friction + damping, 0.0);
  }
}

}  // namespace
}  // namespace edda::contact_test
