#include "forces/dashpot_forces.hpp"

#include <algorithm>

#include "forces/block_matrices.hpp"

namespace edda {
namespace {

bool acts(const Dashpots& d, const Dashpot& at) {
  return d.acts[static_cast<std::size_t>(at.boundary)] != 0;
}

/// sum over the points of w w^T (x) C.
NodalMatrix damping_matrix(const Dashpots& d, Id first, Id last) {
  NodalMatrix m = NodalMatrix::Zero();
  for (Id p = first; p < last; ++p) {
    const Dashpot& at = d.points[p];
    if (!acts(d, at)) continue;
    Eigen::Matrix2d c;
    c << at.cxx, at.cxy, at.cxy, at.cyy;
    add_at(m, at.weight, c);
  }
  return m;
}

Vec2 times(const Dashpot& at, Vec2 v) {
  return {at.cxx * v.x + at.cxy * v.y, at.cxy * v.x + at.cyy * v.y};
}

Vec2 push_of(const DashpotStep& step, std::size_t p) {
  return step.push.empty() ? Vec2{} : step.push[p];
}

void spread_to(BodyVectors& forces, const BlockSet& b, const Dashpot& at, Vec2 force) {
  NodeVectors f = vectors_of(forces, at.block);
  spread(f, at.weight, force);
  store(f, forces, at.block);
  if (at.node != no_id) forces.modes.add(b.bending.modes() + at.node, force);
}

/// Calls body(i, first, last) for the blocks of [begin, end) on active dashpots, with their points.
/// Those of the others carry nothing.
template <class Body>
void for_damped(const Dashpots& d, const DashpotScene& scene, bool meshed, std::size_t begin,
                std::size_t end, std::vector<Vec2>& on_point, Body body) {
  const auto start = std::lower_bound(d.blocks.begin(), d.blocks.end(), static_cast<Id>(begin));
  for (auto it = start; it != d.blocks.end() && *it < end; ++it) {
    const Id i = *it;
    if (scene.blocks.is_meshed(i) != meshed) continue;
    const auto q = static_cast<std::size_t>(it - d.blocks.begin());
    const Id first = d.begin[q], last = d.begin[q + 1];
    if (scene.state.alive[i] && std::binary_search(d.damped.begin(), d.damped.end(), i)) {
      body(i, first, last);
    } else {
      std::fill(on_point.begin() + first, on_point.begin() + last, Vec2{});
    }
  }
}

/// The force of a point that moves at velocity v, which is stored and added to those on its block.
void act(const Dashpots& d, const DashpotStep& step, Id p, Vec2 v, const BlockSet& b,
         BodyVectors& forces, std::vector<Vec2>& on_point) {
  const Dashpot& at = d.points[p];
  on_point[p] = {};
  if (!acts(d, at)) return;
  on_point[p] = push_of(step, p) - times(at, v - step.reference[p]);
  spread_to(forces, b, at, on_point[p]);
}

using Eigen::Matrix2d;
using Eigen::Vector2d;
using AffineColumn = Eigen::Matrix<double, 6, 1>;  // of an AffinePart
using AffineMatrix = Eigen::Matrix<double, 6, 6>;

/// P_j (x) 1: the affine part of a force on node j.
Eigen::Matrix<double, 6, 2> affine_of(const Meshes& m, std::size_t j) {
  Eigen::Matrix<double, 6, 2> e;
  e << Matrix2d::Identity(), m.arm_x[j] * Matrix2d::Identity(), m.arm_y[j] * Matrix2d::Identity();
  return e;
}

/// Q of block i (beside_lumped()).
AffineMatrix beside_lumped(const DashpotScene& scene, std::size_t i) {
  AffineMatrix q;
  for (Eigen::Index column = 0; column < q.cols(); ++column) {
    const AffineColumn p = AffineColumn::Unit(column);
    const AffinePart a =
        beside_lumped(scene.masses, scene.blocks, i, {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}});
    q.col(column) << a.one.x, a.one.y, a.x.x, a.x.y, a.y.x, a.y.y;
  }
  return q;
}

/// The dashpots of one node of a mesh, whose mean velocity of the step is `alone` + moves z, with z
/// the affine acceleration that the dashpots of all nodes make beside that of the lumped masses.
struct DampedNode {
  Id node, first, last;  ///< points
  Vector2d alone;
  Eigen::Matrix<double, 2, 6> moves;
};

/// The mean velocities of the nodes of block i on dashpots.
struct DampedMesh {
  std::vector<DampedNode> nodes;
  AffineMatrix loss = AffineMatrix::Zero();  ///< force on the affine part by z
  AffineColumn push = AffineColumn::Zero();  ///< and without it

  /// free: mean velocity without dashpots; kick: change of it by a force over the lumped mass.
  void add(const Meshes& m, const Dashpots& d, const DashpotStep& step, DampedNode at,
           Vector2d free, double half_kick, double inverse) {
    Matrix2d c = Matrix2d::Zero();
    Vector2d drive = Vector2d::Zero();
    for (Id p = at.first; p < at.last; ++p) {
      const Dashpot& o = d.points[p];
      if (!acts(d, o)) continue;
      c += (Matrix2d() << o.cxx, o.cxy, o.cxy, o.cyy).finished();
      const Vec2 f = times(o, step.reference[p]) + push_of(step, p);
      drive += Vector2d(f.x, f.y);
    }
    const Eigen::Matrix<double, 6, 2> e = affine_of(m, at.node);
    const double per_force = half_kick * inverse / m.share[at.node];
    const Matrix2d keeps = (Matrix2d::Identity() + per_force * c).inverse();
    at.alone = keeps * (free + per_force * drive);
    at.moves = half_kick * keeps * e.transpose();
    push += e * (drive - c * at.alone);
    loss += e * c * at.moves;
    nodes.push_back(at);
  }
};

}  // namespace

void add_dashpots(BodyVectors& forces, std::vector<Vec2>& on_point, const Dashpots& d,
                  const DashpotScene& scene, const DashpotStep& step, std::size_t begin,
                  std::size_t end) {
  const BlockSet& b = scene.blocks;
  for_damped(d, scene, false, begin, end, on_point, [&](Id i, Id first, Id last) {
    const NodalMatrix mass = mass_matrix(scene.masses, i);
    const NodalMatrix c = damping_matrix(d, first, last);
    const NodalVector before = nodal(scene.velocity, i);
    NodalVector push = nodal(forces, i);
    for (Id p = first; p < last; ++p) {
      if (!acts(d, d.points[p])) continue;
      push += along(d.points[p].weight, times(d.points[p], step.reference[p]) + push_of(step, p));
    }
    const NodalVector right =
        (1.0 - step.half_damping_of(i)) * (mass * before) + step.h * (push - 0.5 * c * before);
    const NodalMatrix strain =
        viscous_matrix(b, scene.masses, i, deformation(b, scene.state.position, i));
    const NodalMatrix left =
        (1.0 + step.half_damping_of(i)) * mass + (0.5 * step.h) * c + step.h * strain;
    const NodeVectors mean =
        vectors_of(0.5 * (before + Eigen::LLT<NodalMatrix>(left).solve(right)));
    for (Id p = first; p < last; ++p)
      act(d, step, p, weighted(d.points[p].weight, mean), b, forces, on_point);
  });
}

void add_mesh_dashpots(BodyVectors& forces, std::vector<Vec2>& on_point, const Dashpots& d,
                       const DashpotScene& scene, const DashpotStep& step,
                       const BodyVectors* yet_on_nodes, std::size_t begin, std::size_t end) {
  const BlockSet& b = scene.blocks;
  for_damped(d, scene, true, begin, end, on_point, [&](Id i, Id first, Id last) {
    BodyVector f = vector_of(b, forces, i);
    if (yet_on_nodes != nullptr) f.nodes = f.nodes + vectors_of(*yet_on_nodes, i);
    const BodyVector free = accelerations(scene.masses, b, i, f);
    const AffineMotion affine = affine_motion(b, free.nodes, i);
    const double keeps = 1.0 / (1.0 + step.half_damping_of(i)), half_kick = 0.5 * step.h * keeps;
    DampedMesh mesh;
    for (Id p = first, next = first; p < last; p = next) {
      const Dashpot& at = d.points[p];
      while (next < last && d.points[next].node == at.node) ++next;
      const Vec2 a = affine.of(b.meshes.arm_x[at.node], b.meshes.arm_y[at.node]) +
                     free.modes[at.node - b.meshes.begin[i]];
      const Vec2 v = keeps * point_at(b, scene.velocity, at) + half_kick * a;
      mesh.add(b.meshes, d, step, {at.node, p, next, {}, {}}, {v.x, v.y}, half_kick,
               scene.masses.mode_inverse[i]);
    }
    const AffineMatrix q = beside_lumped(scene, i);
    const AffineColumn z =
        (AffineMatrix::Identity() + q * mesh.loss).partialPivLu().solve(q * mesh.push);
    for (const DampedNode& at : mesh.nodes) {
      const Vector2d v = at.alone + at.moves * z;
      for (Id p = at.first; p < at.last; ++p) act(d, step, p, {v[0], v[1]}, b, forces, on_point);
    }
  });
}

void remove_dashpots(BodyVectors& forces, const std::vector<Vec2>& on_point, const Dashpots& d,
                     const BlockSet& b) {
  for (std::size_t p = 0; p < d.points.size(); ++p) spread_to(forces, b, d.points[p], -on_point[p]);
}

}  // namespace edda
