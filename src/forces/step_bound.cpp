#include "forces/step_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "forces/mesh_bound.hpp"

namespace edda {
namespace {

double not_beyond_mass_damping(double step, double mass_damping) {
  return mass_damping > 0.0 ? std::min(step, 1.0 / mass_damping) : step;
}

/// L^-1 K, M = L L^T; column by column, so that Eigen allocates no memory.
template <class Matrix>
Matrix divided_by_root(const Eigen::LLT<Matrix>& mass, const Matrix& k) {
  using Vector = typename BlockEquations<Matrix>::Vector;
  Matrix a(k.rows(), k.cols());
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    a.col(column) = mass.matrixL().solve(Vector(k.col(column)));
  }
  return a;
}

/// Upper bound of the largest eigenvalue of M^-1 K, at most n^(1/64) times it for n degrees of
/// freedom: (tr A^64)^(1/64) of
/// A = L^-1 K L^-T, M = L L^T.
template <class Matrix>
double eigenvalue_bound(const Matrix& k, const Eigen::LLT<Matrix>& mass) {
  Matrix a = divided_by_root(mass, k);
  a = divided_by_root(mass, Matrix(a.transpose()));
  const double size = a.trace();
  if (!std::isfinite(size)) return std::numeric_limits<double>::infinity();
  if (!(size > 0.0)) return 0.0;
  a /= size;
  constexpr int squares = 5;
  for (int square = 0; square < squares; ++square) a = Matrix(a.lazyProduct(a));
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

/// A step not above the critical one, at little cost: first without the strain damping D, then with
/// h D/2 at that step as additional mass.
template <class Matrix>
double lower_estimate(const BlockEquations<Matrix>& q, const Damping& damping) {
  const Matrix stiffness = (1.0 + damping.local) * q.stiffness();
  const bool viscous = q.viscous.trace() > 0.0, dashpots = q.dashpots.trace() > 0.0;
  double h = 0.0;
  for (int round = 0; round < (viscous ? 2 : 1); ++round) {
    const Eigen::LLT<Matrix> mass(q.mass + (0.5 * h) * q.viscous);
    const double k = eigenvalue_bound(stiffness, mass);
    if (!(k > 0.0)) return std::numeric_limits<double>::infinity();
    const double c = dashpots ? eigenvalue_bound(q.dashpots, mass) : 0.0;
    h = std::max(h, root_of_step(k, c, 0.0, 1.0));
  }
  return h;
}

/// The largest h for which A(h) = M + h D/2 - h C/2 - h^2 K/4 has no negative eigenvalue. Then the
/// energy v.A v/2 + x.K x/2, with v between two steps and x halfway between their positions, is
/// never negative; a leapfrog conserves it where C = D = 0, and can only decrease it where C is
/// taken with the old velocity and D with the new one. For each vector v there is one h > 0 at
/// which v.A(h) v vanishes. The worst v is found by iteration: at the step that v allows, the
/// eigenvector of the least eigenvalue of A is the next v.
template <class Matrix>
double critical_step_of(const BlockEquations<Matrix>& q, const Damping& damping) {
  using Vector = typename BlockEquations<Matrix>::Vector;
  const Matrix k = (1.0 + damping.local) * q.stiffness();
  const Eigen::Index fastest = k.rows() - 1;  // of the modes of a block
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> first(k, q.mass);
  if (!(first.eigenvalues()[fastest] > 0.0)) return std::numeric_limits<double>::infinity();
  const auto allowed = [&](const Vector& v) {
    return root_of_step(v.dot(k * v), v.dot(q.dashpots * v), v.dot(q.viscous * v),
                        v.dot(q.mass * v));
  };
  double h = allowed(first.eigenvectors().col(fastest));
  if (q.viscous.trace() > 0.0 || q.dashpots.trace() > 0.0) {
    constexpr int most_rounds = 30;
    for (int round = 0; round < most_rounds; ++round) {
      const Matrix left = q.mass + (0.5 * h) * (q.viscous - q.dashpots) - (0.25 * h * h) * k;
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(left, q.mass);
      const double next = allowed(solver.eigenvectors().col(0));
      const bool converged = !(next < h * (1.0 - 1e-12));
      h = std::min(h, next);
      if (converged) break;
    }
  }
  return h;
}

/// The step that the bound of a meshed block allows.
double mesh_step(const MeshBound& bound, const Damping& damping) {
  const double k = (1.0 + damping.local) * bound.square;
  if (!(k > 0.0)) return std::numeric_limits<double>::infinity();
  return root_of_step(k, bound.dashpots, 0.0, 1.0);
}

/// Calls body(equations) with those of block i, in the matrices that it needs.
template <class Body>
auto with_equations(const StiffnessInputs& w, std::size_t i, Body body) {
  if (w.blocks.bending.modes_of(i) == 0) return body(equations_of<NodalMatrix>(w, i));
  return body(equations_of<BodyMatrix>(w, i));
}

/// The smallest exact step of all blocks, and the first block that has it.
struct Smallest {
  double step = std::numeric_limits<double>::infinity();
  Id block = no_id;
};

/// The steps of blocks, computed anew where the known values are no longer valid.
class BlockSteps {
 public:
  BlockSteps(const StiffnessInputs& scene, StepCache& known) : w_(scene), known_(known) {
    if (known.equations_hash.size() != w_.blocks.size()) {
      known.equations_hash.assign(w_.blocks.size(), 0);
      known.estimate.assign(w_.blocks.size(), 0.0);
      known.exact.assign(w_.blocks.size(), unknown);
    }
  }
  /// Exact where it is below `limit`; elsewhere a lower estimate that is not below `limit`.
  double below(double limit, std::size_t i) {
    const std::uint64_t now = equations_hash(w_, i);
    if (now == 0 || now != known_.equations_hash[i]) {
      known_.equations_hash[i] = now;
      if (w_.blocks.is_meshed(i)) {
        known_.estimate[i] = known_.exact[i] = damped(mesh_step(mesh_bound(w_, i), w_.damping), i);
        return known_.exact[i];
      }
      with_equations(w_, i, [&](const auto& q) {
        known_.estimate[i] = damped(lower_estimate(q, w_.damping), i);
        known_.exact[i] =
            known_.estimate[i] < limit ? damped(critical_step_of(q, w_.damping), i) : unknown;
      });
    }
    return known_.estimate[i] < limit ? exact(i) : known_.estimate[i];
  }
  /// The exact step; call below() of this block first.
  double exact(std::size_t i) {
    if (!is_known(i)) {
      known_.exact[i] = damped(
          with_equations(w_, i, [&](const auto& q) { return critical_step_of(q, w_.damping); }), i);
    }
    return known_.exact[i];
  }
  /// Whether the exact step is known.
  bool is_known(std::size_t i) const { return known_.exact[i] >= 0.0; }

 private:
  static constexpr double unknown = -1.0;
  double damped(double step, std::size_t i) const {
    return not_beyond_mass_damping(step, mass_damping_of(w_.masses, w_.damping, i));
  }
  const StiffnessInputs& w_;
  StepCache& known_;
};

/// The exact step is computed only for blocks whose lower `estimates` do not exclude them.
Smallest smallest_step(BlockSteps& steps, const std::vector<double>& estimates) {
  const auto first = std::min_element(estimates.begin(), estimates.end());
  if (first == estimates.end() || !(*first < std::numeric_limits<double>::infinity())) return {};
  const double least = steps.exact(static_cast<std::size_t>(first - estimates.begin()));
  std::vector<Id> open, to_compute;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!(estimates[i] <= least)) continue;
    open.push_back(static_cast<Id>(i));
    if (!steps.is_known(i)) to_compute.push_back(static_cast<Id>(i));
  }
  constexpr std::size_t cost = 10000 / seldom;  // ns
  parallel_for(
      to_compute.size(), [&](std::size_t q) { steps.exact(to_compute[q]); }, cost);
  Smallest found;
  for (const Id i : open) {
    if (const double step = steps.exact(i); step < found.step) found = {step, i};
  }
  return found;
}

/// Finds which stiffness governs the step of a block: its parts in the fastest mode.
template <class Matrix>
void explain(StepBound& bound, const StiffnessInputs& w, const BlockEquations<Matrix>& k) {
  using Vector = typename BlockEquations<Matrix>::Vector;
  const double h = bound.critical_step;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(k.stiffness(),
                                                                k.mass + (0.5 * h) * k.viscous);
  const Vector mode = solver.eigenvectors().col(k.mass.rows() - 1);
  const double total = mode.dot(k.stiffness() * mode);
  bound.elastic_part = std::max(0.0, mode.dot(k.elastic * mode) / total);  // not below by rounding
  bound.boundary_part = mode.dot(k.boundary * mode) / total;
  bound.bolt_part = mode.dot(k.bolts * mode) / total;
  bound.contact_part = 1.0 - bound.elastic_part - bound.boundary_part - bound.bolt_part;
  double largest = 0.0;
  for (const SpringOnBlock& p : k.parts) {
    const double hn = at_corner_of<Vector>(w.blocks, p, p.normal).dot(mode),
                 ht = at_corner_of<Vector>(w.blocks, p, p.tangent).dot(mode);
    const double part = p.kn * hn * hn + p.ks * ht * ht;
    if (part > largest) {
      largest = part;
      bound.contact = p.face;
    }
  }
}

/// [nb] s: the step of every free block by `steps`, infinite for the others.
std::vector<double> all_below(double limit, BlockSteps& steps, const StiffnessInputs& w) {
  const std::size_t nb = w.blocks.size();
  std::vector<double> step(nb, std::numeric_limits<double>::infinity());
  parallel_for(
      nb,
      [&](std::size_t i) {
        if (is_free(w.blocks, w.state, i)) step[i] = steps.below(limit, i);
      },
      100);
  return step;
}

}  // namespace

StepBound step_bound(const StiffnessInputs& inputs, StepCache* known) {
  StepCache here;
  BlockSteps steps(inputs, known == nullptr ? here : *known);
  const Smallest critical = smallest_step(steps, all_below(0.0, steps, inputs));
  StepBound bound;
  bound.critical_step = critical.step;
  bound.block = critical.block;
  if (bound.block == no_id) return bound;
  if (inputs.blocks.is_meshed(bound.block)) {
    const MeshBound of_mesh = mesh_bound(inputs, bound.block);
    bound.contact = of_mesh.contact;
    bound.contact_part = of_mesh.of_contacts;
    bound.boundary_part = of_mesh.of_boundaries;
    bound.bolt_part = of_mesh.of_bolts;
    bound.elastic_part = 1.0 - bound.contact_part - bound.boundary_part - bound.bolt_part;
    return bound;
  }
  with_equations(inputs, bound.block, [&](const auto& k) { explain(bound, inputs, k); });
  return bound;
}

std::vector<double> steps_of_blocks(const StiffnessInputs& inputs, double limit, StepCache* known) {
  StepCache here;
  BlockSteps steps(inputs, known == nullptr ? here : *known);
  return all_below(limit, steps, inputs);
}

}  // namespace edda
