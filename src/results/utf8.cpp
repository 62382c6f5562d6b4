#include "results/utf8.hpp"

namespace edda {

// Table 3-7 of the Unicode standard: the shortest form only, and no halves of UTF-16's pairs.
std::size_t character_size(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
  const unsigned char c = byte(0);
  const std::size_t size = c < 0x80                ? 1
                           : c >= 0xc2 && c < 0xe0 ? 2
                           : c >= 0xe0 && c < 0xf0 ? 3
                           : c >= 0xf0 && c < 0xf5 ? 4
                                                   : 0;
  if (size == 0 || at + size > text.size()) return 0;
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return 0;
  }
  const bool too_long = (c == 0xe0 && byte(1) < 0xa0) || (c == 0xf0 && byte(1) < 0x90);
  const bool beyond = (c == 0xed && byte(1) > 0x9f) || (c == 0xf4 && byte(1) > 0x8f);
  return too_long || beyond ? 0 : size;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = character_size(text, at);
    const std::string_view character = text.substr(at, size);
    const auto c = static_cast<unsigned char>(text[at]);
    if (size == 0 || character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf") {
      out += replacement_character;
    } else if ((size == 1 && (c < 0x20 || c == 0x7f)) ||
               (size == 2 && c == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0)) {
      out += ' ';
    } else {
      out += character;
    }
    at += size == 0 ? 1 : size;
  }
  return out;
}

}  // namespace edda
