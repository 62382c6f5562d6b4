#include "sampler/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edda::sampler {
namespace {

using nlohmann::json;

constexpr double degree = std::numbers::pi / 180.0;

double value_of(const json& v, const char* name, double otherwise = 0.0) {
  return v.value(name, otherwise);
}

OT::Distribution weighted(const json& v) {
  const auto values = v.at("values").get<std::vector<double>>();
  const auto weights = v.value("weights", std::vector<double>(values.size(), 1.0));
  OT::Sample points(values.size(), 1);
  OT::Point chances(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    points(i, 0) = values[i];
    chances[i] = weights[i];
  }
  return OT::UserDefined(points, chances);
}

OT::Distribution untruncated(const json& v) {
  const std::string kind = v.at("distribution");
  const double mean = value_of(v, "mean"), sd = value_of(v, "sd"), low = value_of(v, "low");
  const double high = value_of(v, "high");
  if (kind == "normal") return OT::Normal(mean, sd);
  if (kind == "lognormal") return OT::LogNormalMuSigma(mean, sd, low).getDistribution();
  if (kind == "uniform") return OT::Uniform(low, high);
  if (kind == "triangular") return OT::Triangular(low, value_of(v, "mode"), high);
  if (kind == "exponential") return OT::Exponential(1.0 / (mean - low), low);
  if (kind == "weibull") return OT::WeibullMinMuSigma(mean, sd, low).getDistribution();
  if (kind == "beta") return OT::BetaMuSigma(mean, sd, low, high).getDistribution();
  if (kind == "fisher") return OT::Uniform(0.0, 1.0);  // which orient() turns into angles
  if (kind == "von-mises") return OT::VonMises(0.0, value_of(v, "concentration"));
  return weighted(v);
}

/// zero, unit: of the variable in terms of the distribution's.
OT::Distribution truncated(const json& v, double zero, double unit) {
  const OT::Distribution whole = untruncated(v);
  const bool below = v.contains("at_most"), above = v.contains("at_least");
  const auto bound = [&](const char* name) { return (value_of(v, name) - zero) / unit; };
  if (below && above) return OT::TruncatedDistribution(whole, bound("at_least"), bound("at_most"));
  if (above)
    return OT::TruncatedDistribution(whole, bound("at_least"), OT::TruncatedDistribution::LOWER);
  if (below)
    return OT::TruncatedDistribution(whole, bound("at_most"), OT::TruncatedDistribution::UPPER);
  return whole;
}

OT::Distribution pair_of(const std::string& copula, double theta) {
  if (copula == "clayton") return OT::ClaytonCopula(theta);
  if (copula == "gumbel") return OT::GumbelCopula(theta);
  return OT::FrankCopula(theta);
}

}  // namespace

Variables::Variables(const json& variables, const json& dependence) {
  const std::size_t n = variables.size();
  std::vector<char> in_pair(n, 0);
  OT::Collection<OT::Distribution> copulas, marginals;
  for (const json& d : dependence) {
    if (d.at("copula") == "normal") continue;
    for (const std::size_t i : d.at("between").get<std::vector<std::size_t>>()) {
      in_pair[i] = 1;
      order_.push_back(i);
    }
    copulas.add(pair_of(d.at("copula"), d.at("theta")));
  }
  std::vector<std::size_t> place(n, 0);  // among those under the normal copula
  std::size_t others = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (in_pair[i] != 0) continue;
    place[i] = others++;
    order_.push_back(i);
  }
  if (others > 0) {
    OT::CorrelationMatrix rank(others);
    for (const json& d : dependence) {
      if (d.at("copula") != "normal") continue;
      const auto between = d.at("between").get<std::vector<std::size_t>>();
      rank(place[between[0]], place[between[1]]) = d.at("rank");
    }
    copulas.add(OT::NormalCopula(OT::NormalCopula::GetCorrelationFromSpearmanCorrelation(rank)));
  }
  scale_.resize(n);
  for (const std::size_t i : order_) {
    const json& v = variables[i];
    if (v.at("distribution") == "von-mises") scale_[i] = {value_of(v, "mean"), 1.0 / degree};
    marginals.add(truncated(v, scale_[i].zero, scale_[i].unit));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (variables[i].at("distribution") != "fisher" || !variables[i].contains("with")) continue;
    for (std::size_t j = 0; j < n; ++j) {
      if (variables[j].at("name") != variables[i].at("with")) continue;
      orientations_.push_back({j, i, value_of(variables[j], "mean"), value_of(variables[i], "mean"),
                               value_of(variables[j], "concentration")});
    }
  }
  if (dependence.empty()) {
    joint_ = OT::ComposedDistribution(marginals);
  } else {
    joint_ = OT::ComposedDistribution(marginals, OT::ComposedCopula(copulas));
  }
}

/// From two uniform numbers u, v: the pole of the plane lies at the angle t from its mean,
/// cos(t) = 1 + ln(u + (1 - u) exp(-2 k))/k (Fisher 1953), all round it alike.
void Variables::orient(const Orientation& o, OT::Point& x) const {
  const double u = x[o.dip], around = 2.0 * std::numbers::pi * x[o.direction];
  const double k = o.concentration;
  const double c = 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * k)) / k;
  const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
  // The upward pole of a plane of dip d leans by d to its dip direction. North, east, up, in the
  // frame of the mean: along the dip, along the strike, along the mean pole.
  const double d = o.mean_dip * degree, a = o.mean_direction * degree;
  const double down = s * std::cos(around), strike = s * std::sin(around);
  const double out = std::sin(d) * c + std::cos(d) * down;  // towards the mean dip direction
  double north = out * std::cos(a) - strike * std::sin(a);
  double east = out * std::sin(a) + strike * std::cos(a);
  double up = std::cos(d) * c - std::sin(d) * down;
  if (up < 0.0) {  // the same plane, seen from above
    north = -north;
    east = -east;
    up = -up;
  }
  const double direction = std::atan2(east, north) / degree;
  x[o.dip] = std::acos(std::clamp(up, -1.0, 1.0)) / degree;
  x[o.direction] = direction < 0.0 ? direction + 360.0 : direction;
}

OT::Point Variables::from_uniform(const OT::Point& p) const {
  OT::Point ordered(count()), x(count());
  for (std::size_t k = 0; k < count(); ++k) ordered[k] = p[order_[k]];
  const OT::Point y = joint_.computeSequentialConditionalQuantile(ordered);
  for (std::size_t k = 0; k < count(); ++k) {
    const Scale& s = scale_[order_[k]];
    x[order_[k]] = s.zero + s.unit * y[k];
  }
  for (const Orientation& o : orientations_) orient(o, x);
  return x;
}

OT::Point Variables::from_normal(const OT::Point& u) const {
  OT::Point p(count());
  // Far in the tail the last bits of p are all that is left; p = 1 would be infinite.
  for (std::size_t k = 0; k < count(); ++k)
    p[k] = std::clamp(OT::DistFunc::pNormal(u[k]), 1e-300, 1.0 - 1e-16);
  return from_uniform(p);
}

}  // namespace edda::sampler
