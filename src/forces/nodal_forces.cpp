#include "forces/nodal_forces.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

using NodeForce = std::array<Vec2, 3>;

/// Contact forces are summed on the vertices first and spread to the nodes once per vertex. Most
/// blocks have no more corners than this.
constexpr Id few_corners = 64;

/// Sums on one vertex: of its own contacts, and of those of the edges that start and end there.
/// Apart, so that one sum need not wait for the other; and plain numbers, for an array of them that
/// is not filled before it is known how many count.
struct VertexSums {
  double own_x, own_y, start_x, start_y, end_x, end_y;
  Vec2 sum() const { return {own_x + start_x + end_x, own_y + start_y + end_y}; }
};

/// Contact forces on the vertices of block i: those of its own vertices, which follow each other in
/// the list, then those of its edges.
void sum_on_vertices(VertexSums* on, const BlockSet& b, const ContactSet& c, std::size_t i) {
  const Id first = b.vertex_begin[i], end = b.vertex_begin[i + 1];
  std::fill(on, on + (end - first), VertexSums{0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  const Id own = c.begin_of_vertex[first], own_end = c.begin_of_vertex[end];
  for (Id k = own; k < own_end; ++k) {
    VertexSums& at = on[c.vertex[k] - first];
    at.own_x += c.fx[k];
    at.own_y += c.fy[k];
  }
  for (Id q = c.block_begin[i] + (own_end - own); q < c.block_begin[i + 1]; ++q) {
    const Id k = c.block_entry[q] >> 1;
    const Vec2 start = c.on_start(k), last = c.on_end(k);
    VertexSums &from = on[c.edge[k] - first], &to = on[c.edge_end[k] - first];
    from.start_x += start.x;
    from.start_y += start.y;
    to.end_x += last.x;
    to.end_y += last.y;
  }
}

void add_contacts(NodeForce& f, const BlockSet& b, const ContactSet& c, std::size_t i) {
  if (c.block_begin[i] == c.block_begin[i + 1]) return;
  const Id first = b.vertex_begin[i], corners = b.vertex_begin[i + 1] - first;
  const auto add = [&](VertexSums* on) {
    sum_on_vertices(on, b, c, i);
    for (Id v = 0; v < corners; ++v) spread(f, b, first + v, on[v].sum());
  };
  if (corners <= few_corners) {
    std::array<VertexSums, few_corners> on;
    add(on.data());
  } else {
    std::vector<VertexSums> on(corners);
    add(on.data());
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

}  // namespace

void gather_forces(NodalForces& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const ContactSet& contacts, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads, std::size_t begin, std::size_t end) {
  const BodyView body{values_of(b.grad_x),  values_of(b.grad_y), b.volume.data(),
                      b.lame_lambda.data(), b.lame_mu.data(),    b.mass.data()};
  body_forces(body, values_of(state.x), values_of(state.y), gravity - loads.frame,
              values_of(forces.x), values_of(forces.y), begin, end);
  for (std::size_t i = begin; i < end; ++i) {
    NodeForce f{};
    if (is_free(b, state, i)) {
      for (std::size_t k = 0; k < 3; ++k) f[k] = {forces.x[k][i], forces.y[k][i]};
      add_springs(f, b, springs, pose, i);
      if (loads.loads != nullptr) add_loads(f, b, loads, pose.x, pose.y, i);
      if (loads.bolts != nullptr) add_bolts(f, *loads.bolts, i);
      add_contacts(f, b, contacts, i);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      forces.x[k][i] = f[k].x;
      forces.y[k][i] = f[k].y;
    }
  }
}

void gather_forces(NodalForces& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const ContactSet& contacts, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads) {
  parallel_chunks(b.size(), blocks_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    gather_forces(forces, b, state, pose, contacts, springs, gravity, loads, begin, end);
  });
}

Vec2 contact_resultant(const BlockSet& b, const ContactSet& c, std::size_t i) {
  NodeForce f{};
  add_contacts(f, b, c, i);
  return f[0] + f[1] + f[2];
}

}  // namespace edda
