// Contacts of a frame, made by hand: faces with pressures.
#pragma once

#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "results/grid.hpp"

namespace edda {

/// Block j lies on the left on the way from a to b.
struct TestFace {
  Vec2 a, b;
  double stress_a = 0.0, stress_b = 0.0;  ///< Pa, compression positive
  double closed = 1.0;                    ///< fraction of its length that carries
  double state = 1.0;
  double block_i = 4.0, block_j = 5.0;
  Vec2 displacement{};
  double broken_by = 0.0;  ///< 1 tension, 2 shear
};

/// With the forces of these pressures, 1 m thick, and a fifth of them as shear.
inline Grid face_grid(const std::vector<TestFace>& faces) {
  Grid g;
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    Field* field = nullptr;
    for (Field& f : g.cell_fields) field = f.name == name ? &f : field;
    const bool whole = name.starts_with("block_") || name == "state" || name == "broken_by";
    if (field == nullptr)
      field = &g.cell_fields.emplace_back(Field{name, values.size(), {}, {}, whole});
    field->values.insert(field->values.end(), values.begin(), values.end());
  };
  for (const TestFace& f : faces) {
    const Vec2 middle = 0.5 * (f.a + f.b), t = unit(f.b - f.a);
    const double length = norm(f.b - f.a), mean = 0.5 * f.closed * (f.stress_a + f.stress_b);
    const double normal = mean * length, shear = 0.2 * mean * length;
    const Vec2 force = -normal * perp(t) + shear * t;
    g.corners.push_back(static_cast<std::int64_t>(g.point_count()));
    g.points.insert(g.points.end(), {middle.x, middle.y, 0.0});
    g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
    g.types.push_back(cell_type::vertex);
    add("block_i", {f.block_i});
    add("block_j", {f.block_j});
    add("state", {f.state});
    add("normal_force", {normal});
    add("shear_force", {shear});
    add("force", {force.x, force.y, 0.0});
    add("opening", {0.0});
    add("slip", {0.0});
    add("displacement", {f.displacement.x, f.displacement.y, 0.0});
    add("length", {length});
    add("closed_length", {f.closed * length});
    add("damage", {f.broken_by > 0.0 ? 1.0 : 0.25});
    add("broken_by", {f.broken_by});
    add("x_a", {f.a.x});
    add("y_a", {f.a.y});
    add("x_b", {f.b.x});
    add("y_b", {f.b.y});
    add("normal_stress", {mean});
    add("shear_stress", {0.2 * mean});
    add("normal_stress_a", {f.stress_a});
    add("normal_stress_b", {f.stress_b});
  }
  return g;
}

}  // namespace edda
