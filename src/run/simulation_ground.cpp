// What drives and damps the model at its borders, in the explicit method: a ground that shakes,
// boundaries that are moved, waves that leave and come in.
#include <algorithm>

#include "base/parallel.hpp"
#include "forces/nodal_forces.hpp"
#include "model/accelerogram.hpp"
#include "run/simulation.hpp"

namespace edda {

LoadsNow Simulation::acting() const {
  LoadsNow now = loads_at(model, loads, state.time);
  if (!bolts.rows.empty()) now.bolts = &bolts;
  if (at_points()) now.on_nodes = &point_contacts.on_nodes;
  return now;
}

Vec2 Simulation::ground_velocity() const {
  return ground.velocity +
         (0.5 * state.step) * ground_acceleration(model, loads.spells, state.time);
}

/// 2 v of the waves that come up through a boundary, m/s; `none`: of all.
Vec2 Simulation::twice_incoming(Index boundary) const {
  Vec2 sum;
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    const Shaking& shaking = model.shakings[q];
    const Spell& spell = loads.spells.shakings[q];
    if (shaking.apply != ShakingKind::upgoing || !spell.acts()) continue;
    if (boundary != none && shaking.enters != boundary) continue;
    sum += 2.0 * velocity_at(shaking, state.time - spell.since);
  }
  return sum;
}

Simulation::DashpotHold Simulation::dashpot_hold(Vec2 of_ground,
                                                 const std::vector<FreeFieldColumn>& next) const {
  DashpotHold hold;
  const std::size_t points = dashpots.points.size();
  std::vector<Vec2> of_row(model.boundaries.size());
  for (std::size_t q = 0; q < of_row.size(); ++q) {
    of_row[q] = of_ground + twice_incoming(static_cast<Index>(q));
  }
  hold.reference.resize(points);
  if (!free_field.empty()) hold.push.resize(points);
  for (std::size_t p = 0; p < points; ++p) {
    const Index q = free_field.empty() ? none : free_field.column[p];
    if (q == none) {
      hold.reference[p] = of_row[static_cast<std::size_t>(dashpots.points[p].boundary)];
      continue;
    }
    const FreeFieldColumn& now = free_field.columns[static_cast<std::size_t>(q)];
    const FreeFieldColumn& then = next[static_cast<std::size_t>(q)];
    const double y = free_field.height[p];
    hold.reference[p] = 0.5 * (now.at(now.velocity, y) + then.at(then.velocity, y));
    hold.push[p] = free_field.face[p] * now.traction(now.moved, y);
  }
  return hold;
}

std::vector<FreeFieldColumn> Simulation::next_free_field(Vec2 of_ground, double h_old,
                                                         double h_new) const {
  if (free_field.empty()) return {};
  FreeFieldDrive drive;
  drive.lets_waves_in =
      std::any_of(model.shakings.begin(), model.shakings.end(),
                  [](const Shaking& s) { return s.apply == ShakingKind::upgoing; });
  drive.twice_incoming = twice_incoming(none);
  drive.ground = of_ground;
  drive.frame = loads_at(model, loads, state.time).frame;
  drive.mass_damping = drag();
  drive.local_damping = damping.local;
  return next_columns(free_field.columns, drive, h_old, h_new);
}

/// Half a step back, as the blocks: v_{-1/2} = -a_0 h/2. Looks back at where it was, too.
void Simulation::start_ground(double h) {
  if (!ground.moves) return;
  ground.velocity = (-0.5 * h) * ground_acceleration(model, loads.spells, state.time);
  ground.shift_1 = ground.shift - h * ground.velocity;
  springs.shift_1.assign(springs.shift.size(), ground.shift_1);
  for (const Id i : ground.held) {
    for (Id v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
      pose.x1[v] = pose.x[v] - h * ground.velocity.x;
      pose.y1[v] = pose.y[v] - h * ground.velocity.y;
    }
  }
}

void Simulation::drive_ground(double h_old, double h_new) {
  if (!ground.moves) {
    if (dashpots.points.empty()) return;
    next_columns_ = next_free_field({}, h_old, h_new);
    hold_ = dashpot_hold({}, next_columns_);
    return;
  }
  next_ground_ = next_ground(model, loads.spells, ground, springs, state.time, h_old, h_new);
  place_held(blocks, ground, next_ground_.shift, state.x, state.y);
  next_columns_ = next_free_field(next_ground_.velocity, h_old, h_new);
  hold_ = dashpot_hold(0.5 * (ground.velocity + next_ground_.velocity), next_columns_);
}

void Simulation::hold_ground() {
  if (ground.moves) place_held(blocks, ground, ground.shift, state.x, state.y);
}

/// Of faces and bolts at n, on the blocks that the ground moves.
Vec2 Simulation::force_on_held() const {
  Vec2 on_held;
  for (const Id i : ground.held) {
    std::array<Vec2, 3> f{};
    add_bolts(f, bolts, i);
    on_held += contact_resultant(blocks, contacts, i) + f[0] + f[1] + f[2];
  }
  return on_held;
}

/// Work in the leapfrog's terms, f_n . (x_{n+1} - x_{n-1})/2. A dashpot between a block that moves
/// by u and a ground that moves by r dissipates -f . (u - r), and is given f . r. Held blocks and
/// springs that are moved by r against the force f that they bear are given -f . r. What columns
/// push with is work from outside.
void Simulation::book_boundaries(double h_old, double h_new) {
  for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
    const Dashpot& at = dashpots.points[p];
    const bool acts = dashpots.acts[static_cast<std::size_t>(at.boundary)] != 0;
    if (!acts || !is_free(blocks, state, at.block)) continue;
    Vec2 moved;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 before{old_vx_[k][at.block], old_vy_[k][at.block]};
      const Vec2 after{state.vx[k][at.block], state.vy[k][at.block]};
      moved += (0.5 * at.weight[k]) * (h_old * before + h_new * after);
    }
    const Vec2 carried = (0.5 * (h_old + h_new)) * hold_.reference[p];
    const Vec2 push = hold_.push.empty() ? Vec2{} : hold_.push[p];
    damping_work.joules[at.block] -= dot(on_dashpots[p] - push, moved - carried);
    external_work += dot(on_dashpots[p] - push, carried) + dot(push, moved);
  }
  free_field.columns.swap(next_columns_);
  if (!ground.moves) return;
  for (std::size_t q = 0; q < springs.size(); ++q) {
    const auto row = static_cast<std::size_t>(springs.boundary[q]);
    const Vec2 carried = 0.5 * (next_ground_.shifts[row] - springs.shift_1[row]);
    external_work += dot(spring_force(springs, q, pose.x1, pose.y1), carried);
  }
  external_work -= dot(on_held_ + switching_.on_held, 0.5 * (next_ground_.shift - ground.shift_1));
  springs.shift_1 = springs.shift;
  springs.shift = next_ground_.shifts;
  ground.shift_1 = ground.shift;
  ground.shift = next_ground_.shift;
  ground.velocity = next_ground_.velocity;
}

}  // namespace edda
