#include "contacts/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {

namespace {

void measure(ContactSet& c, const Pose& pose, std::size_t k) {
  const EdgeFrame e = edge_frame(at(pose.x, pose.y, c.edge[k]), at(pose.x, pose.y, c.edge_end[k]));
  const Gap gap = gap_to(e, at(pose.x, pose.y, c.vertex[k]));
  c.depth[k] = gap.depth;
  c.foot[k] = gap.foot;
  c.span[k] = e.length;
  c.tx[k] = e.t.x;
  c.ty[k] = e.t.y;
}

/// Whether the candidate opened or closed at n - 1 or n, has left its edge or come back to it, has
/// turned its shear round, or has a rest penetration to look after. Bonded and blocked ones are
/// looked after elsewhere.
bool stirs(const ContactSet& c, std::size_t k) {
  using namespace contact_state;
  if (c.is(k, closed)) {
    const bool carried = c.effective_1(k) > c.noise;
    const bool switched = (carried && (c.effective(k) <= 0.0 || c.effective_2(k) <= 0.0)) ||
                          c.effective(k) <= -c.noise;
    const double slip = trial_slip(c, k);
    const bool reversed = c.shear[k] * slip > 0.0 && std::abs(slip) > c.noise;
    const bool leaving = !c.on_edge(k) || (c.share[k] < 1.0 && c.pair_of[k] == no_id);
    return (switched && !c.is(k, pulls)) || (!c.is(k, bonded) && (reversed || leaving));
  }
  return !c.is(k, blocked) && (c.rest[k] != 0.0 || (c.depth[k] > 0.0 && c.on_edge(k)));
}

}  // namespace

void update_gap(ContactSet& c, const Pose& pose, std::size_t k) {
  measure(c, pose, k);
  c.stir(k);
}

void remeasure_gaps(ContactSet& c, const Pose& pose) {
  parallel_chunks(c.size(), ContactSet::chunk,
                  [&](std::size_t q, std::size_t begin, std::size_t end) {
                    bool any = false;
                    double deepest = 0.0;
                    for (std::size_t k = begin; k < end; ++k) {
                      measure(c, pose, k);
                      any = any || stirs(c, k);
                      if (c.is(k, contact_state::closed))
                        deepest = std::max(deepest, c.effective_1(k));
                    }
                    c.stirs[q] = any ? 1 : 0;
                    c.deepest[q] = deepest;
                  });
}

void update_gaps(ContactSet& c, const Pose& pose) {
  std::swap(c.depth_2, c.depth_1);
  std::swap(c.depth_1, c.depth);
  remeasure_gaps(c, pose);
}

void stand_still(ContactSet& c) {
  c.depth_1 = c.depth;
  c.depth_2 = c.depth;
}

void look_at_previous_gaps(ContactSet& c, const Pose& pose) {
  parallel_for(c.size(), [&](std::size_t k) {
    const EdgeFrame e =
        edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
    c.depth_1[k] = c.depth_2[k] = gap_to(e, at(pose.x1, pose.y1, c.vertex[k])).depth;
  });
}

void book_dashpots(ContactSet& c) {
  parallel_for(c.size(), [&](std::size_t k) {
    if (!c.is(k, contact_state::closed)) return;
    const bool pulls = c.is(k, contact_state::pulls);
    const double e = c.effective_1(k);
    const double before = pulls ? c.effective_2(k) : std::max(c.effective_2(k), 0.0);
    const double after = pulls ? c.effective(k) : std::max(c.effective(k), 0.0);
    c.damping_work[k] +=
        0.5 * c.share[k] *
        (c.kn[k] * e * (before - after) + c.alpha[k] * c.normal[k] * (c.depth[k] - c.depth_2[k]));
  });
}

}  // namespace edda
