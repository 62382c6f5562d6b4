#include "results/csv.hpp"

namespace edda {

Csv& Csv::raw(std::string_view cell) {
  if (!first_) text_ += ',';
  first_ = false;
  text_ += cell;
  return *this;
}

Csv& Csv::add(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return raw(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return raw(quoted + '"');
}

Csv& Csv::end() {
  text_ += '\n';
  first_ = true;
  return *this;
}

}  // namespace edda
