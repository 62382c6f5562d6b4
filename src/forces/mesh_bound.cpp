#include "forces/mesh_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "forces/bolt_matrix.hpp"

namespace edda {
namespace {

/// Symmetric 2 x 2 stiffnesses or dashpots at the nodes of a mesh.
struct NodeMatrix {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double k, Vec2 along) {
    xx += k * along.x * along.x;
    xy += k * along.x * along.y;
    yy += k * along.y * along.y;
  }
  double largest() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
};

/// lambda_max(I^-1 G), at least 1.
double excess_of_lumped_mass(const BlockSet& b, std::size_t i) {
  const std::array<double, 6>& g = b.meshes.inverse[i];
  Eigen::Matrix3d inverse, exact = Eigen::Matrix3d::Zero();
  inverse << g[0], g[1], g[2], g[1], g[3], g[4], g[2], g[4], g[5];
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const Eigen::Vector3d p(1.0, b.node_x[k][i] - b.centroid_x[i],
                            b.node_y[k][i] - b.centroid_y[i]);
    exact += p * p.transpose() / nodes_per_block;
  }
  const Eigen::Matrix3d root = exact.llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(root.transpose() * inverse * root,
                                                              Eigen::EigenvaluesOnly);
  return std::max(1.0, 1.0 / solver.eigenvalues()[0]);
}

/// Of the bolts.
std::vector<NodeMatrix> bolts_at_nodes(const StiffnessInputs& w, std::size_t i) {
  const Meshes& m = w.blocks.meshes;
  std::vector<NodeMatrix> at(m.nodes_of(i));
  if (w.bolts == nullptr) return at;
  for (const BoltSpringAt& s : bolt_springs(*w.bolts, w.blocks, w.state, i)) {
    const NodeWeights weight = weights_of(w.bolts->weight, s.node);
    double sum = 0.0;
    for (const double part : weight) sum += std::abs(part);
    for (std::size_t k = 0; k < corners_of_zone; ++k) {
      NodeMatrix& node = at[m.zone[w.bolts->zone[s.node]][k] - m.begin[i]];
      node.add(s.along * std::abs(weight[k]) * sum, s.t);
      node.add(s.across * std::abs(weight[k]) * sum, perp(s.t));
    }
  }
  return at;
}

}  // namespace

MeshBound mesh_bound(const StiffnessInputs& w, std::size_t i) {
  const BlockSet& b = w.blocks;
  const Meshes& m = b.meshes;
  const Id first = b.vertex_begin[i];
  const std::size_t corners = b.vertex_begin[i + 1] - first, node = m.begin[i];
  const std::vector<NodeMatrix> bolts = bolts_at_nodes(w, i);
  std::vector<NodeMatrix> contacts(corners), boundaries(corners), dashpots(corners);
  std::vector<Id> stiffest(corners, no_id);
  std::vector<double> most(corners, 0.0);
  for (const SpringOnBlock& s : springs_all_round(w, i)) {
    const std::size_t at = s.corner - first;
    contacts[at].add(s.kn, s.normal);
    contacts[at].add(s.ks, s.tangent);
    dashpots[at].add(s.dashpot, s.normal);
    dashpots[at].add(s.shear_dashpot, s.tangent);
    if (s.kn + s.ks <= most[at]) continue;
    most[at] = s.kn + s.ks;
    stiffest[at] = s.face;
  }
  for (Id q = w.springs.block_begin[i]; q < w.springs.block_begin[i + 1]; ++q) {
    NodeMatrix& at = boundaries[w.springs.vertex[q] - first];
    at.xx += w.springs.kxx[q];
    at.xy += w.springs.kxy[q];
    at.yy += w.springs.kyy[q];
  }
  const double inertia = 1.0 / w.masses.mode_inverse[i], raised = inertia / b.mass[i];
  const double viscosity = viscosity_of(w.masses, i);
  MeshBound bound;
  double of_contacts = 0.0, of_boundaries = 0.0, of_bolts = 0.0, largest = 0.0;
  for (std::size_t j = 0; j < m.nodes_of(i); ++j) {
    const double mass = inertia * m.share[node + j], own = w.zones->square[node + j] / raised;
    const double contact = j < corners ? contacts[j].largest() / mass : 0.0,
                 boundary = j < corners ? boundaries[j].largest() / mass : 0.0,
                 bolt = bolts[j].largest() / mass;
    const double dashpot = j < corners ? dashpots[j].largest() / mass : 0.0;
    bound.dashpots = std::max(bound.dashpots, dashpot + viscosity * own);
    if (own + contact + boundary + bolt <= largest) continue;
    largest = own + contact + boundary + bolt;
    of_contacts = contact;
    of_boundaries = boundary;
    of_bolts = bolt;
    bound.contact = j < corners ? stiffest[j] : no_id;
  }
  const double excess = excess_of_lumped_mass(b, i);
  bound.square = excess * largest;
  bound.dashpots *= excess;
  if (!(bound.square > 0.0)) return bound;
  bound.of_contacts = excess * of_contacts / bound.square;
  bound.of_boundaries = excess * of_boundaries / bound.square;
  bound.of_bolts = excess * of_bolts / bound.square;
  return bound;
}

}  // namespace edda
