#include "forces/bending_forces.hpp"

#include "blocks/bent_state.hpp"

namespace edda {

void add_bending(NodalForces& forces, const BlockSet& b, const State& state,
                 const ModeVectors& locked, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (b.bending.modes_of(i) == 0 || state.alive[i] == 0) continue;
    const BentState q = bent_state(b, state.bend, rotation(deformation(b, state.x, state.y, i)), i);
    ModesOfBlock g = elastic_stress(b, q, i);
    for (std::size_t a = 0; locked.size() > 0 && a < q.modes.count; ++a)
      g[a] += locked[q.modes.first + a];
    for (std::size_t a = 0; a < q.modes.count; ++a)
      forces.modes.add(q.modes.first + a, -1.0 * turned(q.r, g[a]));
    add(couple_on_nodes(b, q.r, couple_of(q, g), i), forces.x, forces.y, i);
  }
}

double bending_energy(const BlockSet& b, const State& s, const ModeVectors& locked, double h,
                      std::size_t i) {
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return 0.0;
  const Deformation now = deformation(b, s.x, s.y, i), rate = deformation(b, s.vx, s.vy, i);
  const Deformation before{now.xx - h * rate.xx, now.xy - h * rate.xy, now.yx - h * rate.yx,
                           now.yy - h * rate.yy};
  const BentState at = bent_state(b, s.bend, rotation(now), i);
  const Rotation r = rotation(before);
  const ModesOfBlock g = elastic_stress(b, at, i);
  double twice = 0.0;
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes.first + a;
    const Vec2 then = turned_back(r, s.bend[m] - h * s.bend_rate[m]);
    twice += dot(then, g[a]);
    if (locked.size() > 0) twice += dot(at.s[a] + then, locked[m]);
  }
  return 0.5 * twice;
}

}  // namespace edda
