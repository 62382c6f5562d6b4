#include "implicit/contact_springs.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"
#include "contacts/switching.hpp"
#include "contacts/transitions.hpp"
#include "forces/contact_forces.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

/// Spring energies at one instant, w (p e^2 + p_t s^2)/2, J.
double energy_now(const ContactSet& c, std::size_t k) {
  if (!c.is(k, cs::closed)) return 0.0;
  const double e = c.is(k, cs::pulls) ? c.effective(k) : std::max(c.effective(k), 0.0);
  const double s = c.shear[k] / c.ks[k];
  return 0.5 * c.share[k] * (c.kn[k] * e * e + c.ks[k] * s * s);
}

void let_rest(ContactSet& c, std::size_t k) {
  c.normal[k] = c.shear[k] = c.shear_1[k] = c.slip_trial[k] = 0.0;
  clear_contact_force(c, k);
}

SpringState evaluate(ContactSprings& springs, ContactSet& c, const BlockSet& b, std::size_t k,
                     double step, double damping) {
  if (!c.is(k, cs::closed)) {
    let_rest(c, k);
    return SpringState::open;
  }
  if (!springs.known[k]) {
    springs.known[k] = 1;
    springs.anchor[k] = c.anchor[k];
    springs.limit[k] = c.cohesion[k];
  }
  const bool bonded = c.is(k, cs::bonded);
  const bool pressed = c.is(k, cs::pulls) || c.effective(k) > 0.0;
  c.clear(k, cs::sliding);
  if (!pressed && !bonded) {
    let_rest(c, k);
    c.anchor[k] = c.foot[k] / c.span[k];
    return SpringState::open;
  }
  set_normal_force(c, b, k, step, damping);
  c.anchor[k] = springs.anchor[k];
  const double trial = -c.ks[k] * trial_slip(c, k);
  c.shear[k] = bonded ? trial : cut_shear(trial, springs.limit[k]);
  SpringState state = pressed ? SpringState::stick : SpringState::shear;
  if (c.shear[k] != trial) {
    c.anchor[k] = (c.foot[k] + c.shear[k] / c.ks[k]) / c.span[k];
    c.set(k, cs::sliding);
    state = SpringState::slide;
  }
  c.shear_1[k] = c.shear[k];
  c.slip_trial[k] = trial_slip(c, k);
  set_contact_force(c, k, tangent_of(c, k), c.span[k], c.foot[k], c.depth[k]);
  return state;
}

/// Carries all the shear it can, but for rounding.
bool at_limit(const ContactSprings& springs, const ContactSet& c, std::size_t k) {
  return springs.limit[k] > 0.0 && std::abs(c.shear[k]) >= (1.0 - 1e-6) * springs.limit[k];
}

/// Gap, of the smaller block's size, within which a contact is expected to close.
constexpr double touch = 1e-9;

/// -sum f . (x - x_1) over the three points of a contact, J.
double taken_from_blocks(const ContactSet& c, const Pose& pose, std::size_t k) {
  auto moved = [&](Id v) { return at(pose.x, pose.y, v) - at(pose.x1, pose.y1, v); };
  const Vec2 end = moved(c.edge_end[k]);
  return -(dot(c.on_vertex(k), moved(c.vertex[k]) - end) +
           dot(c.on_start(k), moved(c.edge[k]) - end));
}

}  // namespace

void begin_springs(ContactSprings& springs, const ContactSet& c) {
  const std::size_t n = c.size();
  springs.state.resize(n);
  springs.known.resize(n);
  springs.anchor = c.anchor;
  springs.stored.resize(n);
  springs.limit.resize(n);
  springs.assumed.assign(n, 0);
  parallel_for(n, [&](std::size_t k) {
    springs.known[k] = c.is(k, cs::closed) ? 1 : 0;
    springs.stored[k] = energy_now(c, k);
    springs.limit[k] = c.shear_limit(k, c.normal[k]);
    springs.state[k] = !c.is(k, cs::closed)                           ? SpringState::open
                       : c.is(k, cs::sliding) && !c.is(k, cs::bonded) ? SpringState::slide
                       : c.is(k, cs::pulls) || c.effective(k) > 0.0   ? SpringState::stick
                       : c.is(k, cs::bonded)                          ? SpringState::shear
                                                                      : SpringState::open;
  });
}

std::size_t evaluate_springs(ContactSprings& springs, ContactSet& c, const BlockSet& b, double step,
                             double damping, bool first) {
  std::vector<std::size_t> changed((c.size() + ContactSet::chunk - 1) / ContactSet::chunk, 0);
  parallel_chunks(
      c.size(), ContactSet::chunk, [&](std::size_t q, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          SpringState state = evaluate(springs, c, b, k, step, damping);
          if (first && state == SpringState::stick && at_limit(springs, c, k) &&
              springs.state[k] == SpringState::slide) {
            state = SpringState::slide;
            c.set(k, cs::sliding);
          }
          const SpringState before = springs.assumed[k] ? SpringState::open : springs.state[k];
          if (state != before) ++changed[q];
          springs.state[k] = state;
          springs.assumed[k] = 0;
        }
      });
  std::size_t sum = 0;
  for (const std::size_t n : changed) sum += n;
  return sum;
}

void assume_touching(ContactSprings& springs, const ContactSet& c, const BlockSet& b,
                     const Pose& pose) {
  parallel_for(c.size(), [&](std::size_t k) {
    if (springs.state[k] != SpringState::open || c.is(k, cs::blocked) || c.share[k] == 0.0) return;
    const double size = std::min(b.radius[c.block_i[k]], b.radius[c.block_j[k]]);
    if (c.effective(k) < -touch * size || !c.on_edge(k)) return;
    if (c.is(k, cs::closed) || hindrance(c, b, pose, k) == Blocked::no) {
      springs.state[k] = SpringState::stick;
      springs.assumed[k] = 1;
    }
  });
}

void book_springs(const ContactSprings& springs, ContactSet& c, const Pose& pose,
                  const std::vector<Id>& broken) {
  parallel_for(c.size(), [&](std::size_t k) {
    if (!springs.known[k]) return;
    const double lost = taken_from_blocks(c, pose, k) - (energy_now(c, k) - springs.stored[k]);
    double friction = 0.0;
    if (c.is(k, cs::sliding)) {
      c.set(k, cs::slipped);
      friction = -c.share[k] * c.shear[k] * (c.anchor[k] - springs.anchor[k]) * c.span[k];
    }
    c.friction_work[k] += friction;
    const double rest = lost - friction;
    // A bond gives up what it held; what the scheme takes in the same step cannot be told apart.
    const bool broke = std::binary_search(broken.begin(), broken.end(), static_cast<Id>(k));
    const double fracture = broke ? std::clamp(rest, 0.0, springs.stored[k]) : 0.0;
    c.fracture_work[k] += fracture;
    c.damping_work[k] += rest - fracture;
  });
}

}  // namespace edda
