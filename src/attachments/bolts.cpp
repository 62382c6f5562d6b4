#include "attachments/bolts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/polygon.hpp"
#include "model/stage_names.hpp"

namespace edda {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A part of a bolt within one block, m from its head.
struct BoltSegment {
  double from, to;
  Id block;
};

struct Outlines {
  const BlockSet& b;
  const std::vector<double>&x, &y;

  Vec2 at(Id v) const { return {x[v], y[v]}; }
};

/// Counts the crossings of a ray to the right.
bool is_inside(const Outlines& o, Id i, Vec2 p) {
  bool inside = false;
  for (Id v = o.b.vertex_begin[i]; v < o.b.vertex_begin[i + 1]; ++v) {
    const Vec2 a = o.at(v), c = o.at(o.b.next[v]);
    if ((a.y > p.y) == (c.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (c.y - a.y) * (c.x - a.x)) inside = !inside;
  }
  return inside;
}

/// The parts of the line from `head` along `t` that lie in block i.
void add_stays(const Outlines& o, Id i, Vec2 head, Vec2 t, double length,
               std::vector<BoltSegment>& stays) {
  std::vector<double> cuts{0.0, length};
  for (Id v = o.b.vertex_begin[i]; v < o.b.vertex_begin[i + 1]; ++v) {
    const Vec2 a = o.at(v) - head, u = o.at(o.b.next[v]) - o.at(v);
    const double slope = cross(t, u);
    if (slope == 0.0) continue;
    const double along_edge = cross(a, t) / slope;
    if (along_edge < -1e-9 || along_edge > 1.0 + 1e-9) continue;
    cuts.push_back(std::clamp(cross(a, u) / slope, 0.0, length));
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    if (!(cuts[k] > cuts[k - 1])) continue;
    if (is_inside(o, i, head + 0.5 * (cuts[k - 1] + cuts[k]) * t))
      stays.push_back({cuts[k - 1], cuts[k], i});
  }
}

/// All blocks that the bolt passes through, in order and without overlap; adjoining parts within
/// one block are joined.
std::vector<BoltSegment> segments_of(const Outlines& o, const State& state, Vec2 head, Vec2 t,
                                     double length) {
  std::vector<BoltSegment> stays, clean;
  for (Id i = 0; i < o.b.size(); ++i) {
    if (state.alive[i] == 0) continue;
    const Vec2 arm = centroid(state.position, i) - head;
    const double reach = 1.1 * o.b.radius[i];
    if (dot(arm, t) < -reach || dot(arm, t) > length + reach || std::abs(cross(arm, t)) > reach)
      continue;
    add_stays(o, i, head, t, length, stays);
  }
  std::sort(stays.begin(), stays.end(), [](const BoltSegment& p, const BoltSegment& q) {
    return p.from != q.from ? p.from < q.from : p.block < q.block;
  });
  const double least = 1e-6 * length;
  for (BoltSegment s : stays) {
    if (!clean.empty()) s.from = std::max(s.from, clean.back().to);
    if (s.to - s.from <= least) continue;
    if (!clean.empty() && clean.back().block == s.block && s.from - clean.back().to <= least) {
      clean.back().to = s.to;
    } else {
      clean.push_back(s);
    }
  }
  return clean;
}

BoltData data_of(const Bolt& bolt, std::size_t number, double thickness) {
  BoltData d;
  d.name = bolt.name.empty() ? std::to_string(number) : bolt.name;
  d.row = static_cast<Index>(number);
  d.grouted = bolt.type == BoltType::grouted;
  d.share = thickness / bolt.spacing;
  const double area = 0.25 * std::numbers::pi * bolt.diameter * bolt.diameter;
  d.steel = d.share * bolt.young * area;
  d.yield = bolt.yield_stress ? d.share * *bolt.yield_stress * area : never;
  d.rupture = bolt.rupture_strain.value_or(never);
  constexpr double gauge_over_diameter = 10.0;
  d.gauge = gauge_over_diameter * bolt.diameter;
  d.pretension = d.share * bolt.pretension;
  d.bond = d.share * bolt.bond.stiffness;
  d.bond_strength = d.share * bolt.bond.strength;
  if (bolt.dowel) {
    d.dowel = d.share * bolt.dowel->stiffness.value_or(0.0);
    d.dowel_strength = d.share * bolt.dowel->strength.value_or(0.0);
  }
  return d;
}

void add_spring(BoltSprings& s, double stiffness, double strength) {
  s.stiffness.push_back(stiffness);
  s.strength.push_back(strength);
  s.plastic.push_back(0.0);
  s.force.push_back(0.0);
  s.force_1.push_back(0.0);
  s.yielded.push_back(0);
  s.broken.push_back(0);
}

/// For the bolt of a pattern the place is the table, since a pattern gives no ends.
Where at_key(const Bolt& bolt, const char* key) {
  Where where = bolt.where;
  if (where.key.starts_with("bolt.")) where.key += key;
  return where;
}

/// Builds one bolt after the other.
class Builder {
 public:
  Builder(const Model& model, const Outlines& outlines, const State& state, double slack)
      : model_(model), o_(outlines), state_(state), slack_(slack) {
    bolts.begin.push_back(0);
  }

  std::optional<Fault> add(const Bolt& bolt, const BoltData& data) {
    const Vec2 head = bolt.from - o_.b.origin, whole = bolt.to - bolt.from;
    const double length = norm(whole);
    const Vec2 t = whole / length;
    const std::vector<BoltSegment> stays = segments_of(o_, state_, head, t, length);
    const bool any_free = std::any_of(
        stays.begin(), stays.end(), [&](const BoltSegment& s) { return o_.b.fixed[s.block] == 0; });
    if (!any_free) {
      return Fault{at_key(bolt, ".from"), "bolt " + data.name + " goes through no free block",
                   "move it into the rock (edda cut draws the blocks)"};
    }
    if (data.grouted) {
      const bool of_bar = bolt.dowel && bolt.dowel->of_bar();
      if (of_bar) {
        if (auto fault = find_foundations(bolt, data, stays)) return fault;
      }
      add_grouted(data, stays, head, t, length);
      if (of_bar) set_links(bolt, data, bolts.begin.back());
    } else {
      const double near = slack_ * length;
      const bool ends = stays.front().from <= near && stays.back().to >= length - near;
      if (!ends) {
        return Fault{at_key(bolt, ".to"), "an end of bolt " + data.name + " lies in no block",
                     "let both ends of an end-anchored bolt lie in blocks, or on their faces"};
      }
      add_node(stays.front().block, head, t, 0.0, 0.0, data);
      add_node(stays.back().block, head + length * t, t, length, 0.0, data);
      set_bar(bolts.size() - 2, length, length, data);
    }
    bolts.rows.push_back(data);
    bolts.begin.push_back(static_cast<Id>(bolts.size()));
    return {};
  }

  Bolts bolts;

 private:
  /// Spaces the nodes a fifth of the shear lag 1/lambda = sqrt(EA/K) apart.
  void add_grouted(const BoltData& data, const std::vector<BoltSegment>& stays, Vec2 head, Vec2 t,
                   double length) {
    constexpr double part = 0.2, most = 1000.0, link = 0.01;
    const double lag = std::sqrt(data.steel / data.bond);
    const double wanted = std::max(std::min(part * lag, 0.1 * length), length / most);
    std::size_t last = no_node;
    double last_piece = 0.0;
    for (const BoltSegment& s : stays) {
      const double long_ = s.to - s.from, pieces = std::max(2.0, std::ceil(long_ / wanted));
      const double piece = long_ / pieces;
      for (int q = 0; q <= static_cast<int>(pieces); ++q) {
        const bool end = q == 0 || q == static_cast<int>(pieces);
        const double at = s.from + q * piece;
        const std::size_t k =
            add_node(s.block, head + at * t, t, at, end ? 0.5 * piece : piece, data);
        if (q > 0) {
          set_bar(k - 1, piece, piece, data);
        } else if (last != no_node) {
          // Where blocks meet: a bar so short that only its yield matters.
          const double gap = at - bolts.distance[last];
          const double stretches = std::max(gap, link * std::min(piece, last_piece));
          set_bar(last, gap, stretches, data);
          bolts.crossing[last] = 1;
          if (bolts.host[last] != s.block) {
            bolts.dowels.stiffness[last] = data.dowel;
            bolts.dowels.strength[last] = data.dowel_strength;
          }
        }
        last = k;
      }
      last_piece = piece;
    }
  }

  const Material& rock_of(Id i) const {
    return model_.materials[static_cast<std::size_t>(o_.b.material[i])];
  }

  static std::optional<double> bearing_strength(const Bolt& bolt, const Material& rock) {
    if (bolt.dowel->bearing_strength) return bolt.dowel->bearing_strength;
    if (rock.strength) return rock.strength->ucs;
    return rock.yield ? rock.yield->peak.ucs : std::nullopt;
  }

  /// It is a fault if rock that a bolt goes through has no strength in which it could be bedded.
  std::optional<Fault> find_foundations(const Bolt& bolt, const BoltData& data,
                                        const std::vector<BoltSegment>& stays) const {
    for (const BoltSegment& s : stays) {
      const Material& rock = rock_of(s.block);
      if (bearing_strength(bolt, rock)) continue;
      return Fault{at_key(bolt, ".dowel.bearing_strength"),
                   "is missing: bolt " + data.name + " goes through \"" + rock.name +
                       "\", of which no ucs is known",
                   "give the dowel a bearing_strength, or that material strength = { ucs = ..., "
                   "tension = ... }"};
    }
    return {};
  }

  /// Of a bolt whose nodes begin at `first`: makes every bar from block to block a link.
  void set_links(const Bolt& bolt, const BoltData& data, std::size_t first) {
    const auto foundation = [&](std::size_t k) {
      const Material& rock = rock_of(bolts.host[k]);
      return Foundation{bolt.dowel->foundation_modulus.value_or(rock.young),
                        bearing_strength(bolt, rock).value_or(0.0)};
    };
    const DowelBar bar{bolt.diameter, bolt.young, bolt.yield_stress.value_or(0.0)};
    for (std::size_t k = first; k + 1 < bolts.size(); ++k) {
      if (bolts.crossing[k] == 0 || bolts.host[k] == bolts.host[k + 1]) continue;
      const DowelAction dowel =
          dowel_action(bar, foundation(k), foundation(k + 1), bolts.length[k]);
      bolts.hinges[k] = dowel.hinges;
      bolts.dowels.stiffness[k] = data.share * dowel.stiffness;
      bolts.dowels.strength[k] = data.share * dowel.strength;
    }
  }

  std::size_t add_node(Id i, Vec2 p, Vec2 t, double distance, double bonded, const BoltData& data) {
    // The material point now at p, and the material direction that is now t.
    const auto [zone, gradient, at] = carriers(i, p);
    const Deformation f = gradient_of(gradient, at);
    const double det = f.xx * f.yy - f.xy * f.yx;
    const auto back = [&](Vec2 v) {
      return Vec2{(f.yy * v.x - f.xy * v.y) / det, (f.xx * v.y - f.yx * v.x) / det};
    };
    const Vec2 arm = back(p - resultant(at) / nodes_per_block), a = back(t);
    for (std::size_t j = 0; j < nodes_per_block; ++j) {
      bolts.weight[j].push_back(centroid_weights[j] + dot(gradient[j], arm));
      bolts.along[j].push_back(dot(gradient[j], a));
    }
    bolts.host.push_back(i);
    bolts.zone.push_back(zone);
    bolts.distance.push_back(distance);
    bolts.bonded.push_back(bonded);
    bolts.length.push_back(0.0);
    bolts.crossing.push_back(0);
    bolts.hinges.push_back(0.0);
    bolts.slip.push_back(0.0);
    add_spring(bolts.bonds, data.grouted ? bonded * data.bond : 0.0, bonded * data.bond_strength);
    add_spring(bolts.bars, 0.0, data.yield);
    add_spring(bolts.dowels, 0.0, 0.0);
    return bolts.size() - 1;
  }

  /// The three points that carry what is now at p in block i, and the gradients of the area
  /// coordinates in them at the start.
  struct Carriers {
    Id zone;
    NodeVectors gradient, at;
  };
  Carriers carriers(Id i, Vec2 p) const {
    const BlockSet& b = o_.b;
    const Meshes& m = b.meshes;
    if (!b.is_meshed(i))
      return {no_id, vectors_of(b.grad_x, b.grad_y, i), vectors_of(state_.position, i)};
    std::vector<Vec2> node;
    for (std::size_t j = m.begin[i]; j < m.begin[i + 1]; ++j)
      node.push_back(mesh_node_at(b, state_.position, i, j));
    const std::size_t zone = in_its_zone(m, i, node, p).zone;
    const auto arm = [&](std::size_t k) {
      return Vec2{m.arm_x[m.zone[zone][k]], m.arm_y[m.zone[zone][k]]};
    };
    return {static_cast<Id>(zone), area_gradients(arm(0), arm(1), arm(2)),
            zone_at(b, state_.position, i, zone)};
  }

  void set_bar(std::size_t k, double length, double stretches, const BoltData& data) {
    bolts.length[k] = length;
    bolts.bars.stiffness[k] = data.steel / stretches;
    bolts.bars.plastic[k] = -data.pretension / bolts.bars.stiffness[k];
  }

  static constexpr std::size_t no_node = static_cast<std::size_t>(-1);
  const Model& model_;
  const Outlines& o_;
  const State& state_;
  double slack_;
};

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

void append(BoltSprings& s, const BoltSprings& more) {
  for (auto of : {&BoltSprings::stiffness, &BoltSprings::strength, &BoltSprings::plastic,
                  &BoltSprings::force, &BoltSprings::force_1}) {
    append(s.*of, more.*of);
  }
  append(s.yielded, more.yielded);
  append(s.broken, more.broken);
}

void list_by_block(Bolts& bolts, std::size_t blocks) {
  bolts.place.assign(blocks, no_id);
  bolts.block_begin.clear();
  bolts.block_nodes.clear();
  std::vector<std::vector<Id>> nodes(blocks);
  for (Id k = 0; k < bolts.size(); ++k) nodes[bolts.host[k]].push_back(k);
  for (std::size_t i = 0; i < blocks; ++i) {
    if (nodes[i].empty()) continue;
    bolts.place[i] = static_cast<Id>(bolts.block_begin.size());
    bolts.block_begin.push_back(static_cast<Id>(bolts.block_nodes.size()));
    bolts.block_nodes.insert(bolts.block_nodes.end(), nodes[i].begin(), nodes[i].end());
  }
  bolts.block_begin.push_back(static_cast<Id>(bolts.block_nodes.size()));
}

}  // namespace

std::vector<Bolt> all_bolts(const Model& model) {
  std::vector<Bolt> bolts = model.bolts;
  for (const BoltPattern& pattern : model.bolt_patterns) {
    const auto named = [&](const Opening& q) { return q.name == pattern.opening; };
    const auto opening = std::find_if(model.openings.begin(), model.openings.end(), named);
    if (opening == model.openings.end()) continue;
    const Ring& ring = opening->polygon;
    const Vec2 middle = moments(std::span<const Ring>(&ring, 1)).centroid;
    const double sweep = pattern.to_angle - pattern.from_angle;
    const bool round = std::abs(std::remainder(sweep, 360.0)) < 1e-9 && std::abs(sweep) > 1.0;
    const int gaps = round ? pattern.count : std::max(1, pattern.count - 1);
    for (int q = 0; q < pattern.count; ++q) {
      const double angle = (pattern.from_angle + sweep * q / gaps) * std::numbers::pi / 180.0;
      const Vec2 t{std::cos(angle), std::sin(angle)};
      double out = 0.0;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k] - middle, u = ring[(k + 1) % ring.size()] - ring[k];
        const double slope = cross(t, u);
        if (slope == 0.0) continue;
        const double on_edge = cross(a, t) / slope;
        if (on_edge >= -1e-9 && on_edge <= 1.0 + 1e-9) out = std::max(out, cross(a, u) / slope);
      }
      Bolt bolt = pattern.bolt;
      bolt.name = pattern.name.empty() ? "" : pattern.name + "." + std::to_string(q);
      bolt.where = pattern.where;
      bolt.from = middle + out * t;
      bolt.to = middle + (out + pattern.length) * t;
      bolts.push_back(bolt);
    }
  }
  return bolts;
}

Result<Bolts> attach_bolts(const Model& model, const BlockSet& b, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<Index>& which, double slack) {
  const std::vector<Bolt> all = all_bolts(model);
  if (which.empty()) return Bolts{};
  const Outlines outlines{b, x, y};
  Builder builder(model, outlines, state, slack);
  Faults faults;
  for (const Index row : which) {
    const auto q = static_cast<std::size_t>(row);
    if (auto fault = builder.add(all[q], data_of(all[q], q, b.thickness))) faults.push_back(*fault);
  }
  if (!faults.empty()) return faults;
  Bolts bolts = std::move(builder.bolts);
  complete_bolts(bolts, model, b.size());
  update_bolts(bolts, b, state);
  // Slip while the pretension reaches equilibrium is not part of the run.
  bolts.slipped = bolts.fractured = bolts.pending_friction = bolts.pending_fracture =
      bolts.work_pending = 0.0;
  for (BoltSprings* s : {&bolts.bonds, &bolts.bars, &bolts.dowels}) s->force_1 = s->force;
  return bolts;
}

Result<Bolts> attach_bolts(const Model& model, const BlockSet& b, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double as_drawn = 1e-6;
  std::vector<Index> all, later;
  for (std::size_t q = 0; q < all_bolts(model).size(); ++q) all.push_back(static_cast<Index>(q));
  for (const Stage& stage : model.stages) append(later, bolts_called(model, stage.install));
  Result<Bolts> found = attach_bolts(model, b, state, x, y, all, as_drawn);
  if (later.empty() || !found.ok()) return found;
  std::vector<Index> now;
  for (const Index q : all) {
    if (std::find(later.begin(), later.end(), q) == later.end()) now.push_back(q);
  }
  return attach_bolts(model, b, state, x, y, now, as_drawn);
}

void complete_bolts(Bolts& bolts, const Model& model, std::size_t blocks) {
  const std::vector<Bolt> all = all_bolts(model);
  for (BoltData& row : bolts.rows) {
    const auto q = static_cast<std::size_t>(row.row);
    row = data_of(all[q], q, model.thickness);
  }
  list_by_block(bolts, blocks);
  bolts.on_host.resize(bolts.size());
  bolts.frame.resize(bolts.size());
  for (auto* scratch : {&bolts.trial, &bolts.diagonal, &bolts.upper, &bolts.right, &bolts.change}) {
    scratch->resize(bolts.size());
  }
}

void add_bolts(Bolts& bolts, const Bolts& more, const Model& model, std::size_t blocks) {
  const auto before = static_cast<Id>(bolts.size());
  if (bolts.begin.empty()) bolts.begin.push_back(0);
  append(bolts.rows, more.rows);
  for (std::size_t r = 1; r < more.begin.size(); ++r) bolts.begin.push_back(before + more.begin[r]);
  append(bolts.host, more.host);
  append(bolts.zone, more.zone);
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    append(bolts.weight[k], more.weight[k]);
    append(bolts.along[k], more.along[k]);
  }
  append(bolts.distance, more.distance);
  append(bolts.bonded, more.bonded);
  append(bolts.length, more.length);
  append(bolts.crossing, more.crossing);
  append(bolts.hinges, more.hinges);
  append(bolts.slip, more.slip);
  append(bolts.bonds, more.bonds);
  append(bolts.bars, more.bars);
  append(bolts.dowels, more.dowels);
  append(bolts.on_host, more.on_host);
  complete_bolts(bolts, model, blocks);
}

}  // namespace edda
