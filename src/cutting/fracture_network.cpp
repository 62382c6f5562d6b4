#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "base/place.hpp"
#include "base/random.hpp"
#include "base/rings.hpp"
#include "base/text.hpp"
#include "cutting/random_lines.hpp"
#include "cutting/rock_area.hpp"

namespace edda {
namespace {

/// Lengths: constant; lognormal, log length normal with s^2 = ln(1 + (d/m)^2) and mean ln m -
/// s^2/2; a power law, density ~ l^-a from min to max; or exponential. Discs of diameter d meet the
/// section with a chance that is proportional to d (`met`): density times d, for a lognormal the
/// mean of the logarithm s^2 higher, for a power law a less 1, for an exponential the sum of two.
/// Their chords are d sqrt(1 - u^2), u the distance of the centre from the section over d/2,
/// uniform.
class Lengths {
 public:
  Lengths(const LengthSpread& spread, bool met) : spread_(spread), met_(met) {
    if (spread.distribution == LengthKind::lognormal) {
      const double ratio = spread.deviation / *spread.mean;
      sigma_ = std::sqrt(portable_log(1.0 + ratio * ratio));
      mu_ = portable_log(*spread.mean) + (met ? 0.5 : -0.5) * sigma_ * sigma_;
    }
  }

  double longest() const {
    switch (spread_.distribution) {
      case LengthKind::lognormal:
        return portable_exp(mu_ + cut_off * sigma_);
      case LengthKind::power:
        return *spread_.max;
      case LengthKind::exponential:
        return longest_exponential() * *spread_.mean;
      case LengthKind::constant:
        break;
    }
    return *spread_.mean;
  }

  double draw(Random& random) const {
    const double length = draw_whole(random);
    if (!met_) return length;
    const double u = random.uniform();
    return length * std::sqrt(1.0 - u * u);
  }

 private:
  static constexpr double cut_off = 4.0;  ///< standard deviations: one in 30,000 lies beyond
  double longest_exponential() const { return met_ ? 13.0 : 10.4; }  ///< means, likewise

  double draw_whole(Random& random) const {
    switch (spread_.distribution) {
      case LengthKind::lognormal:
        for (;;) {
          const double z = random.normal();
          if (z <= cut_off) return portable_exp(mu_ + z * sigma_);
        }
      case LengthKind::power:
        return power(random.uniform());
      case LengthKind::exponential:
        for (;;) {
          double x = -portable_log(1.0 - random.uniform());
          if (met_) x -= portable_log(1.0 - random.uniform());
          if (x <= longest_exponential()) return x * *spread_.mean;
        }
      case LengthKind::constant:
        break;
    }
    return *spread_.mean;
  }

  /// The inverse of the distribution, with lengths over the shortest: r = max/min, b = 1 - a,
  /// l/min = (1 + u (r^b - 1))^(1/b).
  double power(double u) const {
    const double low = *spread_.min, log_ratio = portable_log(*spread_.max / low);
    const double b = (met_ ? 2.0 : 1.0) - *spread_.exponent;
    constexpr double logarithmic = 1e-9;
    if (std::abs(b * log_ratio) < logarithmic) return low * portable_exp(u * log_ratio);
    const double whole = portable_exp(b * log_ratio);
    return low * portable_exp(portable_log(1.0 + u * (whole - 1.0)) / b);
  }

  const LengthSpread& spread_;
  bool met_;
  double mu_ = 0.0, sigma_ = 0.0;
};

double draw_angle(const AngleSpread& spread, Random& random) {
  if (spread.deviation == 0.0) return spread.mean;
  const double z =
      spread.distribution == Spread::normal ? random.normal() : 2.0 * random.uniform() - 1.0;
  return spread.mean + spread.deviation * z;
}

struct Place {
  Ring region;
  Vec2 low, high;  ///< box of centres
  double area = 0.0;
};

Place place_of(const LineWork& work, const Ring& region, double reach) {
  Place place;
  place.region = region;
  Stretch x = extent_along(work.outline, {1, 0}), y = extent_along(work.outline, {0, 1});
  if (!region.empty()) {
    const Stretch rx = extent_along(region, {1, 0}), ry = extent_along(region, {0, 1});
    x = {std::max(x.first, rx.first), std::min(x.second, rx.second)};
    y = {std::max(y.first, ry.first), std::min(y.second, ry.second)};
  }
  place.low = {x.first - reach, y.first - reach};
  place.high = {x.second + reach, y.second + reach};
  place.area = common_area(work.outline, region).value_or(0.0);
  return place;
}

struct Fracture {
  Vec2 middle, direction;
  double length = 0.0;
  std::vector<Stretch> inside;  ///< of outline and region
  double length_inside = 0.0;
};

void clip(Fracture& f, const LineWork& work, const Place& place, double snap) {
  f.inside = common(clip_line(work.outline, f.middle, f.direction, snap),
                    {{-0.5 * f.length, 0.5 * f.length}});
  if (!place.region.empty()) {
    f.inside = common(f.inside, clip_line(place.region, f.middle, f.direction, snap));
  }
  for (const Stretch& part : f.inside) f.length_inside += part.second - part.first;
}

Fracture draw_fracture(const FractureNetwork& network, const LineWork& work, const Place& place,
                       const Lengths& lengths, double snap, Random& random) {
  Fracture f;
  f.middle.x = place.low.x + random.uniform() * (place.high.x - place.low.x);
  f.middle.y = place.low.y + random.uniform() * (place.high.y - place.low.y);
  f.length = lengths.draw(random);
  f.direction = direction_of(draw_angle(network.angle, random));
  clip(f, work, place, snap);
  return f;
}

/// Veneziano's fractures on one line: lines are uniform in their distance from the middle of the
/// domain, and on them exponential lengths of fracture and of rock follow each other, with means m
/// and m (1 - p)/p of the persistence p.
std::vector<Fracture> draw_line(const FractureNetwork& network, const LineWork& work,
                                const Place& place, double snap, Random& random) {
  const double reach = 0.5 * norm(place.high - place.low);
  const double p = *network.persistence, mean = *network.length.mean;
  const Vec2 direction = direction_of(draw_angle(network.angle, random));
  const Vec2 foot =
      0.5 * (place.low + place.high) + (reach * (2.0 * random.uniform() - 1.0)) * perp(direction);
  bool open = random.uniform() < p;
  std::vector<Fracture> fractures;
  for (double t = -reach; t < reach; open = !open) {
    const double part = open ? mean : mean * (1.0 - p) / p;
    const double length = -portable_log(1.0 - random.uniform()) * part;
    if (open) {
      Fracture f{foot + (t + 0.5 * length) * direction, direction, length, {}, 0.0};
      clip(f, work, place, snap);
      fractures.push_back(std::move(f));
    }
    t += length;
  }
  return fractures;
}

void add_fracture(LineWork& work, const Fracture& f, const Place& place, Index source,
                  double snap) {
  const double margin = margin_of(work.outline, snap);
  for (Stretch part : drawn(work.outline, place.region, f.middle, f.direction, snap, margin,
                            {-0.5 * f.length, 0.5 * f.length})) {
    work.lines.push_back(
        {{f.middle + part.first * f.direction, f.middle + part.second * f.direction}, source});
  }
}

std::string name_of(const FractureNetwork& network) {
  return network.name.empty() ? "fracture network" : "fracture network \"" + network.name + '"';
}

}  // namespace

Faults add_network(LineWork& work, const FractureNetwork& network, Index source, Vec2 origin,
                   double snap, double limit) {
  const bool on_lines = network.model == NetworkModel::veneziano;
  const Lengths lengths(network.length, network.model == NetworkModel::baecher);
  const Place place =
      place_of(work, local_ring(network.region, origin), on_lines ? 0.0 : 0.5 * lengths.longest());
  const auto fault = [&](const char* key, std::string problem, std::string remedy) {
    return Faults{{member_of(network.where, key), std::move(problem), std::move(remedy)}};
  };
  if (!(place.area > 0.0)) {
    return fault("region", "lies wholly outside domain.outline",
                 "move it into the outline or leave it out");
  }
  Random random(mixed(mixed(mixed(0, "fracture_network"), static_cast<std::uint64_t>(network.seed)),
                      network.name));
  const double wanted = network.p21 ? *network.p21 * place.area : 0.0;
  constexpr double most_drawn = 5e7;
  double reached = 0.0, shown = 0.0, drawn_so_far = 0.0;
  const char* const key = network.p21 ? "p21" : "count";
  std::vector<Fracture> waiting;
  while (network.p21 ? reached < wanted : shown < static_cast<double>(*network.count)) {
    if (waiting.empty() && on_lines) waiting = draw_line(network, work, place, snap, random);
    if (waiting.empty() && !on_lines) {
      waiting.push_back(draw_fracture(network, work, place, lengths, snap, random));
    }
    drawn_so_far += 1.0;
    if (drawn_so_far > most_drawn) {
      return fault(key,
                   "takes more than " + number_text(most_drawn, 4) +
                       " fractures to be drawn, of "
                       "which " +
                       number_text(shown, 4) + " show in the domain",
                   "give fewer or shorter fractures; the longest are much longer than the domain");
    }
    if (waiting.empty()) continue;
    const Fracture f = std::move(waiting.back());
    waiting.pop_back();
    if (f.length_inside <= snap) continue;
    // The last fracture is left out where the total is nearer to the target without it.
    if (network.p21 && reached + f.length_inside - wanted > wanted - reached) break;
    reached += f.length_inside;
    shown += 1.0;
    if (shown > limit) {
      return fault(key,
                   "makes more lines than domain.max_blocks = " + number_text(limit, 4) + " blocks",
                   "give fewer fractures, or raise domain.max_blocks");
    }
    add_fracture(work, f, place, source, snap);
  }
  work.notes.push_back(name_of(network) + ": " + number_text(shown, 4) + " fractures, " +
                       number_text(reached, 4) + " m, " + number_text(reached / place.area, 4) +
                       " m of them per m2");
  return {};
}

}  // namespace edda
