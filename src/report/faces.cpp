#include "report/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "report/shapes.hpp"

namespace edda {
namespace {

/// A point of the diagram: its position along the face, and the pressure there.
struct Station {
  double along, pressure;
};

/// The ends of the part that carries, and the points where the pressure changes its sign or reaches
/// the limit at which it is cut.
std::vector<Station> stations_of(const DrawnFace& face, double most) {
  Station from{0.0, face.pressure_a}, to{1.0, face.pressure_b};
  if (face.pressure_b == 0.0) to.along = face.closed;
  if (face.pressure_a == 0.0) from.along = 1.0 - face.closed;
  std::vector<Station> stations{from, to};
  for (const double level : {0.0, most, -most}) {
    const double before = from.pressure - level, behind = to.pressure - level;
    if (before * behind >= 0.0) continue;
    stations.push_back({from.along + before / (before - behind) * (to.along - from.along), level});
  }
  std::sort(stations.begin(), stations.end(),
            [](const Station& p, const Station& q) { return p.along < q.along; });
  return stations;
}

/// Across the face: upwards, of a steep one to the left, so that parallel joints have their
/// diagrams on the same side.
Vec2 upper_side(Vec2 along) {
  constexpr Vec2 up{-0.3, 1.0};
  const Vec2 across = perp(along);
  return dot(across, up) < 0.0 ? -across : across;
}

/// An edge of a block with the displacements of its ends, m.
struct MovedEdge {
  Vec2 p, q, of_p, of_q;
};
std::vector<MovedEdge> moved_edges(const Grid& blocks, const BlockShape& shape,
                                   const std::vector<Vec2>& points) {
  const Field* u = blocks.point_field("displacement");
  std::vector<MovedEdge> edges;
  if (u == nullptr) return edges;
  const auto of_point = [&](std::int64_t point) {
    const auto at = 3 * static_cast<std::size_t>(point);
    return Vec2{u->values[at], u->values[at + 1]};
  };
  for (const auto& [first, second] : shape.outline)
    edges.push_back({points[static_cast<std::size_t>(first)],
                     points[static_cast<std::size_t>(second)], of_point(first), of_point(second)});
  return edges;
}

/// Displacement of a point on the outline.
Vec2 displacement_at(Vec2 at, const std::vector<MovedEdge>& edges) {
  Vec2 moved;
  double least = std::numeric_limits<double>::infinity();
  for (const MovedEdge& e : edges) {
    const double off = distance_to_segment(at, e.p, e.q);
    if (off >= least) continue;
    least = off;
    const Vec2 along = e.q - e.p;
    const double size = dot(along, along),
                 part = size > 0.0 ? std::clamp(dot(at - e.p, along) / size, 0.0, 1.0) : 0.0;
    moved = (1.0 - part) * e.of_p + part * e.of_q;
  }
  return moved;
}

}  // namespace

std::vector<DrawnFace> drawn_faces(const Grid& contacts) {
  constexpr std::array names{
      "x_a",    "y_a",           "x_b",  "y_b", "normal_stress_a", "normal_stress_b",
      "length", "closed_length", "state"};
  std::array<const double*, names.size()> columns{};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Field* field = contacts.cell_field(names[k]);
    if (field == nullptr) return {};
    columns[k] = field->values.data();
  }
  std::vector<DrawnFace> faces(contacts.cell_count());
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const auto value = [&](std::size_t k) { return columns[k][c]; };
    DrawnFace& face = faces[c];
    face.a = {value(0), value(1)};
    face.b = {value(2), value(3)};
    face.pressure_a = value(4);
    face.pressure_b = value(5);
    face.closed = value(6) > 0.0 ? value(7) / value(6) : 0.0;
    face.open = value(8) == 0.0;
  }
  return faces;
}

std::vector<DrawnFace> drawn_faces(const Grid& contacts, const Grid& blocks, double scale) {
  std::vector<DrawnFace> faces = drawn_faces(contacts);
  const Field *j = contacts.cell_field("block_j"), *id = blocks.cell_field("id");
  if (scale == 1.0 || j == nullptr || id == nullptr) return faces;
  const std::vector<Vec2> points = drawn_points(blocks, 1.0);
  std::map<double, std::vector<MovedEdge>> of_block;
  for (const BlockShape& shape : block_shapes(blocks))
    of_block.emplace(id->values[shape.first_cell], moved_edges(blocks, shape, points));
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const auto found = of_block.find(j->values[c]);
    if (found == of_block.end()) continue;
    for (Vec2* end : {&faces[c].a, &faces[c].b})
      *end += (scale - 1.0) * displacement_at(*end, found->second);
  }
  return faces;
}

std::vector<PressureArea> pressure_diagram(const DrawnFace& face, double per_unit, double most) {
  std::vector<PressureArea> areas;
  const double length = norm(face.b - face.a);
  if (!(length > 0.0) || (face.pressure_a == 0.0 && face.pressure_b == 0.0)) return areas;
  const Vec2 across = upper_side((face.b - face.a) / length);
  const std::vector<Station> stations = stations_of(face, most);
  PressureArea area;
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const double pressure = stations[k].pressure;
    const Vec2 base = face.a + stations[k].along * (face.b - face.a);
    if (k == 0) area.ring = {base};
    if (pressure != 0.0) {
      area.ring.push_back(base + per_unit * std::clamp(pressure, -most, most) * across);
      area.tension = pressure < 0.0;
    }
    if (k == 0 || (pressure != 0.0 && k + 1 < stations.size())) continue;
    area.ring.push_back(base);
    areas.push_back(area);
    area.ring = {base};
  }
  return areas;
}

}  // namespace edda
