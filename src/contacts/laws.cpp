#include "contacts/laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace edda {
namespace {

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

}  // namespace

LawTable build_laws(const Model& model) {
  LawTable table;
  table.default_kn = model.contact.normal_stiffness;
  table.default_ks = model.contact.shear_stiffness;
  table.thickness = model.thickness;
  table.default_law = model.contact.joint;
  for (const JointLaw& j : model.joints) {
    table.rows.push_back({tangent(j.peak.friction_angle), j.peak.cohesion, j.peak.tensile_strength,
                          tangent(j.residual.friction_angle), j.residual.cohesion,
                          j.residual.tensile_strength, j.kn.value_or(0.0),
                          j.ks.value_or(0.4 * j.kn.value_or(0.0)), j.type == LawType::glued});
  }
  std::vector<std::uint16_t> order(table.rows.size());
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  auto key = [&](std::uint16_t r) {
    const JointLaw& j = model.joints[r];
    // A glued joint is the strongest of all.
    return std::make_tuple(j.type == LawType::glued, j.peak.friction_angle, j.peak.cohesion,
                           j.peak.tensile_strength, j.name);
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint16_t a, std::uint16_t b) { return key(a) < key(b); });
  table.rank.resize(table.rows.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    table.rank[order[place]] = static_cast<std::uint16_t>(place);
  }
  if (table.rows.empty()) {  // a single block touches nothing: any law will do
    table.rows.push_back({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false});
    table.rank.push_back(0);
  }
  return table;
}

std::uint16_t LawTable::resolve(Index struck, Index facing) const {
  if (struck == none && facing == none) {
    return static_cast<std::uint16_t>(default_law == none ? 0 : default_law);
  }
  if (struck == none) return static_cast<std::uint16_t>(facing);
  if (facing == none || facing == struck) return static_cast<std::uint16_t>(struck);
  const auto a = static_cast<std::uint16_t>(struck), b = static_cast<std::uint16_t>(facing);
  return rank[a] < rank[b] ? a : b;
}

}  // namespace edda
