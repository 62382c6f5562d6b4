#include "attachments/bolts.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace edda {
namespace {

/// Slope of a spring beyond its strength, as a part of its stiffness. It makes the solution unique
/// where a bolt slips along its whole length. The force exceeds the strength by this part of the
/// trial increment of one step.
constexpr double beyond = 1e-4;

struct SpringResponse {
  double force, slope;
};

/// Force and slope of a spring with the elastic elongation `stretch`.
SpringResponse answer(const BoltSprings& s, std::size_t k, double stretch) {
  const double stiffness = s.broken[k] != 0 ? 0.0 : s.stiffness[k];
  const double force = stiffness * stretch, over = std::abs(force) - s.strength[k];
  if (!(over > 0.0)) return {force, stiffness};
  return {std::copysign(s.strength[k] + beyond * over, force), beyond * stiffness};
}

/// Work of that force from zero to this elongation.
double energy(const BoltSprings& s, std::size_t k, double stretch) {
  const SpringResponse a = answer(s, k, stretch);
  if (s.broken[k] != 0 || s.stiffness[k] == 0.0) return 0.0;
  const double whole = s.stiffness[k] * std::abs(stretch), most = std::min(whole, s.strength[k]);
  return 0.5 * most * most / s.stiffness[k] +
         0.5 * (most + std::abs(a.force)) * (whole - most) / s.stiffness[k];
}

/// Work of plastic flow from n - 1 to n: the half that F_{n-1} has done so far, and the half that
/// F_n does in the next step.
struct Spent {
  double slipped = 0.0, fractured = 0.0;
  double pending_friction = 0.0, pending_fracture = 0.0;
  int increments = 0;  ///< of Newton's method
};

/// Sets the force at an elastic elongation `stretch` that may have to flow. Plastic flow dissipates
/// (F_{n-1} + F_n)/2 times its amount. A spring that has just broken releases all of its energy.
void set_force(BoltSprings& s, std::size_t k, double stretch, double force, bool flows,
               Spent& spent) {
  s.force_1[k] = s.force[k];
  s.force[k] = force;
  const bool broken = s.broken[k] != 0;
  if (!broken && !flows) return;
  const double flow = stretch - s.force[k] / s.stiffness[k];
  s.plastic[k] += flow;
  (broken ? spent.fractured : spent.slipped) += 0.5 * s.force_1[k] * flow;
  (broken ? spent.pending_fracture : spent.pending_friction) += 0.5 * s.force[k] * flow;
  if (!broken) s.yielded[k] = 1;
}

void yield_to(BoltSprings& s, std::size_t k, double elongation, Spent& spent) {
  if (s.stiffness[k] == 0.0) {
    s.force_1[k] = s.force[k];
    return;
  }
  const double stretch = elongation - s.plastic[k], force = answer(s, k, stretch).force;
  set_force(s, k, stretch, force, std::abs(force) > s.strength[k], spent);
}

double elongation(const BarFrame& f, const std::vector<double>& slip, std::size_t k) {
  return f.stretch + slip[k + 1] * f.end - slip[k] * f.start;
}
double elongation(const Bolts& b, const std::vector<double>& slip, std::size_t k) {
  return elongation(b.frame[k], slip, k);
}

double offset(const BarFrame& f) {
  return cross(f.t, f.gap);
}

LinkForces answer(const Bolts& b, std::size_t k, const BarLink& link) {
  const LinkPair stiffness{b.bars.stiffness[k], b.dowels.stiffness[k]};
  if (b.bars.broken[k] != 0) return {};
  return link_forces({stiffness.axial * (link.longer - b.bars.plastic[k]),
                      stiffness.shear * (link.shear - b.dowels.plastic[k])},
                     stiffness, {b.bars.strength[k], b.dowels.strength[k]}, beyond);
}

/// Force of bar k along the bolt at these slips.
SpringResponse answer_of_bar(const Bolts& b, const std::vector<double>& slip, std::size_t k) {
  const double e = elongation(b, slip, k);
  if (b.hinges[k] == 0.0) return answer(b.bars, k, e - b.bars.plastic[k]);
  const BarLink at = link_at(b.hinges[k], e, offset(b.frame[k]));
  const LinkForces f = answer(b, k, at);
  const double c = at.cosine, s = at.part * at.sine;
  const double turning =
      at.sine * (f.force.axial * at.sine + 2.0 * f.force.shear * at.part * c) / at.length;
  return {at.pull(f.force).x,
          c * c * f.axial_slope - 2.0 * c * s * f.mixed_slope + s * s * f.shear_slope + turning};
}

double energy_of_bar(const Bolts& b, const std::vector<double>& slip, std::size_t k) {
  const double e = elongation(b, slip, k);
  if (b.hinges[k] == 0.0) return energy(b.bars, k, e - b.bars.plastic[k]);
  return answer(b, k, link_at(b.hinges[k], e, offset(b.frame[k]))).energy;
}

/// As yield_to(), of a bar and its dowel that are a link.
void yield_to(Bolts& b, std::size_t k, const BarLink& link, Spent& spent) {
  const LinkForces f = answer(b, k, link);
  set_force(b.bars, k, link.longer - b.bars.plastic[k], f.force.axial, f.flows, spent);
  set_force(b.dowels, k, link.shear - b.dowels.plastic[k], f.force.shear, f.flows, spent);
}

/// The direction m of a bolt at a node, and the point h in its host.
struct NodeAt {
  Vec2 m, h;
};

NodeAt node_at(const Bolts& b, const BlockSet& blocks, const State& state, std::size_t k) {
  const NodeVectors x = carriers_at(b, blocks, state, k);
  return {weighted(weights_of(b.along, k), x), weighted(weights_of(b.weight, k), x)};
}

BarFrame frame_between(const NodeAt& at, const NodeAt& next, double length) {
  const Vec2 sum = at.m + next.m;
  BarFrame f;
  f.from = at.m;
  f.to = next.m;
  f.size = norm(sum);
  f.t = sum / f.size;
  f.gap = next.h - at.h;
  f.start = dot(f.t, f.from);
  f.end = dot(f.t, f.to);
  f.stretch = dot(f.t, f.gap) - length;
  return f;
}

/// One grouted bolt at the present positions of its hosts.
class Chain {
 public:
  Chain(Bolts& bolts, const BlockSet& blocks, const State& state, Id first, Id last)
      : b_(bolts), first_(first), last_(last) {
    NodeAt at = node_at(b_, blocks, state, first);
    for (std::size_t k = first; k + 1 < last; ++k) {
      const NodeAt next = node_at(b_, blocks, state, k + 1);
      b_.frame[k] = frame_between(at, next, b_.length[k]);
      at = next;
    }
  }

  /// Newton's method on the energy, which is convex and piecewise quadratic; an increment that
  /// would raise the energy is shortened. Whole increments that lead into balance need no energy:
  /// the minimum is there. Returns the number of increments.
  int solve() {
    constexpr int most = 100;
    int round = 0;
    for (bool balanced = in_balance(b_.slip); round < most && !balanced; ++round) {
      find_change();
      increase_by(1.0);
      balanced = in_balance(b_.trial);
      if (!balanced && shorten()) balanced = in_balance(b_.trial);
      std::copy_n(b_.trial.data() + first_, last_ - first_, b_.slip.data() + first_);
    }
    return round;
  }

 private:
  void increase_by(double part) {
    for (std::size_t k = first_; k < last_; ++k) b_.trial[k] = b_.slip[k] + part * b_.change[k];
  }

  /// Halves the increment as long as it raises the energy. Returns whether it did.
  bool shorten() {
    constexpr int most_cuts = 30;
    constexpr double rounding = 1e-12;
    const double now = energy_at(b_.slip);
    double part = 1.0;
    for (int cut = 1; cut < most_cuts && !(energy_at(b_.trial) <= (1.0 + rounding) * now); ++cut) {
      increase_by(part *= 0.5);
    }
    return part < 1.0;
  }

  double energy_at(const std::vector<double>& slip) const {
    double sum = 0.0;
    for (std::size_t k = first_; k < last_; ++k) {
      sum += energy(b_.bonds, k, slip[k] - b_.bonds.plastic[k]);
      if (k + 1 < last_) sum += energy_of_bar(b_, slip, k);
    }
    return sum;
  }

  /// Fills residual and tangent at these slips. Returns whether the residual is rounding.
  bool in_balance(const std::vector<double>& slip) {
    constexpr double rounding = 1e-11;
    std::fill_n(b_.diagonal.data() + first_, last_ - first_, 0.0);
    std::fill_n(b_.right.data() + first_, last_ - first_, 0.0);
    double largest = 0.0, error = 0.0;
    for (std::size_t k = first_; k < last_; ++k) {
      const SpringResponse bond = answer(b_.bonds, k, slip[k] - b_.bonds.plastic[k]);
      b_.diagonal[k] += bond.slope;
      b_.right[k] -= bond.force;
      largest = std::max(largest, std::abs(bond.force));
      if (k + 1 < last_) {
        const BarFrame& f = b_.frame[k];
        const SpringResponse bar = answer_of_bar(b_, slip, k);
        b_.diagonal[k] += bar.slope * f.start * f.start;
        b_.diagonal[k + 1] += bar.slope * f.end * f.end;
        b_.upper[k] = -bar.slope * f.start * f.end;
        b_.right[k] += bar.force * f.start;
        b_.right[k + 1] -= bar.force * f.end;
        largest = std::max(largest, std::abs(bar.force));
      }
      if (b_.diagonal[k] == 0.0) b_.diagonal[k] = 1.0;  // connected to nothing
      error = std::max(error, std::abs(b_.right[k]));
    }
    return error <= rounding * largest;
  }

  /// Solves the tridiagonal system by elimination from the head; `diagonal` is inverted on the way.
  void find_change() {
    std::vector<double>&inverse = b_.diagonal, &change = b_.change;
    inverse[first_] = 1.0 / inverse[first_];
    change[first_] = b_.right[first_];
    for (std::size_t k = first_ + 1; k < last_; ++k) {
      const double factor = b_.upper[k - 1] * inverse[k - 1];
      inverse[k] = 1.0 / (inverse[k] - factor * b_.upper[k - 1]);
      change[k] = b_.right[k] - factor * change[k - 1];
    }
    change[last_ - 1] *= inverse[last_ - 1];
    for (std::size_t k = last_ - 1; k-- > first_;) {
      change[k] = (change[k] - b_.upper[k] * change[k + 1]) * inverse[k];
    }
  }

  Bolts& b_;
  std::size_t first_, last_;
};

/// Forces of bar k of a grouted bolt and of its dowel on the hosts of its two nodes: the gradients
/// of their elongations. e = t . g: t on the points, and (g - t (t . g))/|m| on the directions.
/// delta = t x h: its normal on the points, and -n (t . h)/|m| on the directions.
void push_hosts(Bolts& b, std::size_t k) {
  const BarFrame& f = b.frame[k];
  double axial = b.bars.force[k], across = b.dowels.force[k];
  if (axial == 0.0 && across == 0.0) return;
  if (b.hinges[k] > 0.0) {
    const Vec2 pull = link_of(b, f, k).pull({axial, across});
    axial = pull.x;
    across = pull.y;
  }
  const Vec2 n = perp(f.t);
  const Vec2 whole = f.gap + b.slip[k + 1] * f.to - b.slip[k] * f.from;
  const Vec2 turning =
      (axial / f.size) * (whole - dot(f.t, whole) * f.t) - (across * dot(f.t, f.gap) / f.size) * n;
  for (std::size_t j = 0; j < nodes_per_block; ++j) {
    b.on_host[k + 1][j] -= (b.weight[j][k + 1] + b.slip[k + 1] * b.along[j][k + 1]) * axial * f.t +
                           b.weight[j][k + 1] * across * n + b.along[j][k + 1] * turning;
    b.on_host[k][j] += (b.weight[j][k] + b.slip[k] * b.along[j][k]) * axial * f.t +
                       b.weight[j][k] * across * n - b.along[j][k] * turning;
  }
}

/// Breaks the steel where its strain, plastic and elastic over the length that stretches, reaches
/// the rupture strain.
void break_steel(Bolts& b, const BoltData& row, std::size_t k) {
  if (b.bars.stiffness[k] == 0.0 || b.bars.broken[k] != 0 || !(b.bars.force[k] > 0.0)) return;
  const bool link = row.grouted && b.crossing[k] != 0;
  const double elastic = b.bars.force[k] / row.steel;
  // The stretch by pretension at the start counts as elastic, not as yield.
  const double before = -row.pretension / b.bars.stiffness[k];
  const double yielded = b.bars.plastic[k] - before;
  const double strain = elastic + yielded / (link ? row.gauge : b.length[k]);
  if (strain < row.rupture) return;
  b.bars.broken[k] = 1;
  b.dowels.broken[k] = 1;
}

void disconnect_excavated(Bolts& b, const State& state, Id first, Id last) {
  for (std::size_t k = first; k < last; ++k) {
    const bool dead = is_cut_off(b, state, k), next = k + 1 < last && is_cut_off(b, state, k + 1);
    if (dead) b.bonds.broken[k] = 1;
    if (dead || next) b.bars.broken[k] = b.dowels.broken[k] = 1;
  }
}

Spent update_grouted(Bolts& b, const BlockSet& blocks, const State& state, std::size_t r) {
  const BoltData& row = b.rows[r];
  const Id first = b.begin[r], last = b.begin[r + 1];
  Spent spent;
  spent.increments = Chain(b, blocks, state, first, last).solve();
  for (std::size_t k = first; k < last; ++k) {
    yield_to(b.bonds, k, b.slip[k], spent);
    if (k + 1 == last) break;
    if (b.hinges[k] > 0.0) {
      yield_to(b, k, link_of(b, b.frame[k], k), spent);
      continue;
    }
    yield_to(b.bars, k, elongation(b, b.slip, k), spent);
    yield_to(b.dowels, k, offset(b.frame[k]), spent);
  }
  for (std::size_t k = first; k + 1 < last; ++k) {
    push_hosts(b, k);
    break_steel(b, row, k);
  }
  return spent;
}

/// End-anchored bolt: one bar along the distance of its ends, which goes slack rather than push.
Spent update_ends(Bolts& b, const BlockSet& blocks, const State& state, std::size_t r) {
  const Id k = b.begin[r];
  Spent spent;
  const Vec2 gap = node_place(b, blocks, state, k + 1) - node_place(b, blocks, state, k);
  const double distance = norm(gap), longer = distance - b.length[k];
  if (longer - b.bars.plastic[k] >= 0.0 || b.bars.broken[k] != 0) {
    yield_to(b.bars, k, longer, spent);
  } else {
    b.bars.force_1[k] = b.bars.force[k];
    b.bars.force[k] = 0.0;
  }
  const Vec2 pull = (b.bars.force[k] / distance) * gap;
  spread(b.on_host[k], weights_of(b.weight, k), pull);
  spread(b.on_host[k + 1], weights_of(b.weight, k + 1), -pull);
  break_steel(b, b.rows[r], k);
  return spent;
}

}  // namespace

NodeVectors carriers_at(const Bolts& b, const BlockSet& blocks, const State& state, std::size_t k) {
  if (b.zone[k] == no_id) return vectors_of(state.position, b.host[k]);
  return zone_at(blocks, state.position, b.host[k], b.zone[k]);
}

BarLink link_of(const Bolts& b, const BarFrame& f, std::size_t k) {
  return link_at(b.hinges[k], elongation(f, b.slip, k), offset(f));
}

BarFrame bar_frame(const Bolts& b, const BlockSet& blocks, const State& state, std::size_t k) {
  return frame_between(node_at(b, blocks, state, k), node_at(b, blocks, state, k + 1), b.length[k]);
}

Vec2 node_place(const Bolts& b, const BlockSet& blocks, const State& state, std::size_t k) {
  NodeWeights w;
  for (std::size_t j = 0; j < nodes_per_block; ++j) {
    w[j] = b.weight[j][k] + b.slip[k] * b.along[j][k];
  }
  return weighted(w, carriers_at(b, blocks, state, k));
}

void update_bolts(Bolts& b, const BlockSet& blocks, const State& state) {
  if (b.rows.empty()) return;
  std::vector<Spent> spent(b.rows.size());
  const auto update_row = [&](std::size_t r) {
    const Id first = b.begin[r], last = b.begin[r + 1];
    for (Id k = first; k < last; ++k) b.on_host[k] = {};
    disconnect_excavated(b, state, first, last);
    spent[r] =
        b.rows[r].grouted ? update_grouted(b, blocks, state, r) : update_ends(b, blocks, state, r);
  };
  parallel_for(b.rows.size(), update_row, 1000);
  b.slipped += b.pending_friction;
  b.fractured += b.pending_fracture;
  b.pending_friction = b.pending_fracture = b.work_pending = 0.0;
  b.most_increments = 0;
  for (const Spent& s : spent) {
    b.slipped += s.slipped;
    b.fractured += s.fractured;
    b.pending_friction += s.pending_friction;
    b.pending_fracture += s.pending_fracture;
    b.most_increments = std::max(b.most_increments, s.increments);
  }
}

void add_bolts(BlockForces& on, const Bolts& b) {
  if (b.place.empty()) return;
  const Id place = b.place[on.block];
  if (place == no_id) return;
  for (Id q = b.block_begin[place]; q < b.block_begin[place + 1]; ++q) {
    const Id k = b.block_nodes[q];
    if (b.zone[k] == no_id) {
      on.sum.nodes = on.sum.nodes + b.on_host[k];
    } else {
      on.on_zone(b.zone[k], b.on_host[k]);
    }
  }
}

double bolt_energy(const Bolts& b) {
  double sum = b.work_pending;
  for (const BoltSprings* s : {&b.bonds, &b.bars, &b.dowels}) {
    for (std::size_t k = 0; k < s->force.size(); ++k) {
      if (s->stiffness[k] > 0.0) sum += 0.5 * s->force_1[k] * s->force[k] / s->stiffness[k];
    }
  }
  return sum;
}

}  // namespace edda
