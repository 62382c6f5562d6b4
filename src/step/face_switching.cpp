#include "step/face_switching.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_rows.hpp"
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

/// The forces of a face on the edges of its two blocks.
struct OnBlocks {
  EdgeForce first, second;
};
OnBlocks on_blocks(const FaceSet& c, const CornerForces& f, std::size_t k) {
  return {{c.edge[k], c.edge_end[k], f.p1, f.p2}, {c.facing[k], c.facing_end[k], f.q1, f.q2}};
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

class Correction {
 public:
  Correction(FaceSet& faces, FaceTiles& tiles, FacesInStep& in_step, const StepTaken& taken,
             FaceSwitchingScratch& scratch)
      : c_(faces),
        t_(tiles),
        in_step_(in_step),
        b_(taken.leap.blocks),
        pose_(taken.pose),
        scratch_(scratch),
        taken_(taken) {
    scratch_.moved_at.resize(b_.size(), 0);
    scratch_.first_face.resize(b_.size(), no_id);
    begin_set();
    scratch_.known.clear();
    scratch_.evaluated.clear();
    scratch_.pushed_by = 0.0;
  }

  /// Adds those of these faces that switch, and are not known yet. Returns whether there are any.
  bool find(const std::vector<Id>& among) {
    std::vector<SwitchingFace>& set = scratch_.set;
    const std::size_t known = set.size();
    for (const Id k : among) {
      if (std::binary_search(scratch_.known.begin(), scratch_.known.end(), k)) continue;
      set.emplace_back();
      set.back().face = k;
    }
    const auto add = [&](std::size_t q) { add_if_it_switches(set[known + q]); };
    parallel_for(set.size() - known, add, cost_of_a_face);
    const auto added = set.begin() + static_cast<std::ptrdiff_t>(known);
    set.erase(
        std::remove_if(added, set.end(), [](const SwitchingFace& f) { return f.face == no_id; }),
        set.end());
    for (std::size_t q = known; q < set.size(); ++q) scratch_.known.push_back(set[q].face);
    std::sort(scratch_.known.begin(), scratch_.known.end());
    return set.size() > known;
  }

  /// At most so many passes over each group of faces that share free blocks; groups do not affect
  /// each other. Returns the most that any group took.
  std::uint64_t pass(std::uint64_t most) {
    divide();
    std::vector<SwitchingGroup>& groups = scratch_.groups;
    const auto correct_group = [&](std::size_t q) { this->correct_group(groups[q], most); };
    parallel_for(groups.size(), correct_group,
                 cost_of_a_face * scratch_.set.size() / std::max<std::size_t>(1, groups.size()));
    std::uint64_t passes = 0;
    double farthest = 0.0;
    for (const SwitchingGroup& g : groups) {
      passes = std::max(passes, g.passes);
      farthest = std::max(farthest, g.pushed_by);
      scratch_.corrections = std::max(scratch_.corrections, g.corrections);
      scratch_.on_fixed += g.on_fixed;
    }
    scratch_.pushed_by += farthest;
    return passes;
  }

  /// Evaluates the faces of the blocks that were pushed again and adds those that switch now.
  /// Returns whether there are any.
  bool refresh() {
    std::vector<Id> pushed;
    for (const SwitchingGroup& g : scratch_.groups)
      pushed.insert(pushed.end(), g.pushed.begin(), g.pushed.end());
    std::sort(pushed.begin(), pushed.end());
    pushed.erase(std::unique(pushed.begin(), pushed.end()), pushed.end());
    std::vector<Id> faces;
    for (const Id i : pushed) {
      c_.for_faces(b_.vertex_begin[i], b_.vertex_begin[i + 1], [&](Id k, bool) {
        if (in_step_.takes_part(scratch_.pushed_by, k)) faces.push_back(k);
      });
    }
    std::sort(faces.begin(), faces.end());  // a face of two pushed blocks is in there twice
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    evaluate_again(faces);
    std::erase_if(faces, [&](Id k) { return !t_.has_found(lane_bits::switching, k); });
    return find(faces);
  }

  bool has_converged() const {
    return std::all_of(scratch_.groups.begin(), scratch_.groups.end(),
                       [](const SwitchingGroup& g) { return g.converged; });
  }

  /// Accounts for the energy residual left after the last pass as transfer. The slip of these faces
  /// at n has changed, also where no block was pushed.
  void book() {
    const auto book_face = [&](std::size_t q) {
      const SwitchingFace& f = scratch_.set[q];
      const Face next = face_at(c_, b_, pose_.x, pose_.y, f.face);
      const double stored_next =
          stored_between(f.risen, f.at, next, face_points(c_, pose_.x, pose_.y, f.face), false);
      c_.transfer[f.face] += f.stored + f.dilation_work - stored_next - f.alpha * work(f);
    };
    parallel_for(scratch_.set.size(), book_face, cost_of_a_face / 4);
    std::vector<Id> faces;
    for (const SwitchingFace& f : scratch_.set) {
      faces.push_back(f.face);
      load_correction(t_, c_, f.before, f.face);
    }
    std::sort(faces.begin(), faces.end());
    evaluate_again(faces);
    in_step_.gather(scratch_.evaluated);
  }

 private:
  static constexpr std::size_t cost_of_a_face = 4000 / seldom;  // ns, with some passes

  /// Evaluates these faces at the present positions, with what is decided of them there.
  void evaluate_again(const std::vector<Id>& faces) {
    scratch_.evaluated.insert(scratch_.evaluated.end(), faces.begin(), faces.end());
    in_step_.evaluate(faces, scratch_.pushed_by);
    const StateAtN corrected = [&](Id k) -> const FaceFields* {
      const auto known = std::find_if(scratch_.set.begin(), scratch_.set.end(),
                                      [k](const SwitchingFace& f) { return f.face == k; });
      return known == scratch_.set.end() ? nullptr : &known->before;
    };
    in_step_.evaluate(in_step_.decide(faces, corrected), scratch_.pushed_by);
  }

  /// Empties the set. In the first step of a run every face may close, and in none that follows.
  void begin_set() {
    std::vector<SwitchingFace>& set = scratch_.set;
    constexpr std::size_t few = 64, most = 16;
    if (set.capacity() > most * (set.size() + few)) set = std::vector<SwitchingFace>();
    set.clear();
  }

  Id first_block(const SwitchingFace& f) const { return b_.vertex_block[c_.edge[f.face]]; }
  Id second_block(const SwitchingFace& f) const { return b_.vertex_block[c_.facing[f.face]]; }

  /// Divides the set into groups of faces that share free blocks, directly or by others of the set.
  void divide() {
    const std::vector<SwitchingFace>& set = scratch_.set;
    std::vector<Id> leader(set.size()), group_of(set.size(), no_id);
    const auto leader_of = [&](Id q) {
      while (leader[q] != q) q = leader[q] = leader[leader[q]];
      return q;
    };
    for (Id q = 0; q < set.size(); ++q) {
      leader[q] = q;
      for (const Id i : {first_block(set[q]), second_block(set[q])}) {
        if (b_.fixed[i]) continue;
        Id& first = scratch_.first_face[i];
        if (first == no_id) first = q;
        const Id one = leader_of(first), other = leader_of(q);
        leader[std::max(one, other)] = std::min(one, other);
      }
    }
    std::vector<SwitchingGroup>& groups = scratch_.groups;
    std::size_t count = 0;
    for (Id q = 0; q < set.size(); ++q) {
      for (const Id i : {first_block(set[q]), second_block(set[q])}) scratch_.first_face[i] = no_id;
      Id& group = group_of[leader_of(q)];
      if (group == no_id) {
        group = static_cast<Id>(count++);
        if (groups.size() < count) groups.emplace_back();
        groups[group].begin_anew(scratch_.corrections);
      }
      groups[group].faces.push_back(q);
    }
    groups.resize(count);
  }

  void correct_group(SwitchingGroup& g, std::uint64_t most) {
    while (!g.converged && g.passes < most) {
      g.converged = pass(g);
      ++g.passes;
    }
  }

  /// One pass over the faces of a group, except those whose blocks have not moved since. Returns
  /// whether all have converged.
  bool pass(SwitchingGroup& g) {
    bool all = true;
    for (const Id q : g.faces) {
      SwitchingFace& f = scratch_.set[q];
      const Id i = first_block(f), j = second_block(f);
      if (f.done && scratch_.moved_at[i] <= f.corrected_at &&
          scratch_.moved_at[j] <= f.corrected_at)
        continue;
      all = correct(g, f, i, j) && all;
    }
    return all;
  }

  /// Completes f where the face stored energy at n, and opens or closes in this step or did so in
  /// the last; elsewhere f.face becomes no_id.
  void add_if_it_switches(SwitchingFace& f) {
    recall_work(c_, t_, f.face);
    const FaceFields before = remembered(t_, f.face);
    if (before.energy > 0.0 && !c_.carries_tension(f.face) &&
        (before.switched > 0.0 || t_.remembers(lane_bits::switched, f.face)))
      return complete(f, before);
    f.face = no_id;
  }

  void complete(SwitchingFace& f, const FaceFields& row) {
    const Id k = f.face;
    f.before = row;
    f.then = face_points(c_, pose_.x2, pose_.y2, k);
    f.at = face_points(c_, pose_.x1, pose_.y1, k);
    const bool dilates = !c_.risen.empty() && c_.risen[k] != 0.0;
    const double risen = dilates ? c_.risen[k] : 0.0;
    f.dilation_work = dilates ? c_.dilation_work[k] : 0.0;
    f.element = f.risen = face_at(c_, b_, pose_.x1, pose_.y1, k, risen);
    if (dilates) f.risen = face_at(c_, b_, pose_.x1, pose_.y1, k);
    const Face before = face_at(c_, b_, pose_.x2, pose_.y2, k, risen);
    f.was_closed = before.energy > 0.0;
    f.stored = stored_between(before, f.then, f.element, f.at, false);
    const OnBlocks on = on_blocks(c_, f.element.force, k);
    f.own_work =
        taken_.leap.h_new * (mobility(taken_.leap, b_.vertex_block[c_.edge[k]], on.first) +
                             mobility(taken_.leap, b_.vertex_block[c_.facing[k]], on.second));
    f.alpha = 1.0;
    f.force = f.element.force;
    const CornerForces shear = end_forces(f.at, f.element, {}, {row.shear_a, row.shear_b});
    f.force = {f.force.p1 + shear.p1, f.force.p2 + shear.p2, f.force.q1 + shear.q1,
               f.force.q2 + shear.q2};
  }

  /// Work of the whole normal force over (x_{n+1} - x_{n-1})/2.
  double work(const SwitchingFace& f) const {
    return 0.5 * work_of(f.element.force, face_points(c_, pose_.x, pose_.y, f.face), f.then);
  }

  /// One iteration towards alpha F_n.(x_{n+1} - x_{n-1})/2 + U_{n+1/2} - U_{n-1/2} = 0.
  bool correct(SwitchingGroup& g, SwitchingFace& f, Id i, Id j) {
    const Id k = f.face;
    const FacePoints next_at = face_points(c_, pose_.x, pose_.y, k);
    const Face next = face_at(c_, b_, pose_.x, pose_.y, k);
    const bool closes = next.energy > 0.0;
    f.stored_next = stored_between(f.risen, f.at, next, next_at, false);
    const double whole = work(f);
    const double left = f.alpha * whole + f.stored_next - f.stored - f.dilation_work;
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
    f.corrected_at = ++g.corrections;
    f.done = change <= converged;
    if (!any(more)) return f.done;
    const OnBlocks on = on_blocks(c_, more, k);
    push(g, f, i, on.first);
    push(g, f, j, on.second);
    return f.done;
  }

  /// A fixed block does not move, and may have very many faces.
  void push(SwitchingGroup& g, const SwitchingFace& f, Id i, const EdgeForce& force) {
    if (b_.fixed[i]) {
      g.on_fixed += force.at_edge + force.at_end;
      return;
    }
    g.pushed_by += push_block(taken_, i, force);
    g.pushed.push_back(i);
    if (!f.done) scratch_.moved_at[i] = f.corrected_at;
  }

  FaceSet& c_;
  FaceTiles& t_;
  FacesInStep& in_step_;
  const BlockSet& b_;
  const Pose& pose_;
  FaceSwitchingScratch& scratch_;
  const StepTaken& taken_;
};

}  // namespace

void correct_switching(FaceSet& c, FaceTiles& tiles, FacesInStep& in_step, const StepTaken& taken,
                       OpenCloseCounts& counts, FaceSwitchingScratch& scratch,
                       const std::vector<Id>& switching) {
  Correction correction(c, tiles, in_step, taken, scratch);
  if (!correction.find(switching)) return;
  std::uint64_t passes = 0;
  do {
    passes += correction.pass(most_passes - passes);
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
  if (!correction.has_converged()) ++counts.not_converged;
}

}  // namespace edda
