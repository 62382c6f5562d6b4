// Texts of people: UTF-8, or what was meant to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace edda {

/// In place of bytes that are no UTF-8.
inline constexpr std::string_view replacement_character = "\xef\xbf\xbd";

/// Bytes of the character that begins at `at`; 0 where there is no valid one.
std::size_t character_size(std::string_view text, std::size_t at);

/// The text on one line that any drawing and any XML file takes: control characters become spaces,
/// what is no character the replacement character.
std::string printable(std::string_view text);

}  // namespace edda
