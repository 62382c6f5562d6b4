#include "step/face_switching.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {
namespace {

constexpr std::uint64_t most_passes = 30;
constexpr double converged = 1e-9;    // change of alpha
constexpr double negligible = 1e-10;  // residual, as a part of the stored energy

/// The root x of a + b x + c x^2/2 nearest to 0, c > 0. Where there is none, as where the blocks
/// reverse their motion and the force does no work, the lowest point of the parabola.
double nearest_root(double a, double b, double c) {
  const double square = b * b - 2.0 * a * c;
  if (square <= 0.0) return c > 0.0 ? -b / c : 0.0;
  return -2.0 * a / (b + std::copysign(std::sqrt(square), b));
}

/// The forces of a face on the nodes of its two blocks.
struct OnBlocks {
  NodeVectors first{}, second{};
};
OnBlocks on_blocks(const FaceSet& c, const BlockSet& b, const CornerForces& f, std::size_t k) {
  OnBlocks on;
  spread(on.first, b, c.edge[k], f.p1);
  spread(on.first, b, c.edge_end[k], f.p2);
  spread(on.second, b, c.facing[k], f.q1);
  spread(on.second, b, c.facing_end[k], f.q2);
  return on;
}

CornerForces difference(const CornerForces& f, const CornerForces& g) {
  return {f.p1 - g.p1, f.p2 - g.p2, f.q1 - g.q1, f.q2 - g.q2};
}

bool any(const CornerForces& f) {
  for (const Vec2 v : {f.p1, f.p2, f.q1, f.q2}) {
    if (v.x != 0.0 || v.y != 0.0) return true;
  }
  return false;
}

/// f . M^-1 f of one block.
double mobility(const StepTaken& taken, Id i, const NodeVectors& force) {
  if (taken.blocks.fixed[i]) return 0.0;
  return dot(accelerations(taken.masses, i, force), force);
}

class Correction {
 public:
  Correction(FaceSet& faces, const StepTaken& taken, FaceSwitchingScratch& scratch,
             FaceAccess& access)
      : c_(faces),
        b_(taken.blocks),
        pose_(taken.pose),
        scratch_(scratch),
        taken_(taken),
        access_(access) {
    scratch_.moved_at.resize(b_.size(), 0);
    scratch_.set.clear();
    scratch_.pushed.clear();
    scratch_.pushed_by = 0.0;
  }

  bool find(const std::vector<Id>& among) {
    for (const Id k : among) add_if_it_switches(k);
    return !scratch_.set.empty();
  }

  /// One pass over the faces that switch, except those whose blocks have not moved since. Returns
  /// whether all have converged.
  bool pass() {
    bool all = true;
    for (SwitchingFace& f : scratch_.set) {
      const Id i = b_.vertex_block[c_.edge[f.face]], j = b_.vertex_block[c_.facing[f.face]];
      if (f.done && scratch_.moved_at[i] <= f.corrected_at &&
          scratch_.moved_at[j] <= f.corrected_at)
        continue;
      all = correct(f, i, j) && all;
    }
    return all;
  }

  /// Evaluates the faces of the blocks that were pushed again and adds those that switch now.
  /// Returns whether there are any.
  bool refresh() {
    auto& pushed = scratch_.pushed;
    std::sort(pushed.begin(), pushed.end());
    pushed.erase(std::unique(pushed.begin(), pushed.end()), pushed.end());
    const std::size_t known = scratch_.set.size();
    scratch_.found.clear();
    access_.evaluate(pushed, scratch_.set, scratch_.found);
    for (const Id k : scratch_.found) {
      if (!is_known(k)) add_if_it_switches(k);
    }
    pushed.clear();
    return scratch_.set.size() > known;
  }

  /// Accounts for the energy residual left after the last pass as transfer. The slip of these faces
  /// at n has changed, also where no block was pushed.
  void book() {
    for (const SwitchingFace& f : scratch_.set) {
      const Face next = face_at(c_, b_, pose_.x, pose_.y, f.face);
      const double stored_next =
          stored_between(f.element, f.at, next, face_points(c_, pose_.x, pose_.y, f.face), false);
      c_.transfer[f.face] += f.stored - stored_next - f.alpha * work(f);
    }
    access_.finish(scratch_.set);
  }

 private:
  bool is_known(Id k) const {
    return std::any_of(scratch_.set.begin(), scratch_.set.end(),
                       [&](const SwitchingFace& f) { return f.face == k; });
  }

  /// Where the face stored energy at n, and opens or closes in this step or did so in the last.
  void add_if_it_switches(Id k) {
    const FaceFields<double> before = access_.before(k);
    if (before.energy > 0.0 && c_.carries_tension[k] == 0.0 &&
        (before.switched > 0.0 || access_.switches(k)))
      add(k, before);
  }

  void add(Id k, const FaceFields<double>& row) {
    SwitchingFace f{};
    f.face = k;
    f.before = row;
    f.then = face_points(c_, pose_.x2, pose_.y2, k);
    f.at = face_points(c_, pose_.x1, pose_.y1, k);
    f.element = face_at(c_, b_, pose_.x1, pose_.y1, k);
    const Face before = face_at(c_, b_, pose_.x2, pose_.y2, k);
    f.was_closed = before.energy > 0.0;
    f.stored = stored_between(before, f.then, f.element, f.at, false);
    const OnBlocks on = on_blocks(c_, b_, f.element.force, k);
    f.own_work = taken_.kick * taken_.h_new *
                 (mobility(taken_, b_.vertex_block[c_.edge[k]], on.first) +
                  mobility(taken_, b_.vertex_block[c_.facing[k]], on.second));
    f.alpha = 1.0;
    f.force = f.element.force;
    const CornerForces shear = end_forces(f.at, f.element, {}, {row.shear_a, row.shear_b});
    f.force = {f.force.p1 + shear.p1, f.force.p2 + shear.p2, f.force.q1 + shear.q1,
               f.force.q2 + shear.q2};
    scratch_.set.push_back(f);
  }

  /// Work of the whole normal force over (x_{n+1} - x_{n-1})/2.
  double work(const SwitchingFace& f) const {
    return 0.5 * work_of(f.element.force, face_points(c_, pose_.x, pose_.y, f.face), f.then);
  }

  /// One iteration towards alpha F_n.(x_{n+1} - x_{n-1})/2 + U_{n+1/2} - U_{n-1/2} = 0.
  bool correct(SwitchingFace& f, Id i, Id j) {
    const Id k = f.face;
    const FacePoints next_at = face_points(c_, pose_.x, pose_.y, k);
    const Face next = face_at(c_, b_, pose_.x, pose_.y, k);
    const bool closes = next.energy > 0.0;
    f.stored_next = stored_between(f.element, f.at, next, next_at, false);
    const double whole = work(f);
    const double left = f.alpha * whole + f.stored_next - f.stored;
    const double slope = whole + 0.5 * (f.alpha - (closes ? 1.0 : 0.0)) * f.own_work;
    double alpha = f.alpha + nearest_root(left, slope, f.own_work);
    constexpr double most = 1.5;  // of a face that is closed before and after the step
    alpha = std::clamp(alpha, 0.0, f.was_closed && closes ? most : 1.0);
    if (std::abs(left) <= negligible * (f.stored + f.stored_next)) alpha = f.alpha;
    const double change = std::abs(alpha - f.alpha);
    f.alpha = alpha;
    const CornerForces force = recompute_shear(c_, f.before, f.element, f.at, f.then, alpha, k);
    const CornerForces more = difference(force, f.force);
    f.force = force;
    f.corrected_at = ++scratch_.corrections;
    f.done = change <= converged;
    if (!any(more)) return f.done;
    const OnBlocks on = on_blocks(c_, b_, more, k);
    if (b_.fixed[i]) scratch_.on_fixed += resultant(on.first);
    if (b_.fixed[j]) scratch_.on_fixed += resultant(on.second);
    push(i, on.first);
    push(j, on.second);
    if (!f.done) scratch_.moved_at[i] = scratch_.moved_at[j] = f.corrected_at;
    return f.done;
  }

  /// A fixed block does not move, and may have very many faces.
  void push(Id i, const NodeVectors& force) {
    if (b_.fixed[i]) return;
    scratch_.pushed_by += push_block(taken_, i, force);
    scratch_.pushed.push_back(i);
  }

  FaceSet& c_;
  const BlockSet& b_;
  const Pose& pose_;
  FaceSwitchingScratch& scratch_;
  const StepTaken& taken_;
  FaceAccess& access_;
};

}  // namespace

void FaceRows::evaluate(const std::vector<Id>& blocks, const std::vector<SwitchingFace>& corrected,
                        std::vector<Id>& switching) {
  for (const SwitchingFace& f : corrected) set_row(faces_.before, f.face, f.before);
  const BlockSet& b = scene_.blocks;
  for (const Id i : blocks) {
    faces_.for_faces(b.vertex_begin[i], b.vertex_begin[i + 1], [&](Id k, bool) {
      evaluate_face(faces_, scene_, step_, k);
      if (faces_.now.switched[k] > 0.0 || faces_.before.switched[k] > 0.0) switching.push_back(k);
    });
  }
}

void FaceRows::finish(const std::vector<SwitchingFace>& corrected) {
  for (const SwitchingFace& f : corrected) {
    set_row(faces_.before, f.face, f.before);
    evaluate_face(faces_, scene_, step_, f.face);
  }
}

void correct_switching(FaceSet& c, const StepTaken& taken, OpenCloseCounts& counts,
                       FaceSwitchingScratch& scratch, const std::vector<Id>& switching,
                       FaceAccess& access) {
  Correction correction(c, taken, scratch, access);
  if (!correction.find(switching)) return;
  std::uint64_t passes = 0;
  bool all = false;
  do {
    do {
      all = correction.pass();
      ++passes;
    } while (!all && passes < most_passes);
  } while (correction.refresh() && passes < most_passes);
  correction.book();
  ++counts.steps;
  counts.passes += passes;
  counts.most = std::max(counts.most, passes);
  counts.switched += scratch.set.size();
  if (counts.of_list != c.rebuilds || counts.of_face.size() != c.size()) {
    counts.of_face.assign(c.size(), 0);
    counts.of_list = c.rebuilds;
  }
  for (const SwitchingFace& f : scratch.set) ++counts.of_face[f.face];
  if (!all) ++counts.not_converged;
}

std::vector<Id> switching_faces(const FaceSet& c) {
  std::vector<Id> found;
  for (std::size_t q = 0; q < c.switching.size(); ++q) {
    if (c.switching[q] == 0) continue;
    const std::size_t end = std::min(c.size(), (q + 1) * FaceSet::chunk);
    for (std::size_t k = q * FaceSet::chunk; k < end; ++k) found.push_back(static_cast<Id>(k));
  }
  return found;
}

double largest_closure(const FaceSet& c) {
  double depth = 0.0;
  for (const double d : c.deepest) depth = std::max(depth, d);
  return depth;
}

}  // namespace edda
