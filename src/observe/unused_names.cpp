#include "observe/unused_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace edda {
namespace {

std::vector<bool> used_joints(const Simulation& sim) {
  const Model& model = sim.scene->model;
  std::vector<bool> used(model.joints.size(), false);
  const auto use = [&](Index law) {
    if (law != none) used[static_cast<std::size_t>(law)] = true;
  };
  bool unnamed = false;
  for (const Index law : sim.scene->blocks.edge_joint) {
    unnamed = unnamed || law == none;
    use(law);
  }
  if (unnamed) use(model.contact.joint);
  for (const ContactPair& pair : model.pairs) use(pair.joint);
  return used;
}

std::vector<bool> used_materials(const Simulation& sim) {
  std::vector<bool> used(sim.scene->model.materials.size(), false);
  for (const Index m : sim.scene->blocks.material) {
    if (m != none) used[static_cast<std::size_t>(m)] = true;
  }
  return used;
}

template <class Item>
void warn_of_idle(const std::vector<Item>& items, const std::vector<bool>& used, const char* what,
                  const char* who, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (used[i] || items[i].where.line == 0) continue;  // line 0: built in, not from the model file
    warnings.push_back(
        fmt::format("{}: {} \"{}\" is not used: {}; name it where it belongs, or leave it out",
                    items[i].where.key, what, items[i].name, who));
  }
}

/// Bolts hold nothing where their bars begin and end in one block.
void warn_of_bolts_in_one_block(const Simulation& sim, std::vector<std::string>& warnings) {
  const Scene& scene = *sim.scene;
  if (!has_bolts(scene.model)) return;
  const std::vector<Bolt> all = all_bolts(scene.model);
  std::vector<Index> rows(all.size());
  std::iota(rows.begin(), rows.end(), Index{0});
  const Result<Bolts> placed = attach_bolts(scene.model, scene.blocks, sim.motion.state,
                                            sim.motion.pose.x, sim.motion.pose.y, rows, 0.0);
  if (!placed.ok()) return;
  const Bolts& b = placed.value();
  std::vector<std::string> idle;
  for (std::size_t q = 0; q < b.rows.size(); ++q) {
    const auto first = b.host.begin() + b.begin[q], last = b.host.begin() + b.begin[q + 1];
    if (std::all_of(first, last, [&](Id host) { return host == *first; })) {
      idle.push_back(b.rows[q].name);
    }
  }
  if (idle.empty()) return;
  warnings.push_back(fmt::format("{} a single block and {} no joint: {}; {} nothing there",
                                 idle.size() == 1 ? "a bolt lies within" : "bolts lie within",
                                 idle.size() == 1 ? "crosses" : "cross", fmt::join(idle, ", "),
                                 idle.size() == 1 ? "it holds" : "they hold"));
}

/// Water whose table lies below all faces of free blocks, as these are drawn, and never rises.
void warn_of_dry_waters(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  const BlockSet& b = sim.scene->blocks;
  std::vector<bool> wets(model.waters.size(), false);
  for (const WetEdge& e : sim.attached.loads.wet) {
    const double y = b.vertex(e.edge).y, rise = b.vertex(b.next[e.edge]).y - y;
    const bool under = y + e.from * rise < e.level_from || y + e.to * rise < e.level_to;
    if (under) wets[static_cast<std::size_t>(e.water)] = true;
  }
  for (std::size_t q = 0; q < wets.size(); ++q) {
    const Water& water = model.waters[q];
    if (wets[q] || !water.history.empty()) continue;
    warnings.push_back(fmt::format(
        "{}: the table lies below all faces of free blocks: it has no effect; check its level",
        water.where.key));
  }
}

}  // namespace

std::vector<std::string> unused_names(const Simulation& sim) {
  std::vector<std::string> warnings;
  warn_of_idle(sim.scene->model.joints, used_joints(sim), "joint",
               "no edge of a block has it, and no contact_pair gives it", warnings);
  warn_of_idle(sim.scene->model.materials, used_materials(sim), "material",
               "no block is made of it", warnings);
  warn_of_bolts_in_one_block(sim, warnings);
  warn_of_dry_waters(sim, warnings);
  return warnings;
}

}  // namespace edda
