// Lines, words and numbers of a text, with the number of the line they stand on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edda {

/// The next line of `rest`, which it is taken off; without its end (LF, CR LF).
std::string_view next_line(std::string_view& rest);

/// A whole text that is a finite number of at most 1e12 in size (lengths beyond are no places).
std::optional<double> place_number(std::string_view text);

struct Word {
  std::string_view text;
  int line = 0;
};

/// What stands between blanks, commas and line ends. `first_line`: number of the text's first line.
std::vector<Word> words_of(std::string_view text, int first_line = 1);

/// The text fit for a message: on one line, printable, at most 40 characters.
std::string for_message(std::string_view text);

}  // namespace edda
