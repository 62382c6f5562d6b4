#include "implicit/face_springs.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/face_step.hpp"

namespace edda {
namespace {

constexpr std::uint8_t closed_a = 1, closed_b = 2, slides_a = 4, slides_b = 8;

/// Gap, as a part of the smaller block's size, up to which a face is expected to close.
constexpr double touch = 1e-9;

/// Spring energies at one instant, U and p_t u^2/2 of each end, J.
double energy_of(const FaceMemory& m, std::size_t k) {
  return m.energy[k] + 0.5 * m.spring[k] * (m.slip_a[k] * m.slip_a[k] + m.slip_b[k] * m.slip_b[k]);
}

double limit_of(const FaceSet& c, double normal, std::size_t k) {
  if (c.bonded[k] > 0.0) return unlimited_shear;
  const FaceMemory& m = c.before;
  return coulomb_limit(0.5 * c.cohesion[k] * m.cohesive[k], c.friction[k], normal);
}

void set_limits(FaceSprings& springs, const FaceSet& c, std::size_t k) {
  const FaceMemory& m = c.before;
  springs.limits.a[k] = limit_of(c, m.normal_a[k] + m.damping_a[k], k);
  springs.limits.b[k] = limit_of(c, m.normal_b[k] + m.damping_b[k], k);
}

std::uint8_t state_of(const FaceSet& c, const FaceMemory& m, std::size_t k) {
  if (!(m.energy[k] > 0.0) && c.bonded[k] == 0.0) return 0;
  const bool carries_tension = c.carries_tension[k] > 0.0;
  return static_cast<std::uint8_t>((carries_tension || m.closure_a[k] > 0.0 ? closed_a : 0) |
                                   (carries_tension || m.closure_b[k] > 0.0 ? closed_b : 0) |
                                   (is_cut(m.trial_a[k], m.slip_a[k]) ? slides_a : 0) |
                                   (is_cut(m.trial_b[k], m.slip_b[k]) ? slides_b : 0));
}

/// Whether an end carries its full shear strength, to rounding.
bool at_limit(double shear, double limit) {
  return limit > 0.0 && std::abs(shear) >= (1.0 - 1e-6) * limit;
}

/// Ends that slid in the last step and still carry their full shear strength, before anything has
/// moved.
std::uint8_t slides_on(const FaceSprings& springs, const FaceMemory& m, std::size_t k) {
  const std::uint8_t was = springs.state[k];
  const bool a = (was & slides_a) != 0 && at_limit(m.shear_a[k], springs.limits.a[k]);
  const bool b = (was & slides_b) != 0 && at_limit(m.shear_b[k], springs.limits.b[k]);
  return static_cast<std::uint8_t>((a ? slides_a : 0) | (b ? slides_b : 0));
}

/// -sum f . (x - x_1) over the corners of face k, J.
double taken_from_blocks(const FaceSet& c, const Pose& pose, std::size_t k) {
  return -work_of(corner_forces(c, k), face_points(c, pose.x, pose.y, k),
                  face_points(c, pose.x1, pose.y1, k));
}

}  // namespace

void begin_springs(FaceSprings& springs, const FaceSet& c) {
  const std::size_t n = c.size();
  springs.acts = c.acts.values();
  springs.leans = c.leans.values();
  springs.locked_closure_a = c.locked_closure_a.values();
  springs.locked_closure_b = c.locked_closure_b.values();
  springs.stored.resize(n);
  springs.state.resize(n);
  springs.limits.a.resize(n);
  springs.limits.b.resize(n);
  springs.first = false;
  parallel_for(n, [&](std::size_t k) {
    springs.stored[k] = energy_of(c.before, k);
    springs.state[k] = state_of(c, c.before, k);
    set_limits(springs, c, k);
  });
}

std::size_t evaluate_springs(FaceSprings& springs, FaceSet& c, const FaceScene& scene, double step,
                             bool first) {
  // Restores the decisions and offsets at the start of the step, which may have changed at other
  // trial positions.
  c.acts.take(springs.acts);
  c.leans.take(springs.leans);
  c.locked_closure_a.take(springs.locked_closure_a);
  c.locked_closure_b.take(springs.locked_closure_b);
  evaluate_with_limits(c, scene, step, springs.limits);
  springs.first = first;
  std::vector<std::size_t> changed(c.chunks(), 0);
  parallel_chunks(c.size(), FaceSet::chunk, 5,
                  [&](std::size_t q, std::size_t begin, std::size_t end) {
                    for (std::size_t k = begin; k < end; ++k) {
                      std::uint8_t state = state_of(c, c.now, k);
                      if (first)
                        state = static_cast<std::uint8_t>(state | slides_on(springs, c.now, k));
                      if (state != springs.state[k]) ++changed[q];
                      springs.state[k] = state;
                    }
                  });
  std::size_t sum = 0;
  for (const std::size_t n : changed) sum += n;
  return sum;
}

FaceStiffness springs_of(const FaceSprings& springs, const FaceSet& c, const FaceScene& scene,
                         double step, std::size_t k) {
  EndStates taken;
  taken.a_slides = (springs.state[k] & slides_a) != 0;
  taken.b_slides = (springs.state[k] & slides_b) != 0;
  if (springs.first) taken.near = touch * smaller_size(c, scene.blocks, k);
  return face_stiffness(c, scene, step, taken, k);
}

std::vector<Id> break_overloaded(FaceSprings& springs, FaceSet& c, const BlockSet& b,
                                 const LawTable& laws) {
  std::vector<Id> broken;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.bonded[k] == 0.0 && c.carries_tension[k] == 0.0) continue;
    const FaceFields<double> now = row_of(c.now, k);
    if (!bond_fails(c, b, now, k)) continue;
    break_bond(c, b, laws, now, k);
    set_limits(springs, c, k);
    broken.push_back(static_cast<Id>(k));
  }
  return broken;
}

void account_springs(const FaceSprings& springs, FaceSet& c, const Pose& pose,
                     const std::vector<Id>& broken) {
  parallel_for(c.size(), [&](std::size_t k) {
    FaceMemory& m = c.now;
    const double lost = taken_from_blocks(c, pose, k) - (energy_of(m, k) - springs.stored[k]);
    const double friction = m.spring[k] * (m.slip_a[k] * (m.trial_a[k] - m.slip_a[k]) +
                                           m.slip_b[k] * (m.trial_b[k] - m.slip_b[k]));
    const double rest = lost - friction;
    // A bond that breaks releases its energy. What the scheme dissipates in the same step cannot be
    // separated from this.
    const bool broke = std::binary_search(broken.begin(), broken.end(), static_cast<Id>(k));
    const double fracture = broke ? std::clamp(rest, 0.0, springs.stored[k]) : 0.0;
    if (broke) c.friction_work[k] += friction;
    m.friction_work[k] = broke ? fracture : friction;  // next_step() adds it to fracture or
                                                       // friction
    m.damping_work[k] = rest - fracture;
    m.damping_due[k] = m.transfer[k] = 0.0;
  });
  begin_from_step_end(c);
}

}  // namespace edda
