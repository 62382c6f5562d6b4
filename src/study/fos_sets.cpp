#include "study/fos_sets.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace edda {

const Trial* trial_at(const std::vector<Trial>& trials, double factor) {
  const auto found = std::find_if(trials.begin(), trials.end(),
                                  [&](const Trial& t) { return t.factor == factor; });
  return found == trials.end() ? nullptr : &*found;
}

FosResult found_between(const Model& model, const Fos& fos, const FosBracket& bracket,
                        FosStart& start, const FosOptions& options) {
  FosResult r;
  start.seen.clear();
  FosOptions within = options;  // its lines are not those of the trials that count
  if (options.say) within.say = [&](const std::string& line) { options.say("  " + line); };
  FosSearch search(model, fos, bracket, start, within, r);
  const FosBracket end = search.go();
  search.finish();
  if (end.next()) return {};  // stopped, or beyond all that was tried
  if (end.holds) r.holds = end.low;
  if (end.fails) r.fails = end.high;
  if (r.failed) r.mechanism = first_mechanism(start, r);
  return r;
}

Simulation at_start(const Simulation& rest, const Simulation& later) {
  Simulation start = rest;
  start.motion.state.position = later.motion.state.reference;
  for (std::size_t i = 0; i < start.scene->blocks.size(); ++i) {
    place_vertices(start.scene->blocks, start.motion.state.position, i, start.motion.pose.x,
                   start.motion.pose.y);
  }
  return start;
}

std::optional<Mechanism> first_mechanism(const FosStart& start, const FosResult& r) {
  const bool sound = r.failed && std::isfinite(r.failed->control.last_displacement) &&
                     r.failed->control.last_displacement < 1e100;
  if (!sound) return {};
  const Trial* const trial = r.fails ? trial_at(r.trials, *r.fails) : nullptr;
  if (trial != nullptr && trial->proof) return trial->proof;
  return mechanism_of(at_start(start.sim, *r.failed), *r.failed);
}

std::optional<FailedSet> first_set(const FosResult& r, const BlockSet& b) {
  const Trial* const trial = r.fails ? trial_at(r.trials, *r.fails) : nullptr;
  if (trial == nullptr || trial->failed.empty() || !r.mechanism) return {};
  return FailedSet{r.holds.value_or(0.0), *r.fails, blocks_of(*r.mechanism),
                   area_of(*r.mechanism, b), r.mechanism->text};
}

void find_later_sets(const Model& model, const Fos& fos, FosStart start, const FosOptions& options,
                     FosResult& r) {
  constexpr std::size_t most = 3;
  const BlockSet& b = start.sim.scene->blocks;
  const auto stopped = [&] { return options.stop != nullptr && *options.stop; };
  double area = 0.0;
  while (!r.sets.empty() && r.sets.size() < most && start.rigid && !stopped()) {
    const FailedSet& last = r.sets.back();
    area += last.area;
    start.sim.relaxation.loose.resize(b.size(), 0);
    for (const Id i : last.blocks) start.sim.relaxation.loose[i] = 1;
    const auto next = std::find_if(start.rigid->mechanisms.begin(), start.rigid->mechanisms.end(),
                                   [&](const LimitMechanism& m) {
                                     return m.value.status == LimitEnd::found &&
                                            m.value.lower > last.fails && m.area > area;
                                   });
    if (next == start.rigid->mechanisms.end()) return;
    start.rigid->largest = next->value;
    start.rigid->without_dilation.reset();
    start.rigid->residual.reset();
    if (options.say)
      options.say(
          fmt::format("  without {}: what fails next", counted(last.blocks.size(), "block")));
    const double limit = next->value.lower, low = std::max(0.98 * limit, last.holds);
    const FosResult later = found_between(
        model, fos, {low, 1.01 * limit, fos.tolerance, low == last.holds}, start, options);
    const std::optional<FailedSet> set = first_set(later, b);
    if (!set) return;
    r.sets.push_back(*set);
  }
}

void find_wide(const Model& model, const Fos& fos, FosStart start, const FosOptions& options,
               FosResult& r) {
  const Trial* const trial = r.fails ? trial_at(r.trials, *r.fails) : nullptr;
  const double usual = start.plan.criterion.allowed;
  if (!start.as_drawn || trial == nullptr || !std::isfinite(usual) || usual <= moved_little ||
      trial->part > usual || trial->end != TrialEnd::fails)
    return;
  const Scene& scene = *start.sim.scene;
  const auto may_yield = [&](Id i) {
    return scene.blocks.is_meshed(i) &&
           has_strength(scene.zones.material[static_cast<std::size_t>(scene.blocks.material[i])]);
  };
  if (std::any_of(trial->failed.begin(), trial->failed.end(), may_yield))
    return;  // rock that yields does not take up its strength by moving
  start.wide = true;
  if (options.say) options.say("  where blocks may move by a tenth of their size");
  const FosResult wide = found_between(
      model, fos, {r.holds.value_or(0.0), *r.fails, fos.tolerance, true}, start, options);
  if (!wide.holds || !wide.fails || *wide.holds <= (1.0 + 2.0 * fos.tolerance) * *r.fails) return;
  r.holds_wide = wide.holds;
  r.fails_wide = wide.fails;
}

std::string sets_text(const FosResult& r) {
  if (r.sets.size() < 2) return {};
  std::string text = "in order: ";
  for (std::size_t q = 0; q < r.sets.size(); ++q) {
    const FailedSet& s = r.sets[q];
    text +=
        fmt::format("{}{:.4g}: {} ({:.3g} m2), {}", q == 0 ? "" : "; ", 0.5 * (s.holds + s.fails),
                    counted(s.blocks.size(), "block"), s.area, s.text);
  }
  return text;
}

}  // namespace edda
