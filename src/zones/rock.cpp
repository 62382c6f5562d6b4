#include "zones/rock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace edda {
namespace {

constexpr double degree = std::numbers::pi / 180.0,
                 unlimited = std::numeric_limits<double>::infinity();

YieldSurface surface_of(const RockMass& rock) {
  const double dilation = degree * rock.dilation_angle.value_or(0.0);
  if (!rock.ucs) {
    return surface_of(MohrCoulomb{degree * *rock.friction_angle, dilation, *rock.cohesion,
                                  rock.tensile_strength.value_or(0.0)});
  }
  HoekBrownConstants c{rock.m.value_or(0.0), rock.s.value_or(0.0), rock.a.value_or(0.5)};
  if (rock.gsi) c = hoek_brown_constants(*rock.gsi, *rock.mi, rock.disturbance.value_or(0.0));
  return HoekBrown{*rock.ucs, c.m,      c.s,
                   c.a,       dilation, rock.tensile_strength.value_or(c.s * *rock.ucs / c.m)};
}

Foliation foliation_of(const Material& m) {
  const FoliationInputs& f = *m.foliation;
  Foliation made;
  made.along = {std::cos(degree * f.angle), std::sin(degree * f.angle)};
  if (f.is_elastic()) {
    const double young = f.young.value_or(m.young), poisson = f.poisson.value_or(m.poisson);
    made.elastic = transverse_elasticity(
        m.young, m.poisson, young, poisson,
        f.shear_modulus.value_or(usual_shear_modulus(m.young, young, poisson)));
  }
  if (f.friction_angle) {
    made.strength = FoliationStrength{std::tan(degree * *f.friction_angle),
                                      std::tan(degree * f.dilation_angle.value_or(0.0)),
                                      f.cohesion.value_or(0.0), f.tensile_strength.value_or(0.0)};
  }
  return made;
}

double between(double a, double b, double part) {
  return a + part * (b - a);
}

/// Surfaces of one kind.
struct Between {
  double part;
  YieldSurface operator()(const MohrCoulombSurface& a, const MohrCoulombSurface& b) const {
    const MohrCoulomb &p = a.rock, &q = b.rock;
    return surface_of(
        MohrCoulomb{between(p.friction, q.friction, part), between(p.dilation, q.dilation, part),
                    between(p.cohesion, q.cohesion, part), between(p.tension, q.tension, part)});
  }
  YieldSurface operator()(const HoekBrown& p, const HoekBrown& q) const {
    HoekBrown r = p;
    r.strength = between(p.strength, q.strength, part);
    r.m = between(p.m, q.m, part);
    r.s = between(p.s, q.s, part);
    r.a = between(p.a, q.a, part);
    r.dilation = between(p.dilation, q.dilation, part);
    r.tension = between(p.tension, q.tension, part);
    return r;
  }
  template <class A, class B>
  YieldSurface operator()(const A& a, const B&) const {
    return a;
  }
};

struct Divide {
  double factor;
  YieldSurface operator()(std::monostate) const { return {}; }
  double angle(double of) const { return std::atan(std::tan(of) / factor); }
  YieldSurface operator()(const MohrCoulombSurface& s) const {
    return surface_of(MohrCoulomb{angle(s.rock.friction), angle(s.rock.dilation),
                                  s.rock.cohesion / factor, s.rock.tension / factor});
  }
  YieldSurface operator()(const HoekBrown& s) const {
    HoekBrown r = s;
    r.factor *= factor;
    r.dilation = angle(s.dilation);
    r.tension /= factor;
    return r;
  }
};

/// The largest circle about a centre within a surface, Pa.
struct LargestRadius {
  double centre;
  double operator()(std::monostate) const { return unlimited; }
  double operator()(const MohrCoulombSurface& s) const {
    return std::min(
        0.5 * (s.planes[0].limit - (s.planes[0].normal[0] + s.planes[0].normal[2]) * centre),
        s.planes[1].limit - centre);
  }
  double operator()(const HoekBrown& s) const { return largest_radius(s, centre); }
};

/// How many times the stress that is used goes into the available one, within rounding (Pa).
double part_of(double available, double used, double rounding) {
  if (!(used > -rounding)) return unlimited;
  return std::max((available + rounding) / (used + rounding), 0.0);
}

/// What `body` makes of the surface after a slip (m).
template <class Body>
auto on_surface(const ZoneMaterial& rock, double slip, Body body) {
  if (!yields(rock.residual) || !(slip > 0.0)) return body(rock.peak);
  if (slip >= rock.slip) return body(rock.residual);
  return body(std::visit(Between{slip / rock.slip}, rock.peak, rock.residual));
}

}  // namespace

PlaneStiffness plane_stiffness(const ZoneMaterial& rock) {
  const auto [lambda, mu] = rock.elastic;
  if (!rock.foliation || !rock.foliation->elastic)
    return {{{lambda + 2.0 * mu, lambda, 0.0}, {lambda, lambda + 2.0 * mu, 0.0}, {0.0, 0.0, mu}}};
  const TransverseElasticity& e = *rock.foliation->elastic;
  const auto [x, y] = rock.foliation->along;
  const PlaneStiffness c{{{e.tt, e.tn, 0.0}, {e.tn, e.nn, 0.0}, {0.0, 0.0, e.shear}}};
  const PlaneStiffness in{{{x * x, y * y, x * y},  // strains in the axes of the foliation
                           {y * y, x * x, -x * y},
                           {-2.0 * x * y, 2.0 * x * y, x * x - y * y}}};
  PlaneStiffness turned{};
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t j = 0; j < c.size(); ++j) {
      for (std::size_t k = 0; k < c.size(); ++k) {
        for (std::size_t l = 0; l < c.size(); ++l) turned[i][j] += in[k][i] * c[k][l] * in[l][j];
      }
    }
  }
  return turned;
}

ZoneMaterial zone_material(const Material& m) {
  const double nu = m.poisson, mu = m.young / (2.0 * (1.0 + nu));
  ZoneMaterial made{{2.0 * mu * nu / (1.0 - 2.0 * nu), mu}};
  if (m.yield) {
    made.peak = surface_of(m.yield->peak);
    if (m.yield->residual) made.residual = surface_of(m.yield->after());
    made.slip = m.yield->slip_distance.value_or(0.0);
  }
  if (m.foliation) made.foliation = foliation_of(m);
  return made;
}

ZoneMaterial divided(const ZoneMaterial& rock, double factor) {
  ZoneMaterial r = rock;
  for (YieldSurface* surface : {&r.peak, &r.residual})
    *surface = std::visit(Divide{factor}, *surface);
  if (r.foliation && r.foliation->strength) {
    FoliationStrength& s = *r.foliation->strength;
    for (double* of : {&s.friction, &s.dilation, &s.cohesion, &s.tension}) *of /= factor;
  }
  return r;
}

bool stays_elastic(const ZoneMaterial& rock, double slip, const Principal& stress) {
  return on_surface(rock, slip, [&](const YieldSurface& surface) {
    if (const auto* s = std::get_if<MohrCoulombSurface>(&surface))
      return within(s->planes, stress, 0.0);
    return within(std::get<HoekBrown>(surface), stress);
  });
}

ReturnedStress return_to(const ZoneMaterial& rock, double slip, const Principal& trial) {
  return on_surface(rock, slip, [&](const YieldSurface& surface) {
    if (const auto* s = std::get_if<MohrCoulombSurface>(&surface))
      return return_to(*s, rock.elastic, trial);
    return return_to(std::get<HoekBrown>(surface), rock.elastic, trial);
  });
}

double strength_factor(const ZoneMaterial& rock, double slip, const std::array<double, 4>& stress) {
  const auto [xx, yy, zz, xy] = stress;
  const double centre = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy),
               rounding = 1e-13 * (rock.elastic.lambda + 2.0 * rock.elastic.mu);
  double factor = unlimited;
  if (yields(rock.peak)) {
    const double most = std::max(centre + radius, zz), least = std::min(centre - radius, zz);
    const double available = on_surface(rock, slip, [&](const YieldSurface& surface) {
      return std::visit(LargestRadius{0.5 * (most + least)}, surface);
    });
    factor = std::min(factor, part_of(available, 0.5 * (most - least), rounding));
  }
  if (rock.foliation && rock.foliation->strength) {
    const FoliationStrength& s = *rock.foliation->strength;
    const auto [x, y] = rock.foliation->along;
    const double across = xx * y * y + yy * x * x - 2.0 * xy * x * y - centre,
                 along = std::abs((yy - xx) * x * y + xy * (x * x - y * y));
    factor = std::min(
        {factor, part_of(s.cohesion - centre * s.friction, along + across * s.friction, rounding),
         part_of(s.tension - centre, across, rounding)});
  }
  return factor;
}

}  // namespace edda
