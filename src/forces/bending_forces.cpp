#include "forces/bending_forces.hpp"

#include "blocks/bent_state.hpp"
#include "forces/elastic.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {
namespace {

/// Blocks that bend, and the forces on them.
struct BentView {
  BendingView own;
  GradientView gradients;
  ConstNodeValues x, y;
  const double *bend_x, *bend_y, *locked_x, *locked_y;  ///< locked: null where nothing is
  double *modes_x, *modes_y;
  NodeValues fx, fy;
  EDDA_INLINE Deformation deformation_of(std::size_t i) const {
    return deformation(gradients, x, y, i);
  }
};

/// One group.
EDDA_INLINE void add_to_group(const BentView& b, ModePlaces modes, std::size_t i,
                              std::size_t many) {
  GroupTurn turn;
  turn_of_group(b, i, many, turn);
  const Eight c = from<Eight>(turn.c), s = from<Eight>(turn.s);
  ModeArray<Eight> q, g;
  for (std::size_t a = 0; a < modes.count; ++a) {
    const Eight x = from<Eight>(b.bend_x + modes[a]), y = from<Eight>(b.bend_y + modes[a]);
    g.x[a] = q.x[a] = c * x + s * y;
    g.y[a] = q.y[a] = c * y - s * x;
  }
  mode_stress(b.own, modes, i, g);
  for (std::size_t a = 0; b.locked_x != nullptr && a < modes.count; ++a) {
    g.x[a] += from<Eight>(b.locked_x + modes[a]);
    g.y[a] += from<Eight>(b.locked_y + modes[a]);
  }
  for (std::size_t a = 0; a < modes.count; ++a) {
    double *const on_x = b.modes_x + modes[a], *const on_y = b.modes_y + modes[a];
    to<Eight>(on_x, from<Eight>(on_x) - (c * g.x[a] - s * g.y[a]));
    to<Eight>(on_y, from<Eight>(on_y) - (s * g.x[a] + c * g.y[a]));
  }
  alignas(64) double couple[group_size];
  to<Eight>(couple, couple_of(g, q, modes.count));
  add_couples(b.gradients, turn, couple, b.fx, b.fy, i, many);
}

EDDA_VECTOR void add_to_groups(const BentView b, Groups groups, std::size_t begin,
                               std::size_t end) {
  groups.for_each(
      begin,
      end, [&b](std::size_t i, std::size_t many, ModePlaces modes) __attribute__((always_inline)) {
        add_to_group(b, modes, i, many);
      });
}

/// That of step n - 1, x_{n-1} = x_n - h v_{n-1/2}.
Deformation deformation_before(const BlockSet& b, const State& s, double h, std::size_t i) {
  const Deformation now = deformation(b, s.position, i), rate = deformation(b, s.velocity, i);
  return {now.xx - h * rate.xx, now.xy - h * rate.xy, now.yx - h * rate.yx, now.yy - h * rate.yy};
}

}  // namespace

void add_bending(BodyVectors& forces, const BlockSet& b, const State& state,
                 const ModeVectors& locked, std::size_t begin, std::size_t end) {
  const bool any_locked = locked.size() > 0;
  const BentView view{view_of(b.bending),
                      gradients_of(b),
                      values_of(state.position.x),
                      values_of(state.position.y),
                      state.position.modes.x.data(),
                      state.position.modes.y.data(),
                      any_locked ? locked.x.data() : nullptr,
                      any_locked ? locked.y.data() : nullptr,
                      forces.modes.x.data(),
                      forces.modes.y.data(),
                      values_of(forces.x),
                      values_of(forces.y)};
  add_to_groups(view, groups_of(b), begin, end);
}

double bending_energy(const BlockSet& b, const State& s, const ModeVectors& locked, double h,
                      std::size_t i) {
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return 0.0;
  const Deformation now = deformation(b, s.position, i), before = deformation_before(b, s, h, i);
  const BentState at = bent_state(b, s.position.modes, rotation(now), i);
  const Rotation r = rotation(before);
  const ModesOfBlock g = elastic_stress(b, at, i);
  double twice = 0.0;
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes[a];
    const Vec2 then = turned_back(r, s.position.modes[m] - h * s.velocity.modes[m]);
    twice += dot(then, g[a]);
    if (locked.size() > 0) twice += dot(at.s[a] + then, locked[m]);
  }
  return 0.5 * twice;
}

double stored_energy(const BlockSet& b, const State& s, const RockInside& rock, double h,
                     std::size_t i) {
  if (b.is_meshed(i)) return stored_in_zones(*rock.model, *rock.zones, i);
  const Deformation now = deformation(b, s.position, i), before = deformation_before(b, s, h, i);
  double energy = strain_energy(corotated_strain(before, rotation(before)),
                                corotated_strain(now, rotation(now)), b.volume[i], b.lame_lambda[i],
                                b.lame_mu[i]);
  if (!b.initial_xx.empty())
    energy += initial_energy(before, now, initial_stress(b, i), b.volume[i], b.lame_lambda[i],
                             b.lame_mu[i]);
  return energy + bending_energy(b, s, rock.locked_forces(), h, i);
}

}  // namespace edda
