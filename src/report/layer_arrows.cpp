// Vectors, contact forces and principal stresses: lines whose length is a quantity.
#include <algorithm>
#include <cmath>

#include "report/scene.hpp"

namespace edda {
namespace {

constexpr double shaft = 0.6;          // pt
constexpr double widest_casing = 0.7;  // pt of white about lines, so that they show on any colour

struct Arrow {
  Vec2 at, vector;
  double weight = 1.0;  ///< area of its block, m2; 0 for a fixed one
};

/// Least distance on paper between the marks of neighbouring blocks; closer ones are left out.
double raster(const PlotScene& s) {
  return 1.6 * s.font / s.view.scale;
}

double side_of(const PlotScene& s, const BlockShape& shape) {
  double twice = 0.0;
  for (const auto& [a, b] : shape.outline) {
    twice += cross(s.points[static_cast<std::size_t>(a)], s.points[static_cast<std::size_t>(b)]);
  }
  return std::sqrt(0.5 * std::abs(twice));
}

/// A block, or a zone of one whose zones have values of their own.
struct MarkedPart {
  Vec2 at;
  std::size_t cell;
  double side;  ///< root of its area, m
};

Vec2 middle_of(const PlotScene& s, std::size_t cell) {
  const std::size_t from = s.grid().begin(cell), to = static_cast<std::size_t>(s.grid().ends[cell]);
  Vec2 sum;
  for (std::size_t k = from; k < to; ++k)
    sum += s.points[static_cast<std::size_t>(s.grid().corners[k])];
  return sum / static_cast<double>(to - from);
}

/// Of parts that lie close together some.
std::vector<MarkedPart> marked_parts(const PlotScene& s, const Field& field) {
  const std::vector<double> areas = cell_areas(s.grid());
  const auto value = [&](std::size_t cell) {
    return field.values.begin() + static_cast<std::ptrdiff_t>(cell * field.components);
  };
  std::vector<MarkedPart> all, shown;
  for (const BlockShape& shape : s.shapes) {
    const std::size_t first = shape.first_cell, end = shape.end_cell;
    bool one = true;
    for (std::size_t c = first; one && c < end; ++c)
      one = std::equal(value(first), value(first + 1), value(c));
    if (one) all.push_back({mark_place(s.grid(), shape, s.points), first, side_of(s, shape)});
    for (std::size_t c = first; !one && c < end; ++c)
      all.push_back({middle_of(s, c), c, std::sqrt(areas[c])});
  }
  std::vector<Vec2> centres;
  for (const MarkedPart& part : all) centres.push_back(part.at);
  for (const std::size_t i : thinned(centres, raster(s))) shown.push_back(all[i]);
  return shown;
}

std::vector<Arrow> block_arrows(const PlotScene& s, const std::string& name) {
  std::vector<Arrow> arrows;
  const Field* field = s.grid().cell_field(name);
  if (field == nullptr || field->components < 2) return arrows;
  for (const MarkedPart& part : marked_parts(s, *field)) {
    const double* v = field->values.data() + part.cell * field->components;
    const double side = is_fixed(s.grid(), part.cell) ? 0.0 : part.side;
    arrows.push_back({part.at, {v[0], v[1]}, side * side});
  }
  return arrows;
}

std::vector<Arrow> force_arrows(const PlotScene& s) {
  std::vector<Arrow> arrows;
  if (!s.shot.contacts) return arrows;
  const Field* force = s.shot.contacts->cell_field("force");
  if (force == nullptr) return arrows;
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    arrows.push_back({s.contacts[c], {force->values[3 * c], force->values[3 * c + 1]}});
  }
  return arrows;
}

/// `whole`: no arrow is longer than longest(); else a few may be, by longest_beyond.
template <class ArrowsOf>
ArrowScale arrow_scale(const std::vector<PlotScene>& scenes, bool whole, ArrowsOf arrows_of) {
  std::vector<Weighed> sizes;
  for (const PlotScene& s : scenes) {
    for (const Arrow& a : arrows_of(s)) {
      if (!is_inside(s, a.at) || !std::isfinite(norm(a.vector))) continue;
      sizes.push_back({norm(a.vector), a.weight});
    }
  }
  return scale_for(sizes, whole, longest(scenes.front()));
}

/// First all casings, then all arrows, so that no casing covers an arrow.
void draw_arrows(Canvas& canvas, const PlotScene& s, const std::vector<Arrow>& arrows,
                 const ArrowScale& scale, Colour colour, bool ends_at, double casing) {
  if (scale.per_unit == 0.0) return;
  constexpr double shortest = 0.8;  // pt
  std::vector<std::pair<Vec2, Vec2>> shafts;
  std::vector<std::size_t> beyond;
  for (const Arrow& a : arrows) {
    const Vec2 p = s.view.at(a.at);
    Vec2 v = scale.per_unit * Vec2{a.vector.x, -a.vector.y};
    if (!is_inside(s, a.at) || !std::isfinite(norm(v)) || norm(v) < shortest) continue;
    if (scale.longest > 0.0 && norm(v) > scale.longest) {
      v = scale.longest / norm(v) * v;
      beyond.push_back(shafts.size());
    }
    shafts.emplace_back(ends_at ? p - v : p, ends_at ? p : p + v);
  }
  canvas.colour(ink::white, 0.75);
  for (const auto& [from, to] : shafts) {
    if (norm(to - from) > 3.0 * shaft) canvas.line(from, to, shaft + casing);
  }
  canvas.colour(colour);
  for (const auto& [from, to] : shafts) canvas.arrow(from, to, shaft);
  for (const std::size_t k : beyond) {
    const auto& [from, to] = shafts[k];
    canvas.arrow(from, to - 0.12 * (to - from), shaft);
  }
}

/// Principal stresses of a block: sizes (tension positive) and the direction of the first.
struct Principal {
  double first = 0.0, second = 0.0, angle = 0.0;
};

Principal principal_of(const double* stress) {
  const double xx = stress[0], yy = stress[1], xy = stress[3];
  const double mean = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy);
  return {mean + radius, mean - radius, 0.5 * std::atan2(2.0 * xy, xx - yy)};
}

struct StressCross {
  Vec2 at;
  Principal stress;
  double room = 0.0;  ///< side of its block or zone, m
};

/// Value below which `part` of them lie.
double quantile(std::vector<double> values, double part) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<StressCross> stress_crosses(const PlotScene& s) {
  std::vector<StressCross> crosses;
  const Field* stress = s.grid().cell_field("stress");
  if (stress == nullptr) return crosses;
  for (const MarkedPart& part : marked_parts(s, *stress)) {
    if (is_fixed(s.grid(), part.cell) || !is_inside(s, part.at)) continue;
    crosses.push_back(
        {part.at, principal_of(stress->values.data() + part.cell * stress->components), part.side});
  }
  return crosses;
}

double size_of(const StressCross& c) {
  return std::max(std::abs(c.stress.first), std::abs(c.stress.second));
}

/// One arm of a cross, `half` pt either way: a plain line in compression, arrows outward in
/// tension.
void draw_arm(Canvas& canvas, Vec2 at, Vec2 way, double half, bool tension) {
  if (!tension) {
    canvas.colour(ink::compression);
    canvas.line(at - half * way, at + half * way, 0.8);
    return;
  }
  canvas.colour(ink::tension);
  canvas.arrow(at, at + half * way, 0.8);
  canvas.arrow(at, at - half * way, 0.8);
}

}  // namespace

ArrowScale vector_scale(const std::vector<PlotScene>& scenes, const PlotOptions& options) {
  return arrow_scale(scenes, options.whole_range,
                     [&](const PlotScene& s) { return block_arrows(s, options.vectors); });
}

void draw_vectors(Canvas& canvas, const PlotScene& s, const std::string& name,
                  const ArrowScale& scale) {
  draw_arrows(canvas, s, block_arrows(s, name), scale, ink::vector, false, widest_casing);
}

ArrowScale force_scale(const std::vector<PlotScene>& scenes) {
  return arrow_scale(scenes, true, force_arrows);
}

void draw_forces(Canvas& canvas, const PlotScene& s, const ArrowScale& scale) {
  // The smaller the blocks, the more crosses there are, and the closer.
  const double casing = std::min(widest_casing, 0.015 * block_size(s, s.shapes.size()));
  draw_arrows(canvas, s, force_arrows(s), scale, ink::force, true, casing);
}

ArrowScale stress_scale(const std::vector<PlotScene>& scenes, double least) {
  std::vector<double> sizes, rooms;
  for (const PlotScene& s : scenes) {
    for (const StressCross& c : stress_crosses(s)) {
      if (!std::isfinite(size_of(c))) continue;
      sizes.push_back(size_of(c));
      rooms.push_back(s.view.scale * std::max(c.room, raster(s)));
    }
  }
  if (sizes.empty() || quantile(sizes, 1.0) < least) return {};
  // A few blocks under stress concentrations may have longer crosses than there is room for, else
  // all others would be dots; but not so long that nothing else is seen.
  constexpr double usual = 0.6, longest_arm = 1.8;  // of a block's side
  const double room = quantile(rooms, 0.5), most = quantile(sizes, 1.0);
  const ArrowScale wanted = scale_for(quantile(sizes, 0.95), usual * room);
  const ArrowScale shortest = scale_for(most, longest_arm * room);
  return wanted.per_unit == 0.0 || shortest.per_unit < wanted.per_unit ? shortest : wanted;
}

void draw_stresses(Canvas& canvas, const PlotScene& s, const ArrowScale& scale) {
  if (scale.per_unit == 0.0) return;
  const std::vector<StressCross> crosses = stress_crosses(s);
  const auto arms = [&](const StressCross& c, auto&& draw) {
    const Vec2 at = s.view.at(c.at);
    const Vec2 way{std::cos(c.stress.angle), -std::sin(c.stress.angle)};
    for (const auto& [size, along] :
         {std::pair{c.stress.second, perp(way)}, std::pair{c.stress.first, way}}) {
      const double half = scale.per_unit * std::abs(size);
      if (std::isfinite(half) && half >= 0.2) draw(at, along, half, size > 0.0);
    }
  };
  for (const StressCross& c : crosses) {
    arms(c, [&](Vec2 at, Vec2 way, double half, bool) {
      canvas.colour(ink::white, 0.75);
      canvas.line(at - half * way, at + half * way, 0.8 + widest_casing);
    });
  }
  for (const StressCross& c : crosses) {
    arms(c, [&](Vec2 at, Vec2 way, double half, bool tension) {
      draw_arm(canvas, at, way, half, tension);
    });
  }
}

}  // namespace edda
