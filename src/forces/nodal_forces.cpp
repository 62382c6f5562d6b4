#include "forces/nodal_forces.hpp"

#include <array>
#include <cassert>
#include <cstdint>
#include <limits>

#include "base/parallel.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

using NodeForce = std::array<Vec2, 3>;

/// What the loops over the faces of a block read.
struct FaceListView {
  const Id *begin_of_edge, *on_edge, *next;
  const double* force;
  ConstNodeValues weight;
};
FaceListView faces_of(const BlockSet& b, const FaceSet& c) {
  return {c.begin_of_edge.data(), c.on_edge.data(), b.next.data(), c.force.data(),
          values_of(b.weight)};
}

/// Forces of faces on the nodes of the block with the edges [first, end): summed on each edge, then
/// spread from its two corners (Eq. 15).
EDDA_INLINE void add_faces(NodeForce& f, const FaceListView& c, Id first, Id end) {
  Four from_start_and_end[3] = {};  // x and y from the one, x and y from the other
  for (Id e = first; e < end; ++e) {
    const Id begin = c.begin_of_edge[e], last = c.begin_of_edge[e + 1];
    if (begin == last) continue;
    Four sum{};
    for (std::size_t q = begin; q < last; ++q) {
      const double* const on = c.force + c.on_edge[q];
      sum += Four{on[0], on[1], on[2], on[3]};
    }
    const Id to = c.next[e];
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = c.weight[k][e], w_to = c.weight[k][to];
      from_start_and_end[k] += Four{w, w, w_to, w_to} * sum;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Four& both = from_start_and_end[k];
    f[k] += {both[0] + both[2], both[1] + both[3]};
  }
}

EDDA_VECTOR void add_faces_of_blocks(FaceListView c, const Id* vertex_begin,
                                     const std::uint8_t* is_free, NodeValues fx, NodeValues fy,
                                     std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const Id first = vertex_begin[i], last = vertex_begin[i + 1];
    if (is_free[i - begin] == 0 || c.begin_of_edge[first] == c.begin_of_edge[last]) continue;
    NodeForce f{Vec2{fx[0][i], fy[0][i]}, Vec2{fx[1][i], fy[1][i]}, Vec2{fx[2][i], fy[2][i]}};
    add_faces(f, c, first, last);
    for (std::size_t k = 0; k < 3; ++k) {
      fx[k][i] = f[k].x;
      fy[k][i] = f[k].y;
    }
  }
}

void add_springs(NodeForce& f, const BlockSet& b, const BoundarySprings& s, const Pose& pose,
                 std::size_t i) {
  for (Id q = s.block_begin[i]; q < s.block_begin[i + 1]; ++q) {
    spread(f, b, s.vertex[q], spring_force(s, q, pose.x, pose.y));
  }
}

struct BodyView {
  ConstNodeValues grad_x, grad_y;
  const double *volume, *lame_lambda, *lame_mu, *mass;
};

/// Gravity and elasticity of block i, in place of what its forces were. Every cover is centred on
/// the centroid, so each node carries a third of the weight.
EDDA_INLINE void body_force(const BodyView& b, const ConstNodeValues& x, const ConstNodeValues& y,
                            Vec2 gravity, const NodeValues& fx, const NodeValues& fy,
                            std::size_t i) {
  const Deformation d = deformation(b, x, y, i);
  const Rotation r = rotation(d);
  const PiolaStress p = piola(d, r, b.lame_lambda[i], b.lame_mu[i]);
  const double det = d.xx * d.yy - d.xy * d.yx;
  const bool sound = (det > 0.2) & (r.strength > 0.2);
  const Vec2 weight = (b.mass[i] / 3.0) * gravity;
  const Vec2 f0 = weight + elastic_force(p, b.volume[i], b.grad_x[0][i], b.grad_y[0][i]);
  const Vec2 f1 = weight + elastic_force(p, b.volume[i], b.grad_x[1][i], b.grad_y[1][i]);
  const Vec2 f2 = weight + elastic_force(p, b.volume[i], b.grad_x[2][i], b.grad_y[2][i]);
  fx[0][i] = f0.x + (sound ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  fy[0][i] = f0.y;
  fx[1][i] = f1.x;
  fy[1][i] = f1.y;
  fx[2][i] = f2.x;
  fy[2][i] = f2.y;
}

EDDA_VECTOR void body_forces(BodyView b, ConstNodeValues x, ConstNodeValues y, Vec2 gravity,
                             NodeValues fx, NodeValues fy, std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) body_force(b, x, y, gravity, fx, fy, i);
}

struct InitialView {
  ConstNodeValues grad_x, grad_y;
  const double *volume, *xx, *yy, *xy;
};

/// What initial stress adds.
EDDA_INLINE void add_initial_force(const InitialView& b, const ConstNodeValues& x,
                                   const ConstNodeValues& y, const NodeValues& fx,
                                   const NodeValues& fy, std::size_t i) {
  const PiolaStress p = carried_along(deformation(b, x, y, i), b.xx[i], b.yy[i], b.xy[i]);
  const Vec2 f0 = elastic_force(p, b.volume[i], b.grad_x[0][i], b.grad_y[0][i]);
  const Vec2 f1 = elastic_force(p, b.volume[i], b.grad_x[1][i], b.grad_y[1][i]);
  const Vec2 f2 = elastic_force(p, b.volume[i], b.grad_x[2][i], b.grad_y[2][i]);
  fx[0][i] += f0.x;
  fy[0][i] += f0.y;
  fx[1][i] += f1.x;
  fy[1][i] += f1.y;
  fx[2][i] += f2.x;
  fy[2][i] += f2.y;
}

EDDA_VECTOR void add_initial_forces(InitialView b, ConstNodeValues x, ConstNodeValues y,
                                    NodeValues fx, NodeValues fy, std::size_t begin,
                                    std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) add_initial_force(b, x, y, fx, fy, i);
}

}  // namespace

void gather_forces(NodalForces& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const FaceSet& contacts, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads, std::size_t begin, std::size_t end) {
  const BodyView body{values_of(b.grad_x),  values_of(b.grad_y), b.volume.data(),
                      b.lame_lambda.data(), b.lame_mu.data(),    b.mass.data()};
  body_forces(body, values_of(state.x), values_of(state.y), gravity - loads.less_gravity(),
              values_of(forces.x), values_of(forces.y), begin, end);
  if (!b.initial_xx.empty()) {
    const InitialView initial{values_of(b.grad_x), values_of(b.grad_y), b.volume.data(),
                              b.initial_xx.data(), b.initial_yy.data(), b.initial_xy.data()};
    add_initial_forces(initial, values_of(state.x), values_of(state.y), values_of(forces.x),
                       values_of(forces.y), begin, end);
  }
  assert(end - begin <= blocks_at_once);
  std::array<std::uint8_t, blocks_at_once> moves;
  for (std::size_t i = begin; i < end; ++i) {
    moves[i - begin] = is_free(b, state, i) ? 1 : 0;
    const bool acted_on = springs.block_begin[i] < springs.block_begin[i + 1] ||
                          (loads.loads != nullptr && loads.loads->place[i] != no_id) ||
                          (loads.bolts != nullptr && loads.bolts->place[i] != no_id) ||
                          loads.on_nodes != nullptr;
    if (moves[i - begin] != 0 && !acted_on) continue;
    NodeForce f{};
    if (moves[i - begin] != 0) {
      for (std::size_t k = 0; k < 3; ++k) f[k] = {forces.x[k][i], forces.y[k][i]};
      add_springs(f, b, springs, pose, i);
      if (loads.loads != nullptr) add_loads(f, b, loads, pose.x, pose.y, i);
      if (loads.bolts != nullptr) add_bolts(f, *loads.bolts, i);
      for (std::size_t k = 0; loads.on_nodes != nullptr && k < 3; ++k)
        f[k] += (*loads.on_nodes)[i][k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      forces.x[k][i] = f[k].x;
      forces.y[k][i] = f[k].y;
    }
  }
  add_faces_of_blocks(faces_of(b, contacts), b.vertex_begin.data(), moves.data(),
                      values_of(forces.x), values_of(forces.y), begin, end);
}

void gather_forces(NodalForces& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const FaceSet& contacts, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads) {
  parallel_chunks(b.size(), blocks_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    gather_forces(forces, b, state, pose, contacts, springs, gravity, loads, begin, end);
  });
}

Vec2 contact_resultant(const BlockSet& b, const FaceSet& c, std::size_t i) {
  NodeForce f{};
  add_faces(f, faces_of(b, c), b.vertex_begin[i], b.vertex_begin[i + 1]);
  return f[0] + f[1] + f[2];
}

}  // namespace edda
