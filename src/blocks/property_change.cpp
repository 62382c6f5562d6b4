#include "blocks/property_change.hpp"

#include <algorithm>

#include "base/polygon.hpp"

namespace edda {
namespace {

/// Whether the change is made there.
class Reach {
 public:
  Reach(const BlockSet& b, const Model& model, const PropertyChange& change) : change_(change) {
    if (change.opening != none)
      around_ = model.openings[static_cast<std::size_t>(change.opening)].polygon;
    for (const std::string& table : b.tables) cut_.push_back(has_cut(model, table));
  }
  /// Of the lines from this row of BlockSet::tables, or none.
  bool has(Index table) const {
    return change_.set.empty() || (table != none && cut_[static_cast<std::size_t>(table)]);
  }
  /// In model coordinates.
  bool has(Vec2 p) const {
    const Ring& region = change_.region;
    if (!region.empty() && side_of({&region, 1}, p, 0.0) < 0) return false;
    if (around_.empty() || side_of({&around_, 1}, p, 0.0) >= 0) return true;
    for (std::size_t k = 0; k < around_.size(); ++k) {
      const Vec2 a = around_[k], b = around_[(k + 1) % around_.size()];
      if (distance_to_segment(p, a, b) <= change_.distance) return true;
    }
    return false;
  }

 private:
  bool has_cut(const Model& model, const std::string& table) const {
    const auto is_it = [&](const auto& lines) {
      return lines.name == change_.set && lines.where.key == table;
    };
    return std::any_of(model.joint_sets.begin(), model.joint_sets.end(), is_it) ||
           std::any_of(model.networks.begin(), model.networks.end(), is_it);
  }

  const PropertyChange& change_;
  Ring around_;
  std::vector<bool> cut_;  // [rows of BlockSet::tables]
};

}  // namespace

std::vector<std::uint8_t> change_properties(BlockSet& b, const Model& model,
                                            const PropertyChange& change,
                                            const std::vector<std::uint8_t>& linings) {
  const Reach reach(b, model, change);
  std::vector<std::uint8_t> changed(b.vertex_count(), 0);
  if (change.material != none) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.material[i] != change.material) continue;
      if (b.is_lining(i) && linings[static_cast<std::size_t>(b.lining[i])] == 0) continue;
      if (!reach.has(Vec2{b.centroid_x[i], b.centroid_y[i]} + b.origin)) continue;
      b.material[i] = change.row;
      b.damping[i] = model.materials[static_cast<std::size_t>(change.row)].damping;
      b.rayleigh[i] = model.materials[static_cast<std::size_t>(change.row)].rayleigh;
      std::fill(changed.begin() + b.vertex_begin[i], changed.begin() + b.vertex_begin[i + 1],
                std::uint8_t{1});
    }
  } else {
    if (b.unnamed_joint.empty()) b.unnamed_joint.assign(b.vertex_count(), model.contact.joint);
    for (Id e = 0; e < b.vertex_count(); ++e) {
      Index& joint = b.edge_joint[e] != none ? b.edge_joint[e] : b.unnamed_joint[e];
      const auto becomes = std::find_if(change.laws.begin(), change.laws.end(),
                                        [&](const auto& law) { return law.first == joint; });
      if (becomes == change.laws.end() || !reach.has(b.edge_table[e])) continue;
      if (!reach.has(0.5 * (b.vertex(e) + b.vertex(b.next[e])) + b.origin)) continue;
      joint = becomes->second;
      changed[e] = 1;
    }
  }
  const bool any = std::any_of(changed.begin(), changed.end(), [](auto c) { return c != 0; });
  return any ? changed : std::vector<std::uint8_t>{};
}

}  // namespace edda
