#include "model/write_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/table/keys.hpp"

namespace edda {
namespace {

std::string written(double x) {
  std::string text = fmt::format("{}", x);
  // Without this TOML would read an integer, and -0 would lose its sign.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string written(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string written(Vec2 point) {
  return '[' + written(point.x) + ", " + written(point.y) + ']';
}

template <class Item>
std::string written(const std::vector<Item>& items) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : ", ") + written(items[i]);
  return text + ']';
}

std::string bare_or_quoted(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? key : written(key);
}

/// The value of a field as TOML; empty where there is nothing to write.
struct Write {
  const Key& key;
  const Model& model;

  std::string operator()(const bool* field) const { return *field ? "true" : "false"; }
  std::string operator()(const int* field) const {
    if (key.rule.kind == Kind::integer) return std::to_string(*field);
    if (*field == none) return {};
    const auto i = static_cast<std::size_t>(*field);
    return written(key.rule.kind == Kind::material ? model.materials[i].name
                                                   : model.joints[i].name);
  }
  std::string operator()(const long long* field) const { return std::to_string(*field); }
  std::string operator()(const double* field) const {
    return *field == 0.0 && key.otherwise.zero_is_none ? std::string{} : written(*field);
  }
  std::string operator()(const std::optional<double>* field) const {
    if (*field) return written(**field);
    return key.rule.word.empty() ? std::string{} : written(std::string(key.rule.word));
  }
  std::string operator()(const std::optional<long long>* field) const {
    return *field ? std::to_string(**field) : std::string{};
  }
  std::string operator()(const std::optional<Restitution>* field) const {
    if (!*field) return {};
    return (*field)->housner ? written(std::string(key.rule.word)) : written((*field)->part);
  }
  std::string operator()(const JointMap* field) const {
    std::string text;
    const bool materials = key.rule.kind == Kind::material_map;
    for (const auto& [name, index] : *field) {
      const auto row = static_cast<std::size_t>(index);
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ", bare_or_quoted(name),
                          written(materials ? model.materials[row].name : model.joints[row].name));
    }
    return text.empty() ? text : text + " }";
  }
  std::string operator()(const NumberMap* field) const {
    std::string text;
    for (const auto& [name, value] : *field) {
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ", bare_or_quoted(name),
                          written(value));
    }
    return text.empty() ? text : text + " }";
  }
  std::string operator()(const VariedRange* field) const {
    const Key* const own = find_key({&key, 1}, field->vary);
    return own == nullptr ? std::string{} : written(*field->range);
  }
  std::string operator()(const std::string* field) const {
    return key.rule.kind != Kind::text && field->empty() ? std::string{} : written(*field);
  }
  std::string operator()(const Triple* field) const {
    return written(std::vector<double>(field->begin(), field->end()));
  }
  std::string operator()(const std::optional<Triple>* field) const {
    return *field ? (*this)(&**field) : std::string{};
  }
  std::string operator()(const Vec2* field) const { return written(*field); }
  std::string operator()(const std::optional<Vec2>* field) const {
    return *field ? written(**field) : std::string{};
  }
  std::string operator()(const std::vector<Vec2>* field) const {
    return field->empty() ? std::string{} : written(*field);
  }
  std::string operator()(const std::vector<double>* field) const {
    return field->empty() ? std::string{} : written(*field);
  }
  std::string operator()(const std::vector<std::string>* field) const {
    return field->empty() ? std::string{} : written(*field);
  }
  std::string operator()(const Choice& choice) const {
    return written(std::string(choice.names[static_cast<std::size_t>(choice.get(choice.field))]));
  }
  std::string operator()(const SubTable& table) const {
    if (table.file != nullptr && !table.file->empty()) return written(*table.file);
    if (table.object == nullptr) return {};
    const std::string text = inline_table(table.keys, table.object);
    return text.empty() && table.make != nullptr ? "{}" : text;  // it is there, with all defaults
  }
  std::string operator()(const TableList& tables) const {
    std::string text;
    for (std::size_t i = 0; i < tables.count(tables.list); ++i)
      text += (i == 0 ? "[" : ", ") + inline_table(tables.keys, tables.at(tables.list, i));
    return text.empty() ? text : text + ']';
  }

 private:
  std::string inline_table(std::span<const Key> keys, void* object) const {
    std::string text;
    for (const Key& inner : keys) {
      const Slot slot = inner.slot(object);
      const std::string value = std::visit(Write{inner, model}, slot);
      if (value.empty()) continue;
      const auto* varied = std::get_if<VariedRange*>(&slot);
      text += fmt::format("{}{} = {}", text.empty() ? "{ " : ", ",
                          varied == nullptr ? inner.name : bare_or_quoted((*varied)->vary), value);
    }
    return text.empty() ? text : text + " }";
  }
};

void write_header(const Section& section, void* object, std::string& text) {
  if (section.shape == Shape::root) return;
  if (section.shape == Shape::list) {
    text += fmt::format("\n[[{}]]\n", section.name);
  } else if (section.shape == Shape::named) {
    text += fmt::format("\n[{}.{}]\n", section.name, bare_or_quoted(*section.name_of(object)));
  } else {
    text += fmt::format("\n[{}]\n", section.name);
  }
}

}  // namespace

std::string toml_value(const Key& key, const Slot& slot, const Model& model) {
  return std::visit(Write{key, model}, slot);
}

std::string to_toml(const Model& model) {
  Model copy = model;  // slots reach fields to fill them, too
  std::erase_if(copy.joints, [](const JointLaw& law) { return law.change.has_value(); });
  return to_toml(sections(), &copy, copy);
}

std::string to_toml(std::span<const Section> sections, void* root, const Model& names) {
  std::string text;
  for (const Section& section : sections) {
    for (std::size_t i = 0; i < section.count(root); ++i) {
      void* object = section.at(root, i);
      write_header(section, object, text);
      for (const Key& key : section.keys) {
        if (key.slot == nullptr) continue;
        const std::string value = toml_value(key, key.slot(object), names);
        if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
      }
    }
  }
  return text;
}

}  // namespace edda
