// Points of designs whose size is known before, and what their values say.
#include <openturns/OT.hxx>

#include "sampler/conversation.hpp"
#include "sampler/distributions.hpp"

namespace edda::sampler {
namespace {

using nlohmann::json;

/// [count x d] in (0, 1).
OT::Sample uniform_points(const std::string& method, std::size_t d, std::size_t count,
                          std::uint64_t seed) {
  OT::RandomGenerator::SetSeed(seed);
  if (method == "sobol") return OT::SobolSequence(d).generate(count);
  OT::Collection<OT::Distribution> unit(d, OT::Uniform(0.0, 1.0));
  if (method == "latin-hypercube")
    return OT::LHSExperiment(OT::ComposedDistribution(unit), count).generate();
  OT::Sample points(count, d);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < d; ++k) points(i, k) = OT::RandomGenerator::Generate();
  }
  return points;
}

/// Pairs of matrices A, B, and those in which a column of A comes from B: n (d + 2) points.
OT::Sample saltelli_points(std::size_t d, std::size_t n, std::uint64_t seed) {
  OT::RandomGenerator::SetSeed(seed);
  OT::Collection<OT::Distribution> unit(d, OT::Uniform(0.0, 1.0));
  return OT::SobolIndicesExperiment(OT::ComposedDistribution(unit), n).generate();
}

OT::Sample sample_of(const json& rows) {
  const std::size_t d = rows.empty() ? 0 : rows[0].size();
  OT::Sample sample(rows.size(), d);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < d; ++k) sample(i, k) = rows[i][k];
  }
  return sample;
}

OT::Sample column_of(const json& values) {
  OT::Sample sample(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) sample(i, 0) = values[i];
  return sample;
}

}  // namespace

json points(const json& request) {
  const Variables variables(request.at("variables"), request.at("dependence"));
  const std::string method = request.at("method");
  const std::size_t count = request.at("count");
  const std::uint64_t seed = request.at("seed");
  const OT::Sample unit = method == "sobol-indices"
                              ? saltelli_points(variables.count(), count, seed)
                              : uniform_points(method, variables.count(), count, seed);
  json rows = json::array();
  for (std::size_t i = 0; i < unit.getSize(); ++i)
    rows.push_back(list_of(variables.from_uniform(unit[i])));
  return {{"points", rows}};
}

/// Clopper and Pearson's interval of a probability of which `failures` of `count` are known; exact:
/// it has the truth in it at least as often as `confidence` says.
json interval(const json& request) {
  const double k = request.at("failures"), n = request.at("count"), c = request.at("confidence");
  const auto quantile = [](double a, double b, double p) {
    return OT::Beta(a, b, 0.0, 1.0).computeQuantile(p)[0];
  };
  const double tail = 0.5 * (1.0 - c);
  return {{"low", k > 0.0 ? quantile(k, n - k + 1.0, tail) : 0.0},
          {"high", k < n ? quantile(k + 1.0, n - k, 1.0 - tail) : 1.0}};
}

/// Rank correlation of every input with the values (Spearman), and the regression of ranks on all
/// of them.
json ranks(const json& request) {
  const OT::CorrelationAnalysis analysis(sample_of(request.at("inputs")),
                                         column_of(request.at("values")));
  return {{"spearman", list_of(analysis.computeSpearmanCorrelation())}};
}

/// Saltelli's estimates from the values at the points of "sobol-indices".
json sobol_indices(const json& request) {
  const std::size_t n = request.at("count");
  const OT::SaltelliSensitivityAlgorithm algorithm(sample_of(request.at("inputs")),
                                                   column_of(request.at("values")), n);
  const OT::Interval first = algorithm.getFirstOrderIndicesInterval();
  const OT::Interval total = algorithm.getTotalOrderIndicesInterval();
  return {{"first", list_of(algorithm.getFirstOrderIndices())},
          {"first_low", list_of(first.getLowerBound())},
          {"first_high", list_of(first.getUpperBound())},
          {"total", list_of(algorithm.getTotalOrderIndices())},
          {"total_low", list_of(total.getLowerBound())},
          {"total_high", list_of(total.getUpperBound())}};
}

}  // namespace edda::sampler
