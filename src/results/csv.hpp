// Comma-separated rows: shortest round-trip numbers, text quoted only where it must be. Headers are
// those of results/columns.hpp.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "results/number.hpp"

namespace edda {

/// Builds rows of text. Cells are separated by commas, rows ended by end().
class Csv {
 public:
  Csv& add(double value) { return raw(shortest(value)); }
  Csv& add(std::integral auto value) { return raw(fmt::format("{}", value)); }
  Csv& add(std::string_view text);
  Csv& add(const char* text) { return add(std::string_view(text)); }
  Csv& end();
  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  Csv& raw(std::string_view cell);
  std::string text_;
  bool first_ = true;
};

}  // namespace edda
