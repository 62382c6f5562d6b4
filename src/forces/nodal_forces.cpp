#include "forces/nodal_forces.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

using NodeForce = std::array<Vec2, 3>;

void add_contacts_one_by_one(NodeForce& f, const BlockSet& b, const ContactSet& c, std::size_t i) {
  for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
    const Id k = c.block_entry[q] >> 1;
    const Vec2 f1{c.fx[k], c.fy[k]}, f2{c.gx[k], c.gy[k]};
    if ((c.block_entry[q] & 1u) == 0) {
      spread(f, b, c.vertex[k], f1);
    } else {
      spread(f, b, c.edge[k], f2);
      spread(f, b, c.edge_end[k], -(f1 + f2));
    }
  }
}

/// Contact forces are summed on the vertices first and spread to the nodes once per vertex.
constexpr Id most_corners = 64;

void add_contacts(NodeForce& f, const BlockSet& b, const ContactSet& c, std::size_t i) {
  const Id first = b.vertex_begin[i], corners = b.vertex_begin[i + 1] - first;
  if (corners > most_corners) {
    add_contacts_one_by_one(f, b, c, i);
    return;
  }
  std::array<Vec2, most_corners> on;
  std::fill_n(on.begin(), corners, Vec2{});
  for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
    const Id k = c.block_entry[q] >> 1;
    const Vec2 f1{c.fx[k], c.fy[k]};
    if ((c.block_entry[q] & 1u) == 0) {
      on[c.vertex[k] - first] += f1;
    } else {
      const Vec2 f2{c.gx[k], c.gy[k]};
      on[c.edge[k] - first] += f2;
      on[c.edge_end[k] - first] -= f1 + f2;
    }
  }
  for (Id v = 0; v < corners; ++v) spread(f, b, first + v, on[v]);
}

void add_springs(NodeForce& f, const BlockSet& b, const BoundarySprings& s, const Pose& pose,
                 std::size_t i) {
  for (Id q = s.block_begin[i]; q < s.block_begin[i + 1]; ++q) {
    const Id v = s.vertex[q];
    const double ux = pose.x[v] - s.start_x[q], uy = pose.y[v] - s.start_y[q];
    spread(f, b, v, {-(s.kxx[q] * ux + s.kxy[q] * uy), -(s.kxy[q] * ux + s.kyy[q] * uy)});
  }
}

void add_elastic(NodeForce& f, const BlockSet& b, const State& state, std::size_t i) {
  const Deformation d = deformation(b, state.x, state.y, i);
  const Rotation r = rotation(d);
  const double det = d.xx * d.yy - d.xy * d.yx;
  if (!(det > 0.2) || !(r.strength > 0.2)) {
    f[0].x = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const PiolaStress p = piola(d, r, b.lame_lambda[i], b.lame_mu[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] += elastic_force(p, b.volume[i], b.grad_x[k][i], b.grad_y[k][i]);
  }
}

}  // namespace

void gather_forces(NodalForces& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const ContactSet& contacts, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !state.alive[i]) return;
    NodeForce f;
    // Every cover is centred on the centroid, so each node carries a third of the weight.
    for (Vec2& node : f) node = (b.mass[i] / 3.0) * gravity;
    add_elastic(f, b, state, i);
    add_springs(f, b, springs, pose, i);
    if (loads.loads != nullptr) add_loads(f, b, loads, pose.x, pose.y, i);
    add_contacts(f, b, contacts, i);
    for (std::size_t k = 0; k < 3; ++k) {
      forces.x[k][i] = f[k].x;
      forces.y[k][i] = f[k].y;
    }
  });
}

Vec2 contact_resultant(const BlockSet& b, const ContactSet& c, std::size_t i) {
  NodeForce f{};
  add_contacts(f, b, c, i);
  return f[0] + f[1] + f[2];
}

}  // namespace edda
