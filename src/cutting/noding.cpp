#include "cutting/noding.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/place.hpp"
#include "cutting/geos.hpp"
#include "cutting/snapping.hpp"

namespace edda {
namespace {

using geos::noding::SegmentString;

/// Owns the raw pointers in the vectors that GEOS returns.
class Strings {
 public:
  Strings() = default;
  explicit Strings(std::vector<SegmentString*>* taken) : items_(std::move(*taken)) { delete taken; }
  Strings(Strings&& other) noexcept : items_(std::exchange(other.items_, {})) {}
  Strings(const Strings&) = delete;
  Strings& operator=(const Strings&) = delete;
  Strings& operator=(Strings&& other) noexcept {
    items_.swap(other.items_);
    return *this;
  }
  ~Strings() {
    for (SegmentString* s : items_) delete s;
  }
  std::vector<SegmentString*>& items() { return items_; }

 private:
  std::vector<SegmentString*> items_;
};

/// The lines through their points as `place` moves them, without repeated points.
template <class Place>
Strings strings_of(const LineWork& work, Place place) {
  Strings strings;
  strings.items().reserve(work.lines.size());
  for (const LineString& line : work.lines) {
    auto points = std::make_unique<GeosPoints>();
    for (Vec2 p : line.points) points->add(place(geos::geom::Coordinate(p.x, p.y)), false);
    const LineSource* source = &work.sources[static_cast<std::size_t>(line.source)];
    strings.items().push_back(noded_string(std::move(points), source));
  }
  return strings;
}

/// The noded strings, or nothing where two of them still cross.
std::optional<Strings> noded_by(geos::noding::Noder& noder, Strings input) {
  noder.computeNodes(&input.items());
  Strings output(noder.getNodedSubstrings());
  geos::noding::FastNodingValidator validator(output.items());
  if (!validator.isValid()) return std::nullopt;
  return output;
}

/// Vertices are snapped first, so that crossings snap to them and not the other way round.
std::optional<Strings> by_snapping(const LineWork& work, double snap) {
  SnapPoints points(snap);
  SnappingAdder adder(snap, points);
  geos::noding::MCIndexNoder noder(&adder, 2.0 * snap);
  return noded_by(noder, strings_of(work, [&](const auto& p) { return points.snap(p); }));
}

std::optional<Strings> by_rounding(const LineWork& work, double snap) {
  const geos::geom::PrecisionModel grid(1.0 / snap);
  geos::noding::snapround::SnapRoundingNoder noder(&grid);
  return noded_by(noder, strings_of(work, [](const auto& p) { return p; }));
}

/// GEOS reports failures by exceptions; here they count as invalid noding.
template <class Noder>
std::optional<Strings> attempt(Noder noder, std::string& reason) {
  try {
    return noder();
  } catch (const std::exception& e) {
    reason = std::string(" (") + e.what() + ")";
    return std::nullopt;
  }
}

bool before(Vec2 a, Vec2 b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// Numbers the distinct points; edge k's ends are points[2k] and points[2k + 1] on entry.
void number_nodes(const std::vector<Vec2>& points, NodedLines& lines) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return before(at(i), at(j)); });
  for (int i : order) {
    if (lines.nodes.empty() || before(lines.nodes.back(), at(i))) lines.nodes.push_back(at(i));
    NodedEdge& edge = lines.edges[static_cast<std::size_t>(i) / 2];
    (i % 2 == 0 ? edge.from : edge.to) = static_cast<int>(lines.nodes.size()) - 1;
  }
}

NodedLines collect(Strings strings, const LineWork& work) {
  NodedLines lines;
  std::vector<Vec2> points;
  for (const SegmentString* s : strings.items()) {
    const auto source = static_cast<const LineSource*>(s->getData()) - work.sources.data();
    for (std::size_t i = 0; i + 1 < s->size(); ++i) {
      const auto& a = s->getCoordinate(i);
      const auto& b = s->getCoordinate(i + 1);
      if (a.x == b.x && a.y == b.y) continue;
      points.push_back({a.x, a.y});
      points.push_back({b.x, b.y});
      lines.edges.push_back({0, 0, static_cast<Index>(source)});
    }
  }
  number_nodes(points, lines);
  return lines;
}

}  // namespace

Result<NodedLines> node_lines(const LineWork& work, double snap, const Where& where,
                              Noding noding) {
  std::string reason;
  std::optional<Strings> strings;
  if (noding == Noding::automatic) {
    strings = attempt([&] { return by_snapping(work, snap); }, reason);
  }
  const bool snapped = strings.has_value();
  if (!snapped) strings = attempt([&] { return by_rounding(work, snap); }, reason);
  if (!strings) {
    return Fault{member_of(where, "snap"),
                 "the line work cannot be cut: lines still cross after snapping" + reason,
                 "raise domain.snap tenfold, or move apart lines that nearly coincide"};
  }
  NodedLines lines = collect(*std::move(strings), work);
  lines.snap_rounded = !snapped;
  return lines;
}

std::vector<LineString> line_strings(const NodedLines& lines) {
  std::vector<LineString> strings;
  strings.reserve(lines.edges.size());
  const auto node = [&](int i) { return lines.nodes[static_cast<std::size_t>(i)]; };
  for (const NodedEdge& edge : lines.edges) {
    strings.push_back({{node(edge.from), node(edge.to)}, edge.source});
  }
  return strings;
}

}  // namespace edda
