#include "blocks/initial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edda {
namespace {

/// Levels at which the ring crosses the vertical line at x, unsorted. A corner counts with the edge
/// to its right.
void add_crossings(const Ring& ring, double x, std::vector<double>& levels) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.x <= x) == (b.x <= x)) continue;
    levels.push_back(a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
  }
}

double density_of(const Model& model, Index material) {
  return material == none ? 0.0 : model.materials[static_cast<std::size_t>(material)].density;
}

/// Whether all of the rock has the same density.
bool one_density(const std::vector<double>& densities) {
  return std::all_of(densities.begin(), densities.end(),
                     [&](double d) { return d == densities.front(); });
}

}  // namespace

StressField::StressField(const Model& model, Vec2 origin) : model_(&model), origin_(origin) {
  for (const BrickWall& w : model.walls) {
    const Vec2 size{w.columns * w.brick.x, w.rows * w.brick.y};
    rings_.push_back({w.origin,
                      {w.origin.x + size.x, w.origin.y},
                      w.origin + size,
                      {w.origin.x, w.origin.y + size.y}});
  }
  if (model.domain) {
    bodies_.push_back({&model.domain->outline, density_of(model, model.domain->material)});
    for (const Region& r : model.regions) {
      bodies_.push_back({&r.polygon, density_of(model, r.material)});
    }
  }
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    bodies_.push_back({&rings_[w], density_of(model, model.walls[w].material)});
  }
  for (const BlockInput& b : model.blocks) {
    bodies_.push_back({&b.polygon, density_of(model, b.material)});
  }
  low_ = std::numeric_limits<double>::infinity();
  high_ = -low_;
  for (const Body& body : bodies_) {
    for (const Vec2 p : *body.ring) {
      low_ = std::min(low_, p.x);
      high_ = std::max(high_, p.x);
    }
  }
}

double StressField::column(double x, double y) const {
  const InitialStress& stress = *model_->initial_stress;
  std::vector<double> levels{y}, own;
  struct Inside {
    std::vector<double> levels;
    double density;
    bool holds(double at) const {
      const auto below = std::lower_bound(levels.begin(), levels.end(), at) - levels.begin();
      return below % 2 == 1;
    }
  };
  std::vector<Inside> bodies;
  for (const Body& body : bodies_) {
    own.clear();
    add_crossings(*body.ring, x, own);
    std::sort(own.begin(), own.end());
    levels.insert(levels.end(), own.begin(), own.end());
    bodies.push_back({own, body.density});
  }
  double surface = stress.surface_y.value_or(y);
  if (stress.surface == SurfaceKind::outline) {
    surface = bodies.front().levels.empty() ? y : bodies.front().levels.back();
  }
  levels.push_back(surface);
  std::sort(levels.begin(), levels.end());
  // From bottom to top, so that a gap and what lies above the rock have the density of the rock
  // below them.
  double density = 0.0, weight = 0.0, before = 0.0;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double from = levels[k - 1], to = levels[k], middle = 0.5 * (from + to);
    if (!(to > from)) continue;
    for (const Inside& body : bodies) {
      if (body.holds(middle)) density = body.density;
    }
    const double length = std::min(to, surface) - std::max(from, y);
    if (length <= 0.0) continue;
    // Where the column begins below all rock, it has the density of the lowest rock.
    if (density == 0.0) {
      before += length;
    } else {
      weight += density * (length + before);
      before = 0.0;
    }
  }
  if (before > 0.0 && !bodies_.empty()) weight += before * bodies_.front().density;
  return weight;
}

double StressField::overburden(Vec2 point) const {
  const InitialStress& stress = *model_->initial_stress;
  const double g = -model_->gravity.y;
  std::vector<double> densities;
  for (const Body& body : bodies_) densities.push_back(body.density);
  if (densities.empty()) {
    for (const Material& m : model_->materials) densities.push_back(m.density);
  }
  if (stress.surface == SurfaceKind::level && one_density(densities)) {
    return g * densities.front() * std::max(0.0, *stress.surface_y - point.y);
  }
  // On a vertical edge between two materials both sides count half.
  const double aside = 1e-9 * (high_ - low_);
  const double left = std::max(point.x - aside, low_ + 0.5 * aside),
               right = std::min(point.x + aside, high_ - 0.5 * aside);
  return 0.5 * g * (column(left, point.y) + column(right, point.y));
}

Tensor StressField::at(Vec2 point) const {
  const InitialStress& s = *model_->initial_stress;
  const Vec2 p = point + origin_;
  if (s.stress) {
    const double up = p.y - s.at_y.value_or(0.0);
    const Triple rise = s.gradient.value_or(Triple{});
    return {(*s.stress)[0] + up * rise[0], (*s.stress)[1] + up * rise[1],
            (*s.stress)[2] + up * rise[2]};
  }
  const double vertical = -overburden(p);
  return {*s.k0 * vertical, vertical, 0.0};
}

double out_of_plane_stress(const Model& model, const Material& material, const Tensor& t) {
  const InitialStress& given = *model.initial_stress;
  if (model.plane == Plane::stress) return 0.0;
  return given.k0_out ? *given.k0_out * t.yy : material.poisson * (t.xx + t.yy);
}

void set_initial_stress(BlockSet& b, const Model& model, const StressField& field) {
  for (auto* values : {&b.initial_xx, &b.initial_yy, &b.initial_xy, &b.initial_zz}) {
    values->resize(b.size());
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.is_fill(i)) continue;
    const Tensor t = field.at({b.centroid_x[i], b.centroid_y[i]});
    b.initial_xx[i] = t.xx;
    b.initial_yy[i] = t.yy;
    b.initial_xy[i] = t.xy;
    b.initial_zz[i] =
        out_of_plane_stress(model, model.materials[static_cast<std::size_t>(b.material[i])], t);
  }
}

}  // namespace edda
