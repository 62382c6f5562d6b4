#include "run/open_close.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/stored_energy.hpp"
#include "contacts/switching.hpp"
#include "forces/contact_forces.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {
namespace {

namespace cs = contact_state;
constexpr int most_passes = 30;
constexpr double tolerance = 1e-9;  // of the largest penetration

/// Carried at step n and open before it or after it, or already corrected.
bool switches(const ContactSet& c, std::size_t k) {
  if (!c.is(k, cs::closed) || c.is(k, cs::pulls) || c.effective_1(k) <= c.noise) return false;
  return c.effective_2(k) <= 0.0 || c.effective(k) <= 0.0 || c.alpha[k] < 1.0;
}

/// Coulomb's limit at step n + 1.
double next_limit(const ContactSet& c, std::size_t k) {
  return c.shear_limit(k, c.kn[k] * c.effective(k));
}

/// Stays closed, but its shear has passed through zero within the step and slides the other way:
/// the spring went on pushing after it had given back all it held.
bool reverses(const ContactSet& c, std::size_t k) {
  if (!c.is(k, cs::closed) || c.is(k, cs::bonded)) return false;
  const double slip = trial_slip(c, k);
  return slip * c.shear[k] > 0.0 && std::abs(slip) > c.noise &&
         c.ks[k] * std::abs(slip) > next_limit(c, k);
}

double booked(const ContactSet& c, std::size_t k, double shear) {
  const double s = -shear / c.ks[k], s_1 = -c.shear_1[k] / c.ks[k];
  return 0.5 * c.share[k] * c.ks[k] * (c.slip_trial[k] - s) * (s + s_1);
}

/// Slip s (not more than `most`) of a contact that opens: its shear spring gives up what it stores
/// between n - 1 and n, p_t s_tr s_{n-1}/2, and its force does the work -p_t s (D_n + D_{n+1})/2. s
/// is the nearest to `nominal` for which the first covers the second, so that letting go dissipates
/// and never drives.
double releasing_slip(double nominal, double most, double trial, double before, double moved) {
  const double released = trial * before;
  if (nominal * moved + released >= 0.0 || moved == 0.0) return nominal;
  return std::clamp(-released / moved, -most, most);
}

/// Changes of the nodal forces on the two blocks of a contact.
struct ForceChange {
  std::array<Vec2, 3> on_i{}, on_j{};
};

/// Gives contact k the part alpha of its force and the shear this allows. What this changes.
ForceChange reset_force(ContactSet& c, const BlockSet& b, std::size_t k, double alpha,
                        const EdgeFrame& e, const Gap& gap) {
  const double limit = c.shear_limit(k, alpha * c.normal[k]);
  double shear = cut_shear(-c.ks[k] * c.slip_trial[k], limit);
  if (c.is(k, cs::bonded)) {
    shear = c.shear[k];
  } else if (c.effective(k) <= 0.0) {
    const double before = -c.shear_1[k] / c.ks[k];
    const double ahead =
        (c.foot[k] - c.anchor[k] * c.span[k]) - (gap.foot - c.anchor[k] * e.length);
    const double moved = c.slip_trial[k] - before + ahead;
    shear = -c.ks[k] *
            releasing_slip(-shear / c.ks[k], limit / c.ks[k], c.slip_trial[k], before, moved);
  }
  if (c.effective(k) > 0.0 && reverses(c, k)) {
    // What slides next, s_{n+1}, has s_n + s_{n+1} of its own sign only if s_n is within the next
    // limit.
    shear = cut_shear(shear, next_limit(c, k));
  }
  if (shear != c.shear[k]) {
    c.friction_work[k] += booked(c, k, shear) - booked(c, k, c.shear[k]);
    c.anchor[k] = (gap.foot + shear / c.ks[k]) / e.length;
    c.shear[k] = shear;
    if (shear != -c.ks[k] * c.slip_trial[k]) c.set(k, cs::sliding | cs::slipped);
  }
  c.alpha[k] = alpha;
  const Vec2 old1{c.fx[k], c.fy[k]}, old2{c.gx[k], c.gy[k]};
  set_contact_force(c, k, e.t, e.length, gap.foot, gap.depth);
  const Vec2 d1 = Vec2{c.fx[k], c.fy[k]} - old1, d2 = Vec2{c.gx[k], c.gy[k]} - old2;
  ForceChange change;
  spread(change.on_i, b, c.vertex[k], d1);
  spread(change.on_j, b, c.edge[k], d2);
  spread(change.on_j, b, c.edge_end[k], -(d1 + d2));
  return change;
}

/// Moves block i by a changed impulse.
void push(const BlockSet& b, State& s, Pose& pose, Id i, const std::array<Vec2, 3>& force,
          double dv_per_force, double h_new) {
  if (b.fixed[i]) return;
  const std::array<Vec2, 3> a = accelerations(b, i, force);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 dv = dv_per_force * a[k];
    s.vx[k][i] += dv.x;
    s.vy[k][i] += dv.y;
    s.x[k][i] += h_new * dv.x;
    s.y[k][i] += h_new * dv.y;
  }
  place_vertices(b, s.x, s.y, i, pose.x, pose.y);
}

void keep_once(std::vector<Id>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Looks again at the gaps of the blocks that were pushed; adds what switches now.
void refresh(SwitchingScratch& scratch, ContactSet& c, const Pose& pose) {
  keep_once(scratch.pushed);
  for (const Id i : scratch.pushed) {
    for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
      const Id k = c.block_entry[q] >> 1;
      update_gap(c, pose, k);
      if (switches(c, k) || reverses(c, k)) scratch.set.push_back(k);
    }
  }
  keep_once(scratch.set);
}

}  // namespace

double largest_penetration(const ContactSet& c) {
  return c.deepest.empty() ? 0.0 : *std::max_element(c.deepest.begin(), c.deepest.end());
}

double correct_switching(ContactSet& c, const BlockSet& b, State& s, Pose& pose,
                         const StepTaken& taken, OpenCloseCounts& counts,
                         SwitchingScratch& scratch) {
  scratch.set.clear();
  const double largest = largest_penetration(c);
  for (std::size_t q = 0; q < c.stirs.size(); ++q) {
    if (c.stirs[q] == 0) continue;
    for (std::size_t k = q * ContactSet::chunk; k < c.chunk_end(q); ++k) {
      if (switches(c, k) || reverses(c, k)) scratch.set.push_back(static_cast<Id>(k));
    }
  }
  if (scratch.set.empty()) return largest;
  const double h_mean = 0.5 * (taken.h_old + taken.h_new);
  const double dv_per_force = h_mean / (1.0 + 0.5 * taken.mass_damping * h_mean);
  std::uint64_t passes = 0;
  bool settled = false;
  while (passes < most_passes && !settled) {
    double worst = 0.0;
    scratch.pushed.clear();
    for (const Id k : scratch.set) {
      update_gap(c, pose, k);
      const EdgeFrame e =
          edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
      const Gap gap = gap_to(e, at(pose.x1, pose.y1, c.vertex[k]));
      const double push_whole = dv_per_force * taken.h_new * c.share[k] * c.normal[k] *
                                inverse_contact_mass(b, c, k, gap.foot / e.length);
      const double alpha =
          push_whole > 0.0 ? switching_alpha(c.effective_2(k),
                                             c.effective(k) + c.alpha[k] * push_whole, push_whole)
                           : c.alpha[k];
      worst = std::max(worst, std::abs(alpha - c.alpha[k]) * push_whole);
      const ForceChange change = reset_force(c, b, k, alpha, e, gap);
      push(b, s, pose, c.block_i[k], change.on_i, dv_per_force, taken.h_new);
      push(b, s, pose, c.block_j[k], change.on_j, dv_per_force, taken.h_new);
      scratch.pushed.push_back(c.block_i[k]);
      scratch.pushed.push_back(c.block_j[k]);
    }
    ++passes;
    settled = worst <= std::max(tolerance * largest, c.noise);
    refresh(scratch, c, pose);
  }
  ++counts.steps;
  counts.passes += passes;
  counts.most = std::max(counts.most, passes);
  counts.switched += scratch.set.size();
  if (!settled) ++counts.unsettled;
  return largest;
}

}  // namespace edda
