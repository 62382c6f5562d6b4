// The ruler of tools/bench: the bare arithmetic of an explicit step on a wall in running bond, in
// double precision. One shape of brick, one friction angle, contacts listed once; no search, no
// transitions, no switching, no energy balance, no checks. A program of its own, because it is
// compiled with flags that would change the results of edda.
//   bench_kernel COLUMNS ROWS STEPS
// Prints: bricks, contacts, million brick-steps per second, ns per contact, ns per brick for the
// rest.
#include <omp.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "stopwatch.hpp"

namespace {

using Index = std::int32_t;
using Values = std::vector<double>;

constexpr double length = 1.0, height = 0.5;                     // m
constexpr double young = 20e9, poisson = 0.2, stiffness = 2e11;  // Pa, N/m
constexpr double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
constexpr double shear_modulus = 0.5 * young / (1 + poisson);
constexpr double volume = length * height, node_mass = 2600.0 * volume / 3.0;
constexpr double gravity = -9.81, step = 2e-6;

/// What all bricks have in common: gradients of the area coordinates, and their values at the four
/// corners, counter-clockwise from the lower left.
struct Shape {
  std::array<double, 3> node_x, node_y, grad_x, grad_y;
  std::array<std::array<double, 3>, 4> weight;
};

Shape brick() {
  Shape s{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double turn = std::numbers::pi * (0.5 + 2.0 / 3.0 * static_cast<double>(k));
    s.node_x[k] = length / std::sqrt(6.0) * std::cos(turn);
    s.node_y[k] = height / std::sqrt(6.0) * std::sin(turn);
  }
  const auto& [x, y] = std::pair(s.node_x, s.node_y);
  const double det = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    s.grad_x[k] = (y[p] - y[q]) / det;
    s.grad_y[k] = (x[q] - x[p]) / det;
    for (std::size_t v = 0; v < 4; ++v) {
      const double px = (v == 1 || v == 2 ? 0.5 : -0.5) * length;
      const double py = (v >= 2 ? 0.5 : -0.5) * height;
      s.weight[v][k] = 1.0 / 3.0 + s.grad_x[k] * px + s.grad_y[k] * py;
    }
  }
  return s;
}

/// A contact of a brick: with one of its corners (of which the second weight is zero), or with the
/// edge between two of them.
struct Entry {
  Index contact;
  std::uint8_t corner, on_edge;
};

struct Wall {
  Shape shape = brick();
  Index columns = 0, bricks = 0;
  std::array<Values, 3> x, y, vx, vy;    // [bricks] nodes
  Values px, py;                         // [4 bricks] corners
  std::vector<Index> vertex, edge, end;  // [contacts] P1, P2, P3
  Values anchor, foot, fx, fy;           // [contacts]
  std::vector<Index> begin;              // [bricks + 1]
  std::vector<Entry> entries;

  Wall(Index wide, Index high);
  void contacts_at_step();
  void bricks_at_step();
  void step_once() {
    contacts_at_step();
    bricks_at_step();
  }

 private:
  void touch(Index i, Index corner, Index j, Index from);
  void list_entries();
  void place(std::size_t b);
};

void Wall::touch(Index i, Index corner, Index j, Index from) {
  vertex.push_back(4 * i + corner);
  edge.push_back(4 * j + from);
  end.push_back(4 * j + (from + 1) % 4);
}

Wall::Wall(Index wide, Index high) : columns(wide), bricks(wide * high) {
  const auto nb = static_cast<std::size_t>(bricks);
  for (std::size_t k = 0; k < 3; ++k) {
    for (Values* values : {&x[k], &y[k], &vx[k], &vy[k]}) values->assign(nb, 0.0);
  }
  px.assign(4 * nb, 0.0);
  py.assign(4 * nb, 0.0);
  for (Index row = 0; row < high; ++row) {
    for (Index column = 0; column < wide; ++column) {
      const Index b = row * wide + column;
      for (std::size_t k = 0; k < 3; ++k) {
        x[k][static_cast<std::size_t>(b)] = length * (column + 0.5 * (row % 2)) + shape.node_x[k];
        y[k][static_cast<std::size_t>(b)] = height * row + shape.node_y[k];
      }
      if (column + 1 < wide) {
        touch(b + 1, 0, b, 1);
        touch(b, 2, b + 1, 3);
      }
      if (row + 1 == high) continue;
      const Index left = column - (row % 2 == 0 ? 1 : 0);
      if (left >= 0) {
        touch(b + wide + left - column, 1, b, 2);
        touch(b, 3, b + wide + left - column, 0);
      }
      if (left + 1 < wide) {
        touch(b + wide + left + 1 - column, 0, b, 2);
        touch(b, 2, b + wide + left + 1 - column, 0);
      }
    }
  }
  anchor.assign(vertex.size(), -1.0);
  for (Values* values : {&foot, &fx, &fy}) values->assign(vertex.size(), 0.0);
  list_entries();
  for (std::size_t b = 0; b < nb; ++b) place(b);
}

void Wall::list_entries() {
  begin.assign(static_cast<std::size_t>(bricks) + 1, 0);
  const auto brick_of = [](Index corner) { return static_cast<std::size_t>(corner / 4); };
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    ++begin[brick_of(vertex[c]) + 1];
    ++begin[brick_of(edge[c]) + 1];
  }
  for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
  entries.resize(2 * vertex.size());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    const auto put = [&](Index corner, std::uint8_t on_edge) {
      entries[static_cast<std::size_t>(next[brick_of(corner)]++)] = {
          static_cast<Index>(c), static_cast<std::uint8_t>(corner % 4), on_edge};
    };
    put(vertex[c], 0);
    put(edge[c], 1);
  }
}

inline void Wall::place(std::size_t b) {
  for (std::size_t v = 0; v < 4; ++v) {
    const auto& w = shape.weight[v];
    px[4 * b + v] = w[0] * x[0][b] + w[1] * x[1][b] + w[2] * x[2][b];
    py[4 * b + v] = w[0] * y[0][b] + w[1] * y[1][b] + w[2] * y[2][b];
  }
}

/// Springs and Coulomb's limit of every contact.
void Wall::contacts_at_step() {
  const double mu = std::tan(std::numbers::pi / 6.0);
  const double *p = px.data(), *q = py.data();
  const Index *at = vertex.data(), *from = edge.data(), *to = end.data();
  double *xi0 = anchor.data(), *xi = foot.data(), *gx = fx.data(), *gy = fy.data();
  const auto n = static_cast<Index>(vertex.size());
#pragma omp for simd schedule(static)
  for (Index c = 0; c < n; ++c) {
    const double ax = p[from[c]], ay = q[from[c]];
    const double ux = p[to[c]] - ax, uy = q[to[c]] - ay;
    const double dx = p[at[c]] - ax, dy = q[at[c]] - ay;
    const double square = ux * ux + uy * uy, per_length = 1.0 / std::sqrt(square);
    const double tx = ux * per_length, ty = uy * per_length;
    const double inside = dx * ty - dy * tx, depth = inside > 0.0 ? inside : 0.0;
    const double z = (dx * tx + dy * ty) * per_length;
    const bool closed = depth > 0.0;
    const double start = closed && xi0[c] >= 0.0 ? xi0[c] : z;
    const double normal = stiffness * depth, limit = mu * normal;
    const double trial = -stiffness * (z - start) * (square * per_length);
    const double within = trial > limit ? limit : trial;
    const double shear = within < -limit ? -limit : within;
    xi0[c] = closed ? z + shear * per_length * (1.0 / stiffness) : -1.0;
    gx[c] = normal * ty + shear * tx;
    gy[c] = shear * ty - normal * tx;
    xi[c] = z;
  }
}

/// Forces on every brick, elasticity, motion, corners.
void Wall::bricks_at_step() {
  const Shape s = shape;
#pragma omp for schedule(static)
  for (Index brick_id = 0; brick_id < bricks; ++brick_id) {
    const auto b = static_cast<std::size_t>(brick_id);
    std::array<double, 3> f{}, g{gravity * node_mass, gravity * node_mass, gravity * node_mass};
    if (brick_id < columns) {
      for (std::size_t v = 0; v < 2; ++v) {
        const double depth = std::fmax(-0.5 * height - py[4 * b + v], 0.0);
        for (std::size_t k = 0; k < 3; ++k) g[k] += s.weight[v][k] * stiffness * depth;
      }
    }
    for (auto e = static_cast<std::size_t>(begin[b]); e < static_cast<std::size_t>(begin[b + 1]);
         ++e) {
      const Entry entry = entries[e];
      const auto c = static_cast<std::size_t>(entry.contact);
      const auto& w = s.weight[entry.corner];
      if (entry.on_edge != 0) {
        const auto& other = s.weight[(entry.corner + 1u) % 4];
        const double z = foot[c];
        for (std::size_t k = 0; k < 3; ++k) {
          const double part = w[k] + z * (other[k] - w[k]);
          f[k] -= part * fx[c];
          g[k] -= part * fy[c];
        }
      } else {
        for (std::size_t k = 0; k < 3; ++k) {
          f[k] += w[k] * fx[c];
          g[k] += w[k] * fy[c];
        }
      }
    }
    double f11 = 0.0, f12 = 0.0, f21 = 0.0, f22 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      f11 += x[k][b] * s.grad_x[k];
      f12 += x[k][b] * s.grad_y[k];
      f21 += y[k][b] * s.grad_x[k];
      f22 += y[k][b] * s.grad_y[k];
    }
    const double a = f11 + f22, d = f21 - f12, root = 1.0 / std::sqrt(a * a + d * d);
    const double cosine = a * root, sine = d * root;
    const double volumetric = lambda * (cosine * a + sine * d - 2.0), two_mu = 2 * shear_modulus;
    const double p11 = two_mu * (f11 - cosine) + volumetric * cosine;
    const double p12 = two_mu * (f12 + sine) - volumetric * sine;
    const double p21 = two_mu * (f21 - sine) + volumetric * sine;
    const double p22 = two_mu * (f22 - cosine) + volumetric * cosine;
    constexpr double kick = step / node_mass;
    for (std::size_t k = 0; k < 3; ++k) {
      vx[k][b] += kick * (f[k] - volume * (p11 * s.grad_x[k] + p12 * s.grad_y[k]));
      vy[k][b] += kick * (g[k] - volume * (p21 * s.grad_x[k] + p22 * s.grad_y[k]));
      x[k][b] += step * vx[k][b];
      y[k][b] += step * vy[k][b];
    }
    place(b);
  }
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  std::array<long, 3> given{};
  for (int i = 1; i < argc && i <= 3; ++i) {
    given[static_cast<std::size_t>(i) - 1] = std::strtol(argv[i], nullptr, 10);
  }
  const long columns = given[0], rows = given[1], steps = given[2];
  if (argc != 4 || columns < 1 || rows < 1 || steps < 1 || columns * rows > 100'000'000) {
    std::fprintf(stderr, "usage: bench_kernel COLUMNS ROWS STEPS\n");
    return 2;
  }
  Wall wall(static_cast<Index>(columns), static_cast<Index>(rows));
  double in_contacts = 0.0, in_all = 0.0, seconds = 0.0;
  const long warm_up = steps / 10 + 1;
#pragma omp parallel
  {
    for (long i = 0; i < warm_up; ++i) wall.step_once();
    const bool first = omp_get_thread_num() == 0;
    const Stopwatch watch(omp_get_num_threads());
    for (long i = 0; i < steps; ++i) {
      const double begin = now();
      wall.contacts_at_step();
      const double middle = now();
      wall.bricks_at_step();
      if (!first) continue;
      in_contacts += middle - begin;
      in_all += now() - begin;
    }
    if (first) seconds = watch.seconds();
  }
  const double bricks = static_cast<double>(wall.bricks),
               contacts = static_cast<double>(wall.vertex.size()),
               ns_per_step = 1e9 * seconds / static_cast<double>(steps),
               part = in_contacts / in_all;
  std::printf(
      "%d bricks, %.0f contacts, %.4f million brick-steps/s, %.2f ns/contact, %.2f ns/brick\n",
      wall.bricks, contacts, 1e3 * bricks / ns_per_step, part * ns_per_step / contacts,
      (1.0 - part) * ns_per_step / bricks);
  return 0;
}
