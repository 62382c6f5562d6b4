// Any bytes as a file of lines: a drawing, a table of traces, a geometry of DDA, by the first byte.
// Lines or one fault, never a crash; and where they bound blocks, blocks or faults.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "imports/drawing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const edda::Result<edda::Drawing> drawing = data[0] % 3 == 0 ? edda::parse_dxf(text, "fuzz.dxf")
                                              : data[0] % 3 == 1
                                                  ? edda::parse_geo(text, "fuzz.geo")
                                                  : edda::parse_traces(text, "fuzz.csv");
  if (!drawing.ok()) {
    const edda::Faults& faults = drawing.faults();
    if (faults.size() != 1 || faults[0].problem.empty() || faults[0].remedy.empty()) std::abort();
    if (edda::to_string(faults[0]).find('\n') != std::string::npos) std::abort();
    return 0;
  }
  for (const edda::DrawnLine& line : drawing.value().lines) {
    if (line.points.size() < 2) std::abort();
    for (const edda::Vec2 p : line.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) std::abort();
    }
  }
  return 0;
}
