#include "observe/lining_strength.hpp"

#include <algorithm>

#include "zones/lining_pieces.hpp"

namespace edda {

std::vector<Vec2> strength_outline(const Model& model, const std::string& lining,
                                   const std::string& material, bool residual) {
  const auto called = [&](const Lining& l) {
    return l.name.empty() ? lining == std::to_string(&l - model.linings.data()) : l.name == lining;
  };
  const auto of = std::find_if(model.linings.begin(), model.linings.end(), called);
  const auto from = std::find_if(model.materials.begin(), model.materials.end(),
                                 [&](const Material& m) { return m.name == material; });
  if (of == model.linings.end() || from == model.materials.end()) return {};
  std::vector<Vec2> round;
  for (const Vec2 c : outline_of(strength_of(model, *of, *from, residual)))
    round.push_back({-c.x, c.y});
  for (std::size_t k = round.size(); k-- > 0;) round.push_back({round[k].x, -round[k].y});
  return round;
}

}  // namespace edda
