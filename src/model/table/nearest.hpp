// "Did you mean ...": the nearest of the known words.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace edda {

/// The text on one line and of a length fit for a message: control characters as "?", cut after 40
/// bytes between characters.
std::string clipped(std::string_view text);

/// Whether a byte is a control character, such as a line break or an escape.
inline bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20U || c == 0x7F;
}

/// Up to this number of edits a word counts as a misspelling of another.
inline constexpr int likely_edits = 2;

/// Edits (insert, delete, replace, swap of neighbours) from a to b, ignoring case.
int edit_distance(std::string_view a, std::string_view b);

/// The word of `known` with the fewest edits from `word`, the first of equals; empty if none. A
/// word that contains the other ("friction", "friction_angle") counts as likely_edits away.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

/// The words of `known`, those with the fewest edits from `word` first.
std::vector<std::string_view> nearest_first(std::string_view word,
                                            std::span<const std::string_view> known);

/// `"a", "b", "c"`, cut off after a dozen.
std::string quoted_list(std::span<const std::string_view> words);

/// Whether `word` may be a misspelling of the nearest of `known`.
bool is_likely(std::string_view word, std::span<const std::string_view> known);

/// `did you mean "rock"?`, or the list of known words, the nearest first.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace edda
