#include "run/open_close.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/stored_energy.hpp"
#include "contacts/switching.hpp"
#include "forces/contact_forces.hpp"
#include "run/push_block.hpp"

namespace edda {
namespace {

namespace cs = contact_state;
constexpr int most_passes = 30;
constexpr int passes_to_look = 4;   // before the neighbours are looked at again
constexpr double let_be = 0.01;     // of what counts as settled: what others need not answer to
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

/// Dissipated where the return map cuts the slip `trial` so that the shear is `shear`, J.
double booked(const ContactSet& c, std::size_t k, double trial, double shear) {
  const double s = -shear / c.ks[k], s_1 = -c.shear_1[k] / c.ks[k];
  return 0.5 * c.share[k] * c.ks[k] * (trial - s) * (s + s_1);
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
  double size = 0.0;  ///< N, of the force on the vertex
};

/// Gives the contact the part alpha of its force and the shear this allows. What this changes.
ForceChange reset_force(ContactSet& c, const BlockSet& b, const Switcher& s, double alpha) {
  const std::size_t k = s.contact;
  const double limit = c.shear_limit(k, alpha * c.normal[k]);
  const double trial = c.slip_before_cut(k);
  double shear = cut_shear(c.cut(k) ? -c.ks[k] * trial : c.shear[k], limit);
  if (c.is(k, cs::bonded)) {
    shear = c.shear[k];
  } else if (c.effective(k) <= 0.0) {
    const double before = -c.shear_1[k] / c.ks[k];
    const double ahead = c.trial_slip(k) - (s.foot - c.anchor[k] * s.length);
    const double moved = trial - before + ahead;
    shear = -c.ks[k] * releasing_slip(-shear / c.ks[k], limit / c.ks[k], trial, before, moved);
  }
  if (c.effective(k) > 0.0 && reverses(c, k)) {
    // What slides next, s_{n+1}, has s_n + s_{n+1} of its own sign only if s_n is within the next
    // limit.
    shear = cut_shear(shear, next_limit(c, k));
  }
  if (shear != c.shear[k]) {
    c.keep_slips(k);
    c.friction_work[k] += booked(c, k, trial, shear) - booked(c, k, trial, c.shear[k]);
    c.anchor[k] = (s.foot + shear / c.ks[k]) / s.length;
    c.shear[k] = shear;
    if (shear != -c.ks[k] * trial) c.set(k, cs::slipped);
  }
  // The dashpot along the tangent keeps within what friction may still carry.
  if (!c.drag.empty() && !c.is(k, cs::bonded)) {
    const double left = larger(limit - std::abs(shear), 0.0);
    c.drag[k] = std::clamp(c.drag[k], -left, left);
  }
  c.set_alpha(k, alpha);
  const Vec2 old1 = c.on_vertex(k), old2 = c.on_start(k), old3 = c.on_end(k);
  set_contact_force(c, k, s.t, s.length, s.foot, s.depth);
  const Vec2 d1 = c.on_vertex(k) - old1;
  ForceChange change;
  change.size = norm(d1);
  if (change.size == 0.0) return change;
  spread(change.on_i, b, c.vertex[k], d1);
  spread(change.on_j, b, c.edge[k], c.on_start(k) - old2);
  spread(change.on_j, b, c.edge_end[k], c.on_end(k) - old3);
  return change;
}

void keep_once(std::vector<Id>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// One step's correction: what it works on.
class Correction {
 public:
  Correction(ContactSet& contacts, const BlockSet& blocks, State& state, Pose& pose,
             const StepTaken& taken, double largest, SwitchingScratch& scratch)
      : c_(contacts),
        b_(blocks),
        s_(state),
        pose_(pose),
        scratch_(scratch),
        h_new_(taken.h_new),
        dv_per_force_(kick_of(taken)),
        strain_(taken.strain),
        settled_(std::max(tolerance * largest, contacts.noise)) {
    scratch_.moved.resize(b_.size(), 0);
    scratch_.set.clear();
    scratch_.pushed.clear();
  }

  /// Takes those of the chunks that stir. Whether there are any.
  bool find() {
    for (std::size_t q = 0; q < c_.stirs.size(); ++q) {
      if (c_.stirs[q] == 0) continue;
      for (std::size_t k = q * ContactSet::chunk; k < c_.chunk_end(q); ++k) {
        if (switches(c_, k) || reverses(c_, k)) add(static_cast<Id>(k));
      }
    }
    return !scratch_.set.empty();
  }

  /// Goes once through the contacts that switch, but not through those that feel nothing new:
  /// neither they nor the others of their blocks have changed since by more than may be let be.
  /// Whether all have settled.
  bool pass() {
    bool all = true;
    for (Switcher& s : scratch_.set) {
      const Id i = c_.block_i[s.contact], j = c_.block_j[s.contact];
      if (s.done && scratch_.moved[i] <= s.seen && scratch_.moved[j] <= s.seen) continue;
      all = correct(s, i, j) && all;
    }
    return all;
  }

  /// Looks again at the gaps of the blocks that were pushed; adds what switches now. Whether
  /// anything does.
  bool refresh() {
    keep_once(scratch_.pushed);
    const std::size_t known = scratch_.set.size();
    for (const Id i : scratch_.pushed) {
      c_.for_contacts(b_, i, [&](Id k, bool) {
        update_gap(c_, pose_, k);
        if ((switches(c_, k) || reverses(c_, k)) && !is_known(k, known)) add(k);
      });
    }
    scratch_.pushed.clear();
    if (scratch_.set.size() == known) return false;
    const auto by_contact = [](const Switcher& p, const Switcher& q) {
      return p.contact < q.contact;
    };
    const auto same = [](const Switcher& p, const Switcher& q) { return p.contact == q.contact; };
    const auto fresh = scratch_.set.begin() + static_cast<std::ptrdiff_t>(known);
    std::sort(fresh, scratch_.set.end(), by_contact);
    scratch_.set.erase(std::unique(fresh, scratch_.set.end(), same), scratch_.set.end());
    std::inplace_merge(scratch_.set.begin(), fresh, scratch_.set.end(), by_contact);
    return true;
  }

 private:
  bool is_known(Id k, std::size_t known) const {
    const auto end = scratch_.set.begin() + static_cast<std::ptrdiff_t>(known);
    const auto it = std::lower_bound(scratch_.set.begin(), end, k,
                                     [](const Switcher& s, Id id) { return s.contact < id; });
    return it != end && it->contact == k;
  }

  void add(Id k) {
    const EdgeFrame e =
        edge_frame(at(pose_.x1, pose_.y1, c_.edge[k]), at(pose_.x1, pose_.y1, c_.edge_end[k]));
    const Gap gap = gap_to(e, at(pose_.x1, pose_.y1, c_.vertex[k]));
    const double whole = dv_per_force_ * h_new_ * c_.share[k];
    const double per_force = inverse_contact_mass(b_, c_, k, gap.foot / e.length);
    scratch_.set.push_back({k, e.t, e.length, gap.foot, gap.depth, whole * c_.normal[k] * per_force,
                            dv_per_force_ * h_new_ * per_force, 0, false});
  }

  /// Whether the contact has settled.
  bool correct(Switcher& s, Id i, Id j) {
    const Id k = s.contact;
    update_gap(c_, pose_, k);
    const double alpha =
        s.push > 0.0
            ? switching_alpha(c_.effective_2(k), c_.effective(k) + c_.alpha[k] * s.push, s.push)
            : c_.alpha[k];
    const bool same_part = std::abs(alpha - c_.alpha[k]) * s.push <= settled_;
    const ForceChange change = reset_force(c_, b_, s, alpha);
    s.seen = ++scratch_.tick;
    s.done = same_part && change.size * s.moved_per_force <= let_be * settled_;
    if (change.size == 0.0) return same_part;
    push_block(b_, s_, pose_, i, change.on_i, dv_per_force_, h_new_, strain_);
    push_block(b_, s_, pose_, j, change.on_j, dv_per_force_, h_new_, strain_);
    scratch_.pushed.push_back(i);
    scratch_.pushed.push_back(j);
    if (!s.done) scratch_.moved[i] = scratch_.moved[j] = s.seen;
    return same_part;
  }

  ContactSet& c_;
  const BlockSet& b_;
  State& s_;
  Pose& pose_;
  SwitchingScratch& scratch_;
  double h_new_, dv_per_force_;
  StrainDamping* strain_;
  double settled_;  ///< m
};

}  // namespace

double largest_penetration(const ContactSet& c) {
  return c.deepest.empty() ? 0.0 : *std::max_element(c.deepest.begin(), c.deepest.end());
}

double correct_switching(ContactSet& c, const BlockSet& b, State& s, Pose& pose,
                         const StepTaken& taken, OpenCloseCounts& counts,
                         SwitchingScratch& scratch) {
  const double largest = largest_penetration(c);
  Correction correction(c, b, s, pose, taken, largest, scratch);
  if (!correction.find()) return largest;
  std::uint64_t passes = 0;
  bool settled = false, more = true;
  while (more) {
    do {
      settled = correction.pass();
      ++passes;
    } while (!settled && passes % passes_to_look != 0);
    more = (correction.refresh() || !settled) && passes < most_passes;
  }
  ++counts.steps;
  counts.passes += passes;
  counts.most = std::max(counts.most, passes);
  counts.switched += scratch.set.size();
  if (counts.of_list != c.rebuilds || counts.of_contact.size() != c.size()) {
    counts.of_contact.assign(c.size(), 0);
    counts.of_list = c.rebuilds;
  }
  for (const Switcher& one : scratch.set) ++counts.of_contact[one.contact];
  if (!settled) ++counts.unsettled;
  return largest;
}

}  // namespace edda
