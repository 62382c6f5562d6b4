#include "blocks/cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace edda {
namespace {

static_assert(nodes_per_block == 3, "a cover is a triangle");

constexpr double third_turn = 2.0 * std::numbers::pi / 3.0;

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

std::vector<Vec2> convex_hull(std::span<const Vec2> ring) {
  std::vector<Vec2> p(ring.begin(), ring.end());
  std::sort(p.begin(), p.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (Vec2 q : p) {
      while (hull.size() >= base + 2 &&
             cross(hull.back() - hull[hull.size() - 2], q - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

/// Inradius of the centred equilateral triangle that contains the hull, with side normals at
/// `angle` and at 120 degrees to it.
double inradius_at(std::span<const Vec2> hull, Vec2 centroid, double angle) {
  double r = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec2 n = direction(angle + k * third_turn);
    for (Vec2 p : hull) r = std::max(r, dot(p - centroid, n));
  }
  return r;
}

Vec2 support(std::span<const Vec2> hull, Vec2 centroid, Vec2 n) {
  Vec2 best = hull[0] - centroid;
  for (Vec2 p : hull) {
    if (dot(p - centroid, n) > dot(best, n)) best = p - centroid;
  }
  return best;
}

}  // namespace

Cover matched_cover(const Moments& m) {
  // Symmetric square root of T = 2 S / M: (T + s I) / t with s = sqrt(det T), t = sqrt(tr T + 2 s).
  const double txx = 2.0 * m.sxx / m.area, tyy = 2.0 * m.syy / m.area, txy = 2.0 * m.sxy / m.area;
  const double s = std::sqrt(std::max(0.0, txx * tyy - txy * txy));
  const double t = std::sqrt(txx + tyy + 2.0 * s);
  const double axx = (txx + s) / t, ayy = (tyy + s) / t, axy = txy / t;
  Cover cover;
  for (int k = 0; k < 3; ++k) {
    const Vec2 e = direction(std::numbers::pi / 2.0 + k * third_turn);
    cover[static_cast<std::size_t>(k)] =
        m.centroid + Vec2{axx * e.x + axy * e.y, axy * e.x + ayy * e.y};
  }
  return cover;
}

Cover covering_cover(std::span<const Vec2> ring, Vec2 centroid) {
  // r(angle) is the largest of three support functions, each a sinusoid between the normals of two
  // hull edges. The sinusoids are concave where they are the largest, so the least r lies either at
  // an edge normal or where two of the three intersect. All of these are tried.
  const std::vector<Vec2> hull = convex_hull(ring);
  std::vector<double> breaks;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 t = hull[(i + 1) % hull.size()] - hull[i];
    const double a = std::atan2(-t.x, t.y);
    breaks.push_back(a - third_turn * std::floor(a / third_turn));
  }
  std::sort(breaks.begin(), breaks.end());
  double best_angle = 0.0, best = std::numeric_limits<double>::infinity();
  auto consider = [&](double angle) {
    const double r = inradius_at(hull, centroid, angle);
    if (r < best) {
      best = r;
      best_angle = angle;
    }
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double lo = breaks[i];
    const double hi = i + 1 < breaks.size() ? breaks[i + 1] : breaks[0] + third_turn;
    consider(lo);
    if (hi - lo < 1e-14) continue;
    // In (lo, hi) the three supporting vertices q_k are fixed: r_k = q_k . direction(angle + k
    // third).
    std::array<Vec2, 3> q;
    for (int k = 0; k < 3; ++k) {
      const double shift = k * third_turn;
      q[static_cast<std::size_t>(k)] =
          rotated(support(hull, centroid, direction(0.5 * (lo + hi) + shift)), -shift);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 diff = q[k] - q[(k + 1) % 3];
      const double a = std::atan2(-diff.x, diff.y);
      for (int half = -4; half <= 4; ++half) {
        const double angle = a + half * std::numbers::pi;
        if (angle > lo && angle < hi) consider(angle);
      }
    }
  }
  // Corners lie opposite the sides, at twice the inradius.
  Cover cover;
  for (int k = 0; k < 3; ++k) {
    const double angle = best_angle + std::numbers::pi + k * third_turn;
    cover[static_cast<std::size_t>(k)] = centroid + 2.0 * best * direction(angle);
  }
  return cover;
}

NodeVectors gradients(const Cover& cover) {
  const double twice_area = cross(cover[1] - cover[0], cover[2] - cover[0]);
  NodeVectors g{};
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec2 side = cover[(k + 2) % 3] - cover[(k + 1) % 3];
    g[k] = perp(side) / twice_area;
    g[0] -= g[k];
  }
  return g;
}

std::array<double, 6> consistent_mass(const Moments& m, const NodeVectors& gradient,
                                      const NodeWeights& centroid_weight) {
  std::array<double, 6> mass{};
  std::size_t entry = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t l = k; l < 3; ++l) {
      const Vec2 a = gradient[k], b = gradient[l];
      const double spread =
          (a.x * m.sxx * b.x + a.y * m.syy * b.y + m.sxy * (a.x * b.y + a.y * b.x)) / m.area;
      mass[entry++] = centroid_weight[k] * centroid_weight[l] + spread;
    }
  }
  return mass;
}

std::array<double, 6> inverse_symmetric(const std::array<double, 6>& a) {
  const auto [a11, a12, a13, a22, a23, a33] = a;
  const double c11 = a22 * a33 - a23 * a23;
  const double c12 = a13 * a23 - a12 * a33;
  const double c13 = a12 * a23 - a13 * a22;
  const double det = a11 * c11 + a12 * c12 + a13 * c13;
  return {c11 / det,
          c12 / det,
          c13 / det,
          (a11 * a33 - a13 * a13) / det,
          (a12 * a13 - a11 * a23) / det,
          (a11 * a22 - a12 * a12) / det};
}

}  // namespace edda
