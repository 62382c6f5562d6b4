#include "flow/seepage.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace edda {
namespace {

using Kind = NodeCondition::Kind;

/// What is unknown of a node: p where it is wet, s where air enters. Discharges grow with the
/// unknown of the node they leave and fall with that of the node they enter, so that in steady flow
/// sweeps over the nodes one by one come nearer from anywhere (an M-function: Rheinboldt 1970);
/// Newton's method makes an end of it.
class SeepageSolver {
 public:
  SeepageSolver(const FlowNetwork& net, const std::vector<NodeCondition>& given, double unit_weight,
                std::vector<NodeWater>& water, const Storage* storage)
      : net_(net), given_(given), gamma_(unit_weight), water_(water), storage_(storage) {
    const std::size_t count = net.nodes.size();
    for (std::size_t n = 0; n < count; ++n) {
      if (given_[n].kind == Kind::pressure) {
        water_[n] = {given_[n].pressure, 1.0};
      } else if (given_[n].kind == Kind::air) {
        water_[n] = {0.0, 0.0};
      } else if (given_[n].kind == Kind::rain) {
        water_[n].pressure = 0.0;
      } else if (water_[n].pressure > 0.0) {
        water_[n].filled = 1.0;
      }
    }
    list_pipes();
    list_gives();
    find_inside();
    std::stable_sort(inside_.begin(), inside_.end(),
                     [&](Id a, Id b) { return net.nodes[a].place.y > net.nodes[b].place.y; });
  }

  bool solve() {
    constexpr int rounds = 8, newton_steps = 25;
    int sweeps = 20;
    constexpr double small = 2e-9;
    if (storage_ == nullptr) begin();
    for (int round = 0; round < rounds; ++round, sweeps *= 2) {
      for (int k = 0; k < newton_steps; ++k) {
        if (largest_imbalance() < small) return true;
        make_newton_step();
      }
      for (int k = 0; k < sweeps; ++k) {
        for (const Id n : inside_) balance(n);
        for (auto n = inside_.rbegin(); n != inside_.rend(); ++n) balance(*n);
      }
    }
    return largest_imbalance() < small;
  }

 private:
  struct Neighbour {
    Id node;
    double conductance;
    Id end;  ///< of the pipe, here; the other one is end ^ 1
  };

  /// No potential is above the highest one given, but where water is injected. Where nothing is
  /// known all nodes have it.
  void begin() {
    highest_ = -std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < given_.size(); ++n) {
      if (gives(n)) highest_ = std::max(highest_, potential(n));
    }
    for (const Id n : inside_) {
      if (injects(n)) highest_ = std::numeric_limits<double>::infinity();
    }
    if (std::isinf(highest_)) return;
    for (const Id n : inside_) {
      if (water_[n].pressure > 0.0 || water_[n].filled > 0.0) return;
    }
    for (const Id n : inside_) {
      if (given_[n].kind == Kind::rain) continue;
      if (const double p = most_of(n); p > 0.0) water_[n] = {p, 1.0};
    }
  }
  bool gives(std::size_t n) const {
    return given_[n].kind == Kind::pressure || given_[n].kind == Kind::rain;
  }
  bool injects(std::size_t n) const {
    return given_[n].kind == Kind::inside && given_[n].source > 0.0;
  }
  double most_of(Id n) const { return highest_ - gamma_ * net_.nodes[n].place.y; }

  /// What leaves a node, less what comes to it, and its derivatives by p and by s, m2/s.
  struct Balance {
    double net = 0.0, gross = 0.0, by_pressure = 0.0, by_filled = 0.0;
  };

  double potential(std::size_t n) const {
    return water_[n].pressure + gamma_ * net_.nodes[n].place.y;
  }

  void list_pipes() {
    begin_.assign(net_.nodes.size() + 1, 0);
    for (const FlowPipe& p : net_.pipes) {
      ++begin_[p.from + 1];
      ++begin_[p.to + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    of_node_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (Id q = 0; q < net_.pipes.size(); ++q) {
      const FlowPipe& p = net_.pipes[q];
      of_node_[next[p.from]++] = {p.to, p.conductance, 2 * q};
      of_node_[next[p.to]++] = {p.from, p.conductance, 2 * q + 1};
    }
  }

  void list_gives() {
    if (storage_ == nullptr) return;
    first_give_.assign(2 * net_.pipes.size() + 1, 0);
    for (const Storage::Give& g : storage_->gives) ++first_give_[g.end + 1];
    std::partial_sum(first_give_.begin(), first_give_.end(), first_give_.begin());
  }

  /// The nodes inside the rock that pipes connect to a given pressure, or where water is injected
  /// to the air; of those that store water all. The others are dry.
  void find_inside() {
    std::vector<std::uint8_t> connected(given_.size(), storage_ == nullptr ? 0 : 1);
    std::vector<Id> next;
    bool any_injects = false;
    for (std::size_t n = 0; n < given_.size(); ++n) any_injects = any_injects || injects(n);
    for (Id n = 0; n < given_.size(); ++n) {
      if (gives(n) || (any_injects && given_[n].kind == Kind::air)) next.push_back(n);
    }
    while (!next.empty()) {
      const Id n = next.back();
      next.pop_back();
      if (connected[n] != 0) continue;
      connected[n] = 1;
      for (std::size_t q = begin_[n]; q < begin_[n + 1]; ++q) next.push_back(of_node_[q].node);
    }
    for (Id n = 0; n < given_.size(); ++n) {
      if (given_[n].kind != Kind::inside && given_[n].kind != Kind::rain) continue;
      if (connected[n] != 0 && begin_[n + 1] > begin_[n]) {
        inside_.push_back(n);
      } else {
        water_[n] = {0.0, given_[n].kind == Kind::rain ? 1.0 : 0.0};
      }
    }
  }

  Balance balance_of(Id n) const {
    const NodeWater w = water_[n];
    Balance b;
    for (std::size_t q = begin_[n]; q < begin_[n + 1]; ++q) {
      const auto [m, conductance, end] = of_node_[q];
      const double drop = potential(n) - potential(m);
      const double conducts = drop >= 0.0 ? w.filled : water_[m].filled;
      b.net += conductance * conducts * drop;
      b.gross += conductance * conducts * std::abs(drop);
      b.by_pressure += conductance * conducts;
      if (drop > 0.0) b.by_filled += conductance * drop;
    }
    b.net -= given_[n].source;
    b.gross += given_[n].source;
    if (storage_ != nullptr) store(n, b);
    return b;
  }

  /// Of the time that passes, with what the node stores: m2.
  void store(Id n, Balance& b) const {
    for (double* value : {&b.net, &b.by_pressure, &b.by_filled}) *value *= storage_->passed;
    if (!stores(n)) return;
    double volume = 0.0, drawn = 0.0;
    for (std::size_t q = begin_[n]; q < begin_[n + 1]; ++q) {
      const auto [m, conductance, end] = of_node_[q];
      volume += volume_at(net_.pipes[end / 2], aperture_[end].value(), aperture_[end ^ 1].value());
      drawn += drawn_in(end) * water_[m].filled;
    }
    b.net += volume * part_of(n) + drawn * water_[n].filled - storage_->content[n];
    b.by_pressure += volume / storage_->bulk_modulus;
    b.by_filled += volume + drawn;
    for_growth(n, [&](Id node, double growth) {
      if (node == n) b.by_pressure += growth;
    });
  }
  /// drawn_to() the node at this end, of a pipe that water fills.
  double drawn_in(Id end) const {
    const auto opening = [&](Id e) { return aperture_[e].value() - storage_->before[e]; };
    const Id a = end & ~Id{1};
    const double to = drawn_to(net_.pipes[end / 2], {opening(a), opening(a + 1)});
    return end == a ? -to : to;
  }
  double part_of(Id n) const { return water_[n].content(storage_->bulk_modulus); }
  /// Rain is on the ground, which stores none.
  bool stores(Id n) const { return storage_ != nullptr && given_[n].kind != Kind::rain; }
  /// Finds the apertures of both ends of a pipe under the pressures as they are.
  void find_apertures(Id pipe) {
    for (const Id end : {2 * pipe, 2 * pipe + 1}) {
      aperture_[end] = net_.pipes[pipe].aperture[end % 2];
      for (std::size_t q = first_give_[end]; q < first_give_[end + 1]; ++q) {
        const Storage::Give& g = storage_->gives[q];
        aperture_[end].walls += g.compliance * (water_[g.node].pressure - storage_->acting[g.node]);
      }
    }
  }
  void find_apertures() {
    if (storage_ == nullptr) return;
    aperture_.resize(2 * net_.pipes.size());
    for (Id q = 0; q < net_.pipes.size(); ++q) find_apertures(q);
  }
  /// Calls f(node, m2/Pa): how what n stores grows with the pressure at the node as walls part;
  /// more than once for some.
  template <class F>
  void for_growth(Id n, const F& f) const {
    for (std::size_t q = begin_[n]; q < begin_[n + 1]; ++q) {
      const auto [m, conductance, here] = of_node_[q];
      const FlowPipe& pipe = net_.pipes[here / 2];
      const double both = (here % 2 == 0 ? -1.0 : 1.0) * water_[n].filled * water_[m].filled;
      for (const Id end : {here, here ^ 1}) {
        const Aperture now = aperture_[end];
        if (now.walls < now.least || now.walls > now.largest) continue;
        const double at_a = end % 2 == 0 ? 1.0 : 0.0, at_here = end == here ? 1.0 : 0.0;
        const double weight = part_of(n) * volume_at(pipe, at_here, 1.0 - at_here) +
                              both * drawn_to(pipe, {at_a, 1.0 - at_a});
        for (std::size_t k = first_give_[end]; k < first_give_[end + 1]; ++k)
          f(storage_->gives[k].node, weight * storage_->gives[k].compliance);
      }
    }
  }

  /// As a part of what flows through the node, or of what it stores as its unknown grows.
  double largest_imbalance() {
    find_apertures();
    double largest = 0.0;
    for (const Id n : inside_) {
      const Balance b = balance_of(n);
      if (runs_off(n, b.net)) continue;
      const double least = 1e-3 * gamma_;  // Pa: 1 mm of head
      double whole = std::max(b.gross, least * net_.nodes[n].conductance);
      if (storage_ != nullptr) {
        constexpr double rounding = 1e-6;  // of what is stored, by `small` of solve()
        whole = is_wet(n, b.net)
                    ? b.by_pressure * (water_[n].pressure + least) + rounding * storage_->content[n]
                    : b.by_filled;
      }
      if (whole > 0.0) {
        largest = std::max(largest, std::abs(b.net) / whole);
      } else if (storage_ != nullptr && b.net < 0.0) {
        largest = std::max(largest, 1.0);  // more than it can hold
      }
    }
    return largest;
  }

  /// Whether more rain falls than the joint takes in.
  bool runs_off(Id n, double net) const {
    return given_[n].kind == Kind::rain && water_[n].filled >= 1.0 && net < 0.0;
  }
  /// Whether the unknown of the node is its pressure.
  bool is_wet(Id n, double net) const {
    if (given_[n].kind == Kind::rain) return false;
    return water_[n].pressure > 0.0 || (water_[n].filled >= 1.0 && net <= 0.0);
  }

  /// The node at balance with its neighbours as they are: its discharge grows piece by piece.
  void balance(Id n) {
    constexpr int most = 30;
    for (int k = 0; k < most; ++k) {
      for (std::size_t q = begin_[n]; q < begin_[n + 1] && storage_ != nullptr; ++q)
        find_apertures(of_node_[q].end / 2);
      const Balance b = balance_of(n);
      const bool wet = is_wet(n, b.net);
      const double slope = wet ? b.by_pressure : b.by_filled;
      if (!(slope > 0.0)) {
        if (!wet && b.net < 0.0) water_[n].filled = 1.0;  // water that cannot leave
        if (!wet && b.net >= 0.0) water_[n].filled = 0.0;
        return;
      }
      const double more = -b.net / slope;
      if (!move(n, wet, more)) return;
    }
  }

  /// Changes the unknown of a node, up to where the other begins. Returns whether it is there now.
  bool move(Id n, bool wet, double more) {
    NodeWater& w = water_[n];
    if (wet) {
      const double before = w.pressure;
      w.pressure = std::max(0.0, std::min(w.pressure + more, most_of(n)));
      return w.pressure != before &&
             (w.pressure == 0.0 || std::abs(more) > 1e-13 * (gamma_ + w.pressure));
    }
    const double before = w.filled;
    w.filled = std::clamp(w.filled + more, 0.0, 1.0);
    return w.filled == 1.0 && before != 1.0;
  }

  void make_newton_step() {
    std::vector<Id> row(net_.nodes.size(), no_id);
    for (std::size_t k = 0; k < inside_.size(); ++k) row[inside_[k]] = static_cast<Id>(k);
    const auto rows = static_cast<Eigen::Index>(inside_.size());
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<std::uint8_t> wet(inside_.size()), full(inside_.size());  // full: of rain
    Eigen::VectorXd right(rows);
    const double time = storage_ == nullptr ? 1.0 : storage_->passed;
    const auto add = [&](std::size_t k, std::size_t column, double value) {
      entries.emplace_back(static_cast<int>(k), static_cast<int>(column), value);
    };
    for (std::size_t k = 0; k < inside_.size(); ++k) {
      const Balance b = balance_of(inside_[k]);
      wet[k] = is_wet(inside_[k], b.net) ? 1 : 0;
      const double own = wet[k] != 0 ? b.by_pressure : b.by_filled;
      if (runs_off(inside_[k], b.net) || !(own > 0.0)) {
        if (wet[k] == 0 && b.net < 0.0) water_[inside_[k]].filled = 1.0;  // more than it can hold
        full[k] = 1;
        add(k, k, 1.0);
        right[static_cast<Eigen::Index>(k)] = 0.0;
        continue;
      }
      right[static_cast<Eigen::Index>(k)] = -b.net;
      // What is cut off stays as it is.
      constexpr double cut_off = 1e-14;
      const double conductance = net_.nodes[inside_[k]].conductance * time;
      add(k, k,
          wet[k] != 0 ? b.by_pressure + cut_off * conductance
                      : b.by_filled + cut_off * gamma_ * conductance);
    }
    for (std::size_t k = 0; k < inside_.size(); ++k) {
      const Id n = inside_[k];
      if (full[k] != 0) continue;
      for (std::size_t q = begin_[n]; q < begin_[n + 1]; ++q) {
        const auto [m, conductance, end] = of_node_[q];
        if (row[m] == no_id || full[row[m]] != 0) continue;
        const double drop = potential(n) - potential(m);
        const bool leaves = drop >= 0.0;
        if (wet[row[m]] != 0) {
          add(k, row[m], -time * conductance * (leaves ? water_[n].filled : water_[m].filled));
        } else {
          if (!leaves) add(k, row[m], time * conductance * drop);
          if (stores(n)) add(k, row[m], drawn_in(end) * water_[n].filled);
        }
      }
      if (!stores(n)) continue;
      for_growth(n, [&](Id m, double growth) {
        if (m != n && row[m] != no_id && wet[row[m]] != 0) add(k, row[m], growth);
      });
    }
    if (rows == 0) return;
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return;
    const Eigen::VectorXd more = factor.solve(right);
    for (std::size_t k = 0; k < inside_.size(); ++k)
      move(inside_[k], wet[k] != 0, more[static_cast<Eigen::Index>(k)]);
  }

  const FlowNetwork& net_;
  const std::vector<NodeCondition>& given_;
  double gamma_;
  std::vector<NodeWater>& water_;
  const Storage* storage_;  // null: the flow is steady
  std::vector<std::size_t> begin_, first_give_;
  std::vector<Aperture> aperture_;  // [2 pipes] as Storage::Give::end
  std::vector<Neighbour> of_node_;
  std::vector<Id> inside_;                                    // from the highest to the lowest
  double highest_ = std::numeric_limits<double>::infinity();  // potential, Pa
};

/// The node of higher potential of a pipe, and the other one.
struct Ends {
  std::size_t high, low;
  double drop;  // of the potential, Pa
};
Ends ends_of(const FlowNetwork& net, const FlowPipe& pipe, double gamma,
             const std::vector<NodeWater>& water) {
  const auto potential = [&](Id n) { return water[n].pressure + gamma * net.nodes[n].place.y; };
  const double drop = potential(pipe.from) - potential(pipe.to);
  return drop >= 0.0 ? Ends{pipe.from, pipe.to, drop} : Ends{pipe.to, pipe.from, -drop};
}

}  // namespace

bool solve_seepage(const FlowNetwork& network, const std::vector<NodeCondition>& given,
                   double unit_weight, std::vector<NodeWater>& water, const Storage* storage) {
  return SeepageSolver(network, given, unit_weight, water, storage).solve();
}

double discharge_of(const FlowNetwork& network, const FlowPipe& pipe, double unit_weight,
                    const std::vector<NodeWater>& water) {
  const Ends ends = ends_of(network, pipe, unit_weight, water);
  const double q = water[ends.high].filled * pipe.conductance * ends.drop;
  return ends.high == pipe.from ? q : -q;
}

PipeLevels levels_of(const FlowNetwork& network, const FlowPipe& pipe, double unit_weight,
                     const std::vector<NodeWater>& water) {
  const Ends ends = ends_of(network, pipe, unit_weight, water);
  const double low = network.nodes[ends.low].place.y + water[ends.low].pressure / unit_weight;
  const double high = low + water[ends.high].filled * ends.drop / unit_weight;
  return ends.high == pipe.from ? PipeLevels{high, low} : PipeLevels{low, high};
}

}  // namespace edda
