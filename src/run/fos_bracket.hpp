// Which factor a search for the factor of safety tries next. Pure functions of what is known.
#pragma once

#include <optional>

namespace edda {

/// Two factors about the one looked for: `low` is expected to hold and `high` to fail, until a
/// trial has shown it. An end that turns out otherwise becomes the other end, and a new one is put
/// as far out again by a factor of two.
struct FosBracket {
  double low, high;
  double tolerance;                   ///< width at which the search ends, as a part of `low`
  bool holds = false, fails = false;  ///< low is known to hold, high is known to fail
  int widened = 0;

  static constexpr int widest = 5;  ///< times an end is moved outwards

  bool gave_up() const { return widened > widest; }

  /// Nothing: the search is at its end.
  std::optional<double> next() const {
    if (gave_up()) return {};
    if (!holds) return low;
    if (!fails) return high;
    if (high - low <= tolerance * low) return {};
    return 0.5 * (low + high);
  }

  void take(double factor, bool held) {
    if (held && (!holds || factor > low)) {
      low = factor;
      holds = true;
      if (high <= low) {
        high = 2.0 * low;
        fails = false;
        ++widened;
      }
    } else if (!held && (!fails || factor < high)) {
      high = factor;
      fails = true;
      if (low >= high) {
        low = 0.5 * high;
        holds = false;
        ++widened;
      }
    }
  }

  /// Whether a trial of this factor may still tell something.
  bool may_ask(double factor) const {
    return !(holds && factor <= low) && !(fails && factor >= high);
  }
};

}  // namespace edda
