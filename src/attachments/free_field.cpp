#include "attachments/free_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "attachments/edges_on_line.hpp"

namespace edda {
namespace {

double p_modulus(const FreeFieldColumn& c, std::size_t k) {
  return c.lambda[k] + 2.0 * c.mu[k];
}

/// Stress on the horizontal plane of a cell, s_xy and s_yy.
Vec2 across(const FreeFieldColumn& c, const std::vector<Vec2>& u, std::size_t k) {
  const Vec2 strain = (u[k + 1] - u[k]) / c.cell;
  return {c.mu[k] * strain.x, p_modulus(c, k) * strain.y};
}

/// A side of the model: the row of its boundary, and 1 where its outward normal points to the
/// right, else 0.
using SideKey = std::pair<Index, int>;

/// Extent and blocks of a side of the model.
struct Side {
  double bottom = std::numeric_limits<double>::infinity();  ///< y, m
  double top = -std::numeric_limits<double>::infinity();
  double shortest = std::numeric_limits<double>::infinity();  ///< face, m
  std::vector<std::pair<double, Id>> blocks;                  ///< height of a point, its block
};

struct Sides {
  std::map<SideKey, Side> by_key;  ///< by boundary, left before right
  std::vector<SideKey> of_point;   ///< [points of Dashpots]; those of other boundaries have none
};

double height_of(const Dashpot& at, const BlockSet& b) {
  return weighted(at.weight, b.node_x, b.node_y, at.block).y;
}

/// Extends a side by the piece of face around a point at height y.
void extend(Side& side, const Dashpot& at, double y) {
  // Each piece of a face has two points, each with half of its length, 1/sqrt(3) of it apart.
  const double reach =
      at.node == no_id ? at.length * (1.0 - 1.0 / std::sqrt(3.0)) : 0.5 * at.length;
  side.bottom = std::min(side.bottom, y - reach);
  side.top = std::max(side.top, y + reach);
  side.shortest = std::min(side.shortest, 2.0 * at.length);
  side.blocks.emplace_back(y, at.block);
}

/// The sides with free-field boundaries, their blocks from the bottom up. Fills the heights and
/// tributary areas of their points.
Sides find_sides(const Model& model, const BlockSet& b, const Dashpots& dashpots,
                 FreeField& field) {
  Sides sides;
  sides.of_point.resize(dashpots.points.size());
  for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
    const Dashpot& at = dashpots.points[p];
    if (model.boundaries[static_cast<std::size_t>(at.boundary)].type != BoundaryType::free_field) {
      continue;
    }
    sides.of_point[p] = {at.boundary, at.normal.x > 0.0 ? 1 : 0};
    field.height[p] = height_of(at, b);
    field.face[p] = at.length * b.thickness;
    field.middle[p] = at.node == no_id ? field.height[p] : at.middle.y;
    extend(sides.by_key[sides.of_point[p]], at, field.middle[p]);
  }
  for (auto& [key, side] : sides.by_key) std::sort(side.blocks.begin(), side.blocks.end());
  return sides;
}

/// Speed of the P wave in the fastest block of a side, m/s.
double fastest_p_wave(const Side& side, const BlockSet& b) {
  double fastest = 0.0;
  for (const auto& [y, i] : side.blocks) {
    const double density = b.mass[i] / b.volume[i];
    fastest = std::max(fastest, std::sqrt((b.lame_lambda[i] + 2.0 * b.lame_mu[i]) / density));
  }
  return fastest;
}

/// Number of cells of a column: as high as the shortest face, but high enough for steps of `step`.
double cells_of(const Side& side, const BlockSet& b, double step) {
  constexpr double margin = 2.0, most = 2000.0;  // the step may be lengthened later
  const double height = side.top - side.bottom;
  const double least = std::isfinite(step) ? margin * fastest_p_wave(side, b) * step : 0.0;
  const double wanted = std::max({side.shortest, least, height / most});
  return std::max(1.0, std::floor(height / wanted));
}

/// Of the points of a side, the block of the one nearest to a height.
Id nearest_block(const Side& side, double height) {
  const auto nearest =
      std::min_element(side.blocks.begin(), side.blocks.end(), [&](const auto& p, const auto& q) {
        return std::abs(p.first - height) < std::abs(q.first - height);
      });
  return nearest->second;
}

/// Adds a cell of the rock of block i, on top; its stiffness is that of the wave speeds that the
/// boundary gives, if any.
void add_cell(FreeFieldColumn& c, const BlockSet& b, Id i, const Boundary& boundary) {
  c.density.push_back(b.mass[i] / b.volume[i]);
  if (boundary.wave_speeds) {
    const Vec2 speed = *boundary.wave_speeds;
    c.mu.push_back(c.density.back() * speed.y * speed.y);
    c.lambda.push_back(c.density.back() * speed.x * speed.x - 2.0 * c.mu.back());
  } else {
    c.mu.push_back(b.lame_mu[i]);
    c.lambda.push_back(b.lame_lambda[i]);
  }
}

/// The column beside a side, at rest.
FreeFieldColumn column_of(const SideKey& key, const Side& side, const Model& model,
                          const BlockSet& b, double step) {
  FreeFieldColumn c;
  c.boundary = key.first;
  c.outward = key.second == 1 ? 1.0 : -1.0;
  c.bottom = side.bottom;
  const double cells = cells_of(side, b, step);
  c.cell = (side.top - side.bottom) / cells;
  const auto nodes = static_cast<std::size_t>(cells) + 1;
  for (std::size_t k = 0; k + 1 < nodes; ++k) {
    const double middle = c.bottom + (static_cast<double>(k) + 0.5) * c.cell;
    add_cell(c, b, nearest_block(side, middle),
             model.boundaries[static_cast<std::size_t>(key.first)]);
  }
  c.moved.assign(nodes, {});
  c.velocity.assign(nodes, {});
  return c;
}

}  // namespace

std::size_t FreeFieldColumn::cell_at(double y) const {
  const double place = std::floor((y - bottom) / cell);
  const auto last = static_cast<double>(density.size() - 1);
  return static_cast<std::size_t>(std::clamp(place, 0.0, last));
}

Vec2 FreeFieldColumn::at(const std::vector<Vec2>& nodes, double y) const {
  const std::size_t k = cell_at(y);
  const double s = (y - bottom) / cell - static_cast<double>(k);
  return nodes[k] + s * (nodes[k + 1] - nodes[k]);
}

Vec2 FreeFieldColumn::traction(const std::vector<Vec2>& nodes, double y) const {
  const std::size_t k = cell_at(y);
  const Vec2 strain = (nodes[k + 1] - nodes[k]) / cell;
  return outward * Vec2{lambda[k] * strain.y, mu[k] * strain.x};
}

double FreeField::largest_step() const {
  double step = std::numeric_limits<double>::infinity();
  for (const FreeFieldColumn& c : columns) {
    for (std::size_t k = 0; k < c.density.size(); ++k) {
      step = std::min(step, 0.9 * c.cell * std::sqrt(c.density[k] / p_modulus(c, k)));
    }
  }
  return step;
}

FreeField attach_free_field(const Model& model, const BlockSet& b, const Dashpots& dashpots,
                            double step) {
  FreeField field;
  field.column.assign(dashpots.points.size(), none);
  field.height.assign(dashpots.points.size(), 0.0);
  field.middle = field.face = field.height;
  const Sides sides = find_sides(model, b, dashpots, field);
  std::map<SideKey, Index> number;
  for (const auto& [key, side] : sides.by_key) {
    number[key] = static_cast<Index>(field.columns.size());
    field.columns.push_back(column_of(key, side, model, b, step));
  }
  for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
    if (field.face[p] > 0.0) field.column[p] = number[sides.of_point[p]];
  }
  return field;
}

std::vector<FreeFieldColumn> next_columns(const std::vector<FreeFieldColumn>& columns,
                                          const FreeFieldDrive& drive, double h_old, double h_new) {
  std::vector<FreeFieldColumn> next = columns;
  const double h = 0.5 * (h_old + h_new), mass_damping = 0.5 * drive.mass_damping * h;
  for (std::size_t q = 0; q < columns.size(); ++q) {
    const FreeFieldColumn& c = columns[q];
    FreeFieldColumn& to = next[q];
    const std::size_t top = c.density.size();
    for (std::size_t k = 0; k <= top; ++k) {
      Vec2 force;
      double mass = 0.0, damper_x = 0.0, damper_y = 0.0;
      if (k < top) {
        force += across(c, c.moved, k);
        mass += 0.5 * c.density[k] * c.cell;
      }
      if (k > 0) {
        force -= across(c, c.moved, k - 1);
        mass += 0.5 * c.density[k - 1] * c.cell;
      }
      if (k == 0) {
        if (!drive.lets_waves_in) {
          to.velocity[0] = drive.ground;
          to.moved[0] += h_new * drive.ground;
          continue;
        }
        damper_x = std::sqrt(c.density[0] * c.mu[0]);
        damper_y = std::sqrt(c.density[0] * p_modulus(c, 0));
        force += Vec2{damper_x * drive.twice_incoming.x, damper_y * drive.twice_incoming.y};
      }
      force -= mass * drive.frame;
      const Vec2 v = c.velocity[k];
      if (k > 0) {  // the bottom is damped by its dashpot
        const auto damped = [&](double f, double along) {
          return f - (along == 0.0 ? 0.0 : std::copysign(drive.local_damping * std::abs(f), along));
        };
        force = {damped(force.x, v.x), damped(force.y, v.y)};
      }
      const auto kicked = [&](double before, double f, double damper) {
        const double half = 0.5 * h * damper / mass;
        return ((1.0 - mass_damping - half) * before + h * f / mass) / (1.0 + mass_damping + half);
      };
      to.velocity[k] = {kicked(v.x, force.x, damper_x), kicked(v.y, force.y, damper_y)};
      to.moved[k] += h_new * to.velocity[k];
    }
  }
  return next;
}

}  // namespace edda
