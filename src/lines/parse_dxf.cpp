// DXF drawings, read by libdime from what dxf_groups.cpp found safe.
#include <cstdio>
#include <memory>

#include "base/arc.hpp"
#include "lines/dime.hpp"
#include "lines/drawing.hpp"
#include "lines/dxf_groups.hpp"

namespace edda {
namespace {

/// Straight pieces of a full turn that arcs are drawn with.
constexpr int arc_segments = 48;

struct Corner {
  Vec2 point;
  double bulge = 0.0;  ///< of the side that begins here
};

std::vector<Vec2> polyline(const std::vector<Corner>& corners, bool closed) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.push_back(corners[i].point);
    if (i + 1 == corners.size() && !closed) break;
    const Vec2 to = corners[i + 1 == corners.size() ? 0 : i + 1].point;
    const auto arc = bulge_corners(corners[i].point, to, corners[i].bulge, arc_segments);
    points.insert(points.end(), arc.begin(), arc.end());
  }
  if (closed && corners.size() > 1) points.push_back(corners[0].point);
  return points;
}

std::vector<Corner> corners_of(const dimeLWPolyline& line) {
  std::vector<Corner> corners;
  for (int i = 0; i < line.getNumVertices(); ++i) {
    corners.push_back({{line.getXCoords()[i], line.getYCoords()[i]},
                       line.getBulges() == nullptr ? 0.0 : line.getBulges()[i]});
  }
  return corners;
}

std::vector<Corner> corners_of(dimePolyline& line) {
  std::vector<Corner> corners;
  for (int i = 0; i < line.getNumCoordVertices(); ++i) {
    const dimeVertex& vertex = *line.getCoordVertex(i);
    dimeParam bulge;
    bulge.double_data = 0.0;
    constexpr int bulge_code = 42;
    vertex.getRecord(bulge_code, bulge);
    corners.push_back({{vertex.getCoords().x, vertex.getCoords().y}, bulge.double_data});
  }
  return corners;
}

struct Reading {
  Drawing drawing;
  const std::vector<int>* lines;  ///< of the file, of each entity
  std::size_t entity = 0;
};

bool take(const dimeState*, dimeEntity* entity, void* data) {
  auto& reading = *static_cast<Reading*>(data);
  std::vector<Vec2> points;
  if (auto* line = dynamic_cast<dimeLine*>(entity)) {
    for (int i = 0; i < 2; ++i) points.push_back({line->getCoords(i).x, line->getCoords(i).y});
  } else if (auto* light = dynamic_cast<dimeLWPolyline*>(entity)) {
    points = polyline(corners_of(*light), (light->getFlags() & 1) != 0);
  } else if (auto* poly = dynamic_cast<dimePolyline*>(entity)) {
    points = polyline(corners_of(*poly), (poly->getFlags() & dimePolyline::CLOSED) != 0);
  } else {
    return true;
  }
  const std::size_t i = reading.entity++;
  const int line = i < reading.lines->size() ? (*reading.lines)[i] : 0;
  const char* layer = entity->getLayerName();
  if (points.size() > 1) {
    reading.drawing.lines.push_back({std::move(points), layer == nullptr ? "0" : layer, line});
  } else {
    ++reading.drawing.skipped["POLYLINE of one point"];
  }
  return true;
}

}  // namespace

Result<Drawing> parse_dxf(std::string_view text, const std::string& path) {
  Result<SafeDrawing> safe = safe_drawing(text, path);
  if (!safe.ok()) return safe.faults();
  std::string& content = safe.value().text;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      fmemopen(content.data(), content.size(), "r"), &std::fclose);
  dimeInput input;
  dimeModel model;
  if (!file || !input.setFileHandle(file.get()) || !model.read(&input)) {
    return Fault{{"", path, 0, 0},
                 "cannot be read as a DXF drawing",
                 "save it again as an ASCII DXF drawing, or export the lines as .csv"};
  }
  Reading reading{{}, &safe.value().lines, 0};
  model.traverseEntities(&take, &reading, false, false, false);
  for (const auto& [kind, count] : safe.value().skipped) reading.drawing.skipped[kind] += count;
  return std::move(reading.drawing);
}

}  // namespace edda
