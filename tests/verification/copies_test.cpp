// Copies of a jointed model, mirrored, moved and far from the origin, reach the same equilibrium:
// only rounding differs between them, and no contact, spring or mass may depend on it.
#include <random>

#include "observe/observe.hpp"
#include "run/run_model.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::copies_test {
namespace {

struct Copy {
  std::string name;
  bool mirrored = false;
  Vec2 moved{};  ///< m
  Vec2 at(Vec2 p) const { return Vec2{mirrored ? -p.x : p.x, p.y} + moved; }
};

std::string points(const Copy& copy, const std::vector<Vec2>& list) {
  std::string text = "[";
  for (const Vec2 p : list) {
    const Vec2 q = copy.at(p);
    text += (text.size() > 1 ? ", [" : "[") + number(q.x) + ", " + number(q.y) + "]";
  }
  return text + "]";
}

/// Two joint sets with scatter of angle and spacing under weight and stress; the second stage
/// excavates a round opening.
std::string model(const Copy& copy, unsigned seed) {
  std::mt19937 random(seed);
  const auto scatter = [&](double most) {
    return most * (2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0);
  };
  const double half = 12.0, far = 60.0, spacing = 3.9;
  std::string toml =
      "[materials.rock]\ndensity = 2600.0\nyoung = 10e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 40.0\nkn = 20e9\nks = 8e9\n[contact]\njoint = 'j'\n[domain]\noutline = " +
      points(copy, {{-half, -half}, {half, -half}, {half, half}, {-half, half}}) + "\n";
  for (const double angle : {60.0, -25.0}) {
    const Vec2 across = rotated({0.0, 1.0}, radians(angle));
    for (double at = -2.0 * half + scatter(2.0); at < 2.0 * half;
         at += spacing + scatter(0.5 * spacing)) {
      const Vec2 along = rotated({far, 0.0}, radians(angle + scatter(6.0)));
      toml +=
          "[[trace]]\npoints = " + points(copy, {at * across - along, at * across + along}) + "\n";
    }
  }
  std::vector<Vec2> ring;
  for (int k = 0; k < 16; ++k) ring.push_back(rotated({3.0, 0.0}, std::numbers::pi * k / 8.0));
  return toml + "[[opening]]\nname = 'hole'\npolygon = " + points(copy, ring) +
         "\n[initial_stress]\nk0 = 0.7\nsurface_y = " + number(100.0 + copy.moved.y) +
         "\n[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n[[boundary]]\n"
         "sides = ['top']\ntype = 'stress'\n[quality]\nmin_area = 0.6\nmin_edge = 0.2\n"
         "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\nexcavate = ['hole']\n"
         "reset_displacements = true\n";
}

struct Moved {
  Vec2 from, by;  ///< centroid at the start and displacement, in the coordinates of the original, m
};

std::vector<Moved> displacements_of(const Copy& copy, unsigned seed) {
  std::vector<Moved> all;
  Result<Model> read = read_model_text(model(copy, seed), EDDA_SOURCE_DIR "/copies.toml", {});
  EXPECT_TRUE(read.ok());
  if (!read.ok()) return all;
  Result<PreparedRun> run = prepare_run(std::move(read.value()));
  EXPECT_TRUE(run.ok());
  if (!run.ok()) return all;
  const Result<Outcome> outcome = run_model(run.value(), {});
  EXPECT_TRUE(outcome.ok() && outcome.value().status == Status::equilibrium) << copy.name;
  const Simulation& sim = run.value().sim;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!sim.motion.state.alive[i]) continue;
    Vec2 from = Vec2{sim.scene->blocks.centroid_x[i], sim.scene->blocks.centroid_y[i]} +
                sim.scene->blocks.origin - copy.moved;
    Vec2 by = displacement_of(sim.motion.state, i, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
    if (copy.mirrored) {
      from.x = -from.x;
      by.x = -by.x;
    }
    all.push_back({from, by});
  }
  return all;
}

/// Differences of the blocks' displacements over the largest displacement: of nine in ten, and the
/// largest. Rounding decides which of two faces at a crossing touches first, and so affects small
/// blocks at the wall of the opening.
struct Apart {
  double of_nine_in_ten, largest;
};
Apart apart(const std::vector<Moved>& a, const std::vector<Moved>& b) {
  double most = 0.0;
  std::vector<double> differences;
  for (const Moved& block : a) {
    keep_largest(most, norm(block.by));
    const auto same = std::min_element(b.begin(), b.end(), [&](const Moved& p, const Moved& q) {
      return norm(p.from - block.from) < norm(q.from - block.from);
    });
    differences.push_back(norm(same->by - block.by));
  }
  std::sort(differences.begin(), differences.end());
  return {differences[differences.size() * 9 / 10] / most, differences.back() / most};
}

TEST(Copies, ComeToTheSameRest) {
  const Copy copies[] = {{"mirrored", true, {}},
                         {"moved by 1000 m", false, {1000.0, 1000.0}},
                         {"moved a little", false, {0.1234567, -0.7654321}},
                         {"mirrored, far away", true, {-31415.926, 2718.28}}};
  std::size_t blocks = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const std::vector<Moved> first = displacements_of({"as drawn", false, {}}, seed);
    ASSERT_GT(first.size(), 20U);
    blocks = std::max(blocks, first.size());
    for (const Copy& copy : copies) {
      const std::vector<Moved> other = displacements_of(copy, seed);
      ASSERT_EQ(other.size(), first.size()) << copy.name;
      const Apart difference = apart(first, other);
      EXPECT_LT(difference.of_nine_in_ten, 3e-4) << copy.name << ", seed " << seed;
      EXPECT_LT(difference.largest, 1e-1) << copy.name << ", seed " << seed;
    }
  }
  EXPECT_GE(blocks, 60U);
}

}  // namespace
}  // namespace edda::copies_test
