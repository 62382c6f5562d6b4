#include "study/fos_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "study/fos_sets.hpp"

namespace edda {
namespace {

constexpr double stiffer = 10.0;

Model stiffened(Model model) {
  const auto raise = [](std::optional<double>& stiffness) {
    if (stiffness) *stiffness *= stiffer;
  };
  for (Material& m : model.materials) m.young *= stiffer;
  for (JointLaw& j : model.joints) {
    raise(j.kn);
    raise(j.ks);
  }
  raise(model.contact.normal_stiffness);
  raise(model.contact.shear_stiffness);
  return model;
}

/// Whether another search costs little, its stages included.
bool is_short(const FosStart& start, const FosResult& r) {
  constexpr double most = 4e7;  // block steps, some seconds
  auto steps = static_cast<double>(start.sim.motion.state.steps);
  for (const Trial& trial : r.trials) steps += static_cast<double>(trial.steps);
  return steps * static_cast<double>(r.blocks) < most;
}

}  // namespace

std::string why_below_rigid(const Model& model, const Fos& fos, const FosOptions& options,
                            const FosStart& start, const FosResult& found, double limit) {
  const double factor = *found.factor;
  const std::string below =
      fmt::format("the factor is {:.2g} % lower than theirs", 100.0 * (1.0 - factor / limit));
  // What hinges has no way to go by yielding: arches, which need their thickness.
  constexpr double worth = 0.05, mostly = 0.5;
  const bool hinges =
      start.rigid && start.rigid->mechanism && start.rigid->mechanism->hinging > mostly;
  if (!hinges || factor > (1.0 - worth) * limit) return below + " (docs/limit.md)";
  if (!is_short(start, found)) {
    return below +
           ", which rock and joints that deform may explain: repeat the search with young, "
           "kn and ks ten times as large (docs/limit.md)";
  }
  if (options.say) options.say("  with rock and joints ten times as stiff");
  const Model stiff = stiffened(model);
  Result<FosStart> made = start_trials(stiff, fos, options);
  if (!made.ok() || made.value().status != FosStatus::found) return below + " (docs/limit.md)";
  Fos coarse = fos;
  coarse.tolerance = std::max(fos.tolerance, 0.02);
  const FosResult r =
      found_between(stiff, coarse, {factor, limit, coarse.tolerance}, made.value(), options);
  if (!r.holds || !r.fails) return below + " (docs/limit.md)";
  const double then = 0.5 * (*r.holds + *r.fails);
  return below + (then > (1.0 + coarse.tolerance) * factor
                      ? fmt::format(", since rock and joints deform: it is {:.3g} where both are "
                                    "ten times as stiff (docs/limit.md)",
                                    then)
                      : fmt::format(", and not since rock and joints deform: it is {:.3g} where "
                                    "both are ten times as stiff (docs/limit.md)",
                                    then));
}

}  // namespace edda
