#include "contacts/transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/inside.hpp"
#include "contacts/settling.hpp"
#include "contacts/shares.hpp"
#include "contacts/shield.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

/// Part of a block's size below which a penetration is rounding, not a place it came from.
constexpr double rounding = 1e-12;

/// A contact that closes in a step feels the slip of that whole step: in the ledger's terms its
/// force acts from x_{n-1} to x_{n+1}. (Starting from s = 0 at step n would leave the first force
/// of every impact without friction, and a stiff contact may last no longer.)
void start_shear(ContactSet& c, const Pose& pose, std::size_t k) {
  c.anchor[k] = previous_gap(c, pose, k).foot / previous_edge(c, pose, k).length;
  c.shear[k] = c.shear_1[k] = c.slip_trial[k] = 0.0;
}

/// What has lost its partner is given the rest of its share at the next step.
void watch_part(ContactSet& c, std::size_t k) {
  if (c.share[k] < 1.0 && c.pair_of[k] == no_id) c.lingers[k / ContactSet::chunk] = 1;
}

void close(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
           std::size_t k) {
  set_spring(c, b, pose, laws, k);
  c.set(k, cs::closed);
  c.alpha[k] = 1.0;
  c.normal[k] = 0.0;
  start_shear(c, pose, k);
  watch_part(c, k);
}

/// `keeps`: its rest penetration, where that is below zero, for when it closes again.
void open(ContactSet& c, std::size_t k, bool keeps = false) {
  c.clear(k, cs::closed | cs::bonded | cs::pulls | cs::sliding);
  c.set(k, cs::opened);
  c.normal[k] = c.shear[k] = c.shear_1[k] = c.slip_trial[k] = 0.0;
  c.alpha[k] = 1.0;
  const double least = keeps ? -std::numeric_limits<double>::infinity() : 0.0;
  c.rest[k] = std::max(least, std::min(c.rest[k], std::max(c.depth[k], 0.0)));
  if (c.pair_of[k] == no_id) c.share[k] = 1.0;
}

void block_contact(ContactSet& c, std::size_t k, Blocked why) {
  c.set(k, cs::blocked);
  c.why[k] = why;
  c.rest[k] = std::numeric_limits<double>::infinity();
  c.blocked.push_back(static_cast<Id>(k));
}

bool convex(const BlockSet& b, Id vertex) {
  return b.corner[vertex] < 0.999 * std::numbers::pi;
}

/// Edges of one block that meet in a convex corner explain one penetration in two ways.
bool rivals(const BlockSet& b, Id e, Id f) {
  return (b.next[e] == f && convex(b, f)) || (b.next[f] == e && convex(b, e));
}

/// Takes the contact k over into `heir`: the same stored energy, and so (stiffness being equal) the
/// same force, shear and bond. The rest penetration may be negative until the heir opens.
void hand_over(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
               std::size_t k, std::size_t heir) {
  const double before = stored_energy(c, k);
  const double slip = trial_slip(c, k), slip_before_cut = c.slip_before_cut(k);
  c.keep_slips(heir);
  if (!c.is(heir, cs::closed)) {
    set_spring(c, b, pose, laws, heir);
    // The spring goes on as it is; only the strength is that of the heir's own law.
    c.kn[heir] = c.kn[k];
    c.ks[heir] = c.ks[k];
    c.length[heir] = c.length[k];
    c.cohesion[heir] = laws.rows[c.law[heir]].residual_cohesion * c.length[k] * laws.thickness;
  }
  // e' (e' - (d'_n - d'_{n-1})) p' = e_n e_{n-1} p, so that the ledger sees no change.
  const double stiffness = c.kn[heir] * std::max(c.share[heir], 0.5);
  const double product = c.effective(k) * c.effective_1(k) * c.kn[k] * c.share[k] / stiffness;
  const double gained = c.depth[heir] - c.depth_1[heir];
  const double now = 0.5 * (gained + std::sqrt(gained * gained + 4.0 * std::max(product, 0.0)));
  c.set(heir,
        static_cast<std::uint8_t>(c.state[k] & (cs::closed | cs::bonded | cs::pulls | cs::glued)));
  if (!c.lent.empty()) c.lent[heir] = c.lent[k];
  c.rest[heir] = c.depth[heir] - now;
  c.anchor[heir] = (c.foot[heir] - slip) / c.span[heir];
  c.shear[heir] = c.shear[k] * c.ks[heir] / c.ks[k];
  c.shear_1[heir] = c.shear_1[k] * c.ks[heir] / c.ks[k];
  c.slip_trial[heir] = slip_before_cut;
  c.normal[heir] = c.normal[k] * c.kn[heir] / c.kn[k];
  c.set_alpha(heir, c.alpha[k]);
  c.take_slip_of(heir, k);
  if (c.is(k, cs::bonded)) {
    c.friction[heir] = c.friction[k];
    c.cohesion[heir] = c.cohesion[k];
    c.tension[heir] = c.tension[k];
    for (Segment& s : c.segments) {
      std::replace(s.members.begin(), s.members.end(), static_cast<Id>(k), static_cast<Id>(heir));
    }
  }
  c.friction_work[k] += before - stored_energy(c, heir);
  watch_part(c, heir);
}

void unblock(ContactSet& c, std::size_t k, double rest) {
  c.clear(k, cs::blocked);
  c.why[k] = Blocked::no;
  c.rest[k] = rest;
}

double slack_of(const ContactSet& c, std::size_t k) {
  return 1e-6 * c.span[k] + 2.0 * std::abs(c.depth[k]);
}

/// The same vertex on a collinear edge, of the same block or the next, which takes all of k's
/// spring over at once.
Id collinear_heir(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const Id vertex = c.vertex[k];
  for (Id q = c.begin_of_vertex[vertex]; q < c.begin_of_vertex[vertex + 1]; ++q) {
    if (q == k || c.is(q, cs::closed) || c.depth[q] <= 0.0 || !c.on_edge(q, slack_of(c, k)) ||
        c.why[q] == Blocked::shield) {
      continue;
    }
    if (dot(tangent_of(c, q), tangent_of(c, k)) > opposite &&
        !lies_outside(c, b, pose, q, c.noise)) {
      return q;
    }
  }
  return no_id;
}

/// Whether the vertex comes onto edge q along one that goes on in it: over a seam, not against what
/// lies behind it.
bool comes_along(const ContactSet& c, Id vertex, Id q) {
  for (Id p = c.begin_of_vertex[vertex]; p < c.begin_of_vertex[vertex + 1]; ++p) {
    if (p != q && c.is(p, cs::closed) && c.share[p] > 0.0 &&
        std::abs(c.depth[p] - c.depth[q]) <= slack_of(c, p) &&
        dot(tangent_of(c, p), tangent_of(c, q)) > opposite) {
      return true;
    }
  }
  return false;
}

/// The same of the corner between the edges of k and q: it may come along onto one of the vertex's
/// own edges, whose end the vertex is.
bool comes_along_own(const ContactSet& c, const BlockSet& b, std::size_t k, Id q) {
  const Id vertex = c.vertex[k], e = c.edge[k], f = c.edge[q];
  const Id corner = b.next[e] == f ? f : e;
  for (Id r = c.begin_of_vertex[corner]; r < c.begin_of_vertex[corner + 1]; ++r) {
    const bool own = c.edge[r] == vertex || c.edge[r] == b.previous[vertex];
    if (own && comes_along(c, corner, r)) return true;
  }
  return false;
}

/// The corner that k passes, against one of the vertex's own edges; it may carry already.
Id corner_heir(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const Id vertex = c.vertex[k];
  const Id corner = c.foot[k] < 0.5 * c.span[k] ? c.edge[k] : c.edge_end[k];
  for (Id q = c.begin_of_vertex[corner]; q < c.begin_of_vertex[corner + 1]; ++q) {
    const bool mine = c.edge[q] == vertex || c.edge[q] == b.previous[vertex];
    if (mine && c.depth[q] > 0.0 && c.on_edge(q, slack_of(c, k)) && c.why[q] != Blocked::shield &&
        facing(b, pose.x, pose.y, corner, normal_of(c, q)) &&
        !lies_outside(c, b, pose, q, c.noise)) {
      return q;
    }
  }
  return no_id;
}

/// Gives `heir` so much more normal energy (J) by moving its rest penetration; returns what it
/// took.
double load(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
            std::size_t heir, double energy) {
  if (!c.is(heir, cs::closed)) {
    if (c.is(heir, cs::blocked)) unblock(c, heir, 0.0);
    close(c, b, pose, laws, heir);
    c.rest[heir] = std::max(c.depth[heir], c.depth_1[heir]);
    c.anchor[heir] = c.foot[heir] / c.span[heir];
  }
  const double stiffness = c.kn[heir] * c.share[heir];
  if (stiffness <= 0.0 || c.is(heir, cs::bonded | cs::pulls)) return 0.0;
  const double before = stored_energy(c, heir);
  const double product = std::max(c.effective(heir), 0.0) * std::max(c.effective_1(heir), 0.0) +
                         2.0 * energy / stiffness;
  const double gained = c.depth[heir] - c.depth_1[heir];
  c.rest[heir] = c.depth[heir] - 0.5 * (gained + std::sqrt(gained * gained + 4.0 * product));
  return stored_energy(c, heir) - before;
}

/// Part of its force that a contact keeps whose foot has run past the end of its edge by s r:
/// 1 - s^2 for s up to 1, r twice r_v. What another takes over then grows as s, and neither jumps.
double kept_past_end(const ContactSet& c, const BlockSet& b, std::size_t k) {
  const double past = std::max(-c.before[k] - c.foot[k], c.foot[k] - c.span[k] - c.beyond[k]);
  const double run_off = 2.0 * corner_reach *
                         std::min({b.edge_length[c.edge[k]], b.edge_length[c.vertex[k]],
                                   b.edge_length[b.previous[c.vertex[k]]]});
  const double s = past / run_off;
  return std::max(0.0, 1.0 - s * s);
}

/// The foot of a closed contact has left its edge. Without a collinear heir it lets go little by
/// little; what the normal spring gives off goes to the corner that it passes, if that carries.
void leave(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws, std::size_t k,
           TransitionCounts& counts) {
  const Id heir = c.share[k] > 0.0 ? collinear_heir(c, b, pose, k) : no_id;
  if (heir != no_id) {
    if (c.is(heir, cs::blocked)) unblock(c, heir, 0.0);
    hand_over(c, b, pose, laws, k, heir);
    ++counts.handed_over;
    open(c, k);
    ++counts.opened;
    return;
  }
  const double kept = c.is(k, cs::pulls) ? 0.0 : kept_past_end(c, b, k);
  // A shared spring has been given its share of this step already.
  const double whole = c.pair_of[k] == no_id ? 1.0 : c.share[k];
  const double given_up = c.share[k] - kept * whole;
  const double energy =
      0.5 * given_up * c.kn[k] * std::max(c.effective(k), 0.0) * std::max(c.effective_1(k), 0.0);
  if (kept * whole > 0.0) {
    change_share(c, k, kept * whole, false);
    if (c.pair_of[k] != no_id) c.pair_memory.forget(c.pair_of[k]);
    watch_part(c, k);
  } else {
    c.friction_work[k] += stored_energy(c, k);
    open(c, k);
    ++counts.opened;
  }
  const Id corner = energy > 0.0 ? corner_heir(c, b, pose, k) : no_id;
  if (corner == no_id) return;
  c.friction_work[k] -= load(c, b, pose, laws, corner, energy);
  ++counts.handed_over;
}

/// A corner that comes into its share of a spring from the side, the share still small, takes its
/// partner's history.
bool inherit_from_partner(ContactSet& c, std::size_t k) {
  if (c.pair_of[k] == no_id) return false;
  const CornerPair& p = c.pairs[c.pair_of[k]];
  const Id other = p.first == k ? p.second : p.first;
  constexpr double small = 0.1;
  if (!p.same_way() || !c.is(other, cs::closed) || c.share[k] > small) return false;
  c.rest[k] = std::min(c.rest[other], std::max(c.depth[k], 0.0));
  c.anchor[k] = (c.foot[k] - trial_slip(c, other)) / c.span[k];
  c.shear[k] = c.shear[other] * c.ks[k] / c.ks[other];
  c.shear_1[k] = c.shear_1[other] * c.ks[k] / c.ks[other];
  c.forget_cut(k);
  c.take_slip_of(k, other);
  return true;
}

/// `start`: what lies in each other by rounding alone touches, and is closed once it is pressed.
void find_events(ContactSet& c, bool start, TransitionScratch& events) {
  const double closes_beyond = start ? c.noise : 0.0;
  events.opens.clear();
  events.leaves.clear();
  events.returns.clear();
  events.closes.clear();
  for (std::size_t q = 0; q < c.stirs.size(); ++q) {
    if (c.stirs[q] == 0) continue;
    c.lingers[q] = 0;
    for (std::size_t k = q * ContactSet::chunk; k < c.chunk_end(q); ++k) {
      if (c.is(k, cs::closed)) {
        if (c.is(k, cs::bonded)) continue;
        // Rounding alone must not open and close joints that just touch.
        if (c.effective(k) <= -c.noise && !c.is(k, cs::pulls)) {
          events.opens.push_back(static_cast<Id>(k));
        } else if (!c.on_edge(k)) {
          events.leaves.push_back(static_cast<Id>(k));
        } else if (c.share[k] < 1.0 && c.pair_of[k] == no_id) {
          events.returns.push_back(static_cast<Id>(k));
        }
      } else if (!c.is(k, cs::blocked)) {
        if (c.effective(k) > closes_beyond) {
          if (c.on_edge(k)) events.closes.push_back(static_cast<Id>(k));
        } else if (c.rest[k] != 0.0) {
          c.rest[k] = std::min(c.rest[k], std::max(c.depth[k], 0.0));
        }
      }
    }
  }
}

/// Blocked candidates that may carry again, or are out of touch.
void review_blocked(ContactSet& c, const BlockSet& b, const Pose& pose, std::uint64_t step,
                    TransitionCounts& counts, std::vector<Id>& still) {
  if (c.blocked.empty()) return;
  still.clear();
  for (const Id k : c.blocked) {
    if (!c.is(k, cs::blocked)) continue;
    if (c.why[k] == Blocked::shield) {
      // A shield goes slowly; what it let by meanwhile is born where it is.
      if (step % 16 != 0 || shielded(c, b, pose, k)) {
        still.push_back(k);
        continue;
      }
      ++counts.unshielded;
    }
    if (c.depth[k] > 0.0 && c.on_edge(k)) {
      c.why[k] = hindrance(c, b, pose, k);
      if (c.why[k] != Blocked::no) {
        still.push_back(k);
        continue;
      }
    }
    unblock(c, k, std::max(c.depth[k], 0.0));
    ++counts.born_inside;
  }
  std::swap(c.blocked, still);
}

/// Closes those of scratch.closes that may.
void close_touching(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                    bool start, TransitionScratch& scratch, TransitionCounts& counts,
                    bool long_step = false) {
  // All are judged from the same state before any is closed.
  std::vector<Blocked>& verdict = scratch.verdict;
  verdict.resize(scratch.closes.size());
  for (std::size_t q = 0; q < scratch.closes.size(); ++q) {
    const Id k = scratch.closes[q];
    verdict[q] = c.is(k, cs::closed) ? Blocked::no : hindrance(c, b, pose, k, long_step);
  }
  const std::size_t blocked_before = c.blocked.size();
  for (std::size_t q = 0; q < scratch.closes.size(); ++q) {
    const Id k = scratch.closes[q];
    if (c.is(k, cs::closed)) continue;  // has taken over from another
    if (verdict[q] != Blocked::no) {
      block_contact(c, k, verdict[q]);
      continue;
    }
    if (start || c.effective_1(k) <= rounding * b.radius[c.block_j[k]]) {
      close(c, b, pose, laws, k);
      ++counts.closed;
      continue;
    }
    // Entered from the side.
    ++counts.born_inside;
    close(c, b, pose, laws, k);
    if (inherit_from_partner(c, k)) {
      c.friction_work[k] -= stored_energy(c, k);
    } else {
      c.clear(k, cs::closed);
      c.rest[k] = c.depth[k];
    }
  }
  if (c.blocked.size() != blocked_before) std::sort(c.blocked.begin(), c.blocked.end());
}

}  // namespace

Blocked hindrance(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k,
                  bool long_step) {
  const Id i = c.block_i[k], j = c.block_j[k], vertex = c.vertex[k];
  if (c.depth[k] > 0.5 * std::min(b.inradius[i], b.inradius[j])) return Blocked::depth;
  if (!facing(b, pose.x, pose.y, vertex, normal_of(c, k))) return Blocked::facing;
  const double tie = rounding * b.radius[j];
  // Where edges meet in a convex corner a vertex is inside both; the closed or shallower one has
  // it.
  const auto rival_has_it = [&](Id q) {
    if (q == k || c.block_j[q] != j || !rivals(b, c.edge[k], c.edge[q])) return false;
    if (c.is(q, cs::closed) && c.share[q] > 0.0) return true;
    // Within the rival's line a step ago already: it is k that the vertex has crossed.
    if (long_step && c.depth_1[k] <= tie && c.depth_1[q] > tie)
      return comes_along(c, vertex, q) || comes_along_own(c, b, k, q);
    if (c.depth[q] <= -tie && c.share[k] == 1.0) return true;
    return c.depth[q] < c.depth[k] - tie && c.share[q] > 0.0 &&
           facing(b, pose.x, pose.y, vertex, normal_of(c, q));
  };
  const auto has_rival = [&] {
    Id q = c.begin_of_vertex[vertex];
    while (q < c.begin_of_vertex[vertex + 1] && !rival_has_it(q)) ++q;
    return q < c.begin_of_vertex[vertex + 1];
  };
  const bool had_rival = c.why[k] == Blocked::conflict;  // mostly it still has, quickly seen
  if (had_rival && has_rival()) return Blocked::conflict;
  if (shielded(c, b, pose, k)) return Blocked::shield;
  // What was above the edge a step ago has come in through it.
  if (c.depth_1[k] > tie && lies_outside(c, b, pose, k, std::max(tie, c.noise)))
    return Blocked::outside;
  return !had_rival && has_rival() ? Blocked::conflict : Blocked::no;
}

void block_shielded(ContactSet& c, const BlockSet& b, const Pose& pose) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.is(k, cs::closed | cs::blocked) || !shielded(c, b, pose, k)) continue;
    block_contact(c, k, Blocked::shield);
  }
  std::sort(c.blocked.begin(), c.blocked.end());
}

void block_far_sides(ContactSet& c, const BlockSet& b, const Pose& pose) {
  // As near as bonds hold: blocks of one cut lie this deep in each other by its rounding.
  constexpr double touch = 1e-6;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.is(k, cs::closed | cs::blocked) || !c.on_edge(k)) continue;
    const double size = smaller_size(c, b, k);
    if (lies_outside(c, b, pose, k, touch * size)) block_contact(c, k, Blocked::outside);
  }
  std::sort(c.blocked.begin(), c.blocked.end());
}

std::uint64_t close_in_step(ContactSet& c, const BlockSet& b, const Pose& pose,
                            const LawTable& laws, TransitionScratch& scratch) {
  scratch.closes.clear();
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::closed | cs::blocked) && c.effective(k) > 0.0 && c.on_edge(k) &&
        c.effective_1(k) <= rounding * b.radius[c.block_j[k]]) {
      scratch.closes.push_back(static_cast<Id>(k));
    }
  }
  TransitionCounts counts;
  close_touching(c, b, pose, laws, false, scratch, counts, true);
  return counts.closed;
}

TransitionCounts settle_contacts(ContactSet& c, const BlockSet& b, const Pose& pose,
                                 const LawTable& laws, std::uint64_t step, bool start,
                                 TransitionScratch& scratch) {
  TransitionCounts counts;
  find_events(c, start, scratch);
  for (const Id k : scratch.opens) {
    // What the shear spring still holds goes with the contact.
    c.friction_work[k] += stored_energy(c, k);
    open(c, k, dilates(laws.rows[c.law[k]]));
    ++counts.opened;
  }
  for (const Id k : scratch.leaves) leave(c, b, pose, laws, k, counts);
  for (const Id k : scratch.returns) change_share(c, k, 1.0, false);
  review_blocked(c, b, pose, step, counts, scratch.still_blocked);
  close_touching(c, b, pose, laws, start, scratch, counts);
  if (!c.lent.empty()) glue_pressed(c);
  return counts;
}

}  // namespace edda
