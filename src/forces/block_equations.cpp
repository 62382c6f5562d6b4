#include "forces/block_equations.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "forces/bolt_matrix.hpp"

namespace edda {
namespace {

/// A contact spring that is spread along a part of an edge.
struct DistributedSpring {
  double stiffness, length;  ///< N/m per m, with the factor 1 or 2; m
  Id face;
};

/// Upper bound of the stiffness that springs along an edge of length l have at each of its corners,
/// Int k(s) (1 - s/l) ds. Springs cannot overlap, and each counts most nearest to the corner, so
/// they are laid out from the corner, the stiffest first.
double corner_stiffness_bound(std::vector<DistributedSpring>& distributed_springs, double l,
                              double* count = nullptr) {
  std::stable_sort(distributed_springs.begin(), distributed_springs.end(),
                   [](const DistributedSpring& p, const DistributedSpring& q) {
                     return p.stiffness > q.stiffness;
                   });
  double sum = 0.0, from = 0.0;
  for (const DistributedSpring& bed : distributed_springs) {
    const double to = std::min(from + bed.length / l, 1.0);
    if (count != nullptr && to > from) *count += 1.0;
    sum += bed.stiffness * l * ((to - 0.5 * to * to) - (from - 0.5 * from * from));
    from = to;
  }
  return sum;
}

/// How much stiffer than its two edges say a sharp corner of this interior angle may be held. Where
/// it leans on an edge its sides, at theta to that edge, each have their stiffness over
/// cos(theta/2) along it (theory, section 4.3), the most where both stand at (180 - corner)/2. Only
/// of a block that no other free one may meet: else springs count twice. A right angle is covered,
/// too: its edges count with all of their springs.
double of_sharp_corner(double corner) {
  constexpr double pi = std::numbers::pi;
  if (corner >= 0.5 * pi) return 1.0;
  return std::cos(pi / 8.0) / std::cos(0.25 * (pi - corner));
}

/// What an edge may meet beside the faces in the list: where there is none a block like its own,
/// and else, where a penalty follows from the blocks, a much larger one, so that a thin block among
/// large ones does not hold the step down.
FaceSides beside_faces(const StiffnessInputs& w, Id e) {
  const bool listed = w.contacts.begin_of_edge[e] < w.contacts.begin_of_edge[e + 1];
  return listed ? beside_much_larger(w.blocks, e) : sides_of(w.blocks, e, e);
}

/// Contacts of block i as if it were in contact all round: the faces in the list, and along the
/// rest of its edges what they may meet. They follow from the shape of the blocks alone, so that
/// the step changes only with the list.
std::vector<SpringOnBlock> faces_all_round(const StiffnessInputs& w, std::size_t i) {
  const BlockSet& b = w.blocks;
  const FaceSet& c = w.contacts;
  std::vector<SpringOnBlock> parts;
  std::vector<DistributedSpring> normal, shear;
  for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
    const double l = b.edge_length[e];
    const Law& own = w.laws.rows[w.laws.resolve(b.edge_joint[e], b.edge_joint[e])];
    const double bare = w.alone ? 1.0 : 2.0;
    const FaceSides sides = beside_faces(w, e);
    const double kn = w.laws.normal_stiffness(own, sides);
    const double ks = w.laws.shear_stiffness(own, sides);
    normal.assign(1, {bare * kn, l, no_id});
    shear.assign(1, {bare * ks, l, no_id});
    double zeta = w.laws.damping_of(own, w.damping.contact), shear_zeta = own.shear_damping,
           rebound = own.rebound;
    c.for_faces(e, e + 1, [&](Id k, bool of_edge) {
      const Id f = of_edge ? c.facing[k] : c.edge[k];
      const double factor = b.fixed[b.vertex_block[f]] != 0 ? 1.0 : 2.0;
      const Law& law = w.laws.rows[c.law[k]];
      zeta = std::max(zeta, w.laws.damping_of(law, w.damping.contact));
      shear_zeta = std::max(shear_zeta, law.shear_damping);
      rebound = std::max(rebound, law.rebound);
      normal.push_back({factor * c.stiffness[k], b.edge_length[f], k});
      shear.push_back({factor * c.shear_stiffness[k], b.edge_length[f], k});
    });
    double count = 0.0;
    const double of_normal = corner_stiffness_bound(normal, l, &count),
                 of_shear = corner_stiffness_bound(shear, l);
    const Vec2 t = unit(b.vertex(b.next[e]) - b.vertex(e));
    for (const Id v : {e, b.next[e]}) {
      const NodeWeights weights = weights_of(b.weight, v);
      // n dashpots side by side, each computed with the mass that the corner feels, are sqrt(n)
      // times one dashpot of the whole stiffness.
      const double factor = 2.0 * std::sqrt(bare * count / w.masses.point_inverse[v]);
      const double sharp = w.alone ? of_sharp_corner(b.corner[v]) : 1.0;
      const double normal_here = sharp * of_normal, shear_here = sharp * of_shear;
      parts.push_back({normal.front().face, v, weights, outward_normal(t), t,
                       (1.0 + rebound) * normal_here, shear_here,
                       factor * zeta * std::sqrt(normal_here),
                       factor * shear_zeta * std::sqrt(shear_here)});
    }
  }
  return parts;
}

/// Those that are near, in place of faces all round: all of them act at once.
std::vector<SpringOnBlock> springs_near(const NearSprings& near, std::size_t i) {
  const auto at = [&](Id q) { return near.springs.begin() + static_cast<std::ptrdiff_t>(q); };
  return {at(near.begin[i]), at(near.begin[i + 1])};
}

/// Hash of a sequence of numbers.
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

}  // namespace

std::vector<SpringOnBlock> springs_all_round(const StiffnessInputs& w, std::size_t i) {
  return w.near == nullptr ? faces_all_round(w, i) : springs_near(*w.near, i);
}

template <class Matrix>
BlockEquations<Matrix> equations_of(const StiffnessInputs& w, std::size_t i) {
  using Vector = typename BlockEquations<Matrix>::Vector;
  constexpr bool bends = std::is_same_v<Matrix, BodyMatrix>;
  const Eigen::Index size = components_of(w.blocks, i);
  BlockEquations<Matrix> k;
  k.parts = springs_all_round(w, i);
  const Rotation r = rotation(deformation(w.blocks, w.state.position, i));
  const NodalMatrix elastic = elastic_matrix(w.blocks, i),
                    viscous = viscous_matrix(w.blocks, w.masses, i),
                    bolts = w.bolts == nullptr ? NodalMatrix::Zero().eval()
                                               : bolt_matrix(*w.bolts, w.blocks, w.state, i);
  if constexpr (bends) {
    k.mass = Matrix::Zero(size, size);
    body_mass(w.blocks, w.masses, i).add_to(k.mass, 1.0);
    k.elastic = of_body(elastic, stiffness_of_modes(w.blocks, i));
    k.viscous = of_body(viscous, viscosity_of_modes(w.blocks, w.masses, i));
    k.boundary = boundary_of_body(w.blocks, w.springs, r, i);
    k.bolts = of_body(bolts, Matrix::Zero(size - bolts.rows(), size - bolts.cols()));
  } else {
    k.mass = mass_matrix(w.masses, i);
    k.elastic = elastic;
    k.viscous = viscous;
    k.boundary = boundary_matrix(w.blocks, w.springs, r, i);
    k.bolts = bolts;
  }
  k.contacts = k.dashpots = Matrix::Zero(size, size);
  for (const SpringOnBlock& p : k.parts) {
    const Vector normal = at_corner_of<Vector>(w.blocks, p, p.normal),
                 tangent = at_corner_of<Vector>(w.blocks, p, p.tangent);
    k.contacts += p.kn * normal * normal.transpose() + p.ks * tangent * tangent.transpose();
    if (p.dashpot > 0.0) k.dashpots += p.dashpot * normal * normal.transpose();
    if (p.shear_dashpot > 0.0) k.dashpots += p.shear_dashpot * tangent * tangent.transpose();
  }
  return k;
}

template BlockEquations<NodalMatrix> equations_of(const StiffnessInputs&, std::size_t);
template BlockEquations<BodyMatrix> equations_of(const StiffnessInputs&, std::size_t);

std::uint64_t equations_hash(const StiffnessInputs& w, std::size_t i) {
  const BlockSet& b = w.blocks;
  const bool by_state =
      w.springs.block_begin[i] < w.springs.block_begin[i + 1] ||
      (w.bolts != nullptr && !w.bolts->place.empty() && w.bolts->place[i] != no_id);
  if (by_state || w.near != nullptr) return 0;
  Hash hash;
  for (const std::vector<double>& mass : w.masses.node) hash.add(mass[i]);
  for (const double number :
       {w.damping.local, mass_damping_of(w.masses, w.damping, i), b.lame_lambda[i], b.lame_mu[i]})
    hash.add(number);
  hash.add(viscosity_of(w.masses, i));
  hash.add(w.masses.mode_damping[0].empty() ? 0.0 : w.masses.mode_damping[0][i]);
  hash.add(w.masses.kind == MassKind::consistent ? w.masses.inverse[0][i] : 0.0);
  // The factor of a spring, 1 or 2, enters as the sign of its length.
  const auto add = [&](const Law& law, double kn, double ks, double length, bool once) {
    for (const double number : {kn, ks, once ? -length : length,
                                w.laws.damping_of(law, w.damping.contact), law.shear_damping})
      hash.add(number);
  };
  for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
    const double l = b.edge_length[e];
    const Law& own = w.laws.rows[w.laws.resolve(b.edge_joint[e], b.edge_joint[e])];
    hash.add(static_cast<double>(w.contacts.begin_of_edge[e + 1] - w.contacts.begin_of_edge[e]));
    const FaceSides bare = beside_faces(w, e);
    add(own, w.laws.normal_stiffness(own, bare), w.laws.shear_stiffness(own, bare), l, w.alone);
    w.contacts.for_faces(e, e + 1, [&](Id k, bool of_edge) {
      const Id f = of_edge ? w.contacts.facing[k] : w.contacts.edge[k];
      const bool fixed = b.fixed[b.vertex_block[f]] != 0;
      add(w.laws.rows[w.contacts.law[k]], w.contacts.stiffness[k], w.contacts.shear_stiffness[k],
          b.edge_length[f], fixed);
    });
  }
  return hash.value();
}

}  // namespace edda
