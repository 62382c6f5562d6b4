// Lines, words and numbers of a text, with their line numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edda {

/// Removes the next line from `rest` and returns it without its end (LF, CR LF).
std::string_view next_line(std::string_view& rest);

/// Reads a text that is as a whole a finite number of magnitude at most 1e12 (larger ones are no
/// coordinates).
std::optional<double> place_number(std::string_view text);

struct Word {
  std::string_view text;
  int line = 0;
};

/// The words between blanks, commas and line ends. `first_line`: number of the text's first line.
std::vector<Word> words_of(std::string_view text, int first_line = 1);

/// The text in a form for messages: on one line, printable, at most 40 characters.
std::string for_message(std::string_view text);

}  // namespace edda
