#include "imports/code_page.hpp"

#include <iconv.h>

#include <array>
#include <charconv>
#include <optional>

#include "base/text.hpp"
#include "imports/file_words.hpp"

namespace edda {
namespace {

/// Bytes that follow the first one of a character; nothing for a byte that begins none.
std::optional<std::size_t> following(unsigned char byte) {
  if (byte < 0x80U) return 0;
  if (byte >= 0xC2U && byte <= 0xDFU) return 1;
  if (byte >= 0xE0U && byte <= 0xEFU) return 2;
  if (byte >= 0xF0U && byte <= 0xF4U) return 3;
  return std::nullopt;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto more = following(static_cast<unsigned char>(text[i++]));
    if (!more || text.size() - i < *more) return false;
    for (std::size_t k = 0; k < *more; ++k) {
      if ((static_cast<unsigned char>(text[i++]) & 0xC0U) != 0x80U) return false;
    }
  }
  return true;
}

void append_utf8(std::string& text, unsigned code) {
  const auto tail = [&](unsigned shift) {
    text += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
  };
  if (code < 0x80U) {
    text += static_cast<char>(code);
  } else if (code < 0x800U) {
    text += static_cast<char>(0xC0U | (code >> 6U));
    tail(0);
  } else {
    text += static_cast<char>(0xE0U | (code >> 12U));
    tail(6);
    tail(0);
  }
}

/// "ANSI_1252" of the header, as iconv calls it: "CP1252".
std::string code_page_of(std::string_view drawing) {
  const std::size_t at = drawing.find("$DWGCODEPAGE");
  if (at == std::string_view::npos) return "CP1252";
  drawing.remove_prefix(at);
  next_line(drawing);
  next_line(drawing);
  const std::string_view name = trimmed(next_line(drawing));
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string_view::npos) return "CP1252";
  const std::string number(name.substr(digits));
  return (name.starts_with("ISO") || name.starts_with("iso")) ? "ISO-" + number : "CP" + number;
}

/// Nothing where iconv does not know the code page, or a byte is none of its characters.
std::optional<std::string> converted(std::string_view text, const std::string& from) {
  const iconv_t conversion = iconv_open("UTF-8", from.c_str());
  if (conversion == iconv_t(-1)) return std::nullopt;
  std::string input(text), output;
  char* in = input.data();
  std::size_t left = input.size();
  std::array<char, 4096> part{};
  bool good = true;
  while (good && left > 0) {
    char* out = part.data();
    std::size_t room = part.size();
    const std::size_t before = left;
    const bool whole = iconv(conversion, &in, &left, &out, &room) != static_cast<std::size_t>(-1);
    output.append(part.data(), part.size() - room);
    good = whole || left < before;
  }
  iconv_close(conversion);
  if (!good) return std::nullopt;
  return output;
}

/// Each byte as the character of that number (ISO 8859-1): whatever it is, it becomes text.
std::string byte_by_byte(std::string_view text) {
  std::string output;
  for (const char c : text) append_utf8(output, static_cast<unsigned char>(c));
  return output;
}

/// With \U+00FC as the character itself.
std::string without_escapes(std::string text) {
  constexpr std::string_view begin = "\\U+";
  constexpr std::size_t digits = 4;
  std::size_t at = text.find(begin);
  if (at == std::string::npos) return text;
  std::string output;
  std::size_t from = 0;
  for (; at != std::string::npos; at = text.find(begin, at + 1)) {
    if (at < from || text.size() - at < begin.size() + digits) continue;
    unsigned code = 0;
    const char* first = text.data() + at + begin.size();
    const auto [end, error] = std::from_chars(first, first + digits, code, 16);
    if (error != std::errc{} || end != first + digits || code < 0x20U) continue;
    output.append(text, from, at - from);
    append_utf8(output, code);
    from = at + begin.size() + digits;
  }
  return output.append(text, from);
}

}  // namespace

std::string utf8_of(std::string_view drawing) {
  if (is_utf8(drawing)) return without_escapes(std::string(drawing));
  for (const std::string& page : {code_page_of(drawing), std::string("CP1252")}) {
    if (auto text = converted(drawing, page)) return without_escapes(*std::move(text));
  }
  return without_escapes(byte_by_byte(drawing));
}

}  // namespace edda
