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
  c.block.push_back(i);
  c.density.push_back(b.mass[i] / b.volume[i]);
  if (boundary.wave_speeds) {
    const Vec2 speed = *boundary.wave_speeds;
    c.mu.push_back(c.density.back() * speed.y * speed.y);
    c.lambda.push_back(c.density.back() * speed.x * speed.x - 2.0 * c.mu.back());
  } else {
    c.mu.push_back(b.lame_mu[i]);
    c.lambda.push_back(b.lame_lambda[i]);
  }
  c.softer.push_back({c.mu.back() / b.lame_mu[i],
                      p_modulus(c, c.mu.size() - 1) / (b.lame_lambda[i] + 2.0 * b.lame_mu[i])});
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

Vec2 FreeFieldColumn::viscous_traction(const std::vector<double>& eta,
                                       const std::vector<Vec2>& nodes, double y) const {
  const std::size_t k = cell_at(y);
  const Vec2 rate = (nodes[k + 1] - nodes[k]) / cell;
  return (outward * eta[block[k]]) *
         Vec2{softer[k].y * lambda[k] * rate.y, softer[k].x * mu[k] * rate.x};
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

namespace {

/// Of the block beside cell k.
double value_of(const std::vector<double>* values, const FreeFieldColumn& c, std::size_t k,
                double otherwise) {
  return values == nullptr || values->empty() ? otherwise : (*values)[c.block[k]];
}

/// One direction of a column: (m_k + h d_k/2 + h C) v+ = (m_k - h d_k/2) v- + h f, with the
/// dashpots d and the viscosities c of the cells between nodes, by elimination from the bottom up.
struct Chain {
  std::vector<double> left, right, between;  ///< [nodes], [nodes], [cells] h c
  /// The bottom has the velocity v, whatever acts on it.
  void hold_bottom(double v) {
    left[1] += between[0];
    right[0] = v;
    right[1] += between[0] * v;
    left[0] = 1.0;
    between[0] = 0.0;
  }
  void solve() {
    const std::size_t top = between.size();
    for (std::size_t k = 0; k < top; ++k) {
      left[k] += between[k];
      left[k + 1] += between[k];
    }
    for (std::size_t k = 0; k < top; ++k) {
      const double part = between[k] / left[k];
      left[k + 1] -= part * between[k];
      right[k + 1] += part * right[k];
    }
    right[top] /= left[top];
    for (std::size_t k = top; k-- > 0;) right[k] = (right[k] + between[k] * right[k + 1]) / left[k];
  }
};

/// Forces, masses and mass-proportional damping (kg/s) of the nodes, m2.
struct ColumnNodes {
  std::vector<Vec2> force;
  std::vector<double> mass, decay;
};
ColumnNodes nodes_of(const FreeFieldColumn& c, const FreeFieldDrive& drive) {
  const std::size_t nodes = c.density.size() + 1;
  ColumnNodes n{std::vector<Vec2>(nodes), std::vector<double>(nodes), std::vector<double>(nodes)};
  for (std::size_t k = 0; k + 1 < nodes; ++k) {
    const Vec2 stress = across(c, c.moved, k);
    const double half = 0.5 * c.density[k] * c.cell,
                 decay = half * value_of(drive.decay, c, k, drive.mass_damping);
    n.force[k] += stress;
    n.force[k + 1] -= stress;
    for (const std::size_t at : {k, k + 1}) {
      n.mass[at] += half;
      n.decay[at] += decay;
    }
  }
  for (std::size_t k = 0; k < nodes; ++k) n.force[k] -= n.mass[k] * drive.frame;
  return n;
}

/// The column a step later. Its bottom moves with the ground, or has no local damping: a
/// dashpot takes what goes down.
void advance(const FreeFieldColumn& c, const FreeFieldDrive& drive, double h, double h_new,
             FreeFieldColumn& to) {
  const ColumnNodes n = nodes_of(c, drive);
  const std::size_t nodes = n.mass.size();
  for (double Vec2::*of : {&Vec2::x, &Vec2::y}) {
    const bool along_x = of == &Vec2::x;
    const auto modulus = [&](std::size_t k) { return along_x ? c.mu[k] : p_modulus(c, k); };
    Chain chain{std::vector<double>(nodes), std::vector<double>(nodes),
                std::vector<double>(nodes - 1)};
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
      const double eta = value_of(drive.viscosity, c, k, 0.0);
      if (eta > 0.0) chain.between[k] = h * eta * c.softer[k].*of * modulus(k) / c.cell;
    }
    for (std::size_t k = 0; k < nodes; ++k) {
      const double before = c.velocity[k].*of;
      double damper = n.decay[k], force = n.force[k].*of;
      if (k == 0) {
        const double outgoing = std::sqrt(c.density[0] * modulus(0));
        damper += outgoing;
        force += outgoing * drive.twice_incoming.*of;
      } else if (before != 0.0) {
        force -= std::copysign(drive.local_damping * std::abs(force), before);
      }
      chain.left[k] = n.mass[k] + 0.5 * h * damper;
      chain.right[k] = (n.mass[k] - 0.5 * h * damper) * before + h * force;
    }
    if (!drive.lets_waves_in) chain.hold_bottom(drive.ground.*of);
    chain.solve();
    for (std::size_t k = 0; k < nodes; ++k) {
      to.velocity[k].*of = chain.right[k];
      to.moved[k].*of += h_new * chain.right[k];
    }
  }
}

}  // namespace

std::vector<FreeFieldColumn> next_columns(const std::vector<FreeFieldColumn>& columns,
                                          const FreeFieldDrive& drive, double h_old, double h_new) {
  std::vector<FreeFieldColumn> next = columns;
  for (std::size_t q = 0; q < columns.size(); ++q)
    advance(columns[q], drive, 0.5 * (h_old + h_new), h_new, next[q]);
  return next;
}

}  // namespace edda
