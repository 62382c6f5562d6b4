#include "report/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace edda {
namespace {

template <std::size_t n>
Colour between(const std::array<Colour, n>& stops, double s) {
  if (!(s >= 0.0)) s = 0.0;
  const double at = std::min(s, 1.0) * static_cast<double>(n - 1);
  const auto k = std::min(static_cast<std::size_t>(at), n - 2);
  const double f = at - static_cast<double>(k);
  const Colour a = stops[k], b = stops[k + 1];
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

// Every sixteenth entry of matplotlib's viridis (public domain, CC0).
constexpr std::array<Colour, 17> viridis{{{0.267004, 0.004874, 0.329415},
                                          {0.282327, 0.094955, 0.417331},
                                          {0.278826, 0.175490, 0.483397},
                                          {0.258965, 0.251537, 0.524736},
                                          {0.229739, 0.322361, 0.545706},
                                          {0.199430, 0.387607, 0.554642},
                                          {0.172719, 0.448791, 0.557885},
                                          {0.149039, 0.508051, 0.557250},
                                          {0.127568, 0.566949, 0.550556},
                                          {0.120638, 0.625828, 0.533488},
                                          {0.157851, 0.683765, 0.501686},
                                          {0.246070, 0.738910, 0.452024},
                                          {0.369214, 0.788888, 0.382914},
                                          {0.515992, 0.831158, 0.294279},
                                          {0.678489, 0.863742, 0.189503},
                                          {0.845561, 0.887322, 0.099702},
                                          {0.993248, 0.906157, 0.143936}}};

// Blue over near-white to red: on either side a straight line in OKLab, so that equal steps look
// equal and both ends are equally dark.
constexpr std::array<Colour, 17> blue_red{{{0.078, 0.290, 0.583},
                                           {0.196, 0.374, 0.635},
                                           {0.302, 0.457, 0.684},
                                           {0.408, 0.539, 0.733},
                                           {0.514, 0.622, 0.781},
                                           {0.622, 0.705, 0.827},
                                           {0.733, 0.789, 0.873},
                                           {0.846, 0.875, 0.917},
                                           {0.961, 0.961, 0.961},
                                           {0.920, 0.855, 0.846},
                                           {0.877, 0.751, 0.734},
                                           {0.831, 0.648, 0.624},
                                           {0.782, 0.546, 0.517},
                                           {0.730, 0.444, 0.412},
                                           {0.674, 0.342, 0.309},
                                           {0.615, 0.234, 0.207},
                                           {0.553, 0.104, 0.100}}};

constexpr std::array<Colour, kind_colour_count> colour_of_kind{{{0.851, 0.831, 0.776},
                                                                {0.702, 0.804, 0.890},
                                                                {0.800, 0.922, 0.773},
                                                                {0.984, 0.806, 0.682},
                                                                {0.871, 0.796, 0.894},
                                                                {0.996, 0.949, 0.682},
                                                                {0.729, 0.882, 0.867},
                                                                {0.969, 0.784, 0.831}}};

constexpr std::array<Colour, 4> colour_of_state{
    {{1.0, 1.0, 1.0}, {0.184, 0.525, 0.784}, {0.878, 0.200, 0.039}, {0.227, 0.102, 0.361}}};

}  // namespace

Colour sequential(double s) {
  return between(viridis, s);
}
Colour diverging(double s) {
  return between(blue_red, s);
}
Colour kind_colour(std::size_t k) {
  return colour_of_kind[k % colour_of_kind.size()];
}
Colour state_colour(std::size_t state) {
  return colour_of_state[std::min(state, colour_of_state.size() - 1)];
}

}  // namespace edda
