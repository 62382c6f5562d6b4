#include <cmath>

#include "verification/exact_slopes.hpp"
#include "verification/scene.hpp"
#include "verification/slope_parts.hpp"

namespace edda {

using namespace slopes;

double SlicedSlope::exact() const {
  const std::size_t n = base.size() - 1;
  /// External force that the toe needs.
  const auto needs = [&](double factor) {
    Vec2 from_above;
    for (std::size_t i = n; i-- > 0;) {
      const Vec2 along = (1.0 / norm(base[i + 1] - base[i])) * (base[i + 1] - base[i]);
      const Vec2 across{-along.y, along.x};
      const double t = std::tan(radians(base_phi)) / factor;
      const Vec2 base_way = across + t * along;  // per unit of effective normal force
      const Vec2 base_start = base[i] + (i > 0 ? hollow : 0.0) * along;
      const Vec2 from_base = base_cohesion / factor * norm(base[i + 1] - base_start) * along +
                             push(table, base_start, base[i + 1]) * across;
      if (i == 0) {  // a force along the base
        const Ring slice{base[0], base[1], surface[1], surface[0]};
        const Vec2 known = Vec2{0.0, -unit_weight * area_of(slice)} + from_above + from_base;
        return dot(known, across) * t - dot(known, along);
      }
      // The joint below: its normal force presses on the slice, and its friction supports it.
      const Vec2 up = (1.0 / norm(surface[i] - base[i])) * (surface[i] - base[i]);
      const Vec2 in{up.y, -up.x};
      const double joint_t = std::tan(radians(joint_phi)) / factor;
      const Vec2 joint_way = in + joint_t * up;
      const Vec2 edge = base[i] + hollow * up,
                 across_hollow{edge.y - base_start.y, base_start.x - edge.x};
      const Vec2 from_joint = joint_cohesion / factor * norm(surface[i] - edge) * up;
      const Ring slice{base_start, base[i + 1], surface[i + 1], surface[i], edge};
      const Vec2 known = Vec2{0.0, -unit_weight * area_of(slice)} + from_above + from_base +
                         from_joint + push(table, edge, surface[i]) * in +
                         push(table, edge, base_start) / norm(across_hollow) * across_hollow;
      // known + N base_way + E joint_way = 0
      const double det = edda::cross(base_way, joint_way);
      const double push_of_joint = -edda::cross(base_way, known) / det;
      from_above =
          -1.0 * (from_joint + push_of_joint * joint_way + push(table, base[i], surface[i]) * in);
    }
    return 0.0;
  };
  double low = 0.1, high = 10.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (needs(middle) > 0.0 ? high : low) = middle;
  }
  return low;
}

std::string SlicedSlope::toml() const {
  Ring top(surface.rbegin(), surface.rend());
  if (norm(surface.front() - base.front()) < 1e-9) top.pop_back();
  std::string text = rock() + law("bed", base_phi, base_cohesion) +
                     law("slice", joint_phi, joint_cohesion) + law("inner", 60.0, 10e6) +
                     ground(base, top);
  std::string flooded;
  const auto middle = [&](std::size_t i) { return 0.5 * (base[i] + surface[i]); };
  for (std::size_t i = 0; i + 1 < base.size(); ++i) {
    text += trace(base[i], base[i + 1], "bed");
    if (i > 0) text += trace(base[i], surface[i], "slice");
    if (i > 0 && i + 2 < base.size()) text += trace(middle(i), middle(i + 1), "inner");
    if (i > 0) {
      const Vec2 along = (1.0 / norm(base[i + 1] - base[i])) * (base[i + 1] - base[i]);
      const Vec2 up = (1.0 / norm(surface[i] - base[i])) * (surface[i] - base[i]);
      const std::string name = "'hollow " + std::to_string(i) + "'";
      text += "[[opening]]\nname = " + name +
              "\npolygon = " + points({base[i], base[i] + hollow * along, base[i] + hollow * up}) +
              "\n";
      flooded += name + ",";
    }
  }
  return text + water(table, flooded);
}

}  // namespace edda
