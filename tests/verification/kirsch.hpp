// A circular opening in a mass of strongly bonded Voronoi blocks: validation.md row 38.
#pragma once

#include <algorithm>
#include <array>

#include "model/read_model.hpp"
#include "observe/observe.hpp"
#include "run/run_model.hpp"
#include "verification/models.hpp"

namespace edda::kirsch {

inline constexpr double joints = 2.0;  // stiffness of a joint over that of the blocks beside it
inline constexpr double radius = 1.0, fine_to = 4.0, far = 16.0;  // m
inline constexpr double young = 20e9, poisson = 0.25;
/// Far-field stresses, compression positive: horizontal and vertical.
inline constexpr double px = 10e6, py = 20e6;

/// Elastic constants of the mass as a whole, in plane strain.
struct Mass {
  double shear_modulus = 0.0;  ///< Pa
  double poisson = 0.0;
};

/// Kirsch (1898) with the total stress: tension positive, t from +x.
struct Polar {
  double rr, tt, rt;
};
inline Polar exact_stress(double r, double t) {
  const double p = 0.5 * (px + py), d = 0.5 * (px - py), q = radius * radius / (r * r);
  const double c = std::cos(2.0 * t), s = std::sin(2.0 * t);
  return {-(p * (1.0 - q) + d * (1.0 - 4.0 * q + 3.0 * q * q) * c),
          -(p * (1.0 + q) - d * (1.0 + 3.0 * q * q) * c), d * (1.0 + 2.0 * q - 3.0 * q * q) * s};
}
/// Inward displacement of the wall due to the excavation.
inline double exact_convergence(const Mass& m, double t) {
  const double p = 0.5 * (px + py), d = 0.5 * (px - py);
  return radius / (2.0 * m.shear_modulus) * (p + d * (3.0 - 4.0 * m.poisson) * std::cos(2.0 * t));
}

/// Blocks of this size, and joints whose compliance is a fixed fraction of that of the blocks: the
/// moduli of the mass are the same for every size. (A block's strain is uniform, so a mass of
/// blocks with rigid joints could not bend at all: it is finely divided when the stiffness of the
/// joints over that of the rock, times (block/radius)^2, is small.)
inline std::string mass_of(double size) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2700.0\nyoung = " + number(young) +
         "\npoisson = " + number(poisson) +
         "\n[joints.j]\ntype = 'glued'\nkn = " + number(joints * young / size) +
         "\nks = " + number(0.4 * joints * young / size) +
         "\n[quality]\nmin_edge = " + number(0.05 * size) + "\n";
}
inline std::string until_equilibrium(double ratio, const std::string& solver) {
  return "[[stage]]\nuntil = 'equilibrium'\nratio = " + number(ratio) +
         "\nduration = 2.0\n[solver]\n" + solver;
}
/// Small blocks do not govern the step, since their speed on the way to equilibrium has no meaning.
inline std::string in_steps_for(double size) {
  return "mass_scaling = " + number(0.15 * size / std::sqrt(young / 2700.0)) + "\n";
}
inline std::string ring(double r, int corners) {
  std::string text = "[";
  for (int k = 0; k < corners; ++k) {
    const double t = 2.0 * std::numbers::pi * k / corners;
    text += (k > 0 ? ", [" : "[") + number(r * std::cos(t)) + ", " + number(r * std::sin(t)) + "]";
  }
  return text + "]";
}

/// A ring as a line that ends where it begins.
inline std::string closed_ring(double r, int corners) {
  std::string points = ring(r, corners);
  return points.insert(points.size() - 1, ", [" + number(r) + ", 0]");
}

inline Simulation settled(const std::string& toml) {
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/kirsch.toml", {});
  if (!model.ok()) {
    for (const Fault& f : model.faults()) ADD_FAILURE() << to_string(f);
    std::abort();
  }
  Result<PreparedRun> run = prepare_run(std::move(model.value()));
  if (!run.ok()) {
    for (const Fault& f : run.faults()) ADD_FAILURE() << to_string(f);
    std::abort();
  }
  const Result<Outcome> outcome = run_model(run.value(), {});
  EXPECT_TRUE(outcome.ok() && outcome.value().status == Status::equilibrium)
      << (outcome.ok() ? outcome.value().message : "");
  return std::move(run.value().sim);
}

/// Displacement gradient of the blocks whose centroid lies within `half` of the middle, by least
/// squares.
inline Tensor mean_strain(const Simulation& sim, double half) {
  double n = 0.0, sx = 0.0, sy = 0.0;
  Vec2 su;
  const BlockSet& b = sim.scene->blocks;
  const auto each = [&](auto visit) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      const Vec2 p = Vec2{b.centroid_x[i], b.centroid_y[i]} + b.origin;
      if (std::abs(p.x) < half && std::abs(p.y) < half) visit(p, displacement(sim, i), b.area[i]);
    }
  };
  each([&](Vec2 p, Vec2 u, double w) {
    n += w;
    sx += w * p.x;
    sy += w * p.y;
    su += w * u;
  });
  double xx = 0.0, xy = 0.0, yy = 0.0;
  Vec2 ux, uy;
  each([&](Vec2 p, Vec2 u, double w) {
    const double x = p.x - sx / n, y = p.y - sy / n;
    xx += w * x * x;
    xy += w * x * y;
    yy += w * y * y;
    ux += w * x * (u - su / n);
    uy += w * y * (u - su / n);
  });
  const double det = xx * yy - xy * xy;
  return {(yy * ux.x - xy * uy.x) / det, (xx * uy.y - xy * ux.y) / det, 0.0};
}

/// A square of the same mass, compressed horizontally and then vertically.
inline Mass test_mass(double size) {
  const double half = 12.0 * size, p = 1e6;
  double difference = 0.0, across = 0.0;
  for (const bool along_x : {true, false}) {
    const Simulation sim =
        settled(mass_of(size) + "[domain]\noutline = " + rectangle(-half, -half, half, half) +
                "\n[voronoi]\nsize = " + number(size) + "\nseed = 3\n" +
                "[[boundary]]\nsides = ['" + (along_x ? "left" : "bottom") +
                "']\ntype = 'stress'\ntraction = " + (along_x ? "[1e6, 0]" : "[0, 1e6]") +
                "\n[[boundary]]\nsides = ['" + (along_x ? "right" : "top") +
                "']\ntype = 'stress'\ntraction = " + (along_x ? "[-1e6, 0]" : "[0, -1e6]") + "\n" +
                until_equilibrium(1e-4, in_steps_for(size)));
    const Tensor e = mean_strain(sim, 0.75 * half);
    const double main = along_x ? e.xx : e.yy, other = along_x ? e.yy : e.xx;
    difference += -0.5 * (main - other) / p;
    across += 0.5 * other / p;
  }
  // e_x = -p (1 - nu)/2G, e_y = p nu/2G.
  return {0.5 / difference, across / difference};
}

/// The opening cut at once from rock under stress, brought to equilibrium.
inline Simulation opening(double size) {
  // Blocks further out are twice as large relative to their distance.
  const double angle = 2.0 * size / fine_to;
  const int corners = 4 * static_cast<int>(std::lround(0.5 * std::numbers::pi / angle));
  const int rings = static_cast<int>(std::lround(std::log(far / fine_to) / angle));
  std::string toml =
      mass_of(size) + "[domain]\noutline = " + ring(far, corners) +
      "\n[voronoi]\nsize = " + number(size) + "\nseed = 3\nregion = " + ring(fine_to, corners) +
      "\n[[opening]]\nname = 'hole'\nshape = { kind = 'circle', at = [0, 0], width = " +
      number(2.0 * radius) + ", segments = 64 }\n[initial_stress]\nstress = [" + number(-px) +
      ", " + number(-py) + ", 0]\n[[boundary]]\nalong = " + closed_ring(far, corners) +
      "\ntype = 'fixed'\n" + until_equilibrium(1e-4, in_steps_for(size));
  // Further out, blocks grow with the distance, and the compliance of their joints grows with them:
  // a law for each ring.
  const double growth = std::pow(far / fine_to, 1.0 / rings);
  std::string laws;
  double r = fine_to;
  for (int k = 0; k < rings; ++k, r *= growth) {
    const std::string law = "ring" + std::to_string(k);
    const double kn = joints * young / (r * (growth - 1.0));
    laws += "[joints." + law + "]\ntype = 'glued'\nkn = " + number(kn) +
            "\nks = " + number(0.4 * kn) + "\n";
    if (k > 0) {
      toml += "[[trace]]\njoint = '" + law + "'\npoints = " + closed_ring(r, corners) + "\n";
    }
    for (int q = 0; q < corners; ++q) {
      const double t = 2.0 * std::numbers::pi * q / corners, c = std::cos(t), n = std::sin(t);
      toml += "[[trace]]\njoint = '" + law + "'\npoints = [[" + number(r * c) + ", " +
              number(r * n) + "], [" + number(r * growth * c) + ", " + number(r * growth * n) +
              "]]\n";
    }
  }
  toml.replace(toml.find("[domain]"), 8, laws + "[domain]\njoint = 'j'");
  return settled(toml);
}

/// Means of rr and tt over a ring of blocks, and their components in cos 2t.
struct Harmonics {
  double rr = 0.0, rr2 = 0.0, tt = 0.0, tt2 = 0.0;
};

class RingFit {
 public:
  void add(double t, const Polar& p, double weight) {
    const double c = std::cos(2.0 * t);
    n_ += weight;
    c_ += weight * c;
    cc_ += weight * c * c;
    sum_[0] += weight * p.rr;
    sum_[1] += weight * c * p.rr;
    sum_[2] += weight * p.tt;
    sum_[3] += weight * c * p.tt;
  }
  Harmonics fit() const {
    const double det = n_ * cc_ - c_ * c_;
    const auto mean = [&](std::size_t k) { return (cc_ * sum_[k] - c_ * sum_[k + 1]) / det; };
    const auto second = [&](std::size_t k) { return (n_ * sum_[k + 1] - c_ * sum_[k]) / det; };
    return {mean(0), second(0), mean(2), second(2)};
  }

 private:
  double n_ = 0.0, c_ = 0.0, cc_ = 0.0;
  std::array<double, 4> sum_{};
};

/// Errors outside the first ring of blocks: the largest, of the profiles along x and y over the
/// exact hoop stress; and the root of the mean of their squares.
struct Errors {
  double radial = 0.0, hoop = 0.0;
  double profile = 0.0;  ///< mean, radial and hoop
  double convergence =
      0.0;  ///< largest of the convergence of the wall, horizontal and vertical, over the exact one
};

inline Polar polar(const BlockStress& s, double t) {
  const double c = std::cos(t), n = std::sin(t);
  return {s.xx * c * c + s.yy * n * n + 2.0 * s.xy * c * n,
          s.xx * n * n + s.yy * c * c - 2.0 * s.xy * c * n,
          (s.yy - s.xx) * c * n + s.xy * (c * c - n * n)};
}

inline Errors compare(const Simulation& sim, const Mass& mass, double size) {
  constexpr double bound = 0.1;
  const std::string label = "blocks of " + brief(size) + " radii";
  const BlockSet& b = sim.scene->blocks;
  Errors e;
  double squares = 0.0;
  int count = 0;
  Series profile(38, label,
                 {"r", "rr x exact", "rr x", "tt x exact", "tt x", "rr y exact", "rr y",
                  "tt y exact", "tt y"});
  // Rings as wide as a block, the first of them the blocks at the wall.
  for (double from = radius + size; from + size <= fine_to - size; from += size) {
    RingFit computed, exact;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const Vec2 p = Vec2{b.centroid_x[i], b.centroid_y[i]} + b.origin;
      const double r = norm(p), t = std::atan2(p.y, p.x);
      if (r < from || r >= from + size) continue;
      computed.add(t, polar(block_stress(sim, sim.motion.state, i), t), b.area[i]);
      exact.add(t, exact_stress(r, t), b.area[i]);
    }
    const Harmonics c = computed.fit(), x = exact.fit();
    profile.add({from + 0.5 * size, x.rr + x.rr2, c.rr + c.rr2, x.tt + x.tt2, c.tt + c.tt2,
                 x.rr - x.rr2, c.rr - c.rr2, x.tt - x.tt2, c.tt - c.tt2});
    for (const double side : {1.0, -1.0}) {
      const double scale = std::abs(x.tt + side * x.tt2);
      const double hoop = (c.tt - x.tt + side * (c.tt2 - x.tt2)) / scale;
      const double radial = (c.rr - x.rr + side * (c.rr2 - x.rr2)) / scale;
      keep_largest(e.hoop, hoop);
      keep_largest(e.radial, radial);
      squares += hoop * hoop + radial * radial;
      count += 2;
    }
  }
  e.profile = std::sqrt(squares / count);
  // The wall: mean and second harmonic of its inward displacement.
  RingFit wall;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const Vec2 p = Vec2{b.vertex_x[v], b.vertex_y[v]} + b.origin;
    if (norm(p) > radius * 1.0001) continue;
    const Vec2 u{sim.motion.pose.x[v] - b.vertex_x[v], sim.motion.pose.y[v] - b.vertex_y[v]};
    wall.add(std::atan2(p.y, p.x), {-dot(u, p) / norm(p), 0.0, 0.0}, 1.0);
  }
  const Harmonics w = wall.fit();
  for (const double side : {1.0, -1.0}) {
    const double exact = exact_convergence(mass, side > 0.0 ? 0.0 : 0.5 * std::numbers::pi);
    const std::string where = side > 0.0 ? ", along x" : ", vertical";
    expect_relative({38, label, "convergence of the wall" + where, "m"}, w.rr + side * w.rr2, exact,
                    bound);
    keep_largest(e.convergence, (w.rr + side * w.rr2) / exact - 1.0);
  }
  expect_at_most({38, label, "hoop stress, furthest off, over the exact one", ""}, e.hoop, bound);
  expect_at_most({38, label, "radial stress, furthest off, over the exact hoop stress", ""},
                 e.radial, bound);
  record_model(38, label, sim);
  return e;
}

}  // namespace edda::kirsch
