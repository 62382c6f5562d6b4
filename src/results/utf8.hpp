// Texts from users: UTF-8, valid or not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace edda {

/// In place of bytes that are no UTF-8.
inline constexpr std::string_view replacement_character = "\xef\xbf\xbd";

/// Bytes of the character that begins at `at`; 0 where there is no valid one.
std::size_t character_size(std::string_view text, std::size_t at);

/// The text on one line in a form for drawings and XML files: control characters become spaces,
/// invalid bytes the replacement character.
std::string printable(std::string_view text);

}  // namespace edda
