#include "model/table/key_reference.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/table/keys.hpp"
#include "model/table/nearest.hpp"
#include "model/write_model.hpp"

namespace edda {
namespace {

/// Escapes vertical bars, which would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string heading(const Section& section) {
  switch (section.shape) {
    case Shape::root:
      return "Keys outside any table";
    case Shape::table:
      return fmt::format("`[{}]`", section.name);
    case Shape::named:
      return fmt::format("`[{}.NAME]`", section.name);
    case Shape::list:
      return fmt::format("`[[{}]]`", section.name);
  }
  return {};
}

/// The values that the key may have. `slot`: its field, or null.
std::string value_of(const Key& key, const Slot* slot) {
  if (slot != nullptr) {
    if (const Choice* choice = std::get_if<Choice>(slot)) {
      std::string words;
      for (const std::string_view name : choice->names) {
        words += fmt::format("{}`\"{}\"`", words.empty() ? "" : ", ", name);
      }
      return words;
    }
  }
  if (key.rule.kind == Kind::table) return "a table";
  if (key.rule.kind == Kind::tables) return "a list of tables";
  return expected(key);
}

std::string default_of(const Key& key, const Slot* slot, const Model& model) {
  if (key.otherwise.required) return "**required**";
  if (!key.otherwise.text.empty()) return std::string(key.otherwise.text);
  if (slot == nullptr) return "none";
  if (std::holds_alternative<SubTable>(*slot)) return "its keys' own";
  const std::string value = toml_value(key, *slot, model);
  return value.empty() || value == "\"\"" ? "none" : '`' + value + '`';
}

void add_rows(std::span<const Key> keys, void* object, const std::string& prefix,
              const Model& model, std::string& text) {
  for (const Key& key : keys) {
    const std::string name = prefix + std::string(key.name);
    std::optional<Slot> slot;
    if (key.slot != nullptr) slot = key.slot(object);
    const Slot* known = slot ? &*slot : nullptr;
    text += fmt::format("| `{}` | {} | {} | {} |\n", name, cell(value_of(key, known)),
                        cell(default_of(key, known, model)), cell(std::string(key.meaning)));
    if (!slot || inner_keys_of(*slot).empty()) continue;
    void* inner = nullptr;
    if (const auto* tables = std::get_if<TableList>(&*slot)) {
      inner = tables->add(tables->list);
    } else {
      const SubTable& table = std::get<SubTable>(*slot);
      inner = table.object != nullptr ? table.object : table.make(table.owner);
    }
    add_rows(inner_keys_of(*slot), inner, name + '.', model, text);
  }
}

std::string reference_of(const Section& section) {
  Model model;
  return key_reference(section, &model);
}

}  // namespace

std::string key_reference(const Section& section, void* root) {
  void* object = section.add(root);
  std::string text = fmt::format("## {}\n\n{}\n\n", heading(section), section.meaning);
  text += "| key | value | default | meaning |\n|---|---|---|---|\n";
  add_rows(section.keys, object, "", Model{}, text);
  return text;
}

std::string key_reference() {
  std::string text =
      "# Keys of a model file\n\n"
      "A model is a TOML 1.0 file. Numbers are in SI units and degrees; every quantity may also "
      "be\n"
      "a string with its unit (`\"20 GPa\"`, `\"26 kN/m3\"`, `\"5 cm\"`). Angles run "
      "counter-clockwise\n"
      "from +x, stress is positive in tension, forces and masses are per metre of thickness "
      "unless\n"
      "`thickness` says otherwise. An unknown key is an error that names the nearest known one.\n"
      "`edda keys` prints this page, `edda keys stage` the keys of one table.\n";
  for (const Section& section : sections()) text += '\n' + reference_of(section);
  return text;
}

std::string key_reference(std::string_view name) {
  for (const Section& section : sections()) {
    if (section.name == name) return reference_of(section);
  }
  return {};
}

}  // namespace edda
