// The only file that knows the TOML library.
#include <toml++/toml.h>

#include <algorithm>
#include <exception>
#include <tuple>

#include "model/files/value.hpp"

namespace edda {
namespace {

Place place_of(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), false};
}

Value converted(const toml::node& node, Place fallback);

/// The library sorts a table by key; the model needs the order of the file.
Table converted_table(const toml::table& table, Place fallback) {
  Table entries;
  entries.reserve(table.size());
  for (const auto& [key, node] : table) {
    Place place = place_of(key.source());
    if (place.line == 0) place = fallback;
    entries.push_back({std::string(key.str()), place, converted(node, place)});
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
  return entries;
}

List converted_list(const toml::array& array, Place fallback) {
  List list;
  list.reserve(array.size());
  for (const toml::node& node : array) list.push_back(converted(node, fallback));
  return list;
}

Value converted(const toml::node& node, Place fallback) {
  Value value;
  value.place = place_of(node.source());
  if (value.place.line == 0) value.place = fallback;
  if (const auto* table = node.as_table()) {
    value.content = converted_table(*table, value.place);
  } else if (const auto* array = node.as_array()) {
    value.content = converted_list(*array, value.place);
  } else if (const auto* text = node.as_string()) {
    value.content = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.content = static_cast<long long>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    value.content = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.content = flag->get();
  } else {
    value.content = Date{};
  }
  return value;
}

bool is_bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

/// End of the quoted string that opens at `i`, on the same line; `i` where it does not close there.
std::size_t closing_quote(std::string_view text, std::size_t i) {
  for (std::size_t j = i + 1; j < text.size() && text[j] != '\n'; ++j) {
    if (text[j] == '\\' && text[i] == '"') {
      ++j;
    } else if (text[j] == text[i]) {
      return j;
    }
  }
  return i;
}

/// Line of the first key of more than `limit` dotted parts, 0 if there is none. The library frees
/// nested tables by recursion, so that a key of a million parts would overflow the stack.
int overlong_key(std::string_view text, int limit) {
  int line = 1, dots = 0;
  bool gap = false, after_dot = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const std::size_t close = c == '"' || c == '\'' ? closing_quote(text, i) : i;
    if (is_bare(c) || close != i) {
      if (gap && !after_dot) dots = 0;
      gap = after_dot = false;
      i = close;
    } else if (c == '.') {
      after_dot = true;
      if (++dots >= limit) return line;
    } else if (c == ' ' || c == '\t') {
      gap = true;
    } else {
      dots = 0;
      gap = after_dot = false;
      if (c == '\n') ++line;
    }
  }
  return 0;
}

Fault syntax_fault(const std::string& file, int line, int column, std::string problem) {
  if (const auto own = problem.find(" (TOML_"); own != std::string::npos) {
    problem.resize(own);  // without what the library says of its own settings
  }
  while (!problem.empty() && (problem.back() == '.' || problem.back() == ' ')) problem.pop_back();
  for (char& c : problem) {
    if (static_cast<unsigned char>(c) < 0x20U) c = '?';  // the message may quote control characters
  }
  return {{"", file, std::max(line, 1), std::max(column, 1)},
          "not valid TOML: " + problem,
          "correct this line; nothing else was looked at"};
}

}  // namespace

Result<Value> parse_toml(std::string_view text, const std::string& file) {
  constexpr int most_keys_deep = 32;
  if (const int line = overlong_key(text, most_keys_deep); line > 0) {
    return syntax_fault(file, line, 1, "a key of more than 32 parts");
  }
  try {
    const toml::table root = toml::parse(text);
    return Value{converted_table(root, {1, 1, false}), {1, 1, false}};
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    return syntax_fault(file, place.line, place.column, std::string(error.description()));
  } catch (const std::exception& error) {
    return syntax_fault(file, 1, 1, error.what());
  }
}

}  // namespace edda
