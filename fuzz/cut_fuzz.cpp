// Any bytes as line work in a domain: blocks or faults, never a crash, and no area lost. The bytes
// are read as small whole numbers, so that lines meet in points, overlap and end on each other.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/polygon.hpp"
#include "cutting/build_polygons.hpp"
#include "model/read_model.hpp"

namespace {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  bool empty() const { return left_ == 0; }
  unsigned next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /// A coordinate: mostly on a coarse grid, at times a hair beside it.
  std::string place() {
    const unsigned b = next();
    const double fine[] = {0.0, 1e-9, -1e-9, 1e-7, 1e-5, 1e-3, 0.1, -0.3};
    return number(static_cast<double>(b % 24) - 4.0 + fine[b / 32]);
  }
  std::string point() { return "[" + place() + "," + place() + "]"; }
  std::string points(unsigned least, unsigned most) {
    const unsigned n = least + next() % (most - least + 1);
    std::string list = "[";
    for (unsigned k = 0; k < n; ++k) list += (k ? "," : "") + point();
    return list + "]";
  }
  static std::string number(double v) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", v);
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Why a cut is not one, or nothing.
const char* flaw_of(const edda::PolygonSet& set) {
  double sum = 0.0;
  for (const edda::BlockPolygon& p : set.blocks) {
    const double area = edda::moments(p.rings).area;
    if (!(area > 0.0)) return "a block without area";
    if (edda::self_crossing(p.rings.front())) return "a block that crosses itself";
    for (std::size_t r = 0; r < p.rings.size(); ++r) {
      if (p.joint[r].size() != p.rings[r].size()) return "edges without a law";
    }
    sum += area;
  }
  const edda::CutReport& report = set.report;
  if (!(std::abs(sum - report.area_out) <= 1e-9 * report.area_in)) return "area miscounted";
  // Rock may be lost along every line as far as lines are snapped together.
  constexpr double along_lines = 1e-5;  // m2
  if (!(std::abs(sum - report.area_in) <= 1e-6 * report.area_in + along_lines)) return "area lost";
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 400) return 0;  // a hundred lines say as much as a thousand, and are quicker
  Bytes bytes(data, size);
  std::string toml =
      "[materials.r]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\nfriction_angle = 30\n"
      "[solver]\nduration = 1\n[domain]\nmax_blocks = 3000\noutline = ";
  toml += bytes.next() % 4 == 0 ? bytes.points(3, 7) : "[[0,0],[16,0],[16,12],[0,12]]";
  toml += "\n";
  if (const unsigned poor = bytes.next(); poor % 4 != 0) {
    toml += "[quality]\nmin_edge = " + Bytes::number(poor / 256.0) +
            "\nmin_angle = " + std::to_string(poor % 20) + "\n";
  }
  for (unsigned n = 0; n < 60 && !bytes.empty(); ++n) {
    switch (bytes.next() % 8) {
      case 0:
        toml += "[[joint_set]]\nname = 's" + std::to_string(n) +
                "'\nangle = " + Bytes::number(bytes.next() * 180.0 / 256.0) +
                "\nspacing = " + Bytes::number(0.5 + bytes.next() / 32.0) + "\n";
        break;
      case 1:
        toml += "[[opening]]\nname = 'o" + std::to_string(n) +
                "'\npolygon = " + bytes.points(3, 6) + "\n";
        break;
      case 2:
        toml += "[[region]]\npolygon = " + bytes.points(3, 6) + "\n";
        break;
      case 3:
        toml += "[[joint_set]]\nname = 's" + std::to_string(n) +
                "'\nangle = " + Bytes::number(bytes.next() * 180.0 / 256.0) +
                "\nspacing = " + Bytes::number(0.5 + bytes.next() / 32.0) +
                "\ntrace_length = " + Bytes::number(0.5 + bytes.next() / 8.0) +
                "\ngap = " + Bytes::number(bytes.next() / 32.0) +
                "\ndeviation = { angle = 10, spacing = 0.2, trace_length = 0.4 }\n";
        break;
      default:
        toml += "[[trace]]\npoints = " + bytes.points(2, 4) + "\n";
    }
  }
  const edda::Result<edda::Model> model = edda::read_model_text(toml, "fuzz.toml", {});
  if (!model.ok()) return 0;
  const edda::Result<edda::PolygonSet> cut = edda::build_polygons(model.value());
  if (!cut.ok()) return 0;
  if (const char* flaw = flaw_of(cut.value())) {
    std::fprintf(stderr, "%s\n%s", flaw, toml.c_str());
    std::abort();
  }
  return 0;
}
