#include "run/face_switching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {
namespace {

constexpr std::uint64_t most_passes = 30;
constexpr std::uint64_t passes_to_look = 4;  // before the neighbours are looked at again
constexpr double settled = 1e-9;             // change of alpha
constexpr double negligible = 1e-10;         // energy that is missing, of what is stored

/// The root x of a + b x + c x^2/2 nearest to 0, c > 0; where there is none, its lowest point: a
/// force does no work where its blocks turn back.
double nearest_root(double a, double b, double c) {
  const double square = b * b - 2.0 * a * c;
  if (square <= 0.0) return c > 0.0 ? -b / c : 0.0;
  return -2.0 * a / (b + std::copysign(std::sqrt(square), b));
}

/// The forces of a face on the nodes of its two blocks.
struct OnBlocks {
  std::array<Vec2, 3> first{}, second{};
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
double mobility(const BlockSet& b, Id i, const std::array<Vec2, 3>& force) {
  if (b.fixed[i]) return 0.0;
  const std::array<Vec2, 3> a = accelerations(b, i, force);
  return dot(a[0], force[0]) + dot(a[1], force[1]) + dot(a[2], force[2]);
}

class Correction {
 public:
  Correction(FaceSet& faces, const BlockSet& blocks, const LawTable& laws, State& state, Pose& pose,
             const StepTaken& taken, FaceSwitchingScratch& scratch)
      : c_(faces),
        b_(blocks),
        laws_(laws),
        s_(state),
        pose_(pose),
        scratch_(scratch),
        taken_(taken),
        kick_(kick_of(taken)) {
    scratch_.moved.resize(b_.size(), 0);
    scratch_.set.clear();
    scratch_.pushed.clear();
  }

  bool find() {
    for (std::size_t q = 0; q < c_.stirs.size(); ++q) {
      if (c_.stirs[q] == 0) continue;
      const std::size_t end = std::min(c_.size(), (q + 1) * FaceSet::chunk);
      for (std::size_t k = q * FaceSet::chunk; k < end; ++k) {
        if (switches(k)) add(static_cast<Id>(k));
      }
    }
    return !scratch_.set.empty();
  }

  /// Goes once through the faces that switch, but not through those that feel nothing new. Whether
  /// all have settled.
  bool pass() {
    bool all = true;
    for (SwitchingFace& f : scratch_.set) {
      const Id i = b_.vertex_block[c_.edge[f.face]], j = b_.vertex_block[c_.facing[f.face]];
      if (f.done && scratch_.moved[i] <= f.seen && scratch_.moved[j] <= f.seen) continue;
      all = correct(f, i, j) && all;
    }
    return all;
  }

  /// Works out the faces of the blocks that were pushed once more; takes those that switch now.
  /// Whether any does.
  bool refresh() {
    auto& pushed = scratch_.pushed;
    std::sort(pushed.begin(), pushed.end());
    pushed.erase(std::unique(pushed.begin(), pushed.end()), pushed.end());
    const std::size_t known = scratch_.set.size();
    for (const Id i : pushed) {
      c_.for_faces(b_.vertex_begin[i], b_.vertex_begin[i + 1], [&](Id k, bool) {
        place_face(c_, b_, pose_, laws_, taken_.h_new, k);
        if (switches(k) && !is_known(k)) add(k);
      });
    }
    pushed.clear();
    return scratch_.set.size() > known;
  }

  /// What the last pass has left undone.
  void book() {
    for (const SwitchingFace& f : scratch_.set) {
      const Face next = face_at(c_, b_, pose_.x, pose_.y, f.face);
      const double stored_next =
          stored_between(f.placed, f.at, next, face_points(c_, pose_.x, pose_.y, f.face), false);
      c_.transfer[f.face] += f.stored - stored_next - f.alpha * work(f);
    }
  }

 private:
  bool switches(std::size_t k) const {
    return c_.before.energy[k] > 0.0 && c_.pulls[k] == 0.0 &&
           (c_.now.switched[k] > 0.0 || c_.before.switched[k] > 0.0);
  }
  bool is_known(Id k) const {
    return std::any_of(scratch_.set.begin(), scratch_.set.end(),
                       [&](const SwitchingFace& f) { return f.face == k; });
  }

  void add(Id k) {
    SwitchingFace f{};
    f.face = k;
    f.then = face_points(c_, pose_.x2, pose_.y2, k);
    f.at = face_points(c_, pose_.x1, pose_.y1, k);
    f.placed = face_at(c_, b_, pose_.x1, pose_.y1, k);
    const Face before = face_at(c_, b_, pose_.x2, pose_.y2, k);
    f.was_closed = before.energy > 0.0;
    f.stored = stored_between(before, f.then, f.placed, f.at, false);
    const OnBlocks on = on_blocks(c_, b_, f.placed.force, k);
    f.pushes = kick_ * taken_.h_new *
               (mobility(b_, b_.vertex_block[c_.edge[k]], on.first) +
                mobility(b_, b_.vertex_block[c_.facing[k]], on.second));
    f.alpha = 1.0;
    f.force = f.placed.force;
    const CornerForces shear =
        end_forces(f.at, f.placed, {}, {c_.before.shear_a[k], c_.before.shear_b[k]});
    f.force = {f.force.p1 + shear.p1, f.force.p2 + shear.p2, f.force.q1 + shear.q1,
               f.force.q2 + shear.q2};
    scratch_.set.push_back(f);
  }

  /// Of the whole normal force, over (x_{n+1} - x_{n-1})/2.
  double work(const SwitchingFace& f) const {
    return 0.5 * work_of(f.placed.force, face_points(c_, pose_.x, pose_.y, f.face), f.then);
  }

  /// One step towards alpha F_n.(x_{n+1} - x_{n-1})/2 + U_{n+1/2} - U_{n-1/2} = 0.
  bool correct(SwitchingFace& f, Id i, Id j) {
    const Id k = f.face;
    const FacePoints next_at = face_points(c_, pose_.x, pose_.y, k);
    const Face next = face_at(c_, b_, pose_.x, pose_.y, k);
    const bool closes = next.energy > 0.0;
    f.stored_next = stored_between(f.placed, f.at, next, next_at, false);
    const double whole = work(f);
    const double left = f.alpha * whole + f.stored_next - f.stored;
    const double slope = whole + 0.5 * (f.alpha - (closes ? 1.0 : 0.0)) * f.pushes;
    double alpha = f.alpha + nearest_root(left, slope, f.pushes);
    constexpr double most = 1.5;  // of a face that is closed before and after
    alpha = std::clamp(alpha, 0.0, f.was_closed && closes ? most : 1.0);
    if (std::abs(left) <= negligible * (f.stored + f.stored_next)) alpha = f.alpha;
    const double change = std::abs(alpha - f.alpha);
    f.alpha = alpha;
    const CornerForces force = cut_again(c_, f.placed, f.at, f.then, alpha, k);
    const CornerForces more = difference(force, f.force);
    f.force = force;
    f.seen = ++scratch_.tick;
    f.done = change <= settled;
    if (!any(more)) return f.done;
    const OnBlocks on = on_blocks(c_, b_, more, k);
    if (b_.fixed[i]) scratch_.on_held += on.first[0] + on.first[1] + on.first[2];
    if (b_.fixed[j]) scratch_.on_held += on.second[0] + on.second[1] + on.second[2];
    push_block(b_, s_, pose_, i, on.first, kick_, taken_.h_new, taken_.strain);
    push_block(b_, s_, pose_, j, on.second, kick_, taken_.h_new, taken_.strain);
    scratch_.pushed.push_back(i);
    scratch_.pushed.push_back(j);
    if (!f.done) scratch_.moved[i] = scratch_.moved[j] = f.seen;
    return f.done;
  }

  FaceSet& c_;
  const BlockSet& b_;
  const LawTable& laws_;
  State& s_;
  Pose& pose_;
  FaceSwitchingScratch& scratch_;
  StepTaken taken_;
  double kick_;
};

}  // namespace

void correct_switching(FaceSet& c, const BlockSet& b, const LawTable& laws, State& s, Pose& pose,
                       const StepTaken& taken, OpenCloseCounts& counts,
                       FaceSwitchingScratch& scratch) {
  Correction correction(c, b, laws, s, pose, taken, scratch);
  if (!correction.find()) return;
  std::uint64_t passes = 0;
  bool all = false, more = true;
  while (more) {
    do {
      all = correction.pass();
      ++passes;
    } while (!all && passes % passes_to_look != 0);
    more = (correction.refresh() || !all) && passes < most_passes;
  }
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
  if (!all) ++counts.unsettled;
}

double largest_closure(const FaceSet& c) {
  double depth = 0.0;
  for (const double d : c.deepest) depth = std::max(depth, d);
  return depth;
}

}  // namespace edda
