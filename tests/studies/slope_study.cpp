// Rock slopes as joint statistics cut them, against their geometry: slope_study [N [FIRST
// [STEPS]]]. One line per slope: as cut, how deep blocks lie in each other, how much deeper
// contacts that press take them to lie, what they push at most (weights of the block) and store
// (J); after some steps, the same depths, and how many neighbours overlap without pressing. Exit 1
// if one fails or is not sound.
#include <cstdio>
#include <cstdlib>

#include "verification/cut_slope.hpp"

int main(int argc, char** argv) {
  using namespace edda;
  const auto argument = [&](int i, unsigned otherwise) {
    return argc > i ? static_cast<unsigned>(std::atoi(argv[i])) : otherwise;
  };
  const unsigned n = argument(1, 200), first = argument(2, 0), steps = argument(3, 400);
  unsigned bad = 0;
  std::printf("%-5s %-12s %5s %8s %6s %6s | %8s %8s %8s %8s | %5s %8s %8s %6s %8s\n", "seed",
              "distribution", "angle", "cohesion", "blocks", "pairs", "overlap", "false", "push",
              "energy", "steps", "overlap", "false", "unfelt", "drift");
  for (unsigned k = first; k < first + n; ++k) {
    const CutSlope s = cut_slope(k);
    const SlopeLook l = look_at_slope(s, steps);
    bad += l.good() ? 0 : 1;
    std::printf(
        "%-5u %-12s %5g %8g %6zu %6zu | %8.1e %8.1e %8.1e %8.1e | %5llu %8.1e %8.1e %6zu %8.1e "
        "%s%s\n",
        s.seed, s.distribution.c_str(), s.angle, s.cohesion, l.blocks, l.pairs, l.drawn_overlap,
        l.drawn_false_depth, l.drawn_push, l.drawn_energy, static_cast<unsigned long long>(l.steps),
        l.overlap, l.false_depth, l.unfelt, l.drift, l.good() ? "" : "BAD ", l.failure.c_str());
    std::fflush(stdout);
  }
  std::printf("%u of %u slopes bad\n", bad, n);
  return bad > 0 ? 1 : 0;
}
