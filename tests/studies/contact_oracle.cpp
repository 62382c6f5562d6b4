// Random heaps against brute force: contact_oracle [N [FIRST]].
// N heaps that drift under their list of faces, and N/20 that are thrown at each other and run.
// Which faces act: N heaps of odd shapes that drift, N/50 that run, and N/50 slopes cut by joint
// sets. Exit 1 if a face was missed, listed twice or jumped in force, or acts other than its
// definition says.
#include <cstdio>
#include <cstdlib>

#include "contacts/drifting_heap.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/acting_watch.hpp"
#include "verification/cut_slope.hpp"
#include "verification/heap_watch.hpp"
#include "verification/random_heap.hpp"

namespace {

using namespace edda;

/// A pair's force may change by p u, half as much again where corners pass (row 16), up to
/// sqrt(1 + 4 tan^2 phi) where shear turns round and slides in one step, and more where a corner is
/// passed with a penetration over the 2 r_v in which it lets go.
constexpr double largest_jump = 3.0;

struct Thrown {
  double jump = 0.0, error = 0.0;
  ListFaults list;
  std::uint64_t steps = 0, switched = 0;
  bool failed = false;
};

Thrown thrown(unsigned seed, std::uint64_t steps, bool verbose) {
  const double decades = 2.5 * (seed % 4) / 3.0;
  Simulation sim = scene(
      thrown_model(thrown_blocks(seed, 4, decades, 30.0), (7 * seed) % 41, "duration = 0.5\n"));
  HeapWatch watch(20);
  start(sim, 0.5);
  Thrown t;
  for (; t.steps < steps && sim.motion.state.time < 0.5; ++t.steps) {
    if (const auto failure = step(sim)) {
      std::printf("seed %u: %s at %g s\n", seed, failure->message.c_str(), failure->time);
      t.failed = true;
      break;
    }
    watch.look(sim);
    if (t.steps % 50 == 0) t.error = std::max(t.error, std::abs(account_energy(sim).error));
  }
  t.jump = watch.worst_jump;
  t.list = watch.list;
  t.switched = sim.accounts.open_close.switched;
  if (verbose || t.jump > largest_jump || t.list.missed + t.list.repeated > 0) {
    std::printf(
        "seed %u: jump %.3g at %.6g s (%u, %u), drift %.2g, %zu of %zu missed, switched %llu, "
        "redone %llu\n",
        seed, t.jump, watch.jump_at, watch.jump_of.first, watch.jump_of.second, t.error,
        t.list.missed, t.list.wanted, static_cast<unsigned long long>(t.switched),
        static_cast<unsigned long long>(sim.accounts.steps.redone));
  }
  return t;
}

/// Says what differs; whether anything does. Blocks that drift go through one another: what holds
/// for a third block, and from which side a face presses, is then not asked.
bool told(const char* what, unsigned count, const ActingFaults& f, bool drifting) {
  std::printf("%u %s: %zu faces closed, %zu of them idle, %zu not as defined", count, what,
              f.decided, f.inactive, f.apart);
  if (!drifting) {
    std::printf(
        "; %zu came to carry, %zu with a third block beside, %zu not as defined; %zu of %zu "
        "press from behind",
        f.leaning, f.crossed, f.askew, f.behind, f.pressing);
  }
  std::printf("\n");
  return f.apart > 0 || (!drifting && f.askew + f.behind > 0);
}

/// Whether a face acts otherwise than it should, or a run is lost.
bool acting_differs(unsigned n, unsigned first) {
  ActingFaults drifting, running, slopes;
  for (unsigned seed = first; seed < first + n; ++seed) drifting.add(acting_heap(seed, 30, 3, 4));
  bool differs = told("heaps of odd shapes adrift", n, drifting, true);
  const unsigned runs = (n + 49) / 50;
  const auto run_into = [&](ActingFaults& sum, Simulation sim, std::uint64_t steps,
                            unsigned number) {
    const Acting acting = acting_in(sim, steps);
    sum.add(acting.faults);
    if (acting.faults.apart + acting.faults.askew + acting.faults.behind > 0) {
      std::printf("number %u: %zu and %zu not as defined, %zu from behind\n", number,
                  acting.faults.apart, acting.faults.askew, acting.faults.behind);
    }
    if (acting.failure.empty()) return;
    std::printf("%u: %s\n", number, acting.failure.c_str());
    differs = true;
  };
  for (unsigned seed = first; seed < first + runs; ++seed)
    run_into(running, scene(odd_heap(seed, (7 * seed) % 41)), 20000, seed);
  differs = told("heaps of odd shapes run", runs, running, false) || differs;
  for (unsigned k = first; k < first + runs; ++k) {
    CutSlope slope = cut_slope(k, 15.0);
    if (k % 4 == 1) slope.more = "[quality]\naction = 'report'\n";
    run_into(slopes, scene(slope_model(slope)), 150, k);
  }
  return told("slopes", runs, slopes, false) || differs;
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned n = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 10000;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 0;
  ListFaults sum;
  unsigned bad = 0;
  for (unsigned seed = first; seed < first + n; ++seed) {
    const ListFaults f = drifting_heap(seed, 30, 2, 3);
    sum.wanted += f.wanted;
    bad += f.missed + f.repeated > 0 ? 1 : 0;
  }
  std::printf("%u heaps adrift, %zu pairs wanted: %u heaps with a difference\n", n, sum.wanted,
              bad);
  double jump = 0.0, error = 0.0;
  const unsigned runs = (n + 19) / 20;
  unsigned lost = 0;
  std::uint64_t steps = 0, switched = 0;
  for (unsigned seed = first; seed < first + runs; ++seed) {
    const Thrown t = thrown(seed, 15000, n <= 1000);
    jump = std::max(jump, t.jump);
    error = std::max(error, t.error);
    steps += t.steps;
    switched += t.switched;
    lost += t.failed ? 1 : 0;
    bad += t.list.missed + t.list.repeated > 0 || t.jump > largest_jump ? 1 : 0;
  }
  std::printf(
      "%u heaps run, %llu steps, %llu switchings: largest jump %.3g p u, drift %.2g, %u lost\n",
      runs, static_cast<unsigned long long>(steps), static_cast<unsigned long long>(switched), jump,
      error, lost);
  const bool differs = acting_differs(n, first);
  return bad + lost > 0 || differs ? 1 : 0;
}
