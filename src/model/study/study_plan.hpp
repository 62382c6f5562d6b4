// A study as its file describes it: which model, what varies, what is asked, and of how many
// samples (docs/study.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "base/polygon.hpp"

namespace edda {

enum class SamplingMethod {
  monte_carlo,
  latin_hypercube,
  sobol,
  grid,   ///< every combination of the values
  table,  ///< the rows of a file
  form,
  sorm,
  subset,
  sobol_indices,
  fit,  ///< values with which the answers are those that were measured
};

enum class Distribution {
  normal,
  lognormal,
  uniform,
  triangular,
  exponential,
  weibull,
  beta,
  von_mises,
  fisher,  ///< of an orientation: its dip, or with `with` its dip direction
  choice,  ///< one of `values`
  seed,    ///< another whole number for every sample
};

enum class Copula { normal, clayton, gumbel, frank };
enum class Analysis { run, fos, limit, keyblocks };
enum class Taken { last, largest, smallest };
enum class Scale { linear, log };

/// How many samples, and which.
struct Sampling {
  SamplingMethod method = SamplingMethod::monte_carlo;
  std::optional<long long> samples{};  ///< none: as many as the method needs
  long long seed = 1;
  std::string table;  ///< path of a file
  double confidence = 0.95;
  double half_width = 0.0;  ///< of the interval of the probability of failure; 0: all samples
  double difference = 0.1;  ///< of FORM's derivatives, in standard deviations
  double tolerance = 1e-3;  ///< of FORM's search
  Where where;
};

/// One quantity that varies.
struct Vary {
  std::string name;
  std::string key;                ///< of the model, dotted; moved into keys once read
  std::vector<std::string> keys;  ///< of the model, dotted
  Distribution distribution = Distribution::normal;
  std::optional<double> mean{}, sd{}, cv{}, low{}, high{}, mode{}, concentration{};
  std::optional<double> at_least{}, at_most{};  ///< the distribution is truncated there
  std::string with;                             ///< of a dip direction: the name of its dip
  std::optional<double> start{};                ///< of method fit, with low and high its bounds
  Scale scale = Scale::linear;
  std::vector<double> values{}, weights{};
  std::string unit;  ///< of all of these; empty: that of the key
  Where where;
};

/// Two quantities that depend on each other.
struct Correlated {
  std::vector<std::string> between;
  Copula copula = Copula::normal;
  std::optional<double> rank{};   ///< Spearman's coefficient, of the normal copula
  std::optional<double> theta{};  ///< parameter of the others
  Where where;
};

/// A number that every sample gives.
struct Ask {
  std::string name;
  Analysis of = Analysis::limit;
  std::string value;  ///< path in summary.json, or a column of history.csv or reactions.csv
  Taken take = Taken::last;
  std::optional<double> at{};                 ///< s: the column's value at that time
  std::optional<double> measured{}, error{};  ///< of method fit; error: standard deviation
  Where where;
};

/// "history" or "reactions" where a column of that table of a run is asked; else empty.
inline std::string_view table_asked(const Ask& ask) {
  const std::string_view table = std::string_view(ask.value).substr(0, ask.value.find('.'));
  return table == "history" || table == "reactions" ? table : std::string_view();
}

/// When a sample counts as a failure.
struct FailureCriterion {
  std::string ask;
  std::optional<double> below{}, above{};
  Where where;
};

/// Where it is counted how often a place belongs to a key block.
struct StudyMap {
  double spacing = 0.0;       ///< m, of the places, in rows and columns
  Ring region;                ///< around them
  long long generations = 1;  ///< of key blocks that count: 1, those that leave first
  Where where;
};

struct StudyPlan {
  std::string title;
  std::string model;  ///< path
  Sampling sampling;
  std::vector<Vary> vary;
  std::vector<Correlated> correlated;
  std::vector<Ask> ask;
  std::optional<FailureCriterion> failure;
  std::optional<StudyMap> map;
  std::string file;  ///< path of the study's file
};

/// Whether the points are chosen as the values of those before are known.
constexpr bool chooses_as_it_goes(SamplingMethod m) {
  return m == SamplingMethod::form || m == SamplingMethod::sorm || m == SamplingMethod::subset ||
         m == SamplingMethod::fit;
}
/// Whether samples are independent draws (or, of a Latin hypercube, better than those), so that
/// parts of them estimate probabilities.
constexpr bool is_random(SamplingMethod m) {
  return m == SamplingMethod::monte_carlo || m == SamplingMethod::latin_hypercube ||
         m == SamplingMethod::sobol;
}

/// Whether which samples are run depends on the answers of others.
inline bool needs_all(const StudyPlan& plan) {
  return chooses_as_it_goes(plan.sampling.method) || plan.sampling.half_width > 0.0;
}

/// What each sample answers: as many cells, [plan.ask] and then the map, where there is one.
inline std::size_t answer_cells(const StudyPlan& plan) {
  return plan.ask.size() + (plan.map ? 1 : 0);
}

/// The middles of squares with sides of the spacing, row by row from below, that lie in the region.
std::vector<Vec2> places_of(const StudyMap& map);
/// At most as many.
inline constexpr double most_places = 20'000;

/// Reads the TOML file; every default is filled in. Faults: all of the file together, in the order
/// of its lines.
Result<StudyPlan> read_study(const std::string& path, const std::vector<std::string>& overrides);
Result<StudyPlan> read_study_text(std::string_view text, const std::string& path,
                                  const std::vector<std::string>& overrides);

/// The plan as a file that reads back to the same plan.
std::string to_toml(const StudyPlan& plan);
/// The reference of all keys of a study's file in Markdown.
std::string study_key_reference();

}  // namespace edda
