#include "zones/zone_viscosity.hpp"

#include "base/parallel.hpp"
#include "zones/lining_pieces.hpp"

namespace edda {
namespace {

/// Viscous forces of pair p with the viscosity eta.
void set_viscous_forces(const ZoneModel& model, const BlockSet& b, double eta, Zones& all,
                        std::size_t p) {
  const auto [one, other] = model.pair[p];
  if (eta == 0.0) {
    for (const std::uint32_t z : model.pair[p])
      if (z != no_partner) all.viscous[z] = {};
    return;
  }
  if (model.is_piece(p)) {
    const std::uint32_t q = model.piece_of_pair[p];
    const BeamCorners f = viscous_forces(model.piece[q].shape, all.piece[q],
                                         corners_of(b.meshes, model.pair[p], all.place),
                                         corners_of(b.meshes, model.pair[p], all.rate), eta);
    all.viscous[one] = {f[0], f[1], f[2]};
    all.viscous[other] = {Vec2{}, Vec2{}, f[3]};
    return;
  }
  std::array<ZoneShape, 2> shape{model.shape[one]};
  std::array<std::array<Vec2, 3>, 2> x{at_corners(b.meshes, all.place, one)},
      v{at_corners(b.meshes, all.rate, one)};
  if (other != no_partner) {
    shape[1] = model.shape[other];
    x[1] = at_corners(b.meshes, all.place, other);
    v[1] = at_corners(b.meshes, all.rate, other);
  }
  const ZoneMaterial& rock =
      model.material[static_cast<std::size_t>(b.material[model.pair_block[p]])];
  const std::array<std::array<Vec2, 3>, 2> f = viscous_forces(shape, rock, x, v, eta);
  all.viscous[one] = f[0];
  if (other != no_partner) all.viscous[other] = f[1];
}

}  // namespace

double viscous_power(const ZoneModel& model, const BlockSet& b, const Zones& all, std::size_t p) {
  double power = 0.0;
  for (const std::uint32_t z : model.pair[p]) {
    if (z == no_partner) continue;
    const std::array<Vec2, corners_of_zone> v = at_corners(b.meshes, all.rate, z);
    for (std::size_t k = 0; k < corners_of_zone; ++k) power += dot(all.viscous[z][k], v[k]);
  }
  return power;
}

void evaluate_viscosity(const ZoneModel& model, const BlockSet& b, const State& s,
                        const std::vector<double>& viscosity, double h, Zones& all) {
  const auto eta = [&](std::size_t i) {
    return viscosity.empty() || !b.is_meshed(i) ? 0.0 : viscosity[i];
  };
  bool any = !all.viscous.empty();
  for (std::size_t i = 0; i < viscosity.size() && !any; ++i) any = eta(i) > 0.0;
  if (!any) return;
  all.viscous.resize(model.shape.size());
  all.damped.resize(model.pair.size(), 0.0);
  all.damped_due.resize(model.pair.size(), 0.0);
  constexpr std::size_t cost = 150;  // ns
  parallel_for(
      model.pair.size(),
      [&](std::size_t p) {
        const std::size_t i = model.pair_block[p];
        if (s.alive[i] == 0) return;
        const double before = viscous_power(model, b, all, p);
        set_viscous_forces(model, b, eta(i), all, p);
        const double due = -0.5 * h * viscous_power(model, b, all, p);
        all.damped[p] += all.damped_due[p] - 0.5 * h * before;
        all.damped_due[p] = due;
      },
      cost);
}

void begin_viscosity(const ZoneModel& model, std::size_t p, Zones& zones) {
  if (zones.viscous.empty()) return;
  for (const std::uint32_t z : model.pair[p])
    if (z != no_partner) zones.viscous[z] = {};
  zones.damped_due[p] = 0.0;
}

double damped_in_zones(const Zones& zones) {
  return ordered_sum(zones.damped.size(), [&](std::size_t p) { return zones.damped[p]; });
}

}  // namespace edda
