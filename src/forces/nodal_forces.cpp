#include "forces/nodal_forces.hpp"

#include <limits>

#include "base/parallel.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

using NodeForce = std::array<Vec2, 3>;

/// Blocks with no more corners than this need no memory of their own.
constexpr Id few_corners = 64;

/// On one vertex: of the edge that starts there, and of the one that ends there.
struct OfEdges {
  double start_x, start_y, end_x, end_y;
};

/// Contact forces on the nodes of the block with the vertices [first, end): summed on each vertex,
/// those of its own contacts and of those of its edges, then spread to the nodes. `of`: scratch,
/// [vertices].
void add_contacts(NodeForce& f, const BlockSet& b, const ContactSet& c, Id first, Id end,
                  OfEdges* of) {
  for (Id v = first; v < end; ++v) {
    double start_x = 0.0, start_y = 0.0, end_x = 0.0, end_y = 0.0;
    for (std::size_t q = c.begin_of_edge[v]; q < c.begin_of_edge[v + 1]; ++q) {
      start_x += c.reaction[4 * q];
      start_y += c.reaction[4 * q + 1];
      end_x += c.reaction[4 * q + 2];
      end_y += c.reaction[4 * q + 3];
    }
    OfEdges &from = of[v - first], &to = of[b.next[v] - first];
    from.start_x = start_x;
    from.start_y = start_y;
    to.end_x = end_x;
    to.end_y = end_y;
  }
  for (Id v = first; v < end; ++v) {
    double x = 0.0, y = 0.0;
    for (std::size_t k = c.begin_of_vertex[v]; k < c.begin_of_vertex[v + 1]; ++k) {
      x += c.force[2 * k];
      y += c.force[2 * k + 1];
    }
    const OfEdges& edges = of[v - first];
    spread(f, b, v, {x + edges.start_x + edges.end_x, y + edges.start_y + edges.end_y});
  }
}

void add_contacts(NodeForce& f, const BlockSet& b, const ContactSet& c, std::size_t i) {
  const Id first = b.vertex_begin[i], end = b.vertex_begin[i + 1];
  if (end - first <= few_corners) {
    std::array<OfEdges, few_corners> of;
    add_contacts(f, b, c, first, end, of.data());
  } else {
    std::vector<OfEdges> of(end - first);
    add_contacts(f, b, c, first, end, of.data());
  }
}

void add_springs(NodeForce& f, const BlockSet& b, const BoundarySprings& s, const Pose& pose,
                 std::size_t i) {
  for (Id q = s.block_begin[i]; q < s.block_begin[i + 1]; ++q) {
    const Id v = s.vertex[q];
    const double ux = pose.x[v] - s.start_x[q], uy = pose.y[v] - s.start_y[q];
    spread(f, b, v, {-(s.kxx[q] * ux + s.kxy[q] * uy), -(s.kxy[q] * ux + s.kyy[q] * uy)});
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
  body_forces(body, values_of(state.x), values_of(state.y), gravity, values_of(forces.x),
              values_of(forces.y), begin, end);
  for (std::size_t i = begin; i < end; ++i) {
    NodeForce f{};
    if (is_free(b, state, i)) {
      for (std::size_t k = 0; k < 3; ++k) f[k] = {forces.x[k][i], forces.y[k][i]};
      add_springs(f, b, springs, pose, i);
      if (loads.loads != nullptr) add_loads(f, b, loads, pose.x, pose.y, i);
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
