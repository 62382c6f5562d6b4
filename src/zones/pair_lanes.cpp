#include "zones/pair_lanes.hpp"

#include <cmath>

#include "base/vector_loop.hpp"
#include "blocks/bending.hpp"
#include "blocks/meshes.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {
namespace {

static_assert(sizeof(Eight) == sizeof(OfPairs));

EDDA_INLINE Eight of(const OfPairs& values) {
  return from<Eight>(values.data());
}
EDDA_INLINE void set(OfPairs& values, const Eight& by) {
  to<Eight>(values.data(), by);
}

/// atanh(z)/z of z^2 up to 0.0125.
EDDA_INLINE Eight atanh_ratio(const Eight& square) {
  Eight sum = square / 15.0 + 1.0 / 13.0;
  sum = sum * square + 1.0 / 11.0;
  sum = sum * square + 1.0 / 9.0;
  sum = sum * square + 1.0 / 7.0;
  sum = sum * square + 1.0 / 5.0;
  sum = sum * square + 1.0 / 3.0;
  return sum * square + 1.0;
}
EDDA_INLINE Eight ln(const Eight& x) {
  const Eight z = (x - 1.0) / (x + 1.0);
  return 2.0 * z * atanh_ratio(z * z);
}

/// A symmetric tensor as mean 1 + (half, off; off, -half).
struct Plane {
  Eight mean, half, off;
};

struct Lane {
  Eight xx, xy, yx, yy;  ///< F
  Eight volume;          ///< det F
  Eight ex, ey;          ///< (F_e xx + yy, yx - xy): its rotation times its stretch
  Eight middle;          ///< m
  Eight half, off;       ///< D
  Eight elastic;         ///< det F_e
};

EDDA_INLINE Lane lane_of(const PairShapes& s, const PairInputs& in, std::size_t q) {
  const Eight x0 = of(in.x[q][0]), y0 = of(in.y[q][0]);
  const Eight ax = of(in.x[q][1]) - x0, ay = of(in.y[q][1]) - y0, bx = of(in.x[q][2]) - x0,
              by = of(in.y[q][2]) - y0;
  const Eight gx = of(s.gradient_x[q][0]), gy = of(s.gradient_y[q][0]), hx = of(s.gradient_x[q][1]),
              hy = of(s.gradient_y[q][1]);
  Lane f;
  f.xx = ax * gx + bx * hx;
  f.xy = ax * gy + bx * hy;
  f.yx = ay * gx + by * hx;
  f.yy = ay * gy + by * hy;
  f.volume = f.xx * f.yy - f.xy * f.yx;
  const Eight pxx = of(in.plastic[q][0]), pxy = of(in.plastic[q][1]), pyx = of(in.plastic[q][2]),
              pyy = of(in.plastic[q][3]);
  const Eight xx = f.xx * pxx + f.xy * pyx, xy = f.xx * pxy + f.xy * pyy,
              yx = f.yx * pxx + f.yy * pyx, yy = f.yx * pxy + f.yy * pyy;
  f.elastic = xx * yy - xy * yx;
  f.ex = xx + yy;
  f.ey = yx - xy;
  const Eight bxx = xx * xx + xy * xy, byy = yx * yx + yy * yy;
  f.middle = 0.5 * (bxx + byy);
  f.half = 0.5 * (bxx - byy);
  f.off = xx * yx + xy * yy;
  return f;
}

/// Kirchhoff stress.
struct LaneStress {
  Plane plane;
  Eight zz, stored;  ///< stored: J/m3
};
/// more: change of the volume strain.
EDDA_INLINE LaneStress stress_of(const Lane& f, const Eight& more, const Eight& zz,
                                 const Eight& lambda, const Eight& mu) {
  const Eight per = 1.0 / f.middle, square = (f.half * f.half + f.off * f.off) * per * per;
  const Eight shear = mu * per * atanh_ratio(square), volume = ln(f.elastic) + more;
  const Eight pressure = lambda * (volume + zz);
  LaneStress s;
  s.plane = {pressure + mu * volume, shear * f.half, shear * f.off};
  s.zz = pressure + 2.0 * mu * zz;
  const Eight radius = s.plane.half * s.plane.half + s.plane.off * s.plane.off;
  s.stored = 0.5 * (s.plane.mean * volume + radius / mu + s.zz * zz);
  return s;
}

/// As seen from the zone, which rotates: R^T t R.
EDDA_INLINE void remember(const Lane& f, const LaneStress& s, std::array<OfPairs, 4>& as) {
  const Eight per = 1.0 / (f.ex * f.ex + f.ey * f.ey);
  const Eight c = (f.ex * f.ex - f.ey * f.ey) * per, t = 2.0 * f.ex * f.ey * per;
  const Eight half = c * s.plane.half + t * s.plane.off, off = c * s.plane.off - t * s.plane.half;
  set(as[0], s.plane.mean + half);
  set(as[1], s.plane.mean - half);
  set(as[2], s.zz);
  set(as[3], off);
}

/// Forces and stress under a Kirchhoff stress of this mean.
EDDA_INLINE void act(const PairShapes& s, const Lane& f, const LaneStress& stress,
                     const Eight& mean, std::size_t q, PairResults& r) {
  const Eight xx = mean + stress.plane.half, yy = mean - stress.plane.half, xy = stress.plane.off;
  const Eight per = 1.0 / f.volume, v = of(s.volume[q]) * per;
  // P det F = tau (yy, -yx; -xy, xx) of F.
  const Eight pxx = xx * f.yy - xy * f.xy, pxy = xy * f.xx - xx * f.yx, pyx = xy * f.yy - yy * f.xy,
              pyy = yy * f.xx - xy * f.yx;
  Eight sum_x{}, sum_y{};
  for (std::size_t k = 0; k < 2; ++k) {
    const Eight gx = of(s.gradient_x[q][k]), gy = of(s.gradient_y[q][k]);
    const Eight x = -v * (pxx * gx + pxy * gy), y = -v * (pyx * gx + pyy * gy);
    set(r.force_x[q][k + 1], x);
    set(r.force_y[q][k + 1], y);
    sum_x += x;
    sum_y += y;
  }
  set(r.force_x[q][0], -sum_x);
  set(r.force_y[q][0], -sum_y);
  set(r.stress[q][0], per * xx);
  set(r.stress[q][1], per * yy);
  set(r.stress[q][2], per * stress.zz);
  set(r.stress[q][3], per * xy);
}

/// 1 where x is less than a fifth from 1.
EDDA_INLINE Eight near_one(const Eight& x) {
  const Eight none{}, one = none + 1.0;
  return x > 0.8 ? (x < 1.2 ? one : none) : none;
}
/// 1 where the series hold.
EDDA_INLINE Eight holds(const Lane& f) {
  const Eight none{}, one = none + 1.0, square = f.half * f.half + f.off * f.off;
  return near_one(f.volume) * near_one(f.elastic) *
         (square < 0.01 * f.middle * f.middle ? one : none);
}

EDDA_INLINE void set_principal(PairResults& r, std::size_t q, const LaneStress& on) {
  set(r.mean[q], on.plane.mean);
  set(r.square[q], on.plane.half * on.plane.half + on.plane.off * on.plane.off);
  set(r.out_of_plane[q], on.zz);
}

}  // namespace

void set_shape(PairShapes& to, std::size_t pair, const std::array<ZoneShape, 2>& shape,
               const IsotropicElasticity& elastic) {
  const bool alone = !(shape[1].volume > 0.0);
  for (std::size_t q = 0; q < 2; ++q) {
    const ZoneShape& as = shape[alone ? 0 : q];
    for (std::size_t k = 0; k < 2; ++k) {
      to.gradient_x[q][k][pair] = as.gradient[k + 1].x;
      to.gradient_y[q][k][pair] = as.gradient[k + 1].y;
    }
    to.volume[q][pair] = shape[q].volume;
  }
  to.lambda[pair] = elastic.lambda;
  to.mu[pair] = elastic.mu;
}

void set_inputs(PairInputs& to, std::size_t pair, const std::array<std::array<Vec2, 3>, 2>& x,
                const std::array<const ZoneState*, 2>& state) {
  for (std::size_t q = 0; q < 2; ++q) {
    for (std::size_t k = 0; k < corners_of_zone; ++k) {
      to.x[q][k][pair] = x[q][k].x;
      to.y[q][k][pair] = x[q][k].y;
    }
    const ZoneState& s = *state[q];
    to.plastic[q][0][pair] = s.plastic_inverse.xx;
    to.plastic[q][1][pair] = s.plastic_inverse.xy;
    to.plastic[q][2][pair] = s.plastic_inverse.yx;
    to.plastic[q][3][pair] = s.plastic_inverse.yy;
    to.elastic_zz[q][pair] = s.elastic_zz;
    to.locked[q][pair] = s.locked;
  }
}

EDDA_VECTOR void evaluate_pairs(const PairShapes& s, const PairInputs& in, PairResults& r) {
  const Lane a = lane_of(s, in, 0), b = lane_of(s, in, 1);
  const Eight ln_a = ln(a.volume), ln_b = ln(b.volume);
  const Eight va = of(s.volume[0]), vb = of(s.volume[1]), per = 1.0 / (va + vb);
  const Eight part_a = va * per, part_b = vb * per, mean = part_a * ln_a + part_b * ln_b;
  const Eight lambda = of(s.lambda), mu = of(s.mu), zz_a = of(in.elastic_zz[0]),
              zz_b = of(in.elastic_zz[1]);
  const LaneStress on_a = stress_of(a, mean - ln_a, zz_a, lambda, mu),
                   on_b = stress_of(b, mean - ln_b, zz_b, lambda, mu);
  const Eight pressure = part_a * on_a.plane.mean + part_b * on_b.plane.mean;
  const Eight locked_a = of(in.locked[0]), locked_b = of(in.locked[1]);
  act(s, a, on_a, pressure + locked_a, 0, r);
  act(s, b, on_b, pressure + locked_b, 1, r);
  remember(a, on_a, r.remembered[0]);
  remember(b, on_b, r.remembered[1]);
  set(r.stored, va * (on_a.stored + locked_a * ln_a) + vb * (on_b.stored + locked_b * ln_b));
  set(r.within, holds(a) * holds(b));
  set_principal(r, 0, on_a);
  set_principal(r, 1, on_b);
}

bool may_flow(const PairResults& r, std::size_t pair, std::size_t q, const ZoneMaterial& rock,
              double slip) {
  if (rock.foliation) return true;
  if (!yields(rock.peak)) return false;
  const double radius = std::sqrt(r.square[q][pair]), mean = r.mean[q][pair];
  return !stays_elastic(rock, slip, {mean + radius, mean - radius, r.out_of_plane[q][pair]});
}

}  // namespace edda
