// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace edda {

/// With so many digits at most, as %g has it.
inline std::string number_text(double value, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace edda
