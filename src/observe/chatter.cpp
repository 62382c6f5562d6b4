#include "observe/chatter.hpp"

#include <algorithm>
#include <utility>

#include "contacts/face_reading.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

constexpr std::uint64_t window = 64;  // samples
constexpr Id again = 16;              // opening and closing events
constexpr double above_mean = 2.0;    // of the energy at the mean force

/// Opening and closing events of face k since the list was made.
Id switches(const Simulation& sim, std::size_t k) {
  const OpenCloseCounts& counts = sim.accounts.open_close;
  const bool known = counts.of_list == sim.motion.contacts.rebuilds && k < counts.of_face.size();
  return known ? counts.of_face[k] : 0;
}

void begin_window(Chatter& w, const Simulation& sim) {
  const std::size_t n = sim.motion.contacts.size();
  w.sum.assign(n, 0.0);
  w.squares.assign(n, 0.0);
  w.samples.assign(n, 0);
  w.before.resize(n);
  for (std::size_t k = 0; k < n; ++k) w.before[k] = switches(sim, k);
  w.looks = 0;
  w.rebuilds = sim.motion.contacts.rebuilds;
}

void judge(Chatter& w, const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  const std::vector<std::uint64_t> before = std::exchange(w.last, {});
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id count = switches(sim, k) - w.before[k];
    if (count < again) continue;
    if (w.squares[k] * w.samples[k] < above_mean * w.sum[k] * w.sum[k]) continue;
    const auto [i, j] = blocks_of_face(sim.scene->blocks, c, k);
    const std::uint64_t pair = (std::uint64_t{i} << 32) | j;
    w.last.push_back(pair);
    if (!std::binary_search(before.begin(), before.end(), pair)) continue;
    w.count += count;
    if (count <= w.worst) continue;
    w.worst = count;
    w.block_i = block_of_facing(sim.scene->blocks, c, k);
    w.block_j = block_of_edge(sim.scene->blocks, c, k);
    w.time = sim.motion.state.time;
  }
  std::sort(w.last.begin(), w.last.end());
}

}  // namespace

void look_for_chatter(Chatter& w, const Simulation& sim) {
  if (!is_explicit(sim) || sim.relaxation.seeks_equilibrium) {
    w.looks = 0;
    w.last.clear();
    return;
  }
  const FaceSet& c = sim.motion.contacts;
  const bool fits = w.rebuilds == c.rebuilds && w.sum.size() == c.size() &&
                    w.squares.size() == c.size() && w.samples.size() == c.size() &&
                    w.before.size() == c.size();
  if (w.looks == 0 || !fits) begin_window(w, sim);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (switches(sim, k) == w.before[k]) continue;
    const double normal = normal_force_now(sim, k);
    ++w.samples[k];
    w.sum[k] += normal;
    w.squares[k] += normal * normal;
  }
  if (++w.looks < window) return;
  judge(w, sim);
  w.looks = 0;
}

}  // namespace edda
