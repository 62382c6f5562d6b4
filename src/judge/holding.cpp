#include "judge/holding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edda {
namespace {

/// Rock that yields flows where a part has gone several times as far as it strains until it yields.
/// Further on its new shape would hold it: a slope is flatter by then.
constexpr double most_strains = 3.0;

}  // namespace

Verdict Holding::end(Verdict verdict, std::string reason, Id block) {
  block_ = block;
  reason_ = std::move(reason);
  return verdict;
}

Verdict Holding::look(Simulation& sim) {
  if (!judge_.look(sim)) return Verdict::not_yet;
  part_ = 0.0;
  for (const MovedSet& set : judge_.moved()) {
    if (set.area < criterion_.least_area) continue;
    part_ = std::max(part_, set.part);
    if (set.part <= criterion_.allowed) continue;
    failed_.insert(failed_.end(), set.blocks.begin(), set.blocks.end());
  }
  for (const FlowingPart& flow : judge_.flowing(sim)) {
    if (flow.area < criterion_.least_area || !std::isfinite(criterion_.allowed)) continue;
    part_ = std::max(part_, flow.part);
    if (flow.strains > most_strains) failed_.push_back(flow.block);
  }
  if (!failed_.empty()) {
    const Id first = failed_.front();  // of the set that has moved furthest
    std::sort(failed_.begin(), failed_.end());
    const bool rest =
        std::all_of(failed_.begin(), failed_.end(), [&](Id i) { return judge_.rests()[i] != 0; });
    return end(Verdict::fails, rest ? "moved too far" : "keeps moving", first);
  }
  if (criterion_.displacement) {
    const Furthest furthest = judge_.furthest(sim);
    if (furthest.value > *criterion_.displacement)
      return end(Verdict::fails, "moved too far", furthest.block);
  }
  if (!sim.relaxation.seeks_equilibrium || !judge_.in_equilibrium()) return Verdict::not_yet;
  return end(Verdict::holds, "in equilibrium");
}

Verdict Holding::at_end(Simulation& sim) {
  std::vector<Id> blocks;
  for (Id i = 0; i < sim.scene->blocks.size(); ++i) {
    if (judge_.left().empty() || judge_.left()[i] == 0) blocks.push_back(i);
  }
  const Furthest fastest = fastest_of(sim, blocks);
  if (!criterion_.velocity)
    return end(Verdict::undecided, "neither at rest nor gone", fastest.block);
  return fastest.value > *criterion_.velocity
             ? end(Verdict::fails, "still moving", fastest.block)
             : end(Verdict::holds, "slower than the velocity of a failure");
}

}  // namespace edda
