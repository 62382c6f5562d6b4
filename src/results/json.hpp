// JSON, written in order, two spaces per level.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/number.hpp"

namespace edda {

/// Usage: open_object(); key("a").value(1.5); close(); text(). Numbers that are not finite (nan,
/// inf) become null.
class Json {
 public:
  Json& open_object() { return open('{', '}'); }
  Json& open_list() { return open('[', ']'); }
  Json& close();
  Json& key(std::string_view name);
  Json& value(double number);
  Json& value(bool truth) { return raw(truth ? "true" : "false"); }
  Json& value(std::integral auto number) { return raw(fmt::format("{}", number)); }
  Json& value(std::string_view text);
  Json& value(const char* text) { return value(std::string_view(text)); }
  Json& null() { return raw("null"); }
  /// Nothing becomes null.
  Json& value(const std::optional<double>& number) { return number ? value(*number) : null(); }
  template <class T>
  Json& pair(std::string_view name, const T& content) {
    return key(name).value(content);
  }
  const std::string& text() const { return text_; }
  /// The same without line breaks.
  std::string line() const;

 private:
  Json& open(char begin, char end);
  Json& raw(std::string_view content);
  void next_line();
  std::string text_;
  std::vector<char> ends_;  ///< closing characters of the open levels
  bool first_ = true;       ///< nothing yet at this level
  bool after_key_ = false;
};

/// JSON as Json lays it out, without its line breaks.
std::string one_line(std::string_view json);

}  // namespace edda
