// Methods that choose their points as they go: FORM, SORM and subset simulation, in standard space.
#include <openturns/OT.hxx>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sampler/conversation.hpp"
#include "sampler/distributions.hpp"

namespace edda::sampler {
namespace {

using nlohmann::json;

/// The value that is asked of a run, as a function on standard space. All points of a call are
/// asked at once, so that they may run side by side.
class AskedValue : public OT::EvaluationImplementation {
 public:
  explicit AskedValue(const Variables& variables) : variables_(&variables) {}
  AskedValue* clone() const override { return new AskedValue(*this); }
  OT::UnsignedInteger getInputDimension() const override { return variables_->count(); }
  OT::UnsignedInteger getOutputDimension() const override { return 1; }
  OT::Description getInputDescription() const override {
    return OT::Description::BuildDefault(variables_->count(), "u");
  }
  OT::Description getOutputDescription() const override {
    return OT::Description::BuildDefault(1, "value");
  }
  OT::Point operator()(const OT::Point& u) const override { return (*this)(OT::Sample(1, u))[0]; }
  OT::Sample operator()(const OT::Sample& u) const override {
    json rows = json::array();
    for (std::size_t i = 0; i < u.getSize(); ++i)
      rows.push_back(list_of(variables_->from_normal(u[i])));
    answer({{"ask", rows}});
    const json reply = next_line();
    if (!reply.contains("values")) throw OT::InternalException(HERE) << "the study was ended";
    OT::Sample values(u.getSize(), 1);
    for (std::size_t i = 0; i < u.getSize(); ++i) values(i, 0) = reply["values"][i];
    return values;
  }

 private:
  const Variables* variables_;
};

OT::ThresholdEvent event_of(const json& request, const OT::Function& value, std::size_t d) {
  const OT::CompositeRandomVector output(value, OT::RandomVector(OT::Normal(d)));
  const double threshold = request.at("threshold");
  if (request.at("fails") == "below") return {output, OT::Less(), threshold};
  return {output, OT::Greater(), threshold};
}

/// What FORM finds: its design point is that of failure nearest to the origin of standard space.
json form_answer(const OT::AnalyticalResult& result, const Variables& variables) {
  const OT::Point u = result.getStandardSpaceDesignPoint();
  const double distance = result.getHasoferReliabilityIndex();
  const double index = result.getIsStandardPointOriginInFailureSpace() ? -distance : distance;
  double square = 0.0;
  for (const double c : u) square += c * c;
  json importance = json::array();
  for (const double c : u) importance.push_back(square > 0.0 ? c * c / square : 0.0);
  return {{"probability", OT::DistFunc::pNormal(-index)},
          {"reliability_index", index},
          {"design_point", list_of(variables.from_normal(u))},
          {"importance", importance}};
}

/// Whether the point is one where the value is the threshold.
void check_design_point(const AskedValue& value, const OT::AnalyticalResult& result,
                        const json& request) {
  const double at = value(result.getStandardSpaceDesignPoint())[0];
  constexpr double close = 0.01;
  const double threshold = request.at("threshold"), scale = request.at("scale");
  if (!(std::abs(at - threshold) <= close * scale)) {
    throw OT::InternalException(HERE)
        << "the search for the most likely failure ended at a value of " << at << ", not of "
        << threshold << ": the values are not smooth enough, or there is no failure near";
  }
}

/// OpenTURNS 1.24, other than 1.20, refuses such a point by itself, in words that say nothing of a
/// study.
template <class Method>
void search_design_point(Method& method, const json& request) {
  try {
    method.run();
  } catch (const OT::Exception& error) {
    if (std::string(error.what()).find("not on the limit state") == std::string::npos) throw;
    throw OT::InternalException(HERE)
        << "the search for the most likely failure did not end at a value of "
        << request.at("threshold").get<double>()
        << ": the values are not smooth enough, or there is no failure near";
  }
}

/// Fiessler's, Hasofer's and Lind's index by the algorithm of Abdo and Rackwitz.
json form_or_sorm(const json& request, const Variables& variables) {
  const std::size_t d = variables.count();
  const AskedValue value(variables);
  const OT::Point step(d, request.at("difference").get<double>());
  const OT::Function function(value, OT::CenteredFiniteDifferenceGradient(step, value),
                              OT::CenteredFiniteDifferenceHessian(step, value));
  OT::AbdoRackwitz nearest;
  nearest.setMaximumIterationNumber(50);
  const double tolerance = request.at("tolerance");
  nearest.setMaximumAbsoluteError(tolerance);
  nearest.setMaximumRelativeError(tolerance);
  nearest.setMaximumResidualError(tolerance);
  nearest.setMaximumConstraintError(tolerance * request.at("scale").get<double>());
  const OT::ThresholdEvent event = event_of(request, function, d);
  if (request.at("method") == "form") {
    OT::FORM form(nearest, event, OT::Point(d, 0.0));
    search_design_point(form, request);
    check_design_point(value, form.getResult(), request);
    return form_answer(form.getResult(), variables);
  }
  OT::SORM sorm(nearest, event, OT::Point(d, 0.0));
  search_design_point(sorm, request);
  const OT::SORMResult second = sorm.getResult();
  check_design_point(value, second, request);
  json result = form_answer(second, variables);
  result["probability_form"] = result["probability"];
  result["probability"] = second.getEventProbabilityBreitung();
  result["reliability_index"] = second.getGeneralisedReliabilityIndexBreitung();
  return result;
}

/// Square of the estimate's coefficient of variation (Au and Beck 2001, eq. 28): the sum over the
/// levels of (1 - p)/(p n) (1 + gamma), with the correlation gamma of the level's chains. OpenTURNS
/// 1.20 leaves out the first level.
double squared_variation(const OT::SubsetSampling& sampling, std::size_t n) {
  const OT::Point until = sampling.getProbabilityEstimatePerStep();
  const OT::Point gamma = sampling.getGammaPerStep();
  double square = 0.0, before = 1.0;
  for (std::size_t k = 0; k < until.getSize(); ++k) {
    const double p = until[k] / before;
    if (p > 0.0)
      square += (1.0 - p) / (p * static_cast<double>(n)) * (1.0 + std::max(gamma[k], 0.0));
    before = until[k];
  }
  return square;
}

/// Au and Beck (2001), `count` points a level; the interval is that of a lognormal estimate.
/// level_probability: the part of each level from which the next one starts.
json subset_with(const json& request, const Variables& variables, double level_probability) {
  OT::RandomGenerator::SetSeed(request.at("seed").get<std::uint64_t>());
  const std::size_t count = request.at("count"), block = request.at("block");
  const AskedValue value(variables);
  OT::SubsetSampling sampling(event_of(request, OT::Function(value), variables.count()));
  sampling.setConditionalProbability(level_probability);
  sampling.setBlockSize(block);
  sampling.setMaximumOuterSampling((count + block - 1) / block);
  sampling.run();
  const double p = sampling.getResult().getProbabilityEstimate();
  const double square = squared_variation(sampling, count);
  const double spread = std::sqrt(std::log1p(square));
  const double confidence = request.at("confidence");
  const double z = OT::DistFunc::qNormal(0.5 + 0.5 * confidence);
  return {{"probability", p},
          {"low", p * std::exp(-z * spread)},
          {"high", std::min(1.0, p * std::exp(z * spread))},
          {"coefficient_of_variation", std::sqrt(square)},
          {"levels", sampling.getStepsNumber()}};
}

/// Where chains are correlated negatively OpenTURNS 1.20 may refuse its own variance, one time in
/// fifty; other levels then do.
json subset(const json& request, const Variables& variables) {
  for (const double level_probability : {0.1, 0.12}) {
    try {
      return subset_with(request, variables, level_probability);
    } catch (const OT::InvalidArgumentException&) {
    }
  }
  return subset_with(request, variables, 0.15);
}

}  // namespace

json reliability(const json& request) {
  const Variables variables(request.at("variables"), request.at("dependence"));
  return {{"answer", request.at("method") == "subset" ? subset(request, variables)
                                                      : form_or_sorm(request, variables)}};
}

}  // namespace edda::sampler
