// Meshes of zones with known answers, brought to rest by dynamic relaxation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "zones/pairs.hpp"
#include "zones/zone.hpp"

namespace edda::zone_problems_test {
namespace {

IsotropicElasticity elasticity(double young, double poisson) {
  return {young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
          young / (2.0 * (1.0 + poisson))};
}

/// Zones without inertia of their own: masses make every node as fast as the zones around it allow.
struct Body {
  Mesh mesh;
  ZoneMaterial material;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<std::array<ZoneShape, 2>> shape;
  std::vector<std::array<ZoneState, 2>> state;
  std::vector<Vec2> x, v, load, fixed;  ///< fixed: 0 holds a component
  std::vector<double> mass;
  std::vector<std::array<ZoneResult, 2>> results;

  Body(Mesh m, const ZoneMaterial& rock, const std::array<double, 4>& initial, bool paired)
      : mesh(std::move(m)), material(rock) {
    pairs = pair_triangles(mesh);
    if (!paired) {
      pairs.clear();
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) pairs.push_back({t, no_partner});
    }
    x = mesh.nodes;
    v.assign(x.size(), {});
    load.assign(x.size(), {});
    fixed.assign(x.size(), {1.0, 1.0});
    mass.assign(x.size(), 0.0);
    const double stiff = rock.elastic.lambda + 2.0 * rock.elastic.mu;
    for (const auto& [one, other] : pairs) {
      std::array<ZoneShape, 2> s{};
      for (std::size_t q = 0; q < (other == no_partner ? 1u : 2u); ++q) {
        const Triangle& t = mesh.triangles[q == 0 ? one : other];
        s[q] = zone_shape(x[t[0]], x[t[1]], x[t[2]], 1.0);
        for (std::size_t k = 0; k < 3; ++k) {
          double sum = 0.0;
          for (std::size_t l = 0; l < 3; ++l)
            sum += std::abs(dot(s[q].gradient[k], s[q].gradient[l]));
          mass[t[k]] += stiff * s[q].volume * sum;
        }
      }
      shape.push_back(s);
      state.push_back({zone_at_start(rock, initial), zone_at_start(rock, initial)});
    }
    results.resize(pairs.size());
  }

  std::vector<Vec2> forces() {
    std::vector<Vec2> f = load;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const std::array<std::uint32_t, 2> of{pairs[p].first, pairs[p].second};
      std::array<std::array<Vec2, 3>, 2> at{};
      const std::size_t many = of[1] == no_partner ? 1 : 2;
      for (std::size_t q = 0; q < many; ++q) {
        for (std::size_t k = 0; k < 3; ++k) at[q][k] = x[mesh.triangles[of[q]][k]];
      }
      results[p] = evaluate_zones(shape[p], material, at, state[p]);
      for (std::size_t q = 0; q < many; ++q) {
        for (std::size_t k = 0; k < 3; ++k) f[mesh.triangles[of[q]][k]] += results[p][q].force[k];
      }
    }
    return f;
  }

  /// Steps of length 1 with adaptive damping by the Rayleigh quotient (Underwood 1983), until the
  /// unbalanced force is `balance` of the acting ones.
  int rest(
      double balance, int most, const std::function<void(int)>& before = [](int) {},
      int least = 50) {
    std::vector<Vec2> f_before, x_before = x;
    double w = 0.05;
    for (int n = 0; n < most; ++n) {
      before(n);
      const std::vector<Vec2> f = forces();
      double unbalanced = 0.0, acting = 0.0, stiff = 0.0, inert = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec2 free{f[i].x * fixed[i].x, f[i].y * fixed[i].y};
        unbalanced += dot(free, free);
        acting += dot(f[i], f[i]) + dot(load[i], load[i]);
        if (!f_before.empty()) {
          const Vec2 dx = x[i] - x_before[i], df = f[i] - f_before[i];
          stiff -= dx.x * df.x * fixed[i].x + dx.y * df.y * fixed[i].y;
          inert += mass[i] * dot(dx, dx);
        }
      }
      if (n > least && unbalanced <= balance * balance * acting) return n;
      if (inert > 0.0 && stiff > 0.0) w = 0.98 * w + 0.02 * std::sqrt(stiff / inert);
      f_before = f;
      x_before = x;
      const double half = std::min(w, 0.5);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec2 a = f[i] / mass[i];
        v[i] = ((1.0 - half) * v[i] + a) / (1.0 + half);
        v[i] = {v[i].x * fixed[i].x, v[i].y * fixed[i].y};
        x[i] += v[i];
      }
    }
    return most;
  }
};

Mesh cook(double h) {
  const MeshSize size = [h](Vec2) { return h; };
  const std::vector<Ring> rings{divided({{0, 0}, {48, 44}, {48, 60}, {0, 44}}, size)};
  return mesh_polygon(rings, size);
}

/// Cook's membrane, nearly incompressible: 7.75 where plain triangles lock.
TEST(ZoneProblems, CooksMembraneDoesNotLock) {
  const auto tip = [](double h, bool paired) {
    Body b(cook(h), ZoneMaterial{elasticity(250.0, 0.49)}, {}, paired);
    std::vector<std::pair<double, std::size_t>> end;
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      if (b.x[i].x < 1e-9) b.fixed[i] = {0.0, 0.0};
      if (b.x[i].x > 48.0 - 1e-9) end.push_back({b.x[i].y, i});
    }
    std::sort(end.begin(), end.end());
    constexpr double small = 0.01;  // of the load of 100
    for (std::size_t k = 0; k + 1 < end.size(); ++k) {
      const double share = small * 100.0 * 0.5 * (end[k + 1].first - end[k].first) / 16.0;
      b.load[end[k].second].y += share;
      b.load[end[k + 1].second].y += share;
    }
    const std::size_t top = end.back().second;
    const double start = b.x[top].y;
    EXPECT_LT(b.rest(1e-6, 60000), 60000);
    return (b.x[top].y - start) / small;
  };
  EXPECT_NEAR(tip(2.0, true) / 7.75, 1.0, 0.03);
  EXPECT_NEAR(tip(4.0, true) / 7.75, 1.0, 0.08);
  EXPECT_LT(tip(4.0, false) / 7.75, 0.92);
}

/// Salencon's (1969) circular hole in rock under an equal stress from all sides: closure of the
/// wall.
double salencon(const IsotropicElasticity& e, double p0, double c, double phi, double psi) {
  const double nu = e.lambda / (2.0 * (e.lambda + e.mu)), sine = std::sin(phi),
               flow = std::sin(psi);
  const double kp = (1.0 + sine) / (1.0 - sine), ks = (1.0 + flow) / (1.0 - flow),
               q = 2.0 * c * std::sqrt(kp);
  const double r0 =
      std::pow(2.0 / (kp + 1.0) * (p0 + q / (kp - 1.0)) / (q / (kp - 1.0)), 1.0 / (kp - 1.0));
  const double whole = q / (kp - 1.0);
  const double chi = (2.0 * nu - 1.0) * (p0 + whole) +
                     (1.0 - nu) * (kp * kp - 1.0) / (kp + ks) * whole * std::pow(r0, kp - 1.0) *
                         std::pow(r0, ks + 1.0) +
                     ((1.0 - nu) * (kp * ks + 1.0) / (kp + ks) - nu) * whole;
  return chi / (2.0 * e.mu);
}

TEST(ZoneProblems, AHoleInYieldingRockClosesAsSalenconSays) {
  const double degree = std::numbers::pi / 180.0, g = 2.8e9, bulk = 3.9e9, p0 = 30e6, c = 3.45e6;
  const IsotropicElasticity e{bulk - 2.0 / 3.0 * g, g};
  constexpr double outer = 15.0;
  for (const double psi : {0.0, 30.0}) {
    const MeshSize size = [](Vec2 p) { return 0.1 + 0.16 * (norm(p) - 1.0); };
    Ring ring;
    constexpr int pieces = 16;
    for (int k = 0; k <= pieces; ++k) {
      const double angle = 0.5 * std::numbers::pi * (pieces - k) / pieces;
      ring.push_back({std::cos(angle), std::sin(angle)});
    }
    ring.push_back({outer, 0.0});
    for (int k = 1; k <= pieces; ++k) {
      const double angle = 0.5 * std::numbers::pi * k / pieces;
      ring.push_back({outer * std::cos(angle), outer * std::sin(angle)});
    }
    const std::vector<Ring> rings{divided(ring, size)};
    Body b(mesh_polygon(rings, size), rock_that_yields(e, {30 * degree, psi * degree, c, 1e9}),
           {-p0, -p0, -p0, 0.0}, true);
    std::vector<Vec2> wall(b.x.size());
    const Ring& r = rings[0];
    for (std::size_t k = 0; k < r.size(); ++k) {
      const std::size_t next = (k + 1) % r.size();
      const Vec2 u = r[next] - r[k], half = (-0.5 * p0) * Vec2{u.y, -u.x};
      const bool inner = norm(0.5 * (r[k] + r[next])) < 1.01 && r[k] != Vec2{1.0, 0.0};
      for (const std::size_t n : {k, next}) {
        b.load[n] += half;
        if (inner) wall[n] += half;
      }
    }
    for (std::size_t n = 0; n < b.x.size(); ++n) {
      if (b.x[n].x < 1e-9) b.fixed[n].x = 0.0;
      if (b.x[n].y < 1e-9) b.fixed[n].y = 0.0;
    }
    const std::vector<Vec2> whole = b.load;
    constexpr int slowly = 6000;
    b.rest(
        2e-5, 60000,
        [&](int n) {
          const double part = std::min(1.0, static_cast<double>(n) / slowly);
          for (std::size_t i = 0; i < b.x.size(); ++i) b.load[i] = whole[i] - part * wall[i];
        },
        slowly);
    double closure = 0.0;
    int count = 0;
    for (std::size_t n = 0; n < r.size(); ++n) {
      if (std::abs(norm(b.mesh.nodes[n]) - 1.0) > 1e-3) continue;
      closure -= dot(b.x[n] - b.mesh.nodes[n], b.mesh.nodes[n]);
      ++count;
    }
    closure /= count;
    const double exact = salencon(e, p0, c, 30 * degree, psi * degree);
    EXPECT_NEAR(closure / exact, 1.0, 0.03) << psi;
  }
}

}  // namespace
}  // namespace edda::zone_problems_test
