#include "judge/moved_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "blocks/block_groups.hpp"
#include "blocks/shape_change.hpp"
#include "step/contact_pairs.hpp"

namespace edda {
namespace {

constexpr double landing = 0.1;  // of the way of what was to land

/// Sets of blocks and the ground while they are joined. The ground is the last member.
class Linkage {
 public:
  Linkage(const Simulation& sim, const std::vector<std::vector<Id>>& neighbours)
      : blocks_(sim.scene->blocks), neighbours_(neighbours), sets_(blocks_.size() + 1) {
    members_.resize(blocks_.size() + 1);
    size_.assign(blocks_.size() + 1, std::numeric_limits<double>::infinity());
    for (Id i = 0; i < blocks_.size(); ++i) {
      members_[i] = {i};
      if (is_free(blocks_, sim.motion.state, i)) size_[i] = std::sqrt(blocks_.area[i]);
    }
    for (Id i = 0; i < blocks_.size(); ++i) {
      if (!std::isfinite(size_[i])) join(i, ground(), 0.0);
    }
  }
  Id ground() const { return static_cast<Id>(blocks_.size()); }

  /// Joins the sets of two blocks. Returns the blocks of the smaller one if all its neighbours
  /// belong to the other and it is smaller than `most` (m); else nothing.
  std::vector<Id> join(Id i, Id j, double most) {
    Id small = sets_.find(i), large = sets_.find(j);
    if (small == large) return {};
    if (size_[small] > size_[large] || (size_[small] == size_[large] && small < large))
      std::swap(small, large);
    std::vector<Id> moved;
    if (size_[small] < most && all_beside(small, large)) moved = members_[small];
    last_size_ = size_[small];
    sets_.join(small, large);
    const Id root = sets_.find(small), other = root == small ? large : small;
    size_[root] = std::max(size_[small], size_[large]);
    members_[root].insert(members_[root].end(), members_[other].begin(), members_[other].end());
    members_[other] = {};
    return moved;
  }
  /// Of the smaller set that was joined last, m.
  double last_size() const { return last_size_; }

 private:
  /// Whether all neighbours of one set belong to the other.
  bool all_beside(Id set, Id other) {
    for (const Id i : members_[set]) {
      for (const Id j : neighbours_[i]) {
        const Id of = sets_.find(j);
        if (of != set && of != other) return false;
      }
    }
    return true;
  }

  const BlockSet& blocks_;
  const std::vector<std::vector<Id>>& neighbours_;
  Sets sets_;
  std::vector<std::vector<Id>> members_;  ///< of the set with this lowest member
  std::vector<double> size_;              ///< m, of its largest block; infinite: fixed
  double last_size_ = 0.0;
};

/// [nb] 1: no path of closed contacts, bolts and pairs leads from the block to a fixed one or to a
/// support.
std::vector<std::uint8_t> unsupported(const Simulation& sim, const std::vector<Id>& small,
                                      const std::vector<Id>& large) {
  const BlockSet& b = sim.scene->blocks;
  Sets groups(b.size());
  for (std::size_t q = 0; q < small.size(); ++q) groups.join(small[q], large[q]);
  std::vector<std::uint8_t> stands(b.size(), 0);  // by the first block of each group
  for (Id i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) stands[groups.find(i)] = 1;
  }
  const BoundarySprings& springs = sim.attached.springs;
  for (std::size_t q = 0; q < springs.size(); ++q) {
    if (springs.kxx[q] + springs.kyy[q] > 0.0)
      stands[groups.find(b.vertex_block[springs.vertex[q]])] = 1;
  }
  std::vector<std::uint8_t> apart(b.size());
  for (Id i = 0; i < b.size(); ++i) apart[i] = stands[groups.find(i)] == 0 ? 1 : 0;
  return apart;
}

/// Mean elastic shear strain (s1 - s3)/(2 G) of the zones of block i that yield in shear or along
/// their foliation; 0 where none does.
double strain_at_yield(const Simulation& sim, Id i) {
  const BlockSet& b = sim.scene->blocks;
  const Zones& zones = sim.motion.zones;
  double sum = 0.0, volume = 0.0;
  for (std::uint32_t z = b.meshes.zone_begin[i]; z < b.meshes.zone_begin[i + 1]; ++z) {
    const auto yielding = static_cast<Yielding>(zones.yielding[z]);
    if (yielding == Yielding::nowhere || yielding == Yielding::in_tension) continue;
    const auto [xx, yy, zz, xy] = zones.state[z].stress;
    const double mean = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy);
    const double v = sim.scene->zones.shape[z].volume;
    sum += v * (std::max(mean + radius, zz) - std::min(mean - radius, zz));
    volume += v;
  }
  return volume > 0.0 ? sum / (2.0 * b.lame_mu[i] * volume) : 0.0;
}

/// Keeps of sets within each other the larger: those found later contain or avoid the earlier ones.
void keep_outer(std::vector<MovedSet>& sets, std::size_t blocks) {
  std::vector<std::uint8_t> taken(blocks, 0);
  std::vector<MovedSet> kept;
  for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
    if (taken[set->blocks.front()] != 0) continue;
    for (const Id i : set->blocks) taken[i] = 1;
    kept.push_back(std::move(*set));
  }
  std::sort(kept.begin(), kept.end(), [](const MovedSet& a, const MovedSet& b) {
    return a.part != b.part ? a.part > b.part : a.blocks.front() < b.blocks.front();
  });
  sets = std::move(kept);
}

}  // namespace

bool counts_in_verdicts(const Simulation& sim, std::size_t i) {
  return sim.control.sliver_most.empty() || !(sim.control.sliver_most[i] > 1.0);
}

RelativeMotion::RelativeMotion(const Simulation& sim)
    : then_(sim.motion.state.position),
      ground_(sim.attached.ground.shift),
      shift_(sim.attached.springs.shift) {
  std::vector<std::pair<Id, Id>> pairs;
  const auto add = [&](Id i, Id j) {
    if (i == j) return;
    pairs.push_back(size_of(sim, i) < size_of(sim, j) ||
                            (size_of(sim, i) == size_of(sim, j) && i > j)
                        ? std::pair{i, j}
                        : std::pair{j, i});
  };
  for (const auto& [i, j] : blocks_in_contact(sim, Nearness::near)) add(i, j);
  const Bolts& bolts = sim.attached.bolts;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Id> small, large;
  for (const auto& [i, j] : pairs) {
    small_.push_back(i);
    large_.push_back(j);
  }
  // What hangs from bolts alone is supported, but moves as seen from where it was.
  small = small_;
  large = large_;
  for (std::size_t r = 0; r < bolts.rows.size(); ++r) {
    for (Id k = bolts.begin[r] + 1; k < bolts.begin[r + 1]; ++k) {
      small.push_back(bolts.host[k - 1]);
      large.push_back(bolts.host[k]);
    }
  }
  apart_ = unsupported(sim, small, large);
}

bool RelativeMotion::fits(const BlockSet& b) const {
  const std::size_t blocks = b.size();
  const auto below = [blocks](Id i) { return i < blocks; };
  return edda::fits(b, then_) && apart_.size() == blocks && small_.size() == large_.size() &&
         std::all_of(small_.begin(), small_.end(), below) &&
         std::all_of(large_.begin(), large_.end(), below);
}

double RelativeMotion::size_of(const Simulation& sim, Id i) const {
  const BlockSet& b = sim.scene->blocks;
  return is_free(b, sim.motion.state, i) ? std::sqrt(b.area[i])
                                         : std::numeric_limits<double>::infinity();
}

/// With F = dx/dX of the larger block, now and at the start: x' - x of the corners of the smaller
/// one, x = c + F F_0^-1 (x_0 - d_0 - c_0) + d, with the deviation d of the nearest point of the
/// larger block's boundary from its affine motion.
double RelativeMotion::moved(const Simulation& sim, const Pair& pair) const {
  const BlockSet& b = sim.scene->blocks;
  const State& s = sim.motion.state;
  const Deformation now = deformation(b, s.position, pair.large),
                    was = deformation(b, then_, pair.large);
  const double det = was.xx * was.yy - was.xy * was.yx;
  const Deformation g{
      (now.xx * was.yy - now.xy * was.yx) / det, (now.xy * was.xx - now.xx * was.xy) / det,
      (now.yx * was.yy - now.yy * was.yx) / det, (now.yy * was.xx - now.yx * was.xy) / det};
  const Vec2 c = centroid(s.position, pair.large), c0 = centroid(then_, pair.large);
  double most = 0.0;
  for (Id v = b.vertex_begin[pair.small]; v < b.vertex_begin[pair.small + 1]; ++v) {
    const Vec2 start = corner_at_start(b, v);
    const Deviation bent = deviation_beside(sim, pair.large, start);
    const Vec2 arm = start - bent.then - c0;
    const Vec2 carried =
        c + Vec2{g.xx * arm.x + g.xy * arm.y, g.yx * arm.x + g.yy * arm.y} + bent.now;
    most = std::max(most, norm(corner_now(sim, v) - carried));
  }
  return most;
}

RelativeMotion::Deviation RelativeMotion::deviation_beside(const Simulation& sim, Id block,
                                                           Vec2 p) const {
  const BlockSet& b = sim.scene->blocks;
  if (!b.bends(block)) return {};
  const Id first = b.vertex_begin[block], last = b.vertex_begin[block + 1];
  double nearest = std::numeric_limits<double>::infinity(), part = 0.0;
  Id edge = first;
  for (Id e = first; e < last; ++e) {
    const Vec2 a = corner_at_start(b, e), along = corner_at_start(b, b.next[e]) - a;
    const double xi = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
    const double distance = norm(p - a - xi * along);
    if (!(distance < nearest)) continue;
    nearest = distance;
    edge = e;
    part = xi;
  }
  const auto beside = [&](const BodyVectors& u) {
    return (1.0 - part) * deviation_at(b, u, edge) + part * deviation_at(b, u, b.next[edge]);
  };
  return {beside(then_), beside(sim.motion.state.position)};
}

Vec2 RelativeMotion::corner_at_start(const BlockSet& b, Id v) const {
  return corner_at(b, then_, v);
}

Vec2 RelativeMotion::corner_now(const Simulation& sim, Id v) const {
  const State& s = sim.motion.state;
  return corner_at(sim.scene->blocks, s.position, v);
}

std::vector<FlowingPart> RelativeMotion::flowing(const Simulation& sim,
                                                 const std::vector<std::uint8_t>& left_out) const {
  constexpr int fewest = 20;  // nodes
  const BlockSet& b = sim.scene->blocks;
  std::vector<FlowingPart> parts;
  for (Id i = 0; i < b.size(); ++i) {
    if (!b.is_meshed(i) || !is_free(b, sim.motion.state, i) || !counts_in_verdicts(sim, i) ||
        (!left_out.empty() && left_out[i] != 0))
      continue;
    const double strain = strain_at_yield(sim, i);
    if (strain == 0.0) continue;
    const std::vector<double> moved = shape_change(b, then_, sim.motion.state.position, i);
    const double most = *std::max_element(moved.begin(), moved.end());
    int nodes = 0;
    double share = 0.0;
    for (std::size_t j = 0; j < moved.size(); ++j) {
      if (2.0 * moved[j] < most) continue;
      ++nodes;
      share += b.meshes.share[b.meshes.begin[i] + j];
    }
    if (nodes < fewest) continue;
    const double area = share * b.area[i], part = most / std::sqrt(area);
    parts.push_back({i, area, part, part / strain});
  }
  return parts;
}

bool RelativeMotion::supports_have_moved(const Simulation& sim) const {
  return sim.attached.springs.shift != shift_;
}

double RelativeMotion::moved_from_start(const Simulation& sim, Id i) const {
  return moved_with(sim, i, sim.attached.ground.shift - ground_);
}

double RelativeMotion::moved_from_support(const Simulation& sim, Id i) const {
  const BoundarySprings& springs = sim.attached.springs;
  double least = moved_from_start(sim, i);
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q) {
    const auto row = static_cast<std::size_t>(springs.boundary[q]);
    if (springs.kxx[q] + springs.kyy[q] > 0.0 && springs.shift[row] != shift_[row])
      least = std::min(least, moved_with(sim, i, springs.shift[row] - shift_[row]));
  }
  return least;
}

double RelativeMotion::moved_with(const Simulation& sim, Id i, Vec2 carried) const {
  const BlockSet& b = sim.scene->blocks;
  double most = 0.0;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v)
    most = std::max(most, norm(corner_now(sim, v) - corner_at_start(b, v) - carried));
  return most;
}

std::vector<MovedSet> RelativeMotion::sets(const Simulation& sim, double least,
                                           const std::vector<std::uint8_t>& left_out) const {
  const BlockSet& b = sim.scene->blocks;
  const State& s = sim.motion.state;
  const auto counts = [&](Id i) {
    return s.alive[i] != 0 && counts_in_verdicts(sim, i) && (left_out.empty() || left_out[i] == 0);
  };
  struct Link {
    double distance;
    Id i, j;
  };
  const Id ground = static_cast<Id>(b.size());
  std::vector<Link> links;
  std::vector<std::vector<Id>> neighbours(b.size());
  for (std::size_t q = 0; q < small_.size(); ++q) {
    const Id i = small_[q], j = large_[q];
    if (!counts(i) || !counts(j) || !is_free(b, s, i)) continue;
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
    links.push_back({moved(sim, {i, j}), i, j});
  }
  for (Id i = 0; i < b.size(); ++i) {
    if (counts(i) && is_free(b, s, i)) links.push_back({moved_from_support(sim, i), i, ground});
  }
  std::sort(links.begin(), links.end(), [](const Link& a, const Link& c) {
    return a.distance != c.distance ? a.distance < c.distance
                                    : std::pair{a.i, a.j} < std::pair{c.i, c.j};
  });
  Linkage linkage(sim, neighbours);
  std::vector<MovedSet> sets;
  for (const Link& link : links) {
    std::vector<Id> blocks = linkage.join(link.i, link.j, link.distance / least);
    if (blocks.empty()) continue;
    const bool lands = std::all_of(blocks.begin(), blocks.end(), [&](Id i) { return apart_[i]; });
    const double part = (lands ? landing : 1.0) * link.distance / linkage.last_size();
    if (!(part > least)) continue;
    std::sort(blocks.begin(), blocks.end());
    MovedSet set{std::move(blocks), 0.0, link.distance, part};
    for (const Id i : set.blocks) set.area += b.area[i];
    sets.push_back(std::move(set));
  }
  keep_outer(sets, b.size());
  return sets;
}

}  // namespace edda
