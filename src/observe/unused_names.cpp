#include "observe/unused_names.hpp"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

std::vector<std::string> unused_names(const Simulation& sim) {
  std::vector<std::string> warnings;
  warn_of_idle(sim.scene->model.joints, used_joints(sim), "joint",
               "no edge of a block has it, and no contact_pair gives it", warnings);
  warn_of_idle(sim.scene->model.materials, used_materials(sim), "material",
               "no block is made of it", warnings);
  return warnings;
}

}  // namespace edda
