// What of a DXF drawing is handed to libdime. The library trusts its input: counts that do not
// hold, numbers that are none and blocks that insert themselves end in a crash. So the pairs of
// group code and value are read here first, entities that are no lines are counted and left out,
// and what remains is written anew, with every count true and every number a number.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

struct SafeDrawing {
  std::string text;                    ///< a DXF of LINE, LWPOLYLINE and POLYLINE alone
  std::vector<int> lines;              ///< of the file, where each entity of `text` began
  std::map<std::string, int> skipped;  ///< what was left out: how many of each kind
};

/// Faults at their line: it is a binary drawing or none at all, breaks off, or a line is not what
/// its group code asks for.
Result<SafeDrawing> safe_drawing(std::string_view text, const std::string& path);

}  // namespace edda
