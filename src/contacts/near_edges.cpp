#include "contacts/near_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "base/vector_loop.hpp"
#include "contacts/search.hpp"

namespace edda {
namespace {

/// How much wider than the reach of a list that of the stored pairs is: the wider, the more pairs
/// are looked at for each list, and the fewer times they are found anew.
constexpr double wider = 4.0;
/// But not by more than this part of the mean length of the edges: where blocks move far in a step,
/// the pairs would be too many.
constexpr double most_of_edge = 0.5;

double wider_reach(const BlockSet& b, const Reach& reach) {
  double sum = 0.0;
  for (const double length : b.edge_length) sum += length;
  const double mean = sum / static_cast<double>(std::max<std::size_t>(b.edge_length.size(), 1));
  return reach.furthest() + std::min((wider - 1.0) * reach.apart, most_of_edge * mean);
}

/// Cosine of an angle (degrees) plus (90 - alpha)/2, with the cosine of the corner alpha.
class BesideCorner {
 public:
  explicit BesideCorner(double angle)
      : cosine_(std::cos((angle + 45.0) / 180.0 * std::numbers::pi)),
        sine_(std::sin((angle + 45.0) / 180.0 * std::numbers::pi)) {}
  double operator()(double corner) const {
    return cosine_ * std::sqrt(0.5 * (1.0 + corner)) + sine_ * std::sqrt(0.5 * (1.0 - corner));
  }

 private:
  double cosine_, sine_;
};
const BesideCorner whole_beside(60.0), none_beside(85.0);
constexpr double blunt = 0.0, needle = 1.0;  ///< cosines of the corners

/// What the loop over pairs of edges reads.
struct EdgesView {
  const Id *first, *second, *next;
  const double *x, *y;
};

/// Square of the distance of p from the segment of direction u that starts at a.
EDDA_INLINE double square_of_distance(Vec2 p, Vec2 a, Vec2 u, double per_square) {
  const Vec2 to = p - a;
  const double along = smaller(larger(dot(to, u) * per_square, 0.0), 1.0);
  const Vec2 away = to - along * u;
  return dot(away, away);
}

/// Overlap of two edges along the mean of their directions, of unit vectors ue and uf: negative by
/// how much they are apart along it. -infinity where they are not behind each other.
EDDA_INLINE double overlap_behind(Vec2 p1, Vec2 u, Vec2 ue, Vec2 q1, Vec2 q2, Vec2 uf) {
  const Vec2 mean = ue - uf;
  const double length2 = dot(mean, mean);
  const Vec2 t = (1.0 / std::sqrt(length2 > 0.0 ? length2 : 1.0)) * mean;
  const double s2 = dot(u, t), r1 = dot(q1 - p1, t), r2 = dot(q2 - p1, t);
  const double from = larger(r2, 0.0), to = smaller(s2, r1);
  const double z1 = cross(t, q1 - p1), z2 = cross(t, q2 - p1);
  const double slope_e = cross(t, u) / (s2 > 0.0 ? s2 : 1.0);
  const double slope_f = (z1 - z2) / (r1 > r2 ? r1 - r2 : 1.0);
  const auto closure_at = [&](double s) { return z2 + slope_f * (s - r2) - slope_e * s; };
  const bool opposed = (length2 > 0.0) & (s2 > 0.0) & (r1 > r2);
  const bool behind = opposed & (larger(closure_at(from), closure_at(to)) > 0.0);
  return behind ? to - from : -std::numeric_limits<double>::infinity();
}

/// Cosine to which two edges may turn towards each other before a vertex of either has moved by
/// half of reach.apart; -2 where they are not within reach.
EDDA_INLINE double cosine_within(const EdgesView& v, const Reach& reach, std::size_t n) {
  const Id e = v.first[n], f = v.second[n], e_end = v.next[e], f_end = v.next[f];
  const Vec2 p1{v.x[e], v.y[e]}, p2{v.x[e_end], v.y[e_end]};
  const Vec2 q1{v.x[f], v.y[f]}, q2{v.x[f_end], v.y[f_end]};
  const Vec2 u = p2 - p1, w = q2 - q1;
  const double uu = 1.0 / dot(u, u), ww = 1.0 / dot(w, w);
  const double nearest =
      smaller(smaller(square_of_distance(p1, q1, w, ww), square_of_distance(p2, q1, w, ww)),
              smaller(square_of_distance(q1, p1, u, uu), square_of_distance(q2, p1, u, uu)));
  const double per_e = std::sqrt(uu), per_f = std::sqrt(ww);
  // The largest relative rotation of the two edges is reach/le + reach/lf.
  const double reached = reach.apart * (per_e + per_f) - dot(u, w) * (per_e * per_f);
  const double overlap = overlap_behind(p1, u, per_e * u, q1, q2, per_f * w);
  const double acting = smaller(larger(overlap + reach.apart, 0.0), reach.behind);
  const double within = reach.apart + acting * (1.0 / aspect_from);
  return nearest < within * within ? reached : -2.0;
}

EDDA_VECTOR void find_cosines(EdgesView v, Reach reach, double* cosine, std::size_t begin,
                              std::size_t end) {
#pragma omp simd
  for (std::size_t n = begin; n < end; ++n) cosine[n - begin] = cosine_within(v, reach, n);
}

/// Whether edges that may reach this cosine may be opposed. For most pairs the gate need not be
/// computed: it lies between those of blunt corners and of a needle.
bool may_oppose(const BlockSet& b, Id e, Id f, double cosine) {
  static const double of_blunt = none_beside(blunt), of_needle = none_beside(needle);
  return cosine > of_blunt || (cosine > of_needle && cosine > angle_gate(b, e, f).none);
}

constexpr std::size_t pairs_at_once = 512;

/// Those of the pairs [begin, end) that are within reach, both blocks alive; visit(e, f).
template <class Visit>
void for_pairs_within(const NearEdges& known, const BlockSet& b, const State& state,
                      const Pose& pose, const Reach& reach, std::size_t begin, std::size_t end,
                      Visit visit) {
  double cosine[pairs_at_once];
  const EdgesView view{known.first.data(), known.second.data(), b.next.data(), pose.x.data(),
                       pose.y.data()};
  find_cosines(view, reach, cosine, begin, end);
  for (std::size_t n = begin; n < end; ++n) {
    if (cosine[n - begin] == -2.0) continue;
    const Id e = known.first[n], f = known.second[n];
    const bool alive = state.alive[b.vertex_block[e]] != 0 && state.alive[b.vertex_block[f]] != 0;
    if (alive && may_oppose(b, e, f, cosine[n - begin])) visit(e, f);
  }
}

/// Sorts pairs and drops those that are there twice: by their first edges first, of which each has
/// few.
void store_sorted(NearEdges& known, const std::vector<EdgePair>& pairs, std::size_t edges) {
  std::vector<Id> begin(edges + 1, 0);
  for (const EdgePair& pair : pairs) ++begin[pair.first + 1];
  for (std::size_t e = 0; e < edges; ++e) begin[e + 1] += begin[e];
  std::vector<Id> second(pairs.size()), next(begin.begin(), begin.end() - 1);
  for (const auto& [e, f] : pairs) second[next[e]++] = f;
  std::vector<Id> firsts, seconds;
  firsts.reserve(pairs.size());
  seconds.reserve(pairs.size());
  for (Id e = 0; e < edges; ++e) {
    const auto from = second.begin() + begin[e], to = second.begin() + begin[e + 1];
    std::sort(from, to);
    for (auto f = from; f != to; ++f) {
      if (f != from && *f == *(f - 1)) continue;
      firsts.push_back(e);
      seconds.push_back(*f);
    }
  }
  known.first = std::move(firsts);
  known.second = std::move(seconds);
}

/// Fills the store for this reach.
void find_near_edges(NearEdges& known, const BlockSet& b, const State& state, const Pose& pose,
                     double reach) {
  std::vector<EdgePair> pairs;
  const auto add = [&](Id e, Id f) {
    const Vec2 u = at(pose.x, pose.y, b.next[e]) - at(pose.x, pose.y, e);
    const Vec2 w = at(pose.x, pose.y, b.next[f]) - at(pose.x, pose.y, f);
    const double le = norm(u), lf = norm(w);
    constexpr double strained = 1.01;  // edges may have other lengths later
    if (may_oppose(b, e, f, strained * (reach / le + reach / lf) - dot(u, w) / (le * lf)))
      pairs.push_back(std::minmax(e, f));
  };
  for (const NearPair& near : near_pairs(b, state.alive, pose.x, pose.y, reach)) {
    add(near.vertex, near.edge);
    add(b.previous[near.vertex], near.edge);
  }
  store_sorted(known, pairs, b.vertex_count());
  known.reach = reach;
  known.built_x = pose.x;
  known.built_y = pose.y;
  ++known.lists;
}

/// Whether the pairs within reach are all in the store.
bool holds(NearEdges& known, const BlockSet& b, const State& state, const Pose& pose,
           const Reach& reach) {
  const double furthest = reach.furthest();
  if (known.lists == 0 || !(furthest < known.reach)) return false;
  if (known.reach > wider * wider * furthest) return false;  // it is from a time of faster motion
  const ListOrigin then{known.built_x, known.built_y, known.reach, known.lists};
  // The part takes up the rounding of distances.
  constexpr double part = 1.0 - 1e-9;
  return furthest + largest_approach(known.groups, b, state, pose, then) < part * known.reach;
}

}  // namespace

AngleGate angle_gate(const BlockSet& b, Id e, Id f) {
  double sharpest = blunt;
  for (const Id v : {e, b.next[e], f, b.next[f]})
    sharpest = std::max(sharpest, -b.exterior_cosine[v]);
  return {whole_beside(sharpest), none_beside(sharpest)};
}

std::vector<EdgePair> edges_within(NearEdges& known, const BlockSet& b, const State& state,
                                   const Pose& pose, const Reach& reach) {
  if (!holds(known, b, state, pose, reach))
    find_near_edges(known, b, state, pose, wider_reach(b, reach));
  const std::size_t all = known.first.size();
  std::vector<std::vector<EdgePair>> parts((all + pairs_at_once - 1) / pairs_at_once);
  parallel_chunks(all, pairs_at_once, 10, [&](std::size_t q, std::size_t begin, std::size_t end) {
    for_pairs_within(known, b, state, pose, reach, begin, end, [&](Id e, Id f) {
      parts[q].push_back({e, f});
    });
  });
  std::vector<EdgePair> pairs;
  pairs.reserve(all);
  for (const auto& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

}  // namespace edda
