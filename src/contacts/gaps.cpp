#include "contacts/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "base/vector_loop.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {

namespace {

/// Where candidate k stands; t and l of its edge.
EDDA_INLINE void measure(const ContactView& c, const double* x, const double* y, std::size_t k) {
  const Id p = c.edge[k], q = c.edge_end[k], v = c.vertex[k];
  const EdgeFrame e = edge_frame({x[p], y[p]}, {x[q], y[q]});
  const Gap gap = gap_to(e, {x[v], y[v]});
  c.depth[k] = gap.depth;
  c.foot[k] = gap.foot;
  c.span[k] = e.length;
  c.tx[k] = e.t.x;
  c.ty[k] = e.t.y;
}

/// Whether the candidate opened or closed at n - 1 or n, has left its edge or come back to it, has
/// turned its shear round, or has a rest penetration to look after. Bonded ones are looked after
/// elsewhere, and so are blocked ones, whose rest penetration is infinite.
EDDA_INLINE bool may_switch(const ContactView& c, std::size_t k, double noise) {
  const double hold = c.hold[k], rest = c.rest[k], depth = c.depth[k], foot = c.foot[k];
  const double e = depth - rest, e_1 = c.effective_1(k), e_2 = c.effective_2(k);
  const double slip = c.trial_slip(k), shear = c.shear[k];
  const double from = -c.before[k], to = c.span[k] + c.beyond[k];
  // & and |, not && and ||: no branches.
  const bool switched = ((e_1 > noise) & ((e <= 0.0) | (e_2 <= 0.0))) | (e <= -noise);
  const bool reversed = (shear * slip > 0.0) & (std::abs(slip) > noise);
  const bool away = (foot < from) | (foot > to), on = !away;
  const bool cut = !is_bonded(hold), pushes = !may_pull(hold);
  const bool closed_one = (switched & pushes) | ((reversed | away) & cut);
  const bool inside = (depth > 0.0) & on;
  const bool open_one = ((rest != 0.0) | inside) & (rest < std::numeric_limits<double>::infinity());
  const bool closed = carries(hold), open = !closed;
  return (closed & closed_one) | (open & open_one);
}

/// Where a chunk's findings go, by chunk.
struct Findings {
  std::uint8_t* stirs;
  const std::uint8_t* lingers;
  double* deepest;
};

/// Measures the candidates [begin, end), whole chunks.
EDDA_VECTOR void measure_chunks(ContactView c, const double* x, const double* y, double noise,
                                Findings found, std::size_t begin, std::size_t end) {
  for (std::size_t first = begin; first < end; first += ContactSet::chunk) {
    const std::size_t last = std::min(end, first + ContactSet::chunk);
    double stirring = 0.0, depth = 0.0;
#pragma omp simd reduction(max : stirring, depth)
    for (std::size_t k = first; k < last; ++k) {
      measure(c, x, y, k);
      stirring = larger(stirring, may_switch(c, k, noise) ? 1.0 : 0.0);
      depth = larger(depth, carries(c.hold[k]) ? c.effective_1(k) : 0.0);
    }
    const std::size_t q = first / ContactSet::chunk;
    found.stirs[q] = stirring > 0.0 || found.lingers[q] != 0 ? 1 : 0;
    found.deepest[q] = depth;
  }
}

/// What the dashpot of candidate k took in the last step, J (see book_dashpots() in gaps.hpp).
EDDA_INLINE double taken_by_dashpot(const ContactView& c, const double* alpha, std::size_t k) {
  const double hold = c.hold[k], e = c.effective_1(k), e_2 = c.effective_2(k), e_0 = c.effective(k);
  const double before = may_pull(hold) ? e_2 : larger(e_2, 0.0);
  const double after = may_pull(hold) ? e_0 : larger(e_0, 0.0);
  const double work =
      0.5 * c.share[k] *
      (c.kn[k] * e * (before - after) + alpha[k] * c.normal[k] * (c.depth[k] - c.depth_2[k]));
  return carries(hold) ? work : 0.0;
}

/// As above, of the dashpot along the tangent: its force over (s_{n+1} - s_{n-1})/2.
EDDA_INLINE double taken_by_drag(const ContactView& c, std::size_t k) {
  const double slid = c.trial_slip(k) + c.shear_1[k] / c.ks[k];
  return c.drag[k] != 0.0 ? -0.5 * c.share[k] * c.drag[k] * slid : 0.0;
}

EDDA_VECTOR void book_dashpots(ContactView c, const double* alpha, double* taken, std::size_t begin,
                               std::size_t end) {
#pragma omp simd
  for (std::size_t k = begin; k < end; ++k) taken[k] += taken_by_dashpot(c, alpha, k);
}

void book_drags(ContactView c, double* taken, std::size_t begin, std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) taken[k] += taken_by_drag(c, k);
}

}  // namespace

void update_gap(ContactSet& c, const Pose& pose, std::size_t k) {
  measure(c.view(), pose.x.data(), pose.y.data(), k);
  c.stir(k);
}

void remeasure_gaps(ContactSet& c, const Pose& pose) {
  const ContactView view = c.view();
  const Findings found{c.stirs.data(), c.lingers.data(), c.deepest.data()};
  parallel_chunks(c.size(), ContactSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    measure_chunks(view, pose.x.data(), pose.y.data(), c.noise, found, begin, end);
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
    c.depth_1[k] = c.depth_2[k] = previous_gap(c, pose, k).depth;
  });
}

std::vector<double> previous_slips(const ContactSet& c, const Pose& pose) {
  std::vector<double> slips(c.size());
  parallel_for(c.size(), [&](std::size_t k) {
    const double length = previous_edge(c, pose, k).length;
    slips[k] = previous_gap(c, pose, k).foot - c.anchor[k] * length;
  });
  return slips;
}

void move_previous_slips(ContactSet& c, const Pose& pose, const std::vector<double>& before) {
  const std::vector<double> now = previous_slips(c, pose);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, contact_state::closed) || now[k] == before[k]) continue;
    if (c.cut(k)) {
      c.anchor[k] += (now[k] - before[k]) / c.span[k];
    } else {
      c.shear[k] -= c.ks[k] * (now[k] - before[k]);
      c.forget_cut(k);
    }
  }
}

void book_dashpots(ContactSet& c) {
  parallel_chunks(c.size(), ContactSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    book_dashpots(c.view(), c.alpha.data(), c.damping_work.data(), begin, end);
    if (!c.drag.empty()) book_drags(c.view(), c.damping_work.data(), begin, end);
  });
}

}  // namespace edda
