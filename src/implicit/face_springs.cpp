#include "implicit/face_springs.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/face_step.hpp"
#include "contacts/tile_decisions.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_trials.hpp"

namespace edda {
namespace {

constexpr std::uint8_t closed_a = 1, closed_b = 2, slides_a = 4, slides_b = 8;

/// Gap, as a part of the smaller block's size, up to which a face is expected to close.
constexpr double touch = 1e-9;

/// Time that the evaluation of one face takes, ns.
constexpr std::size_t cost_of_a_face = 150;

/// Spring energies at one instant, U and p_t u^2/2 of each end, J.
double energy_of(const FaceFields& m) {
  return m.energy + 0.5 * m.spring * (m.slip_a * m.slip_a + m.slip_b * m.slip_b);
}

void set_limits(FaceSprings& s, const TrialFaces& of, std::size_t k) {
  const FaceSet& c = of.faces;
  const double cohesion = 0.5 * c.cohesion[k] * s.cohesive[k];
  const auto limit_of = [&](double normal) {
    return c.bonded(k) ? unlimited_shear : coulomb_limit(cohesion, c.friction[k], normal);
  };
  s.limits[k] = {limit_of(s.normal[k].a), limit_of(s.normal[k].b)};
  limit_shear(of.tiled.tiles, s.limits[k], k);
}

/// Whether face k carries force, or would carry it at any displacement, at the last evaluation.
bool touches(const TrialFaces& of, std::size_t k) {
  return of.tiled.tiles.remembers(lane_bits::stored, k) || of.faces.bonded(k);
}

/// The state of face k, which touches.
std::uint8_t state_of(const FaceSet& c, const FaceFields& m, std::size_t k) {
  const bool carries_tension = c.carries_tension(k);
  return static_cast<std::uint8_t>((carries_tension || m.closure_a > 0.0 ? closed_a : 0) |
                                   (carries_tension || m.closure_b > 0.0 ? closed_b : 0) |
                                   (is_cut(m.trial_a, m.slip_a) ? slides_a : 0) |
                                   (is_cut(m.trial_b, m.slip_b) ? slides_b : 0));
}

/// Whether an end carries its full shear strength, to rounding.
bool at_limit(double shear, double limit) {
  return limit > 0.0 && std::abs(shear) >= (1.0 - 1e-6) * limit;
}

/// Ends that slid in the last step and still carry their full shear strength, before anything has
/// moved.
std::uint8_t slides_on(const FaceSprings& springs, const FaceFields& m, std::size_t k) {
  const std::uint8_t was = springs.state[k];
  const bool a = (was & slides_a) != 0 && at_limit(m.shear_a, springs.limits[k].a);
  const bool b = (was & slides_b) != 0 && at_limit(m.shear_b, springs.limits[k].b);
  return static_cast<std::uint8_t>((a ? slides_a : 0) | (b ? slides_b : 0));
}

/// -sum f . (x - x_1) over the corners of a face, J.
double taken_from_blocks(const FaceRow& r, const Pose& pose) {
  return -work_of(r.force, face_points(r.of, pose.x, pose.y, r.k),
                  face_points(r.of, pose.x1, pose.y1, r.k));
}

/// Notes what is decided of faces now, before it changes.
void note(FaceSprings& s, const TrialFaces& of, const std::vector<Id>& faces) {
  for (const Id k : faces) {
    recall_work(of.faces, of.tiled.tiles, k);
    s.undecided.try_emplace(k, record_of(of.faces, k));
  }
}

/// Restores activity and offsets at the start of the step, which may have changed at other trial
/// positions.
void restore_activity(const FaceSprings& s, const TrialFaces& of, const BlockSet& b) {
  FaceSet& c = of.faces;
  for (const auto& [k, was] : s.undecided) {
    recall_work(c, of.tiled.tiles, k);
    for (const FaceFlag flag : {FaceFlag::acts, FaceFlag::leans})
      c.set(flag, k, (was.flags & static_cast<std::uint16_t>(flag)) != 0);
    c.locked_closure_a[k] = was.properties.locked_closure_a;
    c.locked_closure_b[k] = was.properties.locked_closure_b;
    load_decisions(of.tiled.tiles, c, b, k);
  }
}

}  // namespace

FaceRow face_row(const TrialFaces& of, const BlockSet& b, const Pose& pose, std::size_t k) {
  return face_row(of.faces, of.tiled.tiles, b, pose, k);
}

void begin_springs(FaceSprings& s, const TrialFaces& of, const FaceScene& scene) {
  const FaceSet& c = of.faces;
  const std::size_t n = c.size();
  of.tiled.sleep_part = 0.0;
  begin_limits(of.tiled.tiles);
  for (auto* ends : {&s.normal, &s.limits}) ends->resize(n);
  for (auto* values : {&s.cohesive, &s.stored}) values->resize(n);
  s.state.resize(n);
  s.undecided.clear();
  s.first = false;
  const auto begin = [&](std::size_t k) {
    const bool carries = touches(of, k);
    const FaceFields m = carries ? face_row(of, scene.blocks, scene.pose, k).state : FaceFields{};
    s.stored[k] = energy_of(m);
    s.state[k] = carries ? state_of(c, m, k) : 0;
    s.normal[k] = {m.normal_a + m.damping_a, m.normal_b + m.damping_b};
    s.cohesive[k] = m.cohesive;
    set_limits(s, of, k);
  };
  parallel_for(n, begin, cost_of_a_face);
}

std::size_t evaluate_springs(FaceSprings& s, const TrialFaces& of, const FaceScene& scene,
                             double step, bool first, BodyVectors& on) {
  FaceSet& c = of.faces;
  const FaceTiles& t = of.tiled.tiles;
  restore_activity(s, of, scene.blocks);
  FacesInStep faces(c, of.tiled, scene, step, 0.0, on, true);
  faces.sweep();
  const std::vector<Id> undecided = faces.undecided();
  note(s, of, undecided);
  faces.decide_and_evaluate(undecided);
  s.first = first;
  std::vector<std::size_t> changed(c.failure_groups(), 0);
  const auto look = [&](std::size_t q, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::uint8_t state = 0;
      if (touches(of, k)) {
        const FaceFields m = remembered(t, t.now, k);
        state = state_of(c, m, k);
        if (first) state = static_cast<std::uint8_t>(state | slides_on(s, m, k));
      }
      if (state != s.state[k]) ++changed[q];
      s.state[k] = state;
    }
  };
  parallel_chunks(c.size(), FaceSet::failure_group, 40, look);
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

std::vector<Id> break_overloaded(FaceSprings& s, const TrialFaces& of, const FaceScene& scene) {
  FaceSet& c = of.faces;
  FaceTiles& t = of.tiled.tiles;
  std::vector<Id> broken;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (t.has_found(lane_bits::fails, k)) broken.push_back(static_cast<Id>(k));
  }
  note(s, of, broken);
  for (const Id k : broken) {
    break_bond(c, scene.blocks, scene.laws, face_row(of, scene.blocks, scene.pose, k).state, k);
    set_limits(s, of, k);
    load_decisions(t, c, scene.blocks, k);
  }
  return broken;
}

void account_springs(const FaceSprings& s, const TrialFaces& of, const FaceScene& scene,
                     const std::vector<Id>& broken) {
  FaceSet& c = of.faces;
  FaceTiles& t = of.tiled.tiles;
  recall_work(c, t);
  const auto account = [&](std::size_t k) {
    if (!touches(of, k) && s.stored[k] == 0.0) return;
    const FaceRow row = face_row(of, scene.blocks, scene.pose, k);
    const FaceFields& m = row.state;
    const double lost = taken_from_blocks(row, scene.pose) - (energy_of(m) - s.stored[k]);
    const double friction =
        m.spring * (m.slip_a * (m.trial_a - m.slip_a) + m.slip_b * (m.trial_b - m.slip_b));
    const double rest = lost - friction;
    // A bond that breaks releases its energy. What the scheme dissipates in the same step cannot be
    // separated from this.
    const bool broke = std::binary_search(broken.begin(), broken.end(), static_cast<Id>(k));
    const double fracture = broke ? std::clamp(rest, 0.0, s.stored[k]) : 0.0;
    const bool failed = c.is(FaceFlag::fails, k) && !broke;  // since the last step
    (failed ? c.fracture_work : c.friction_work)[k] += friction;
    c.fracture_work[k] += fracture;
    c.damping_work[k] += rest - fracture;
    if (t.has_found(lane_bits::opens, k)) c.set(FaceFlag::opened, k);
    if (t.has_found(lane_bits::slides, k)) c.set(FaceFlag::slipped, k);
  };
  parallel_for(c.size(), account, cost_of_a_face);
  if (c.gluing) glue_pressed(c, t, scene.blocks, scene.pose.x, scene.pose.y);
  count_failures(c);
  keep_trial(t, c);
}

void go_back(FaceSprings& s, const TrialFaces& of, const BlockSet& b) {
  FaceTiles& t = of.tiled.tiles;
  for (const auto& [k, was] : s.undecided) {
    set_record(of.faces, k, was);
    load_decisions(t, of.faces, b, k);
  }
  s.undecided.clear();
  drop_trial(t);
}

}  // namespace edda
