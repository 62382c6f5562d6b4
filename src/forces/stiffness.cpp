#include "forces/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/gap.hpp"
#include "forces/block_matrices.hpp"
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
  for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
    const Id k = c.block_entry[q] >> 1;
    const EdgeFrame e =
        edge_frame(at(pose.x, pose.y, c.edge[k]), at(pose.x, pose.y, c.edge_end[k]));
    if (!counts(c, b, pose, k, e)) continue;
    const bool has_vertex = (c.block_entry[q] & 1u) == 0;
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
  }
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

struct BlockBound {
  double omega2 = 0.0;
  double likely = std::numeric_limits<double>::infinity();
  double step = std::numeric_limits<double>::infinity();
  Id contact = no_id;
  double elastic = 0.0, contacts = 0.0, boundary = 0.0;
};

/// (2/w)(sqrt(1 + x^2) - x), x = zeta w / (lowest contact frequency of the block).
double damped_step(double omega, const Damping& damping, double lowest) {
  const double x = damping.contact > 0.0 ? damping.contact * omega / lowest : 0.0;
  const double step = 2.0 / omega * (std::sqrt(1.0 + x * x) - x);
  return damping.mass > 0.0 ? std::min(step, 1.0 / damping.mass) : step;
}

BlockBound bound_of(const BlockSet& b, const State& s, const Pose& pose, const ContactSet& c,
                    const BoundarySprings& springs, const LawTable& laws, const Damping& damping,
                    std::size_t i) {
  const std::vector<Part> parts = parts_of(b, s, pose, c, i);
  const Matrix6 elastic = elastic_matrix(b, i),
                boundary = boundary_matrix(b, springs, rotation(deformation(b, s.x, s.y, i)), i);
  Matrix6 k = elastic + boundary;
  double lowest2 = std::numeric_limits<double>::infinity();
  for (const Part& p : parts) {
    k += p.kn * p.normal * p.normal.transpose() + p.ks * p.tangent * p.tangent.transpose();
    if (damping.contact > 0.0) {
      const double xi = 0.5;
      lowest2 = std::min(lowest2, c.kn[p.contact] * inverse_contact_mass(b, c, p.contact, xi));
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(k, mass_matrix(b, i));
  BlockBound bound;
  const double against = 1.0 + damping.local;
  bound.omega2 = against * solver.eigenvalues()[5];
  if (!(bound.omega2 > 0.0)) return bound;
  bound.step = damped_step(std::sqrt(bound.omega2), damping, std::sqrt(lowest2));
  const Matrix6 bare = bare_corners(b, c, laws, parts, i);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> likely(k + bare, mass_matrix(b, i),
                                                                 Eigen::EigenvaluesOnly);
  bound.likely =
      damped_step(std::sqrt(against * likely.eigenvalues()[5]), damping, std::sqrt(lowest2));
  const Vector6 mode = solver.eigenvectors().col(5);
  const double total = mode.dot(k * mode);
  bound.elastic = mode.dot(elastic * mode) / total;
  bound.boundary = mode.dot(boundary * mode) / total;
  bound.contacts = 1.0 - bound.elastic - bound.boundary;
  double largest = 0.0;
  for (const Part& p : parts) {
    const double hn = p.normal.dot(mode), ht = p.tangent.dot(mode);
    const double part = p.kn * hn * hn + p.ks * ht * ht;
    if (part > largest) {
      largest = part;
      bound.contact = p.contact;
    }
  }
  return bound;
}

}  // namespace

StepBound step_bound(const BlockSet& b, const State& s, const Pose& pose, const ContactSet& c,
                     const BoundarySprings& springs, const LawTable& laws, const Damping& damping) {
  std::vector<BlockBound> bounds(b.size());
  parallel_for(b.size(), [&](std::size_t i) {
    if (!b.fixed[i] && s.alive[i]) bounds[i] = bound_of(b, s, pose, c, springs, laws, damping, i);
  });
  StepBound result;
  result.critical_step = result.likely_step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double likely = std::min(result.likely_step, bounds[i].likely);
    if (bounds[i].step < result.critical_step) {
      result = {bounds[i].step,     likely,
                static_cast<Id>(i), bounds[i].contact,
                bounds[i].elastic,  bounds[i].contacts,
                bounds[i].boundary};
    }
    result.likely_step = likely;
  }
  return result;
}

}  // namespace edda
