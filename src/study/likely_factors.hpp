// Speculative bisection: factors whose trials a search for the factor of safety may need after the
// next one, made side by side with it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "study/fos_bracket.hpp"

namespace edda {

/// Whether the trial of a factor holds; nothing while that is not known.
using KnownOutcome = std::function<std::optional<bool>(double factor)>;

/// Up to `most` factors whose outcome is not known, the first of them the one that the search asks
/// for next, then those that it asks for after either outcome, and so on, the likeliest first. An
/// end of the bracket is expected to do what it was given for. Between them failure counts as
/// likelier: trials that hold end soon, and it is during a long trial of a factor that fails that
/// others have time to run.
std::vector<double> likely_factors(const FosBracket& bracket, std::size_t most,
                                   const KnownOutcome& known);

}  // namespace edda
