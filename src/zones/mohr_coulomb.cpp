#include "zones/mohr_coulomb.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

MohrCoulombPlanes yield_planes(const MohrCoulomb& rock) {
  const double sine = std::sin(rock.friction), flow = std::sin(rock.dilation),
               limit = 2.0 * rock.cohesion * std::cos(rock.friction);
  const double cut = sine > 0.0 ? std::min(rock.tension, limit / (2.0 * sine)) : rock.tension;
  const auto shear = [&](std::size_t i, std::size_t j) {
    YieldPlane p{{}, limit, {}, false};
    p.normal[i] = 1.0 + sine;
    p.normal[j] = -(1.0 - sine);
    p.flow[i] = 1.0 + flow;
    p.flow[j] = -(1.0 - flow);
    return p;
  };
  const auto tensile = [&](std::size_t i) { return tensile_plane(i, cut); };
  return {shear(0, 2), tensile(0), shear(0, 1), shear(1, 2), tensile(1), tensile(2)};
}

ReturnedStress return_to(const MohrCoulombSurface& surface, const IsotropicElasticity& elastic,
                         const Principal& trial) {
  const MohrCoulombPlanes& planes = surface.planes;
  const double size =
      std::max({std::abs(trial[0]), std::abs(trial[1]), std::abs(trial[2]), surface.rock.cohesion});
  constexpr double rounding = 1e-12;
  if (within(planes, trial, rounding * size)) return {trial};
  return in_order(trial, [&](const Principal& sorted) {
    return return_to_planes(sorted, elastic, planes, rounding * size);
  });
}

}  // namespace edda
