#include "imports/file_words.hpp"

#include <charconv>
#include <cmath>

namespace edda {

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::optional<double> place_number(std::string_view text) {
  constexpr double largest = 1e12;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value) || std::abs(value) > largest) return std::nullopt;
  return value;
}

std::vector<Word> words_of(std::string_view text, int first_line) {
  std::vector<Word> words;
  int line = first_line;
  std::size_t i = 0;
  const std::string_view between = " \t\r\n,;";
  while (i < text.size()) {
    if (text[i] == '\n') ++line;
    if (between.find(text[i]) != std::string_view::npos) {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(between, i), text.size());
    words.push_back({text.substr(i, end - i), line});
    i = end;
  }
  return words;
}

std::string for_message(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown;
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x20U || byte >= 0x7FU ? '?' : c;
  }
  return text.size() > longest ? shown + "..." : shown;
}

}  // namespace edda
