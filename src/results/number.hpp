// Numbers as text.
#pragma once

#include <fmt/format.h>

#include <string>

namespace edda {

/// The shortest text that reads back to the same value (-0 becomes 0); "nan", "inf" and "-inf"
/// where it is not finite.
inline std::string shortest(double value) {
  return fmt::format("{}", value + 0.0);
}

}  // namespace edda
