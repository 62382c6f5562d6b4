#include "zones/zone.hpp"

#include <cmath>

#include "blocks/meshes.hpp"

namespace edda {
namespace {

Matrix2 operator*(const Matrix2& a, const Matrix2& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy};
}
double determinant(const Matrix2& a) {
  return a.xx * a.yy - a.xy * a.yx;
}
Matrix2 transpose(const Matrix2& a) {
  return {a.xx, a.yx, a.xy, a.yy};
}
Matrix2 inverse(const Matrix2& a) {
  const double per = 1.0 / determinant(a);
  return {per * a.yy, -per * a.xy, -per * a.yx, per * a.xx};
}

/// sum_a values_a n_a n_a^T with n_1 = (c, s), n_2 = (-s, c).
Matrix2 from_principal(Vec2 n, double first, double second) {
  const double mean = 0.5 * (first + second), half = 0.5 * (first - second);
  const double c2 = n.x * n.x - n.y * n.y, s2 = 2.0 * n.x * n.y;
  return {mean + half * c2, half * s2, half * s2, mean - half * c2};
}

/// Symmetric xx, xy, yy: principal values, the larger first, and the direction of that.
struct Spectrum2 {
  double first, second;
  Vec2 n;
};
Spectrum2 spectrum_of(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), r = std::sqrt(half * half + xy * xy);
  Vec2 n{1.0, 0.0};
  if (r > 0.0) n = half >= 0.0 ? unit({r + half, xy}) : unit({xy, r - half});
  return {mean + r, mean - r, n};
}

/// F; the gradients have the sum 0.
Matrix2 deformation_of(const ZoneShape& z, const std::array<Vec2, 3>& x) {
  const Vec2 a = x[1] - x[0], b = x[2] - x[0], g = z.gradient[1], h = z.gradient[2];
  return {a.x * g.x + b.x * h.x, a.x * g.y + b.x * h.y, a.y * g.x + b.y * h.x,
          a.y * g.y + b.y * h.y};
}

/// The rotation R of F.
Vec2 rotation_of(const Matrix2& f) {
  const double c = f.xx + f.yy, s = f.yx - f.xy, per = 1.0 / std::sqrt(c * c + s * s);
  return {per * c, per * s};
}
/// R^T n.
Vec2 seen_from(Vec2 r, Vec2 n) {
  return {r.x * n.x + r.y * n.y, r.x * n.y - r.y * n.x};
}
/// R^T t R of a symmetric t.
Matrix2 seen_from(Vec2 r, const Matrix2& t) {
  const Matrix2 back{r.x, r.y, -r.y, r.x};
  return back * t * Matrix2{r.x, -r.y, r.y, r.x};
}
/// t n^T.
Matrix2 outer(Vec2 t, Vec2 n) {
  return {t.x * n.x, t.x * n.y, t.y * n.x, t.y * n.y};
}
double component(const Matrix2& a, Vec2 t, Vec2 n) {
  return t.x * (a.xx * n.x + a.xy * n.y) + t.y * (a.yx * n.x + a.yy * n.y);
}
/// sum_a x_a m_a.
Matrix2 sum_of(double x, const Matrix2& m, double y, const Matrix2& n) {
  return {x * m.xx + y * n.xx, x * m.xy + y * n.xy, x * m.yx + y * n.yx, x * m.yy + y * n.yy};
}

/// Stress of a zone whose volume strain is changed by `more`.
struct Stressed {
  Matrix2 tau{};
  double zz = 0.0;
  double stored = 0.0;  ///< per volume, J/m3
};

/// Of logarithmic strains, in their principal directions.
struct PrincipalState {
  Matrix2 e;  ///< F_e
  Vec2 n;
  Principal strain, stress;
};
PrincipalState principal_state(const Matrix2& f, double more, const IsotropicElasticity& elastic,
                               const ZoneState& state) {
  const Matrix2 e = f * state.plastic_inverse;
  const Spectrum2 b =
      spectrum_of(e.xx * e.xx + e.xy * e.xy, e.xx * e.yx + e.xy * e.yy, e.yx * e.yx + e.yy * e.yy);
  const Principal strain{0.5 * (std::log(b.first) + more), 0.5 * (std::log(b.second) + more),
                         state.elastic_zz};
  return {e, b.n, strain, elastic.stress(strain)};
}

/// S = C E in the axes of a foliation, of E as seen from the zone.
struct Transverse {
  Matrix2 stress;
  double zz, stored;
};
Transverse transverse(const TransverseElasticity& c, Vec2 t, const Matrix2& strain, double zz) {
  const Vec2 q = perp(t);
  const double tt = component(strain, t, t), nn = component(strain, q, q),
               tn = component(strain, t, q);
  const double along = c.tt * tt + c.tn * nn + c.tz * zz,
               across = c.tn * tt + c.nn * nn + c.nz * zz, out = c.tz * tt + c.nz * nn + c.zz * zz,
               shear = 2.0 * c.shear * tn;
  const Matrix2 in_plane = sum_of(along, outer(t, t), across, outer(q, q)),
                sheared = sum_of(shear, outer(t, q), shear, outer(q, t));
  return {sum_of(1.0, in_plane, 1.0, sheared), out,
          0.5 * (along * tt + across * nn + out * zz + 2.0 * shear * tn)};
}

Stressed stress_of(const PrincipalState& p) {
  return {from_principal(p.n, p.stress[0], p.stress[1]), p.stress[2],
          0.5 * dot(p.stress, p.strain)};
}

Stressed stress_of(const Matrix2& f, double more, const ZoneMaterial& material,
                   const ZoneState& state) {
  if (!material.foliation || !material.foliation->elastic)
    return stress_of(principal_state(f, more, material.elastic, state));
  const Foliation& foliation = *material.foliation;
  const Matrix2 e = sum_of(std::exp(0.5 * more), f * state.plastic_inverse, 0.0, {});
  const Matrix2 strain = sum_of(0.5, transpose(e) * e, -0.5, {});
  const double square_zz = std::exp(2.0 * state.elastic_zz);
  const Transverse s =
      transverse(*foliation.elastic, foliation.along, strain, 0.5 * (square_zz - 1.0));
  return {e * s.stress * transpose(e), square_zz * s.zz, s.stored};
}

/// What has become plastic, as seen from the zone.
struct Flow {
  Matrix2 plane{0.0, 0.0, 0.0, 0.0};
  double zz = 0.0;
  Yielding yielding{};
  double volume() const { return plane.xx + plane.yy + zz; }
  bool any() const { return yielding != Yielding::nowhere; }
};

/// Where rock yields, the return to its strength; the plastic strain of the state follows.
void yield(const Matrix2& f, const PrincipalState& trial, const ZoneMaterial& material,
           double width, ZoneState& state, Flow& flow) {
  const ReturnedStress r = return_to(material, width * state.plastic_shear, trial.stress);
  if (r.count == 0) return;
  const Matrix2 relaxed = from_principal(trial.n, std::exp(-r.plastic[0]), std::exp(-r.plastic[1]));
  state.plastic_inverse = inverse(f) * (relaxed * trial.e);
  state.elastic_zz -= r.plastic[2];
  const auto [least, most] = std::minmax({r.plastic[0], r.plastic[1], r.plastic[2]});
  state.plastic_shear += most - least;
  const Vec2 n = seen_from(rotation_of(trial.e), trial.n);
  flow = {from_principal(n, r.plastic[0], r.plastic[1]), r.plastic[2],
          r.tensile > 0 ? Yielding::in_tension : Yielding::in_shear};
}

/// What slips and opens on the foliation under this stress; the plastic strain of the state
/// follows.
void slip_on(const ZoneMaterial& material, const Matrix2& stress, ZoneState& state, Flow& flow) {
  const Foliation& p = *material.foliation;
  const Vec2 t = p.along, q = perp(t);
  const double stiffness =
      p.elastic ? p.elastic->nn : material.elastic.lambda + 2.0 * material.elastic.mu;
  const FoliationSlip s =
      slip_to(*p.strength, stiffness, p.elastic ? p.elastic->shear : material.elastic.mu,
              component(stress, q, q), component(stress, t, q));
  if (!s.any()) return;
  // exp(-(g t q^T + n q q^T))
  const double thinner = std::expm1(-s.opening),
               slides = s.opening > 0.0 ? -s.slip * thinner / s.opening : s.slip;
  const Matrix2 back = sum_of(1.0, {}, 1.0, sum_of(-slides, outer(t, q), thinner, outer(q, q)));
  state.plastic_inverse = state.plastic_inverse * back;
  state.slipped += std::hypot(s.slip, s.opening);
  const Matrix2 sheared = sum_of(0.5 * s.slip, outer(t, q), 0.5 * s.slip, outer(q, t));
  flow.plane = sum_of(1.0, flow.plane, 1.0, sum_of(1.0, sheared, s.opening, outer(q, q)));
  flow.yielding = Yielding::along_foliation;
}

/// s: the stress where nothing flows.
Flow flow_of(const Matrix2& f, double more, const ZoneMaterial& material, double width,
             ZoneState& state, Stressed& s) {
  Flow flow;
  if (yields(material.peak)) {
    const PrincipalState trial = principal_state(f, more, material.elastic, state);
    s = stress_of(trial);
    yield(f, trial, material, width, state, flow);
  } else {
    s = stress_of(f, more, material, state);
  }
  if (material.foliation && material.foliation->strength) {
    if (flow.any()) s = stress_of(f, more, material, state);
    slip_on(material, seen_from(rotation_of(f * state.plastic_inverse), s.tau), state, flow);
  }
  return flow;
}

/// Plastic volume strain of a pair goes to both alike: F_p^-1 and the flow of one of them lose
/// `more` of it.
void change_volume(ZoneState& state, Flow& flow, double more) {
  state.plastic_inverse = sum_of(std::exp(0.5 * more), state.plastic_inverse, 0.0, {});
  flow.plane = sum_of(1.0, flow.plane, -0.5 * more, {});
}

/// What a flow dissipates per volume, J/m3, by the mean of the stresses before and now; the state
/// remembers those of now.
double dissipated_by(const Flow& flow, const Matrix2& f, const Stressed& s, ZoneState& state) {
  const Matrix2 tau = seen_from(rotation_of(f * state.plastic_inverse), s.tau);
  const auto [xx, yy, zz, xy] = state.stress;
  state.stress = {tau.xx, tau.yy, s.zz, tau.xy};
  return 0.5 * ((xx + tau.xx) * flow.plane.xx + (yy + tau.yy) * flow.plane.yy +
                2.0 * (xy + tau.xy) * flow.plane.xy + (zz + s.zz) * flow.zz);
}

/// The elastic deformation U under a stress, tau = U S U: each round leaves an error as large as a
/// strain beside 1.
ZoneState transverse_at_start(const Foliation& foliation, const std::array<double, 4>& stress) {
  const auto [xx, yy, zz, xy] = stress;
  const Vec2 t = foliation.along, q = perp(t);
  ZoneState s;
  Matrix2& u = s.plastic_inverse;
  constexpr int rounds = 8;
  for (int n = 0; n < rounds; ++n) {
    const Matrix2 back = inverse(u), second = back * Matrix2{xx, xy, xy, yy} * back;
    const double out = zz * std::exp(-2.0 * s.elastic_zz);
    const std::array<double, 3> e =
        strains_of(*foliation.elastic, component(second, t, t), component(second, q, q), out);
    const double shear = 0.5 * component(second, t, q) / foliation.elastic->shear;
    const Matrix2 strain = sum_of(1.0, sum_of(e[0], outer(t, t), e[1], outer(q, q)), shear,
                                  sum_of(1.0, outer(t, q), 1.0, outer(q, t)));
    const Spectrum2 square =
        spectrum_of(1.0 + 2.0 * strain.xx, 2.0 * strain.xy, 1.0 + 2.0 * strain.yy);
    u = from_principal(square.n, std::sqrt(square.first), std::sqrt(square.second));
    s.elastic_zz = 0.5 * std::log1p(2.0 * e[2]);
  }
  s.stress = stress;
  return s;
}

}  // namespace

ZoneShape zone_shape(Vec2 a, Vec2 b, Vec2 c, double thickness) {
  const double twice = cross(b - a, c - a);
  return {area_gradients(a, b, c), 0.5 * twice * thickness, 2.0 * std::sqrt(std::abs(twice))};
}

double swelling_of(const ZoneShape& shape, const std::array<Vec2, 3>& x) {
  return std::log(determinant(deformation_of(shape, x)));
}

ZoneState zone_at_start(const ZoneMaterial& material, const std::array<double, 4>& stress) {
  if (material.foliation && material.foliation->elastic)
    return transverse_at_start(*material.foliation, stress);
  const auto [xx, yy, zz, xy] = stress;
  const IsotropicElasticity& elastic = material.elastic;
  ZoneState s;
  const double part = elastic.lambda / (3.0 * elastic.lambda + 2.0 * elastic.mu) * (xx + yy + zz),
               per = 0.5 / elastic.mu;
  const Spectrum2 e = spectrum_of(per * (xx - part), per * xy, per * (yy - part));
  s.plastic_inverse = from_principal(e.n, std::exp(e.first), std::exp(e.second));
  s.elastic_zz = per * (zz - part);
  s.stress = stress;
  return s;
}

void lock_pressures(const std::array<ZoneShape, 2>& shape, std::array<ZoneState, 2>& state) {
  const auto pressure = [](const ZoneState& s) { return 0.5 * (s.stress[0] + s.stress[1]); };
  const double volume = shape[0].volume + shape[1].volume;
  const double mean =
      (shape[0].volume * pressure(state[0]) + shape[1].volume * pressure(state[1])) / volume;
  for (ZoneState& s : state) s.locked = pressure(s) - mean;
}

void begin_without_stress(const std::array<ZoneShape, 2>& shape,
                          const std::array<std::array<Vec2, 3>, 2>& x,
                          std::array<ZoneState, 2>& state) {
  const std::size_t many = shape[1].volume > 0.0 ? 2 : 1;
  const double volume = shape[0].volume + shape[1].volume;
  double mean = 0.0;
  for (std::size_t q = 0; q < many; ++q)
    mean += shape[q].volume / volume * swelling_of(shape[q], x[q]);
  for (std::size_t q = 0; q < many; ++q) {
    const double more = mean - swelling_of(shape[q], x[q]);
    state[q] = {};
    state[q].plastic_inverse =
        sum_of(std::exp(-0.5 * more), inverse(deformation_of(shape[q], x[q])), 0.0, {});
  }
}

namespace {

/// -V P g_k, P = tau F^-T.
std::array<Vec2, 3> forces_on_nodes(const ZoneShape& shape, const Matrix2& tau, const Matrix2& f) {
  const Matrix2 in = inverse(f), p = tau * Matrix2{in.xx, in.yx, in.xy, in.yy};
  const double v = shape.volume;
  std::array<Vec2, 3> force;
  for (std::size_t k = 0; k < force.size(); ++k) {
    const Vec2 g = shape.gradient[k];
    force[k] = {-v * (p.xx * g.x + p.xy * g.y), -v * (p.yx * g.x + p.yy * g.y)};
  }
  return force;
}

}  // namespace

std::array<ZoneResult, 2> evaluate_zones(const std::array<ZoneShape, 2>& shape,
                                         const ZoneMaterial& material,
                                         const std::array<std::array<Vec2, 3>, 2>& x,
                                         std::array<ZoneState, 2>& state) {
  const std::size_t many = shape[1].volume > 0.0 ? 2 : 1;
  std::array<Matrix2, 2> f;
  std::array<double, 2> theta{};
  double volume = 0.0, mean_theta = 0.0;
  for (std::size_t q = 0; q < many; ++q) {
    f[q] = deformation_of(shape[q], x[q]);
    theta[q] = std::log(determinant(f[q]));
    volume += shape[q].volume;
    mean_theta += shape[q].volume * theta[q];
  }
  mean_theta /= volume;
  std::array<Flow, 2> flow;
  std::array<Stressed, 2> s;
  double mean_flow = 0.0;
  for (std::size_t q = 0; q < many; ++q) {
    flow[q] = flow_of(f[q], mean_theta - theta[q], material, shape[q].width, state[q], s[q]);
    mean_flow += shape[q].volume / volume * flow[q].volume();
  }
  double pressure = 0.0;
  for (std::size_t q = 0; q < many; ++q) {
    const double more = flow[q].volume() - mean_flow;
    if (more != 0.0) change_volume(state[q], flow[q], more);
    if (flow[q].any() || more != 0.0)
      s[q] = stress_of(f[q], mean_theta - theta[q], material, state[q]);
    pressure += shape[q].volume / volume * 0.5 * (s[q].tau.xx + s[q].tau.yy);
  }
  std::array<ZoneResult, 2> results;
  for (std::size_t q = 0; q < many; ++q) {
    const double more = pressure + state[q].locked - 0.5 * (s[q].tau.xx + s[q].tau.yy);
    const Matrix2 tau = sum_of(1.0, s[q].tau, more, {});
    ZoneResult& r = results[q];
    const double v = shape[q].volume, per = 1.0 / determinant(f[q]);
    r.force = forces_on_nodes(shape[q], tau, f[q]);
    r.stored = v * (s[q].stored + state[q].locked * theta[q]);
    r.dissipated = v * dissipated_by(flow[q], f[q], s[q], state[q]);
    r.stress = {per * tau.xx, per * tau.yy, per * s[q].zz, per * tau.xy};
    r.yielding = flow[q].yielding;
  }
  return results;
}

std::array<std::array<Vec2, 3>, 2> viscous_forces(const std::array<ZoneShape, 2>& shape,
                                                  const ZoneMaterial& material,
                                                  const std::array<std::array<Vec2, 3>, 2>& x,
                                                  const std::array<std::array<Vec2, 3>, 2>& v,
                                                  double eta) {
  const std::size_t many = shape[1].volume > 0.0 ? 2 : 1;
  const double volume = shape[0].volume + shape[1].volume;
  std::array<Matrix2, 2> f, rate, tau;
  std::array<double, 2> swelling{};
  double mean = 0.0, pressure = 0.0;
  for (std::size_t q = 0; q < many; ++q) {
    f[q] = deformation_of(shape[q], x[q]);
    rate[q] = deformation_of(shape[q], v[q]);
    const Matrix2 l = rate[q] * inverse(f[q]);
    swelling[q] = l.xx + l.yy;
    mean += shape[q].volume / volume * swelling[q];
  }
  const PlaneStiffness c = plane_stiffness(material);
  for (std::size_t q = 0; q < many; ++q) {
    const Matrix2 r = sum_of(1.0, rate[q], 0.5 * (mean - swelling[q]), f[q]);
    const double xx = f[q].xx * r.xx + f[q].yx * r.yx, yy = f[q].xy * r.xy + f[q].yy * r.yy,
                 twice = f[q].xx * r.xy + f[q].yx * r.yy + f[q].xy * r.xx + f[q].yy * r.yx;
    const auto stress = [&](std::size_t k) {
      return eta * (c[k][0] * xx + c[k][1] * yy + c[k][2] * twice);
    };
    const double off = stress(2);
    tau[q] = f[q] * Matrix2{stress(0), off, off, stress(1)} *
             Matrix2{f[q].xx, f[q].yx, f[q].xy, f[q].yy};
    pressure += shape[q].volume / volume * 0.5 * (tau[q].xx + tau[q].yy);
  }
  std::array<std::array<Vec2, 3>, 2> force{};
  for (std::size_t q = 0; q < many; ++q) {
    const double more = pressure - 0.5 * (tau[q].xx + tau[q].yy);
    force[q] = forces_on_nodes(shape[q], sum_of(1.0, tau[q], more, {}), f[q]);
  }
  return force;
}

}  // namespace edda
