#include "forces/stiffness.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "forces/block_matrices.hpp"
#include "forces/bolt_matrix.hpp"

namespace edda {
namespace {

/// Contribution of one contact to one block.
struct Part {
  Id face;
  Vector6 normal, tangent;       ///< h, k in the block's frame
  double kn, ks, dashpot, drag;  ///< with the factor 1 or 2
};

/// What a step bound looks at.
struct Scene {
  const BlockSet& b;
  const State& s;
  const FaceSet& c;
  const BoundarySprings& springs;
  const LawTable& laws;
  const Damping& damping;
  const Bolts* bolts;
  const PointSet* points = nullptr;
  bool alone = std::count(b.fixed.begin(), b.fixed.end(), 0) == 1;  ///< one block moves
};

/// What decides the step of one block: that of its equations M a + (C + D) v + K x = f, seen from
/// its own frame.
struct BlockEquations {
  Matrix6 mass;
  Matrix6 viscous;                     ///< D, taken with the new velocity
  Matrix6 dashpots = Matrix6::Zero();  ///< C of contacts, taken with the old one
  Matrix6 elastic, boundary, bolts;    ///< parts of K
  Matrix6 contacts = Matrix6::Zero();
  std::vector<Part> parts;  ///< of that of contacts

  Matrix6 stiffness() const { return elastic + boundary + bolts + contacts; }
  void add(const Part& p) {
    contacts += p.kn * p.normal * p.normal.transpose() + p.ks * p.tangent * p.tangent.transpose();
    if (p.dashpot > 0.0) dashpots += p.dashpot * p.normal * p.normal.transpose();
    if (p.drag > 0.0) dashpots += p.drag * p.tangent * p.tangent.transpose();
  }
};

/// A spring that lies along a part of an edge.
struct Bedded {
  double stiffness, length;  ///< N/m per m, with the factor 1 or 2; m
  Id face;
};

/// What springs along an edge of length l make of the stiffness at each of its corners, at most:
/// they cannot lie over each other, and each is least favourable nearest to the corner, the
/// stiffest first. Int k(s) (1 - s/l) ds.
double at_each_corner(std::vector<Bedded>& beds, double l, double* count = nullptr) {
  std::stable_sort(beds.begin(), beds.end(),
                   [](const Bedded& p, const Bedded& q) { return p.stiffness > q.stiffness; });
  double sum = 0.0, from = 0.0;
  for (const Bedded& bed : beds) {
    const double to = std::min(from + bed.length / l, 1.0);
    if (count != nullptr && to > from) *count += 1.0;
    sum += bed.stiffness * l * ((to - 0.5 * to * to) - (from - 0.5 * from * from));
    from = to;
  }
  return sum;
}

/// Faces of block i as if they touched all round: those in the list, and others as itself where
/// there is none. From the shape of the blocks alone, so that the step does not change with the
/// state.
std::vector<Part> faces_all_round(const Scene& w, std::size_t i) {
  const BlockSet& b = w.b;
  const FaceSet& c = w.c;
  std::vector<Part> parts;
  std::vector<Bedded> normal, shear;
  for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
    const double l = b.edge_length[e];
    const Law& own = w.laws.rows[w.laws.resolve(b.edge_joint[e], b.edge_joint[e])];
    const double bare = w.alone ? 1.0 : 2.0;
    const double kn = w.laws.normal_stiffness(own, l);
    const double ks = w.laws.shear_stiffness(own, l);
    normal.assign(1, {bare * kn, l, no_id});
    shear.assign(1, {bare * ks, l, no_id});
    double zeta = w.laws.damping_of(own, w.damping.contact), drag = own.shear_damping;
    c.for_faces(e, e + 1, [&](Id k, bool of_edge) {
      const Id f = of_edge ? c.facing[k] : c.edge[k];
      const double factor = b.fixed[b.vertex_block[f]] != 0 ? 1.0 : 2.0;
      const Law& law = w.laws.rows[c.law[k]];
      zeta = std::max(zeta, w.laws.damping_of(law, w.damping.contact));
      drag = std::max(drag, law.shear_damping);
      normal.push_back({factor * c.stiffness[k], b.edge_length[f], k});
      shear.push_back({factor * c.shear_stiffness[k], b.edge_length[f], k});
    });
    double count = 0.0;
    const double of_normal = at_each_corner(normal, l, &count), of_shear = at_each_corner(shear, l);
    const Vec2 t = unit(b.vertex(b.next[e]) - b.vertex(e));
    for (const Id v : {e, b.next[e]}) {
      const auto weights = vertex_weights(b, v);
      // n dashpots side by side, each of the mass that the corner feels, are sqrt(n) times one of
      // all.
      const double factor = 2.0 * std::sqrt(bare * count / b.point_inverse[v]);
      parts.push_back({normal.front().face, along(weights, outward_normal(t)), along(weights, t),
                       of_normal, of_shear, factor * zeta * std::sqrt(of_normal),
                       factor * drag * std::sqrt(of_shear)});
    }
  }
  return parts;
}

/// In place of faces: contacts at points that are near, all at once, each in both directions, since
/// it is open which edge a vertex will meet.
std::vector<Part> points_near(const Scene& w, std::size_t i) {
  const std::vector<PointSpring>& springs = w.points->springs;
  const double p = std::max(w.points->stiffness, w.points->shear_stiffness);
  std::vector<Part> parts;
  const auto before = [](const PointSpring& s, std::size_t block) { return s.block < block; };
  for (auto s = std::lower_bound(springs.begin(), springs.end(), i, before);
       s != springs.end() && s->block == i; ++s) {
    parts.push_back({no_id, along(s->weight, {1.0, 0.0}), along(s->weight, {0.0, 1.0}),
                     s->factor * p, s->factor * p, 0.0, 0.0});
  }
  return parts;
}

BlockEquations equations_of(const Scene& w, std::size_t i) {
  BlockEquations k;
  k.mass = mass_matrix(w.b, i);
  k.viscous = viscous_matrix(w.b, i);
  k.parts = w.points == nullptr ? faces_all_round(w, i) : points_near(w, i);
  k.elastic = elastic_matrix(w.b, i);
  k.boundary = boundary_matrix(w.b, w.springs, rotation(deformation(w.b, w.s.x, w.s.y, i)), i);
  k.bolts = w.bolts == nullptr ? Matrix6::Zero().eval() : bolt_matrix(*w.bolts, w.b, w.s, i);
  for (const Part& p : k.parts) k.add(p);
  return k;
}

double not_beyond_drag(double step, const Damping& damping) {
  const double drag = damping.drag();
  return drag > 0.0 ? std::min(step, 1.0 / drag) : step;
}

/// L^-1 K, M = L L^T: a column at a time, for which Eigen needs no memory.
Matrix6 divided_by_root(const Eigen::LLT<Matrix6>& mass, const Matrix6& k) {
  Matrix6 a;
  for (int column = 0; column < 6; ++column) {
    a.col(column) = mass.matrixL().solve(Vector6(k.col(column)));
  }
  return a;
}

/// Not below the largest eigenvalue of M^-1 K, and at most 6^(1/64) times it: with A = L^-1 K L^-T,
/// M = L L^T, the root (tr A^64)^(1/64).
double eigenvalue_bound(const Matrix6& k, const Eigen::LLT<Matrix6>& mass) {
  Matrix6 a = divided_by_root(mass, k);
  a = divided_by_root(mass, a.transpose().eval());
  const double size = a.trace();
  if (!std::isfinite(size)) return std::numeric_limits<double>::infinity();
  if (!(size > 0.0)) return 0.0;
  a /= size;
  constexpr int squares = 5;
  for (int square = 0; square < squares; ++square) a = Matrix6(a.lazyProduct(a));
  double root = a.squaredNorm();
  for (int square = 0; square <= squares; ++square) root = std::sqrt(root);
  constexpr double rounding = 1e-9;
  return (1.0 + rounding) * size * root;
}

/// The h > 0 with h^2 k/4 + h (c - d)/2 = m.
double root_of_step(double k, double c, double d, double m) {
  const double b = 0.5 * (c - d), root = std::sqrt(b * b + k * m);
  return b > 0.0 ? 2.0 * m / (b + root) : 2.0 * (root - b) / k;
}

/// A step not above the critical one, at little cost: a first one without D; then D of that step
/// counts as mass.
double lower_estimate(const BlockEquations& q, const Damping& damping) {
  const Matrix6 stiffness = (1.0 + damping.local) * q.stiffness();
  const bool viscous = q.viscous.trace() > 0.0, dashpots = q.dashpots.trace() > 0.0;
  double h = 0.0;
  for (int round = 0; round < (viscous ? 2 : 1); ++round) {
    const Eigen::LLT<Matrix6> mass(q.mass + (0.5 * h) * q.viscous);
    const double k = eigenvalue_bound(stiffness, mass);
    if (!(k > 0.0)) return std::numeric_limits<double>::infinity();
    const double c = dashpots ? eigenvalue_bound(q.dashpots, mass) : 0.0;
    h = std::max(h, root_of_step(k, c, 0.0, 1.0));
  }
  return not_beyond_drag(h, damping);
}

/// Of a sequence of numbers.
class Hash {
 public:
  void add(double number) {
    value_ = (value_ ^ std::bit_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 32;
  }
  std::uint64_t value() const { return value_ == 0 ? 1 : value_; }

 private:
  std::uint64_t value_ = 1;
};

/// A hash of all that may change in the equations of block i with the list of faces, stages or
/// masses; 0: they change with the state, too.
std::uint64_t made_of(const Scene& w, std::size_t i) {
  const BlockSet& b = w.b;
  const bool by_state =
      w.springs.block_begin[i] < w.springs.block_begin[i + 1] ||
      (w.bolts != nullptr && !w.bolts->place.empty() && w.bolts->place[i] != no_id);
  if (by_state || w.points != nullptr) return 0;
  Hash hash;
  for (const double number : {w.damping.local, w.damping.drag(), b.node_mass[0][i],
                              b.node_mass[1][i], b.node_mass[2][i], b.lame_lambda[i], b.lame_mu[i]})
    hash.add(number);
  hash.add(b.viscosity.empty() ? 0.0 : b.viscosity[i]);
  hash.add(b.mass_kind == MassKind::consistent ? b.inverse_mass[0][i] : 0.0);
  // The factor of a spring, 1 or 2, as the sign of its length.
  const auto add = [&](const Law& law, double kn, double ks, double length, bool once) {
    for (const double number : {kn, ks, once ? -length : length,
                                w.laws.damping_of(law, w.damping.contact), law.shear_damping})
      hash.add(number);
  };
  for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
    const double l = b.edge_length[e];
    const Law& own = w.laws.rows[w.laws.resolve(b.edge_joint[e], b.edge_joint[e])];
    hash.add(static_cast<double>(w.c.begin_of_edge[e + 1] - w.c.begin_of_edge[e]));
    add(own, w.laws.normal_stiffness(own, l), w.laws.shear_stiffness(own, l), l, w.alone);
    w.c.for_faces(e, e + 1, [&](Id k, bool of_edge) {
      const Id f = of_edge ? w.c.facing[k] : w.c.edge[k];
      const bool held = b.fixed[b.vertex_block[f]] != 0;
      add(w.laws.rows[w.c.law[k]], w.c.stiffness[k], w.c.shear_stiffness[k], b.edge_length[f],
          held);
    });
  }
  return hash.value();
}

/// The largest h for which M + h D/2 - h C/2 - h^2 K/4 has no negative eigenvalue: as long as it
/// has none, what a leapfrog with C of the old velocity and D of the new one keeps as its energy,
/// v (M + h D/2 - h C/2 - h^2 K/4) v/2 + x K x/2 (x halfway between two steps), can only fall. Each
/// vector v has one h at which it reaches zero; from any vector the worst is found by taking the
/// eigenvector of the least eigenvalue at the step that it allows, again and again.
double critical_step_of(const BlockEquations& q, const Damping& damping) {
  const Matrix6 k = (1.0 + damping.local) * q.stiffness();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> first(k, q.mass);
  if (!(first.eigenvalues()[5] > 0.0)) return std::numeric_limits<double>::infinity();
  const auto allowed = [&](const Vector6& v) {
    return root_of_step(v.dot(k * v), v.dot(q.dashpots * v), v.dot(q.viscous * v),
                        v.dot(q.mass * v));
  };
  double h = allowed(first.eigenvectors().col(5));
  if (q.viscous.trace() > 0.0 || q.dashpots.trace() > 0.0) {
    constexpr int most_rounds = 30;
    for (int round = 0; round < most_rounds; ++round) {
      const Matrix6 left = q.mass + (0.5 * h) * (q.viscous - q.dashpots) - (0.25 * h * h) * k;
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(left, q.mass);
      const double next = allowed(solver.eigenvectors().col(0));
      const bool settled = !(next < h * (1.0 - 1e-12));
      h = std::min(h, next);
      if (settled) break;
    }
  }
  return not_beyond_drag(h, damping);
}

/// The smallest exact step, and the first block that has it: worked out only for blocks whose
/// `estimates` from below leave it open.
struct Smallest {
  double step = std::numeric_limits<double>::infinity();
  Id block = no_id;
};

/// The steps of blocks, worked out anew where what is known of them no longer holds.
class BlockSteps {
 public:
  BlockSteps(const Scene& scene, KnownSteps& known) : w_(scene), known_(known) {
    if (known.made_of.size() != w_.b.size()) {
      known.made_of.assign(w_.b.size(), 0);
      known.estimate.assign(w_.b.size(), 0.0);
      known.exact.assign(w_.b.size(), unknown);
    }
  }
  /// Exact where it is below `limit`, elsewhere not below `limit` and perhaps too small.
  double below(double limit, std::size_t i) {
    const std::uint64_t now = made_of(w_, i);
    if (now == 0 || now != known_.made_of[i]) {
      const BlockEquations q = equations_of(w_, i);
      known_.made_of[i] = now;
      known_.estimate[i] = lower_estimate(q, w_.damping);
      known_.exact[i] = known_.estimate[i] < limit ? critical_step_of(q, w_.damping) : unknown;
    }
    return known_.estimate[i] < limit ? exact(i) : known_.estimate[i];
  }
  /// After below() of this block.
  double exact(std::size_t i) {
    if (known_.exact[i] < 0.0) known_.exact[i] = critical_step_of(equations_of(w_, i), w_.damping);
    return known_.exact[i];
  }

 private:
  static constexpr double unknown = -1.0;
  const Scene& w_;
  KnownSteps& known_;
};

Smallest smallest_step(BlockSteps& steps, const std::vector<double>& estimates) {
  const auto first = std::min_element(estimates.begin(), estimates.end());
  if (first == estimates.end() || !(*first < std::numeric_limits<double>::infinity())) return {};
  const double known = steps.exact(static_cast<std::size_t>(first - estimates.begin()));
  std::vector<Id> open;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (estimates[i] <= known) open.push_back(static_cast<Id>(i));
  }
  std::vector<double> exact(open.size());
  parallel_for(open.size(), [&](std::size_t q) { exact[q] = steps.exact(open[q]); });
  Smallest found;
  for (std::size_t q = 0; q < open.size(); ++q) {
    if (exact[q] < found.step) found = {exact[q], open[q]};
  }
  return found;
}

/// Whose stiffness it is that holds block i's step.
void explain(StepBound& bound, const Scene& w, std::size_t i) {
  const BlockEquations k = equations_of(w, i);
  const double h = bound.critical_step;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(k.stiffness(),
                                                                 k.mass + (0.5 * h) * k.viscous);
  const Vector6 mode = solver.eigenvectors().col(5);
  const double total = mode.dot(k.stiffness() * mode);
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
      bound.contact = p.face;
    }
  }
}

}  // namespace

StepBound step_bound(const BlockSet& b, const State& s, const FaceSet& c,
                     const BoundarySprings& springs, const LawTable& laws, const Damping& damping,
                     const Bolts* bolts, const PointSet* points, KnownSteps* known) {
  const Scene scene{b, s, c, springs, laws, damping, bolts, points};
  KnownSteps here;
  BlockSteps steps(scene, known == nullptr ? here : *known);
  std::vector<double> step(b.size(), std::numeric_limits<double>::infinity());
  parallel_for(b.size(), [&](std::size_t i) {
    if (!b.fixed[i] && s.alive[i]) step[i] = steps.below(0.0, i);
  });
  const Smallest critical = smallest_step(steps, step);
  StepBound bound;
  bound.critical_step = critical.step;
  bound.block = critical.block;
  if (bound.block != no_id) explain(bound, scene, bound.block);
  return bound;
}

std::vector<double> steps_of_blocks(const BlockSet& b, const State& s, const FaceSet& c,
                                    const BoundarySprings& springs, const LawTable& laws,
                                    const Damping& damping, double limit, const Bolts* bolts,
                                    KnownSteps* known) {
  const Scene scene{b, s, c, springs, laws, damping, bolts};
  KnownSteps here;
  BlockSteps steps(scene, known == nullptr ? here : *known);
  std::vector<double> step(b.size(), std::numeric_limits<double>::infinity());
  parallel_for(b.size(), [&](std::size_t i) {
    if (!b.fixed[i] && s.alive[i]) step[i] = steps.below(limit, i);
  });
  return step;
}

}  // namespace edda
