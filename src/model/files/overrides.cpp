#include "model/files/overrides.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "base/text.hpp"
#include "model/files/old_names.hpp"
#include "model/files/reader.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

constexpr std::size_t most_parts = 16;

/// Parts of a dotted path; a part in quotes may hold dots. Empty where a part is empty.
std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts;
  while (true) {
    path = trimmed(path);
    std::string_view part;
    if (!path.empty() && (path.front() == '"' || path.front() == '\'')) {
      const std::size_t close = path.find(path.front(), 1);
      if (close == std::string_view::npos) return {};
      part = path.substr(1, close - 1);
      path = trimmed(path.substr(close + 1));
      if (!path.empty() && path.front() != '.') return {};
    } else {
      part = trimmed(path.substr(0, path.find('.')));
      path.remove_prefix(std::min(path.find('.'), path.size()));
    }
    if (part.empty()) return {};
    parts.emplace_back(part);
    if (path.empty()) return parts;
    path.remove_prefix(1);
  }
}

/// Where the '=' between path and value is: the first one outside quotes.
std::size_t find_equals(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote == 0 && text[i] == '=') return i;
    if (quote == 0 && (text[i] == '"' || text[i] == '\'')) {
      quote = text[i];
    } else if (text[i] == quote) {
      quote = 0;
    }
  }
  return std::string_view::npos;
}

void move_to(Value& value, const Place& place) {
  value.place = place;
  if (List* list = std::get_if<List>(&value.content)) {
    for (Value& item : *list) move_to(item, place);
  } else if (Table* table = std::get_if<Table>(&value.content)) {
    for (Entry& entry : *table) {
      entry.place = place;
      move_to(entry.value, place);
    }
  }
}

/// The text as a TOML value, else as a string.
Value value_of(std::string_view text, const Place& place) {
  Value value{std::string(text), place};
  // A line break could smuggle in more than one value.
  if (text.find('\n') != std::string_view::npos) return value;
  Result<Value> document = parse_toml("value = " + std::string(text), "--set");
  if (!document) return value;
  Table* entries = std::get_if<Table>(&document.value().content);
  if (entries == nullptr || entries->size() != 1) return value;
  value.content = std::move((*entries)[0].value.content);
  move_to(value, place);
  return value;
}

std::optional<std::size_t> element_number(const List& list, const std::string& part) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Value* name = find(&list[i], "name");
    const std::string* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->content);
    if (text != nullptr && *text == part) return i;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (error != std::errc{} || end != part.data() + part.size()) return std::nullopt;
  return number < list.size() ? std::optional(number) : std::nullopt;
}

Fault fault_at(int number, std::string key, std::string problem, std::string remedy) {
  return {{std::move(key), "--set", number, 1}, std::move(problem), std::move(remedy)};
}

Fault no_such_element(int number, const List& list, const std::string& path,
                      const std::string& part) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < list.size(); ++i) labels.push_back(label(list[i], i));
  const std::vector<std::string_view> known(labels.begin(), labels.end());
  return fault_at(number, path, fmt::format("no element is called \"{}\"", clipped(part)),
                  suggestion(part, known));
}

/// An element of a named table that the model does not have. If an override of one of its keys made
/// it, nothing would refer to it.
Fault no_such_name(int number, const Table& table, const std::string& section,
                   const std::string& part) {
  std::vector<std::string_view> known;
  for (const Entry& entry : table) known.push_back(entry.key);
  const std::string path = section + '.' + clipped(part);
  return fault_at(number, path, fmt::format("the model has no [{}]", path),
                  fmt::format("{}; a whole table, {} = {{ ... }}, adds one",
                              known.empty() ? fmt::format("it has no [{}.NAME] at all", section)
                                            : "it has " + quoted_list(nearest_first(part, known)),
                              path));
}

/// The entry of a table, made where it is missing.
Value& entry_of(Table& table, const std::string& key, const Place& place) {
  if (Entry* entry = find_entry(table, key)) return entry->value;
  table.push_back({key, place, {Table{}, place}});
  return table.back().value;
}

auto is_named(std::string_view name) {
  return [name](const Entry& entry) { return entry.key == name; };
}

std::optional<Fault> apply(Value& root, const std::string& override_text, int number,
                           Reading& reading) {
  const Place place{number, 1, true};
  const std::size_t equals = find_equals(override_text);
  const std::string_view text = override_text;
  if (equals == std::string_view::npos) {
    return fault_at(number, "", fmt::format("\"{}\" has no \"=\"", clipped(text)),
                    "write key=value, such as solver.duration=0.2");
  }
  const std::string key(trimmed(text.substr(0, equals)));
  std::vector<std::string> parts = split_path(key);
  rename_old(parts, reading);
  if (parts.empty() || parts.size() > most_parts) {
    return fault_at(number, "", fmt::format("\"{}\" is not a key", clipped(key)),
                    "write key=value, such as solver.duration=0.2");
  }
  Value* node = &root;
  std::string path;
  const Section* named = nullptr;  // the table whose names `node` holds
  for (const std::string& part : parts) {
    if (Table* table = std::get_if<Table>(&node->content)) {
      path += (path.empty() ? "" : ".") + part;
      const std::size_t before = table->size();
      Value& next = entry_of(*table, part, place);
      const Section* section = node == &root ? find_section(part, reading.sections) : nullptr;
      const bool is_made = table->size() > before;
      if (is_made && &part != &parts.back() && section != nullptr &&
          section->shape == Shape::list) {
        table->pop_back();
        return fault_at(number, path, fmt::format("the model has no [[{}]]", part),
                        fmt::format("add one to the model, or set {} to a whole list", part));
      }
      if (is_made && &part != &parts.back() && named != nullptr) {
        table->pop_back();
        const Fault fault = no_such_name(number, *table, std::string(named->name), part);
        if (table->empty()) std::erase_if(std::get<Table>(root.content), is_named(named->name));
        return fault;
      }
      named = section != nullptr && section->shape == Shape::named ? section : nullptr;
      node = &next;
    } else if (List* list = std::get_if<List>(&node->content)) {
      const bool of_tables = !list->empty() && std::holds_alternative<Table>(list->front().content);
      if (!of_tables) {
        return fault_at(number, path, "a list is replaced whole",
                        fmt::format("set {} to a list", path));
      }
      const auto element = element_number(*list, part);
      if (!element) return no_such_element(number, *list, path, part);
      node = &(*list)[*element];
      path += "." + part;
    } else {
      return fault_at(number, path, "is " + shown(*node) + " and has no keys",
                      fmt::format("set {} itself", path));
    }
  }
  *node = value_of(trimmed(text.substr(equals + 1)), place);
  // A key that is overridden is unknown, if it is, on the command line.
  return std::nullopt;
}

}  // namespace

void apply_overrides(Value& root, const std::vector<std::string>& overrides, Reading& reading) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    if (auto fault = apply(root, overrides[i], static_cast<int>(i) + 1, reading)) {
      reading.faults.push_back(std::move(*fault));
    }
  }
}

}  // namespace edda
