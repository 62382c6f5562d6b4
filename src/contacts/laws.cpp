#include "contacts/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

namespace edda {
namespace {

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

/// Adds the slip-dependent part of the law.
void add_slip(const JointLaw& j, Law& law) {
  law.type = j.type;
  law.changes = j.type == LawType::slip_weakening || j.type == LawType::barton_bandis ||
                j.dilation_angle.value_or(0.0) > 0.0;
  law.slip_distance = j.slip_distance.value_or(std::numeric_limits<double>::infinity());
  law.dilation = tangent(j.dilation_angle.value_or(0.0));
  law.jrc = j.jrc.value_or(0.0);
  law.jcs = j.jcs.value_or(0.0);
  law.residual_angle = j.residual_angle.value_or(0.0);
}

/// Adds its fracture energies, by the opening and the slip at which they are spent.
void add_fracture(const JointLaw& j, Law& law) {
  law.softens = j.fracture_energy && j.shear_fracture_energy;
  if (!law.softens) return;
  law.crack_opening = 2.0 * *j.fracture_energy / j.peak.tensile_strength;
  law.crack_slip = 2.0 * *j.shear_fracture_energy / j.peak.cohesion;
}

void add_pair(std::vector<LawTable::Pair>& pairs, const Index (&between)[2], Index law) {
  if (between[0] == none || law == none) return;
  pairs.push_back({std::minmax(between[0], between[1]), static_cast<std::uint16_t>(law)});
}

/// The law of a pair, or none.
Index law_of(const std::vector<LawTable::Pair>& pairs, Index a, Index b) {
  const std::pair<Index, Index> between = std::minmax(a, b);
  const auto found = std::lower_bound(
      pairs.begin(), pairs.end(), between,
      [](const LawTable::Pair& p, const std::pair<Index, Index>& x) { return p.between < x; });
  return found != pairs.end() && found->between == between ? found->law : none;
}

void lose_strength(const JointLaw& j, double time, Law& law) {
  if (!j.decay_time) return;
  const double left = std::exp(-time / *j.decay_time);
  const auto lose = [&](double& peak, double residual) { peak = std::lerp(residual, peak, left); };
  lose(law.peak_friction, law.residual_friction);
  lose(law.peak_cohesion, law.residual_cohesion);
  lose(law.peak_tension, law.residual_tension);
}

constexpr double Law::*changing[] = {
    &Law::peak_friction,     &Law::peak_cohesion,    &Law::peak_tension, &Law::residual_friction,
    &Law::residual_cohesion, &Law::residual_tension, &Law::kn,           &Law::ks};

/// Brings the laws to where they have come in time. Those from which others change come before
/// these.
void make_progress(const Model& model, const LawProgress& progress, std::vector<Law>& rows) {
  const auto at = [](const std::vector<double>& values, std::size_t r) {
    return values.empty() ? 0.0 : values[r];
  };
  for (std::size_t r = 0; r < model.joints.size(); ++r) {
    const JointLaw& j = model.joints[r];
    lose_strength(j, progress.time - (j.change ? at(progress.since, r) : 0.0), rows[r]);
    if (!j.change || j.change->from == none) continue;
    const Law& from = rows[static_cast<std::size_t>(j.change->from)];
    rows[r].loses_peak = may_weaken(from) || may_weaken(rows[r]);
    for (const auto value : changing)
      rows[r].*value = std::lerp(from.*value, rows[r].*value, at(progress.part, r));
  }
}

/// LawTable::rank; a law that changes is as strong as the weaker one of the two.
std::vector<std::uint16_t> ranks(const Model& model) {
  using Key = std::tuple<bool, double, double, double, std::string, std::size_t>;
  std::vector<Key> keys;
  for (std::size_t r = 0; r < model.joints.size(); ++r) {
    const JointLaw& j = model.joints[r];
    // A glued joint is the strongest of all.
    Key own{j.type == LawType::glued,
            j.peak.friction_angle,
            j.peak.cohesion,
            j.peak.tensile_strength,
            j.name,
            r};
    if (j.change && j.change->from != none) {
      own = std::min(own, keys[static_cast<std::size_t>(j.change->from)]);
      std::get<std::size_t>(own) = r;
    }
    keys.push_back(std::move(own));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint16_t> rank(keys.size());
  for (std::size_t place = 0; place < keys.size(); ++place)
    rank[std::get<std::size_t>(keys[place])] = static_cast<std::uint16_t>(place);
  return rank;
}

/// LawTable::named of the laws of the model.
std::vector<std::uint16_t> named_laws(const Model& model) {
  std::vector<std::uint16_t> named;
  for (std::size_t r = 0; r < model.joints.size(); ++r) {
    const auto& change = model.joints[r].change;
    named.push_back(static_cast<std::uint16_t>(change ? static_cast<std::size_t>(change->to) : r));
  }
  return named;
}

}  // namespace

LawTable build_laws(const Model& model, const LawProgress& progress) {
  LawTable table;
  table.penalty = contact_springs(model);
  table.thickness = model.thickness;
  table.default_law = model.contact.joint;
  table.progress = progress;
  for (const JointLaw& j : model.joints) {
    table.rows.push_back({tangent(j.peak.friction_angle), j.peak.cohesion, j.peak.tensile_strength,
                          tangent(j.residual.friction_angle), j.residual.cohesion,
                          j.residual.tensile_strength, j.kn.value_or(0.0),
                          j.ks.value_or(0.4 * j.kn.value_or(0.0)), j.type == LawType::glued});
    add_slip(j, table.rows.back());
    add_fracture(j, table.rows.back());
    if (j.dashpots) {
      Law& law = table.rows.back();
      law.dashpots = table.any_dashpots = true;
      law.damping = j.dashpots->damping;
      law.shear_damping = j.dashpots->shear_damping;
      law.spring = j.dashpots->spring;
      law.rebound = j.dashpots->rebound;
    }
    table.any_changes = table.any_changes || table.rows.back().changes;
    table.any_softens = table.any_softens || table.rows.back().softens;
    table.rows.back().loses_peak = j.decay_time && may_weaken(table.rows.back());
  }
  make_progress(model, progress, table.rows);
  table.rank = ranks(model);
  table.named = named_laws(model);
  for (const ContactPair& pair : model.pairs) {
    add_pair(table.joint_pairs, pair.joints, pair.joint);
    add_pair(table.material_pairs, pair.materials, pair.joint);
  }
  for (auto* pairs : {&table.joint_pairs, &table.material_pairs}) {
    std::sort(pairs->begin(), pairs->end(), [](const LawTable::Pair& a, const LawTable::Pair& b) {
      return a.between < b.between;
    });
  }
  table.rows.push_back({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, true});
  table.rank.push_back(static_cast<std::uint16_t>(table.rank.size()));
  table.named.push_back(static_cast<std::uint16_t>(table.named.size()));
  table.divided_by.assign(table.rows.size(), 1.0);
  return table;
}

namespace {

constexpr double most_of_smaller = 4.0;

/// Stiffness of a penalty, N/m per m: from the blocks behind the face where `over_young` is above
/// 0, else from a spring (N/m) at each end of the shorter edge.
double of_penalty(double at_end, double over_young, const FaceSides& sides) {
  return over_young > 0.0 ? 2.0 * over_young / sides.compliance : 2.0 * at_end / sides.shorter;
}

}  // namespace

FaceSides sides_of(const BlockSet& b, Id edge, Id facing) {
  const auto counts = [&](Id e) {
    const Id i = b.vertex_block[e];
    return b.fixed[i] == 0 && !b.is_lining(i);
  };
  const double of_edge = b.compliance[counts(edge) || !counts(facing) ? edge : facing],
               of_facing = b.compliance[counts(facing) || !counts(edge) ? facing : edge];
  return {std::min(b.edge_length[edge], b.edge_length[facing]),
          std::min(0.5 * (of_edge + of_facing), most_of_smaller * std::min(of_edge, of_facing))};
}

FaceSides beside_much_larger(const BlockSet& b, Id edge) {
  return {b.edge_length[edge], most_of_smaller * b.compliance[edge]};
}

double LawTable::normal_stiffness(const Law& law, const FaceSides& sides) const {
  if (law.kn > 0.0) return thickness * law.kn;
  const bool own = law.spring > 0.0;
  return of_penalty(thickness * (own ? law.spring : penalty.normal),
                    own ? 0.0 : thickness * penalty.normal_over_young, sides);
}

double LawTable::shear_stiffness(const Law& law, const FaceSides& sides) const {
  if (law.ks > 0.0) return thickness * law.ks;
  const bool own = law.spring > 0.0;
  return of_penalty(thickness * penalty.shear * (own ? law.spring / penalty.normal : 1.0),
                    own ? 0.0 : thickness * penalty.shear_over_young, sides);
}

std::uint16_t LawTable::resolve(Index edge, Index facing) const {
  if (edge == none && facing == none) {
    return static_cast<std::uint16_t>(default_law == none ? 0 : default_law);
  }
  if (edge == none) return static_cast<std::uint16_t>(facing);
  if (facing == none || facing == edge) return static_cast<std::uint16_t>(edge);
  const auto a = static_cast<std::uint16_t>(edge), b = static_cast<std::uint16_t>(facing);
  return rank[a] < rank[b] ? a : b;
}

std::uint16_t LawTable::resolve(Index edge, Index facing, Index edge_material,
                                Index facing_material) const {
  if (!joint_pairs.empty()) {
    const auto as_named = [&](Index joint) {
      const Index law = joint == none ? default_law : joint;
      return law == none ? none : static_cast<Index>(named[static_cast<std::size_t>(law)]);
    };
    const Index law = law_of(joint_pairs, as_named(edge), as_named(facing));
    if (law != none) return static_cast<std::uint16_t>(law);
  }
  if (!material_pairs.empty()) {
    const Index law = law_of(material_pairs, edge_material, facing_material);
    if (law != none) return static_cast<std::uint16_t>(law);
  }
  return resolve(edge, facing);
}

std::uint16_t LawTable::resolve_met(Index edge, Index facing, Index edge_material,
                                    Index facing_material) const {
  const auto unglued = [&](Index joint) {
    return joint != none && rows[static_cast<std::size_t>(joint)].glued ? none : joint;
  };
  return resolve(unglued(edge), unglued(facing), edge_material, facing_material);
}

std::uint16_t law_between(const LawTable& laws, const BlockSet& b, Id edge, Id facing, bool drawn) {
  const Id i = b.vertex_block[edge], j = b.vertex_block[facing];
  Index of_edge = b.edge_joint[edge], of_facing = b.edge_joint[facing];
  if (b.is_added(i) != b.is_added(j)) {
    const Index own = b.is_added(i) ? of_edge : of_facing;
    const bool holds = own != none && (drawn || !laws.rows[static_cast<std::size_t>(own)].glued);
    if (holds) return static_cast<std::uint16_t>(own);
  }
  if (of_edge == none && of_facing == none && !b.unnamed_joint.empty()) {
    of_edge = b.unnamed_joint[edge];
    of_facing = b.unnamed_joint[facing];
  }
  return drawn ? laws.resolve(of_edge, of_facing, b.material[i], b.material[j])
               : laws.resolve_met(of_edge, of_facing, b.material[i], b.material[j]);
}

}  // namespace edda
