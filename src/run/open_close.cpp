#include "run/open_close.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/switching.hpp"
#include "forces/contact_forces.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {
namespace {

namespace cs = contact_state;
constexpr int most_passes = 12;
constexpr double tolerance = 1e-9;  // of the largest penetration

/// Carried at step n and open before it or after it, or already corrected.
bool switches(const ContactSet& c, std::size_t k) {
  if (!c.is(k, cs::closed) || c.is(k, cs::pulls) || c.effective_1(k) <= 0.0) return false;
  return c.effective_2(k) <= 0.0 || c.effective(k) <= 0.0 || c.alpha[k] < 1.0;
}

std::array<Vec2, 3>& force_on(ForceChange& change, Id block) {
  const auto it = std::lower_bound(change.blocks.begin(), change.blocks.end(), block);
  return change.force[static_cast<std::size_t>(it - change.blocks.begin())];
}

void spread(std::array<Vec2, 3>& f, const BlockSet& b, Id v, Vec2 force) {
  for (std::size_t k = 0; k < 3; ++k) f[k] += b.weight[k][v] * force;
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

/// Gives contact k the part alpha of its force and the shear this allows; adds what this changes.
void reset_force(ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k, double alpha,
                 ForceChange& change) {
  const EdgeFrame e =
      edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
  const Gap gap = gap_to(e, at(pose.x1, pose.y1, c.vertex[k]));
  const double limit = c.cohesion[k] + c.friction[k] * std::max(alpha * c.normal[k], 0.0);
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
  if (!b.fixed[c.block_i[k]]) spread(force_on(change, c.block_i[k]), b, c.vertex[k], d1);
  if (!b.fixed[c.block_j[k]]) {
    std::array<Vec2, 3>& f = force_on(change, c.block_j[k]);
    spread(f, b, c.edge[k], d2);
    spread(f, b, c.edge_end[k], -(d1 + d2));
  }
}

void start_change(ForceChange& change, const ContactSet& c, const BlockSet& b,
                  const std::vector<Id>& set) {
  change.blocks.clear();
  for (const Id k : set) {
    if (!b.fixed[c.block_i[k]]) change.blocks.push_back(c.block_i[k]);
    if (!b.fixed[c.block_j[k]]) change.blocks.push_back(c.block_j[k]);
  }
  std::sort(change.blocks.begin(), change.blocks.end());
  change.blocks.erase(std::unique(change.blocks.begin(), change.blocks.end()), change.blocks.end());
  change.force.assign(change.blocks.size(), {});
}

/// Moves the touched blocks by their changed impulses and looks at their gaps again.
void apply(const ForceChange& change, ContactSet& c, const BlockSet& b, State& s, Pose& pose,
           double dv_per_force, double h_new) {
  for (std::size_t q = 0; q < change.blocks.size(); ++q) {
    const Id i = change.blocks[q];
    const std::array<Vec2, 3> a = accelerations(b, i, change.force[q]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 dv = dv_per_force * a[k];
      s.vx[k][i] += dv.x;
      s.vy[k][i] += dv.y;
      s.x[k][i] += h_new * dv.x;
      s.y[k][i] += h_new * dv.y;
    }
    place_vertices(b, s.x, s.y, i, pose.x, pose.y);
  }
  for (const Id i : change.blocks) {
    for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
      update_gap(c, pose, c.block_entry[q] >> 1);
    }
  }
}

/// The switching contacts after the touched blocks have moved.
void refresh(std::vector<Id>& set, const ForceChange& change, const ContactSet& c) {
  for (const Id i : change.blocks) {
    for (Id q = c.block_begin[i]; q < c.block_begin[i + 1]; ++q) {
      const Id k = c.block_entry[q] >> 1;
      if (switches(c, k)) set.push_back(k);
    }
  }
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

}  // namespace

double largest_penetration(const ContactSet& c) {
  return c.deepest.empty() ? 0.0 : *std::max_element(c.deepest.begin(), c.deepest.end());
}

double correct_switching(ContactSet& c, const BlockSet& b, State& s, Pose& pose,
                         const StepTaken& taken, OpenCloseCounts& counts,
                         SwitchingScratch& scratch) {
  std::vector<Id>& set = scratch.set;
  std::vector<double>& next = scratch.alpha;
  ForceChange& change = scratch.change;
  set.clear();
  const double largest = largest_penetration(c);
  for (std::size_t q = 0; q < c.stirs.size(); ++q) {
    if (c.stirs[q] == 0) continue;
    const std::size_t end = std::min(c.size(), (q + 1) * ContactSet::chunk);
    for (std::size_t k = q * ContactSet::chunk; k < end; ++k) {
      if (switches(c, k)) set.push_back(static_cast<Id>(k));
    }
  }
  if (set.empty()) return largest;
  const double h_mean = 0.5 * (taken.h_old + taken.h_new);
  const double dv_per_force = h_mean / (1.0 + 0.5 * taken.mass_damping * h_mean);
  std::uint64_t passes = 0;
  bool settled = false;
  while (passes < most_passes && !settled) {
    next.clear();
    double worst = 0.0;
    for (const Id k : set) {
      const EdgeFrame e =
          edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
      const double xi = gap_to(e, at(pose.x1, pose.y1, c.vertex[k])).foot / e.length;
      const double push =
          dv_per_force * taken.h_new * c.share[k] * c.normal[k] * inverse_contact_mass(b, c, k, xi);
      const double alpha =
          push > 0.0 ? switching_alpha(c.effective_2(k), c.effective(k) + c.alpha[k] * push, push)
                     : c.alpha[k];
      worst = std::max(worst, std::abs(alpha - c.alpha[k]) * push);
      next.push_back(alpha);
    }
    settled = worst <= tolerance * largest;
    if (settled) break;
    ++passes;
    start_change(change, c, b, set);
    for (std::size_t q = 0; q < set.size(); ++q) reset_force(c, b, pose, set[q], next[q], change);
    apply(change, c, b, s, pose, dv_per_force, taken.h_new);
    refresh(set, change, c);
  }
  ++counts.steps;
  counts.passes += passes;
  counts.most = std::max(counts.most, passes);
  counts.switched += set.size();
  if (!settled) ++counts.unsettled;
  return largest;
}

}  // namespace edda
