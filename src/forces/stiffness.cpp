#include "forces/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/gap.hpp"
#include "forces/block_matrices.hpp"
#include "forces/bolt_matrix.hpp"
#include "forces/contact_forces.hpp"

namespace edda {
namespace {

/// Contribution of one contact to one block.
struct Part {
  Id contact;
  Vector6 normal, tangent;  ///< h, k in the block's frame
  double kn, ks;            ///< with the factor 1 or 2
};

/// May carry before the list is made anew.
bool counts(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k,
            const EdgeFrame& e) {
  if (c.is(k, contact_state::closed)) return true;
  if (c.why[k] == Blocked::shield) return false;
  return c.on_edge(k, c.reach) && facing(b, pose.x, pose.y, c.vertex[k], e.normal(), 0.5 * c.reach);
}

std::vector<Part> parts_of(const BlockSet& b, const State& s, const Pose& pose, const ContactSet& c,
                           std::size_t i) {
  const Rotation r = rotation(deformation(b, s.x, s.y, i));
  auto back = [&](Vec2 u) { return Vec2{r.c * u.x + r.s * u.y, -r.s * u.x + r.c * u.y}; };
  std::vector<Part> parts;
  c.for_contacts(b, i, [&](Id k, bool has_vertex) {
    const EdgeFrame e =
        edge_frame(at(pose.x, pose.y, c.edge[k]), at(pose.x, pose.y, c.edge_end[k]));
    if (!counts(c, b, pose, k, e)) return;
    const Id partner = has_vertex ? c.block_j[k] : c.block_i[k];
    // One that is letting go past the end of its edge may come back.
    const double share = c.pair_of[k] == no_id ? 1.0 : c.share[k];
    const double factor = (b.fixed[partner] ? 1.0 : 2.0) * share;
    std::array<double, 3> w = vertex_weights(b, c.vertex[k]);
    if (!has_vertex) {
      const double xi = std::clamp(c.foot[k] / e.length, 0.0, 1.0);
      const auto w2 = vertex_weights(b, c.edge[k]), w3 = vertex_weights(b, c.edge_end[k]);
      for (std::size_t n = 0; n < 3; ++n) w[n] = (1.0 - xi) * w2[n] + xi * w3[n];
    }
    parts.push_back(
        {k, along(w, back(e.normal())), along(w, back(e.t)), factor * c.kn[k], factor * c.ks[k]});
  });
  return parts;
}

/// Contacts that bare corners would make: a block in motion meets its neighbours corner first, and
/// a step chosen with that in mind need not change when it does.
Matrix6 bare_corners(const BlockSet& b, const ContactSet& c, const LawTable& laws,
                     const std::vector<Part>& parts, std::size_t i) {
  Matrix6 k = Matrix6::Zero();
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    const bool touches = std::any_of(parts.begin(), parts.end(),
                                     [&](const Part& p) { return c.vertex[p.contact] == v; });
    if (touches || b.corner[v] > 3.0) continue;
    const Law& law = laws.rows[laws.resolve(b.edge_joint[v], b.edge_joint[b.previous[v]])];
    const double length = 0.5 * std::max(b.edge_length[v], b.edge_length[b.previous[v]]);
    const double kn = laws.thickness * (law.kn > 0.0 ? law.kn * length : laws.default_kn);
    const double ks = laws.thickness * (law.ks > 0.0 ? law.ks * length : laws.default_ks);
    for (const Vec2 n : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
      const Vector6 h = along(vertex_weights(b, v), n);
      k += std::max(kn, ks) * 2.0 * h * h.transpose();
    }
  }
  return k;
}

/// Stiffness of one block with all that may act on it.
struct BlockStiffness {
  std::vector<Part> parts;
  Matrix6 elastic, boundary, bolts;
  Matrix6 all;                                               ///< with the contacts
  double lowest2 = std::numeric_limits<double>::infinity();  ///< contact frequency^2, with damping
};

/// What a step bound looks at.
struct Scene {
  const BlockSet& b;
  const State& s;
  const Pose& pose;
  const ContactSet& c;
  const BoundarySprings& springs;
  const LawTable& laws;
  const Damping& damping;
  const Bolts* bolts;
};

BlockStiffness stiffness_of(const Scene& w, std::size_t i) {
  BlockStiffness k;
  k.parts = parts_of(w.b, w.s, w.pose, w.c, i);
  k.elastic = elastic_matrix(w.b, i);
  k.boundary = boundary_matrix(w.b, w.springs, rotation(deformation(w.b, w.s.x, w.s.y, i)), i);
  k.bolts = w.bolts == nullptr ? Matrix6::Zero().eval() : bolt_matrix(*w.bolts, w.b, w.s, i);
  k.all = k.elastic + k.boundary + k.bolts;
  for (const Part& p : k.parts) {
    k.all += p.kn * p.normal * p.normal.transpose() + p.ks * p.tangent * p.tangent.transpose();
    if (w.damping.contact > 0.0) {
      const double xi = 0.5;
      k.lowest2 =
          std::min(k.lowest2, w.c.kn[p.contact] * inverse_contact_mass(w.b, w.c, p.contact, xi));
    }
  }
  return k;
}

/// (2/w)(sqrt(1 + x^2) - x), x = zeta w / (lowest contact frequency of the block).
double damped_step(double omega2, const Damping& damping, double lowest2) {
  const double omega = std::sqrt((1.0 + damping.local) * omega2);
  const double x = damping.contact > 0.0 ? damping.contact * omega / std::sqrt(lowest2) : 0.0;
  const double step = 2.0 / omega * (std::sqrt(1.0 + x * x) - x);
  return damping.mass > 0.0 ? std::min(step, 1.0 / damping.mass) : step;
}

double largest_eigenvalue(const Matrix6& k, const Matrix6& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(k, mass, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[5];
}

/// Not below the largest eigenvalue of M^-1 K, and at most 6^(1/16) times it: with A = L^-1 K L^-T,
/// M = L L^T, the root (tr A^16)^(1/16).
double eigenvalue_bound(const Matrix6& k, const Eigen::LLT<Matrix6>& mass) {
  Matrix6 a = mass.matrixL().solve(k);
  a = mass.matrixL().solve(a.transpose().eval()).eval();
  const double size = a.trace();
  if (!(size > 0.0) || !std::isfinite(size)) return std::numeric_limits<double>::infinity();
  a /= size;
  for (int square = 0; square < 3; ++square) a = (a * a).eval();
  constexpr double rounding = 1e-9;
  return (1.0 + rounding) * size * std::pow(a.squaredNorm(), 1.0 / 16.0);
}

/// The step of one block, and what it would be with bare corners; from below, or exact.
struct BlockSteps {
  double step = std::numeric_limits<double>::infinity();
  double likely = std::numeric_limits<double>::infinity();
};

BlockSteps estimate(const Scene& w, std::size_t i) {
  const BlockStiffness k = stiffness_of(w, i);
  const Eigen::LLT<Matrix6> mass(mass_matrix(w.b, i));
  const Matrix6 bare = bare_corners(w.b, w.c, w.laws, k.parts, i);
  return {damped_step(eigenvalue_bound(k.all, mass), w.damping, k.lowest2),
          damped_step(eigenvalue_bound(k.all + bare, mass), w.damping, k.lowest2)};
}

double exact_step(const Scene& w, std::size_t i, bool with_bare_corners) {
  BlockStiffness k = stiffness_of(w, i);
  if (with_bare_corners) k.all += bare_corners(w.b, w.c, w.laws, k.parts, i);
  const double omega2 = largest_eigenvalue(k.all, mass_matrix(w.b, i));
  return omega2 > 0.0 ? damped_step(omega2, w.damping, k.lowest2)
                      : std::numeric_limits<double>::infinity();
}

struct Smallest {
  double step = std::numeric_limits<double>::infinity();
  Id block = no_id;
};

/// The smallest exact step, and the first block that has it: worked out only for blocks whose
/// `estimates` from below leave it open.
Smallest smallest_step(const Scene& w, const std::vector<double>& estimates,
                       bool with_bare_corners) {
  const auto first = std::min_element(estimates.begin(), estimates.end());
  if (first == estimates.end() || !(*first < std::numeric_limits<double>::infinity())) return {};
  const double known =
      exact_step(w, static_cast<std::size_t>(first - estimates.begin()), with_bare_corners);
  std::vector<Id> open;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (estimates[i] <= known) open.push_back(static_cast<Id>(i));
  }
  std::vector<double> exact(open.size());
  parallel_for(open.size(),
               [&](std::size_t q) { exact[q] = exact_step(w, open[q], with_bare_corners); });
  Smallest found;
  for (std::size_t q = 0; q < open.size(); ++q) {
    if (exact[q] < found.step) found = {exact[q], open[q]};
  }
  return found;
}

/// Whose stiffness it is that holds block i's step.
void explain(StepBound& bound, const Scene& w, std::size_t i) {
  const BlockStiffness k = stiffness_of(w, i);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(k.all, mass_matrix(w.b, i));
  const Vector6 mode = solver.eigenvectors().col(5);
  const double total = mode.dot(k.all * mode);
  bound.elastic_part = mode.dot(k.elastic * mode) / total;
  bound.boundary_part = mode.dot(k.boundary * mode) / total;
  bound.bolt_part = mode.dot(k.bolts * mode) / total;
  bound.contact_part = 1.0 - bound.elastic_part - bound.boundary_part - bound.bolt_part;
  double largest = 0.0;
  for (const Part& p : k.parts) {
    const double hn = p.normal.dot(mode), ht = p.tangent.dot(mode);
    const double part = p.kn * hn * hn + p.ks * ht * ht;
    if (part > largest) {
      largest = part;
      bound.contact = p.contact;
    }
  }
}

}  // namespace

StepBound step_bound(const BlockSet& b, const State& s, const Pose& pose, const ContactSet& c,
                     const BoundarySprings& springs, const LawTable& laws, const Damping& damping,
                     const Bolts* bolts) {
  const Scene scene{b, s, pose, c, springs, laws, damping, bolts};
  std::vector<double> step(b.size(), std::numeric_limits<double>::infinity()), likely = step;
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const BlockSteps e = estimate(scene, i);
    step[i] = e.step;
    likely[i] = e.likely;
  });
  const Smallest critical = smallest_step(scene, step, false);
  StepBound bound;
  bound.critical_step = critical.step;
  bound.likely_step = smallest_step(scene, likely, true).step;
  bound.block = critical.block;
  if (bound.block != no_id) explain(bound, scene, bound.block);
  return bound;
}

std::vector<double> steps_of_blocks(const BlockSet& b, const State& s, const Pose& pose,
                                    const ContactSet& c, const BoundarySprings& springs,
                                    const LawTable& laws, const Damping& damping, double limit,
                                    const Bolts* bolts) {
  const Scene scene{b, s, pose, c, springs, laws, damping, bolts};
  std::vector<double> step(b.size(), std::numeric_limits<double>::infinity());
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    step[i] = estimate(scene, i).likely;
    if (step[i] < limit) step[i] = exact_step(scene, i, true);
  });
  return step;
}

}  // namespace edda
