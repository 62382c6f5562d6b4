#include "report/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace edda {
namespace {

/// A point of the diagram: so far along the face, and the pressure there.
struct Station {
  double along, pressure;
};

/// The ends of what bears, and where the pressure changes its sign or reaches what it is cut at.
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

}  // namespace

std::vector<DrawnFace> drawn_faces(const Grid& contacts, double scale) {
  constexpr std::array names{
      "x_a",    "y_a",           "x_b",  "y_b", "normal_stress_a", "normal_stress_b",
      "length", "closed_length", "state"};
  std::array<const double*, names.size()> columns{};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Field* field = contacts.cell_field(names[k]);
    if (field == nullptr) return {};
    columns[k] = field->values.data();
  }
  const Field* moved = contacts.cell_field("displacement");
  std::vector<DrawnFace> faces(contacts.cell_count());
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const auto value = [&](std::size_t k) { return columns[k][c]; };
    const double* const u = moved == nullptr ? nullptr : moved->values.data() + 3 * c;
    const Vec2 further = u == nullptr ? Vec2{} : (scale - 1.0) * Vec2{u[0], u[1]};
    DrawnFace& face = faces[c];
    face.a = Vec2{value(0), value(1)} + further;
    face.b = Vec2{value(2), value(3)} + further;
    // No -0, which would be printed.
    face.pressure_a = 0.0 - value(4);
    face.pressure_b = 0.0 - value(5);
    face.closed = value(6) > 0.0 ? value(7) / value(6) : 0.0;
    face.open = value(8) == 0.0;
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
    const Vec2 foot = face.a + stations[k].along * (face.b - face.a);
    if (k == 0) area.ring = {foot};
    if (pressure != 0.0) {
      area.ring.push_back(foot + per_unit * std::clamp(pressure, -most, most) * across);
      area.tension = pressure < 0.0;
    }
    if (k == 0 || (pressure != 0.0 && k + 1 < stations.size())) continue;
    area.ring.push_back(foot);
    areas.push_back(area);
    area.ring = {foot};
  }
  return areas;
}

}  // namespace edda
