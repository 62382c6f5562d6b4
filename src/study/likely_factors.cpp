#include "study/likely_factors.hpp"

#include <algorithm>
#include <map>

namespace edda {
namespace {

/// Likelihood that the trial which this search asks for next holds.
double likely_to_hold(const FosBracket& search) {
  constexpr double as_expected = 0.9, between = 0.35;
  if (!search.holds) return as_expected;
  return search.fails ? between : 1.0 - as_expected;
}

FosBracket after(FosBracket search, double factor, bool stable) {
  search.take(factor, stable);
  return search;
}

}  // namespace

std::vector<double> likely_factors(const FosBracket& bracket, std::size_t most,
                                   const KnownOutcome& known) {
  std::vector<double> factors;
  std::multimap<double, FosBracket, std::greater<>> searches{{1.0, bracket}};  // by likelihood
  while (!searches.empty() && factors.size() < most) {
    const auto [likelihood, search] = *searches.begin();
    searches.erase(searches.begin());
    const std::optional<double> factor = search.next();
    if (!factor) continue;
    if (const std::optional<bool> holds = known(*factor)) {
      searches.emplace(likelihood, after(search, *factor, *holds));
      continue;
    }
    if (std::find(factors.begin(), factors.end(), *factor) == factors.end()) {
      factors.push_back(*factor);
    }
    const double holding = likely_to_hold(search);
    searches.emplace(likelihood * holding, after(search, *factor, true));
    searches.emplace(likelihood * (1.0 - holding), after(search, *factor, false));
  }
  return factors;
}

}  // namespace edda
