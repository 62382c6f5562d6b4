#include "limit/removal_cone.hpp"

#include <algorithm>

namespace edda {

bool is_free(std::span<const Vec2> outward, Vec2 direction) {
  constexpr double parallel = 1e-6;
  return std::all_of(outward.begin(), outward.end(),
                     [&](Vec2 n) { return dot(n, direction) <= parallel * norm(direction); });
}

bool can_leave(std::span<const Vec2> outward) {
  return std::any_of(outward.begin(), outward.end(), [&](Vec2 n) {
    return is_free(outward, perp(n)) || is_free(outward, -perp(n));
  });
}

}  // namespace edda
