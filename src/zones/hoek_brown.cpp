#include "zones/hoek_brown.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// At the apex of a surface that ends vertically the slope is without bound.
constexpr double least_base = 1e-14;

double cut_off(const HoekBrown& r) {
  return r.m > 0.0 ? std::min(r.tension, r.s * r.strength / r.m) : r.tension;
}

/// Where a plane touches the surface: s1 and s1 - s3 there, and the slope k of s3 over s1 less 1.
struct Touch {
  double s1, deviator, slope;
};

/// The plane that comes from the circle with the first stress t.
Touch touch_of(const HoekBrown& r, double t) {
  const double base = std::max(r.s - r.m * t / r.strength, least_base),
               slope = r.a * r.m * std::pow(base, r.a - 1.0), at = (r.s - base) * r.strength / r.m,
               radius = 0.5 * base * r.strength * slope / (r.a * r.m);
  if (r.factor == 1.0) return {at, 2.0 * radius, slope};
  const double sine = slope / (2.0 + slope), cosine = std::sqrt(1.0 - sine * sine),
               tangent = sine / cosine / r.factor, less = 1.0 / std::hypot(1.0, tangent),
               reduced = radius * cosine / (r.factor * less);
  const double centre = at - radius + radius * sine - reduced * tangent * less;
  return {centre + reduced, 2.0 * reduced, 2.0 * tangent * less / (1.0 - tangent * less)};
}

/// The plane that touches at s1.
Touch touch_at(const HoekBrown& r, double s1) {
  Touch touch = touch_of(r, s1);
  constexpr int most = 60;
  double t = s1;
  for (int n = 0; r.factor != 1.0 && n < most; ++n) {
    const double rest = s1 - touch.s1;
    if (std::abs(rest) <= 1e-11 * r.strength) break;
    touch = touch_of(r, t += rest);
  }
  return touch;
}

/// The planes that touch the surface at these first stresses of the pairs 13, 12 and 23.
std::array<YieldPlane, 6> planes_at(const HoekBrown& r, const Principal& touch) {
  const double flow = std::sin(r.dilation), cut = cut_off(r);
  const auto shear = [&](std::size_t i, std::size_t j, double at) {
    const Touch to = touch_at(r, at);
    const double per = 1.0 / (1.0 + to.slope);
    YieldPlane p{{}, per * (to.deviator + to.slope * to.s1), {}, false};
    p.normal[i] = 1.0;
    p.normal[j] = -per;
    p.flow[i] = 1.0 + flow;
    p.flow[j] = -(1.0 - flow);
    return p;
  };
  const auto tensile = [&](std::size_t i) { return tensile_plane(i, cut); };
  return {shear(0, 2, touch[0]), tensile(0), shear(0, 1, touch[1]),
          shear(1, 2, touch[2]), tensile(1), tensile(2)};
}

}  // namespace

HoekBrownConstants hoek_brown_constants(double index, double intact, double disturbance) {
  return {intact * std::exp((index - 100.0) / (28.0 - 14.0 * disturbance)),
          std::exp((index - 100.0) / (9.0 - 3.0 * disturbance)),
          0.5 + (std::exp(-index / 15.0) - std::exp(-20.0 / 3.0)) / 6.0};
}

double distance_from_yield(const HoekBrown& r, double s1, double s3) {
  const Touch to = touch_at(r, s1);
  return (s1 - s3 - to.deviator + to.slope * (s1 - to.s1)) / (1.0 + to.slope);
}

double largest_radius(const HoekBrown& r, double centre) {
  // By planes that touch the surface: each leaves the domain whole, so that the radius falls.
  const double cut = cut_off(r) - centre;
  constexpr int most = 60;
  double radius = cut;
  for (int n = 0; n < most; ++n) {
    const Touch to = touch_at(r, centre + radius);
    const double next = (to.deviator - to.slope * (centre - to.s1)) / (2.0 + to.slope),
                 change = next - radius;
    radius = next;
    if (std::abs(change) <= 1e-14 * r.strength) break;
  }
  return std::min(radius, cut);
}

bool within(const HoekBrown& r, const Principal& s) {
  const double most = std::max({s[0], s[1], s[2]}), least = std::min({s[0], s[1], s[2]});
  if (!(most <= cut_off(r))) return false;
  // Below the surface without a power: x^a is no less than x^(3/4) below 1, and sqrt(x) above.
  const double base = r.s - r.m * most / r.strength, root = std::sqrt(std::max(base, 0.0)),
               less = base < 1.0 ? root * std::sqrt(root) : root;
  const bool deep = r.factor == 1.0 && r.a >= 0.5 && r.a <= 0.75;
  if (deep && most - least <= r.strength * less) return true;
  return distance_from_yield(r, most, least) <= 0.0;
}

ReturnedStress return_to(const HoekBrown& rock, const IsotropicElasticity& elastic,
                         const Principal& trial) {
  return in_order(trial, [&](const Principal& sorted) {
    const double cut = cut_off(rock);
    const auto is_outside = [&](const Principal& s, double rounding) {
      return s[0] > cut + rounding || distance_from_yield(rock, s[0], s[2]) > rounding;
    };
    ReturnedStress r;
    r.stress = sorted;
    const double rounding = 1e-9 * rock.strength;
    if (is_outside(sorted, 0.0)) {
      constexpr int most = 50;
      Principal touch{std::min(sorted[0], cut), std::min(sorted[0], cut), std::min(sorted[1], cut)};
      for (int n = 0; n < most; ++n) {
        r = return_to_planes(sorted, elastic, planes_at(rock, touch), 1e-12 * rock.strength);
        if (!is_outside(r.stress, rounding)) break;
        touch = {r.stress[0], r.stress[0], r.stress[1]};
      }
    }
    return r;
  });
}

}  // namespace edda
