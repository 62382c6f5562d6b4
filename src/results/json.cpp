#include "results/json.hpp"

#include <cmath>

#include "results/utf8.hpp"

namespace edda {
namespace {

/// Text between quotes; bytes that are no valid UTF-8 become the replacement character.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = character_size(text, i);
    if (length == 0) {
      out += replacement_character;
      ++i;
      continue;
    }
    if (c == '"' || c == '\\') {
      out += '\\';
      out += text[i];
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += text.substr(i, length);
    }
    i += length;
  }
  return out;
}

}  // namespace

void Json::next_line() {
  if (!first_) text_ += ',';
  if (!ends_.empty()) {
    text_ += '\n';
    text_.append(2 * ends_.size(), ' ');
  }
  first_ = false;
}

Json& Json::raw(std::string_view content) {
  if (!after_key_) next_line();
  after_key_ = false;
  text_ += content;
  return *this;
}

Json& Json::open(char begin, char end) {
  raw(std::string_view(&begin, 1));
  ends_.push_back(end);
  first_ = true;
  return *this;
}

Json& Json::close() {
  const char end = ends_.back();
  ends_.pop_back();
  if (!first_) {
    text_ += '\n';
    text_.append(2 * ends_.size(), ' ');
  }
  text_ += end;
  first_ = false;
  if (ends_.empty()) text_ += '\n';
  return *this;
}

Json& Json::key(std::string_view name) {
  next_line();
  text_ += '"' + escaped(name) + "\": ";
  after_key_ = true;
  return *this;
}

Json& Json::value(double number) {
  return std::isfinite(number) ? raw(shortest(number)) : null();
}

Json& Json::value(std::string_view text) {
  return raw('"' + escaped(text) + '"');
}

std::string Json::line() const {
  return one_line(text_);
}

std::string one_line(std::string_view json) {
  std::string line;
  for (std::size_t k = 0; k < json.size(); ++k) {
    if (json[k] != '\n') {
      line += json[k];
      continue;
    }
    // Only the layout has line breaks and what follows them: those of texts are escaped.
    const bool after_comma = !line.empty() && line.back() == ',';
    while (k + 1 < json.size() && json[k + 1] == ' ') ++k;
    if (after_comma) line += ' ';
  }
  return line;
}

}  // namespace edda
