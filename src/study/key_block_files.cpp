// Table and summary of key blocks.
#include <algorithm>
#include <cmath>

#include "results/columns.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "study/key_blocks.hpp"

namespace edda {
namespace {

/// Laws of the joints on which the block slides, each once.
std::string joints_of(const KeyBlocks& found, const RemovableBlock& block) {
  std::string names;
  std::vector<std::uint16_t> seen;
  const std::vector<JointLaw>& joints = found.drawn->scene->model.joints;
  for (const std::size_t k : block.joints) {
    const std::uint16_t law = found.rigid.joints[k].law;
    if (std::find(seen.begin(), seen.end(), law) != seen.end()) continue;
    seen.push_back(law);
    names += names.empty() ? "" : " and ";
    names += law < joints.size() ? joints[law].name : "glued";
  }
  return names;
}

Csv& add(Csv& csv, const std::optional<double>& value) {
  return value ? csv.add(*value) : csv.add("");
}

}  // namespace

std::string key_blocks_csv(const KeyBlocks& found) {
  Csv csv = begin_table(ResultFile::key_blocks);
  const BlockSet& blocks = found.drawn->scene->blocks;
  for (const RemovableBlock& b : found.blocks) {
    csv.add(b.blocks.front()).add(blocks.name(b.blocks.front()));
    csv.add(b.centroid.x).add(b.centroid.y).add(b.area).add(b.weight);
    csv.add(block_class_name(b.kind)).add(removal_mode_name(b.mode)).add(joints_of(found, b));
    const bool moves = b.direction != Vec2{};
    add(csv, moves ? std::optional(std::atan2(b.direction.y, b.direction.x)) : std::nullopt);
    add(csv, b.by_translation);
    add(csv, b.by_rotation);
    add(csv, b.factor).add(b.generation);
    add(csv, b.support).end();
  }
  return csv.text();
}

std::string key_blocks_summary(const Model& model, const KeyBlocks& k) {
  Json j;
  j.open_object().pair("version", version).pair("title", model.title);
  j.pair("message", k.message).pair("required_factor", k.required);
  j.pair("blocks", k.bodies).pair("locked", k.locked).pair("stable", k.stable);
  j.pair("held", k.held).pair("key", k.key).pair("generations", k.generations);
  j.pair("key_area", k.key_area).pair("key_weight", k.key_weight);
  double largest = 0.0;
  std::optional<double> least;
  for (const RemovableBlock& b : k.blocks) {
    if (b.kind == BlockClass::key) largest = std::max(largest, b.area);
    if (b.factor && (!least || *b.factor < *least)) least = b.factor;
  }
  j.pair("largest_key_area", largest).pair("least_factor", least);
  j.key("monitors").open_list();
  for (const MonitoredPlace& m : k.monitors) {
    j.open_object().pair("name", m.name).pair("class", block_class_name(m.kind));
    j.pair("key", m.kind == BlockClass::key).pair("generation", m.generation).close();
  }
  j.close();
  j.key("warnings").open_list();
  for (const std::string& w : k.warnings) j.value(w);
  j.close();
  j.pair("wall_seconds", k.seconds);
  return j.close().text();
}

}  // namespace edda
