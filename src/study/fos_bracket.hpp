// Which factor a search for the factor of safety tries next. Pure functions of the trials so far.
#pragma once

#include <optional>

namespace edda {

/// Two factors around the factor of safety: `low` is expected to hold and `high` to fail, until a
/// trial has shown it. An end with the opposite result becomes the other end, and a new one is set
/// a factor of two further out.
struct FosBracket {
  double low, high;
  double tolerance;  ///< relative width at which the search ends, in units of `low`
  bool holds = false, fails = false;  ///< `low` has been shown to hold, `high` to fail
  int widened = 0;
  std::optional<double> below{};  ///< a factor below `low`, to be tried at last: a model may fail
                                  ///< between factors at which it holds
  std::optional<double> held{}, failed{};  ///< factors far below `low` and above `high` that have
                                           ///< been shown to hold and to fail

  static constexpr int widest = 5;  ///< largest number of times an end is moved outwards

  bool gave_up() const { return widened > widest; }

  /// The next factor; nothing: the search is complete.
  std::optional<double> next() const {
    if (gave_up()) return {};
    if (!holds) return low;
    if (!fails) return high;
    if (high - low <= tolerance * low) return below;
    return 0.5 * (low + high);
  }

  void take(double factor, bool stable) {
    if (factor == below) below.reset();
    if (stable && (!holds || factor > low)) {
      low = factor;
      holds = true;
      if (high <= low) {
        high = 2.0 * low;
        fails = false;
        ++widened;
        if (failed && *failed > low && (high >= *failed || gave_up())) {
          high = *failed;
          fails = true;
          widened = 0;
        }
      }
    } else if (!stable && (!fails || factor < high)) {
      high = factor;
      fails = true;
      if (low >= high) {
        low = 0.5 * high;
        holds = false;
        ++widened;
        if (held && *held < high && (low <= *held || gave_up())) {
          low = *held;
          holds = true;
          widened = 0;
        }
      }
    }
  }

  /// Whether this factor holds, as trials have shown of it, of a higher one or of a lower one.
  std::optional<bool> shown(double factor) const {
    if (holds && factor <= low) return true;
    if (fails && factor >= high) return false;
    return {};
  }

  /// Whether a trial of this factor may still add information.
  bool may_ask(double factor) const { return (below && factor <= *below) || !shown(factor); }
};

/// This search, as far as the outcomes of its trials are known.
template <class Outcome>
FosBracket followed(FosBracket search, Outcome known) {
  while (const std::optional<double> factor = search.next()) {
    const std::optional<bool> holds = known(*factor);
    if (!holds) break;
    search.take(*factor, *holds);
  }
  return search;
}

}  // namespace edda
