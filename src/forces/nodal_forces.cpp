#include "forces/nodal_forces.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "blocks/edge_forces.hpp"
#include "blocks/free_blocks.hpp"
#include "forces/bending_forces.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

/// The faces on each edge, and the forces of each.
struct FaceListView {
  const Id *begin_of_edge, *on_edge;
  const double* force;
};

EDDA_VECTOR void sum_faces_of_blocks(FaceListView c, const EdgeForcesView on, std::size_t begin,
                                     std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    EdgeForces of_block(on, i);
    for (Id e = on.vertex_begin[i]; e < on.vertex_begin[i + 1]; ++e) {
      const Id first = c.begin_of_edge[e], last = c.begin_of_edge[e + 1];
      if (first == last) {
        of_block.set_none(e);
        continue;
      }
      Four sum{};
      for (std::size_t q = first; q < last; ++q) {
        const double* const of_face = c.force + c.on_edge[q];
        sum += Four{of_face[0], of_face[1], of_face[2], of_face[3]};
      }
      of_block.set(e, sum);
    }
    of_block.store();
  }
}

/// Calls body(forces) for those of these blocks, ascending, that lie in [begin, end) and are free.
template <class Body>
void change_forces(BodyVectors& forces, const BlockSet& b, const State& state,
                   const std::vector<Id>& blocks, std::size_t begin, std::size_t end, Body body) {
  auto next = std::lower_bound(blocks.begin(), blocks.end(), static_cast<Id>(begin));
  for (; next != blocks.end() && *next < end; ++next) {
    if (!is_free(b, state, *next)) continue;
    BlockForces f{b, *next, vector_of(b, forces, *next)};
    body(f);
    store(f.sum, b, forces, *next);
  }
}

/// Adds the forces of the springs on the free blocks of [begin, end).
void add_springs(BodyVectors& forces, const BlockSet& b, const BoundarySprings& s,
                 const State& state, const Pose& pose, std::size_t begin, std::size_t end) {
  for (Id q = s.block_begin[begin], next = q; q < s.block_begin[end]; q = next) {
    const Id i = b.vertex_block[s.vertex[q]];
    next = s.block_begin[i + 1];
    if (!is_free(b, state, i)) continue;
    BlockForces f{b, i, vector_of(b, forces, i)};
    for (; q < next; ++q) f.at_corner(s.vertex[q], spring_force(s, q, pose.x, pose.y));
    store(f.sum, b, forces, i);
  }
}

/// Adds the loads, then the forces of the bolts, likewise.
void add_loads(BodyVectors& forces, const BlockSet& b, const LoadsNow& loads, const State& state,
               const Pose& pose, std::size_t begin, std::size_t end) {
  if (loads.loads != nullptr) {
    change_forces(forces, b, state, loads.loads->blocks, begin, end,
                  [&](BlockForces& f) { add_loads(f, loads, pose.x, pose.y); });
  }
  if (loads.bolts == nullptr) return;
  for (std::size_t i = begin; i < end; ++i) {
    if (loads.bolts->place[i] == no_id || !is_free(b, state, i)) continue;
    BlockForces f{b, i, vector_of(b, forces, i)};
    add_bolts(f, *loads.bolts);
    store(f.sum, b, forces, i);
  }
}

struct BodyView {
  ConstNodeValues grad_x, grad_y;
  const double *volume, *lame_lambda, *lame_mu, *mass;
};

/// Sets the forces of block i to gravity and elasticity. Every cover is centred on the centroid, so
/// each node carries the same part of the weight.
EDDA_INLINE void body_force(const BodyView& b, const ConstNodeValues& x, const ConstNodeValues& y,
                            Vec2 gravity, const NodeValues& fx, const NodeValues& fy,
                            std::size_t i) {
  const Deformation d = deformation(b, x, y, i);
  const Rotation r = rotation(d);
  const PiolaStress p = piola(d, r, b.lame_lambda[i], b.lame_mu[i]);
  const double det = d.xx * d.yy - d.xy * d.yx;
  const bool sound = (det > 0.2) & (r.strength > 0.2);
  const Vec2 weight = (b.mass[i] / nodes_per_block) * gravity;
  NodeVectors f = at_every_node(weight) + elastic_forces(b, p, i);
  f[0].x += sound ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  store(f, fx, fy, i);
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

/// Adds the force of the initial stress.
EDDA_INLINE void add_initial_force(const InitialView& b, const ConstNodeValues& x,
                                   const ConstNodeValues& y, const NodeValues& fx,
                                   const NodeValues& fy, std::size_t i) {
  const PiolaStress p = initial_stress_term(deformation(b, x, y, i), b.xx[i], b.yy[i], b.xy[i]);
  add(elastic_forces(b, p, i), fx, fy, i);
}

EDDA_VECTOR void add_initial_forces(InitialView b, ConstNodeValues x, ConstNodeValues y,
                                    NodeValues fx, NodeValues fy, std::size_t begin,
                                    std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) add_initial_force(b, x, y, fx, fy, i);
}

}  // namespace

void sum_faces(BodyVectors& on, const BlockSet& b, const FaceSet& contacts,
               const std::vector<double>& forces) {
  for (Nodes* const nodes : {&on.x, &on.y}) {
    for (auto& values : *nodes) values.resize(b.size());
  }
  on.modes.assign(b.mode_places(), 0.0);
  parallel_blocks(b.size(), 40, [&](std::size_t, std::size_t begin, std::size_t end) {
    sum_faces_of_blocks({contacts.begin_of_edge.data(), contacts.on_edge.data(), forces.data()},
                        edge_forces_view(b, on), begin, end);
  });
}

void gather_own_forces(BodyVectors& forces, const BlockSet& b, const State& state, const Pose& pose,
                       const BoundarySprings& springs, Vec2 gravity, const LoadsNow& loads,
                       const RockInside& rock, std::size_t begin, std::size_t end) {
  const BodyView body{values_of(b.grad_x),  values_of(b.grad_y), b.volume.data(),
                      b.lame_lambda.data(), b.lame_mu.data(),    b.mass.data()};
  const Vec2 weight = gravity - loads.gravity_reduction();
  body_forces(body, values_of(state.position.x), values_of(state.position.y), weight,
              values_of(forces.x), values_of(forces.y), begin, end);
  if (!b.initial_xx.empty()) {
    const InitialView initial{values_of(b.grad_x), values_of(b.grad_y), b.volume.data(),
                              b.initial_xx.data(), b.initial_yy.data(), b.initial_xy.data()};
    add_initial_forces(initial, values_of(state.position.x), values_of(state.position.y),
                       values_of(forces.x), values_of(forces.y), begin, end);
  }
  if (b.bending.any()) {
    const auto first = static_cast<std::ptrdiff_t>(b.bending.begin_of_group(begin)),
               last = static_cast<std::ptrdiff_t>(b.bending.begin_of_group(end));
    for (std::vector<double>* of : {&forces.modes.x, &forces.modes.y})
      std::fill(of->begin() + first, of->begin() + last, 0.0);
  }
  if (rock.zones != nullptr)
    set_zone_forces(*rock.model, b, *rock.zones, weight, forces, begin, end);
  add_springs(forces, b, springs, state, pose, begin, end);
  add_loads(forces, b, loads, state, pose, begin, end);
  if (b.bending.any()) add_bending(forces, b, state, rock.locked_forces(), begin, end);
}

void gather_forces(BodyVectors& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const BodyVectors& on_faces, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads, const RockInside& rock, std::size_t begin,
                   std::size_t end) {
  gather_own_forces(forces, b, state, pose, springs, gravity, loads, rock, begin, end);
  const ForcesToAdd to_add{on_faces, forces};
  add_to_free(b, state, to_add, begin, end);
  add_to_modes(b, to_add, begin, end);
}

void gather_forces(BodyVectors& forces, const BlockSet& b, const State& state, const Pose& pose,
                   const BodyVectors& on_faces, const BoundarySprings& springs, Vec2 gravity,
                   const LoadsNow& loads, const RockInside& rock) {
  if (forces.modes.size() != b.mode_places()) forces.modes.assign(b.mode_places(), 0.0);
  parallel_blocks(b.size(), 40, [&](std::size_t, std::size_t begin, std::size_t end) {
    gather_forces(forces, b, state, pose, on_faces, springs, gravity, loads, rock, begin, end);
  });
}

}  // namespace edda
