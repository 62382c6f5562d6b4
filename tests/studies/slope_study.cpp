// Rock slopes as joint statistics cut them, against their geometry: slope_study [N [FIRST
// [STEPS]]]. One line per slope: as cut, how deep blocks lie in each other, how much deeper
// contacts that press take them to lie, what they push at most (weights of the block) and store
// (J); after some steps, the same depths, and how many neighbours overlap without pressing. At the
// end a table by the deviation of angles. Exit 1 if one fails or is not sound.
#include <cstdio>
#include <cstdlib>
#include <map>

#include "verification/cut_slope.hpp"

namespace edda {
namespace {

/// Slopes of one deviation of angles, the largest of their figures.
struct Group {
  unsigned slopes = 0, bad = 0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max(), most = 0, unfelt = 0;
  double push = 0.0, drawn_false = 0.0, later_false = 0.0, error = 0.0;

  void take(const SlopeLook& l) {
    ++slopes;
    bad += l.good() ? 0 : 1;
    fewest = std::min(fewest, l.blocks);
    most = std::max(most, l.blocks);
    unfelt = std::max(unfelt, l.unfelt);
    push = std::max(push, l.drawn_push);
    drawn_false = std::max(drawn_false, l.drawn_false_depth);
    later_false = std::max(later_false, l.false_depth);
    error = std::max(error, std::abs(l.error));
  }
};

void print(const std::map<double, Group>& groups) {
  std::printf(
      "\n| deviation of angles | slopes | blocks | push as drawn (weights) | deeper than the "
      "geometry "
      "as drawn, m | after the steps, m | overlaps unfelt | drift | bad |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [angle, g] : groups) {
    std::printf("| %g | %u | %zu to %zu | %.1e | %.1e | %.1e | %zu | %.1e | %u |\n", angle,
                g.slopes, g.fewest, g.most, g.push, g.drawn_false, g.later_false, g.unfelt, g.error,
                g.bad);
  }
}

}  // namespace
}  // namespace edda

int main(int argc, char** argv) {
  using namespace edda;
  const auto argument = [&](int i, unsigned otherwise) {
    return argc > i ? static_cast<unsigned>(std::atoi(argv[i])) : otherwise;
  };
  const unsigned n = argument(1, 200), first = argument(2, 0), steps = argument(3, 400);
  unsigned bad = 0;
  std::map<double, Group> groups;
  std::printf("%-5s %-12s %5s %8s %6s %6s | %8s %8s %8s %8s | %5s %8s %8s %6s %8s\n", "seed",
              "distribution", "angle", "cohesion", "blocks", "pairs", "overlap", "false", "push",
              "energy", "steps", "overlap", "false", "unfelt", "drift");
  for (unsigned k = first; k < first + n; ++k) {
    const CutSlope s = cut_slope(k);
    const SlopeLook l = look_at_slope(s, steps);
    bad += l.good() ? 0 : 1;
    groups[s.angle].take(l);
    std::printf(
        "%-5u %-12s %5g %8g %6zu %6zu | %8.1e %8.1e %8.1e %8.1e | %5llu %8.1e %8.1e %6zu %8.1e "
        "%s%s\n",
        s.seed, s.distribution.c_str(), s.angle, s.cohesion, l.blocks, l.pairs, l.drawn_overlap,
        l.drawn_false_depth, l.drawn_push, l.drawn_energy, static_cast<unsigned long long>(l.steps),
        l.overlap, l.false_depth, l.unfelt, l.error, l.good() ? "" : "BAD ", l.failure.c_str());
    std::fflush(stdout);
  }
  print(groups);
  std::printf("\n%u of %u slopes bad\n", bad, n);
  return bad > 0 ? 1 : 0;
}
