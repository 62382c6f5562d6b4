#include "report/relative.hpp"

#include "report/shapes.hpp"

namespace edda {
namespace {

/// Points have three coordinates, and so have displacements.
void shift(std::vector<double>& values, Vec2 by) {
  for (std::size_t k = 0; k + 1 < values.size(); k += 3) {
    values[k] -= by.x;
    values[k + 1] -= by.y;
  }
}

void shift(Grid& grid, Vec2 by) {
  shift(grid.points, by);
  for (auto* fields : {&grid.point_fields, &grid.cell_fields}) {
    for (Field& field : *fields) {
      if (field.name == "displacement" && field.components == 3) shift(field.values, by);
      // Ends of faces.
      const bool is_x = field.name == "x_a" || field.name == "x_b";
      const bool is_y = field.name == "y_a" || field.name == "y_b";
      if (!is_x && !is_y) continue;
      for (double& value : field.values) value -= is_x ? by.x : by.y;
    }
  }
}

}  // namespace

bool move_with(Snapshot& shot, Vec2 start) {
  const std::vector<Vec2> now = drawn_points(shot.blocks, 1.0);
  const std::optional<Vec2> place =
      Follower(shot.blocks, drawn_points(shot.blocks, 0.0), now).on_surface(start);
  if (!place) return false;
  const Vec2 moved = *place - start;
  shift(shot.blocks, moved);
  if (shot.contacts) shift(*shot.contacts, moved);
  if (shot.bolts) {
    for (BoltChain& bolt : *shot.bolts) {
      for (Vec2& p : bolt.points) p = p - moved;
    }
  }
  for (LiningDiagram& lining : shot.linings) {
    for (Vec2& p : lining.points) p = p - moved;
  }
  return true;
}

bool move_with(Table& history, const std::string& monitor) {
  bool found = false;
  for (const std::string ending : {".ux", ".uy", ".vx", ".vy", ".ax", ".ay"}) {
    const Column* const of = history.column(monitor + ending);
    if (of == nullptr) continue;
    found = true;
    const std::vector<double> by = of->values;
    for (Column& column : history.columns) {
      if (!column.name.ends_with(ending)) continue;
      for (std::size_t r = 0; r < by.size(); ++r) column.values[r] -= by[r];
    }
  }
  return found;
}

}  // namespace edda
