// A loose heap poured into a box: heap_study [BLOCKS [SEEDS [FIRST [STIFFNESS
// [DAMPING [SECONDS [ODD [THINNEST [YOUNG]]]]]]]]].
// One line per seed. Exit 1 if one does not come to rest, overlaps, gains energy or cuts its steps.
#include <cstdio>
#include <cstdlib>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/heap_watch.hpp"
#include "verification/overlap.hpp"
#include "verification/random_heap.hpp"

namespace {

using namespace edda;

struct Settings {
  int blocks = 2000;
  double young = 1e9;      ///< Pa
  double stiffness = 4.0;  ///< contact over Young's modulus
  double damping = 0.4;    ///< at contacts
  double seconds = 12.0;   ///< at the most: the last block may slide for ten
  double odd = 0.0;        ///< part of blocks that are stars, needles, slivers or Ls
  double thinnest = 0.2;   ///< of needles and slivers
};

/// Convex polygons of 0.5 to 1 m and some stars, needles and Ls, loosely stacked over a box.
std::string poured(unsigned seed, const Settings& s) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const int columns = static_cast<int>(std::ceil(std::sqrt(4.0 * s.blocks)));
  const double cell = 1.05, width = cell * columns, high = 60.0;
  std::string toml = "[materials.rock]\ndensity = 2600.0\nyoung = " + number(s.young) +
                     "\npoisson = 0.2\n[joints.j]\n"
                     "friction_angle = 30\n[contact]\nnormal_stiffness = " +
                     number(s.young * s.stiffness) + "\n[solver]\nduration = " + number(s.seconds) +
                     "\ndamping = { contact = " + number(s.damping) + " }\n";
  auto wall = [&](double x0, double y0, double x1, double y1) {
    toml += "[[block]]\nfixed = true\npolygon = " + rectangle(x0, y0, x1, y1) + "\n";
  };
  wall(-2, -2, width + 2, -0.5);
  wall(-2, -0.5, -0.5, high);
  wall(width - 0.5, -0.5, width + 2, high);
  for (int i = 0; i < s.blocks; ++i) {
    const Vec2 c{cell * (i % columns), 0.1 + cell * (i / columns)};
    const double size = 0.25 + 0.25 * u(rng);
    if (u(rng) < s.odd) {
      toml += block_text(random_shape(rng, c, size, s.thinnest));
      continue;
    }
    Ring ring;
    const int corners = 4 + static_cast<int>(5.0 * u(rng));
    const double turn = 6.3 * u(rng);
    for (int k = 0; k < corners; ++k) {
      const double a = turn + 2.0 * std::numbers::pi * (k + 0.6 * u(rng)) / corners;
      ring.push_back(c + size * Vec2{std::cos(a), std::sin(a)});
    }
    toml += block_text(ring);
  }
  return toml;
}

std::vector<Vec2> centroids(const Simulation& sim) {
  std::vector<Vec2> at;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    at.push_back(centroid(sim.motion.state.position, i));
  }
  return at;
}

/// Root of the smallest area of a block, m.
double smallest_block(const Simulation& sim) {
  double smallest = 1e9;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i)
    smallest = std::min(smallest, std::sqrt(sim.scene->blocks.area[i]));
  return smallest;
}

/// Largest displacement of a centroid, over the root of its block's area.
double largest_displacement(const Simulation& sim, const std::vector<Vec2>& from,
                            const std::vector<Vec2>& to) {
  double moved = 0.0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    moved = std::max(moved, norm(to[i] - from[i]) / std::sqrt(sim.scene->blocks.area[i]));
  }
  return moved;
}

/// Largest velocity of a centroid, m/s.
double fastest_block(const Simulation& sim) {
  double fastest = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    fastest = std::max(fastest, norm(centroid(sim.motion.state.velocity, i)));
  }
  return fastest;
}

bool pour(unsigned seed, const Settings& s) {
  Simulation sim = scene(poured(seed, s));
  const double smallest = smallest_block(sim);
  const double every = 0.05;
  start(sim, every);
  double overlap = 0.0, overlap_at = 0.0, gained = 0.0, energy = 0.0, error = 0.0;
  std::string failure;
  std::vector<Vec2> second_ago = centroids(sim);
  double kinetic = 0.0, moved = 1.0;
  constexpr int second = 20;  // rows
  bool rests = false;
  for (int row = 1; row * every <= s.seconds * (1 + 1e-9) && failure.empty() && !rests; ++row) {
    fit_step_to(sim, row * every);
    while (sim.motion.state.time < row * every) {
      if (const auto f = step(sim)) {
        failure = f->message;
        break;
      }
    }
    const EnergyBalance l = account_energy(sim);
    const double now = l.kinetic + l.strain + l.contact + l.gravity;
    if (row > 1) gained = std::max(gained, (now - energy) / sim.accounts.largest_energy);
    energy = now;
    kinetic = l.kinetic / sim.accounts.largest_energy;
    if (row % second == 0) {
      const std::vector<Vec2> now_at = centroids(sim);
      moved = largest_displacement(sim, second_ago, now_at);
      second_ago = now_at;
      rests = moved < 0.01 && kinetic < 1e-6;
    }
    error = std::max(error, std::abs(l.error));
    const Overlap o = deepest_overlap(sim.scene->blocks, sim.motion.pose);
    if (o.depth > overlap) {
      overlap = o.depth;
      overlap_at = sim.motion.state.time;
    }
  }
  const double cut =
      static_cast<double>(sim.accounts.steps.redone) / static_cast<double>(sim.motion.state.steps);
  const bool good =
      failure.empty() && overlap < 0.01 * smallest && gained <= 1e-6 && cut < 0.01 && rests;
  std::printf(
      "seed %u: %s after %.0f s; overlap %.2e of the smallest block at %.2f s, gained %.1e, drift "
      "%.1e, cut "
      "%.1e of %llu steps; in the last second no block moves by more than %.1e of its size, "
      "kinetic "
      "energy %.1e of the largest, fastest %.1e m/s, unsettled %.1e %s\n",
      seed, good ? "good" : "BAD", sim.motion.state.time, overlap / smallest, overlap_at, gained,
      error, cut, static_cast<unsigned long long>(sim.motion.state.steps), moved, kinetic,
      fastest_block(sim),
      static_cast<double>(sim.accounts.open_close.not_converged) /
          static_cast<double>(sim.motion.state.steps),
      failure.c_str());
  std::fflush(stdout);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  auto argument = [&](int i, double otherwise) {
    return argc > i ? std::atof(argv[i]) : otherwise;
  };
  Settings s;
  s.blocks = static_cast<int>(argument(1, 2000));
  const unsigned seeds = static_cast<unsigned>(argument(2, 20));
  const unsigned first = static_cast<unsigned>(argument(3, 1));
  s.stiffness = argument(4, s.stiffness);
  s.damping = argument(5, s.damping);
  s.seconds = argument(6, s.seconds);
  s.odd = argument(7, s.odd);
  s.thinnest = argument(8, s.thinnest);
  s.young = argument(9, s.young);
  unsigned bad = 0;
  for (unsigned seed = first; seed < first + seeds; ++seed) bad += pour(seed, s) ? 0 : 1;
  std::printf("%u of %u seeds bad\n", bad, seeds);
  return bad > 0 ? 1 : 0;
}
