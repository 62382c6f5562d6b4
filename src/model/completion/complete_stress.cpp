#include <fmt/format.h>

#include <algorithm>

#include "model/completion/complete_tools.hpp"

namespace edda {
namespace {

void refuse(const Value* node, const InitialStress& stress, std::string_view name,
            std::string problem, std::string remedy, Reading& reading) {
  add_fault(reading, find(node, name)->place, stress.where.key + "." + std::string(name),
            std::move(problem), std::move(remedy));
}

/// Keys of the other form.
void refuse_others(const Value* node, const InitialStress& stress,
                   std::initializer_list<std::string_view> others, const char* with,
                   Reading& reading) {
  for (const std::string_view name : others) {
    if (given(node, name)) {
      refuse(node, stress, name, std::string("has no effect with ") + with, "leave it out",
             reading);
    }
  }
}

/// The stress of rock above the surface would be undefined.
void check_level(const Value* node, const InitialStress& stress, Reading& reading) {
  if (!reading.model.domain || reading.model.domain->outline.empty()) return;
  double top = reading.model.domain->outline.front().y;
  for (const Vec2 p : reading.model.domain->outline) top = std::max(top, p.y);
  const double level = *stress.surface_y;
  if (level >= top - 1e-9 * (1.0 + std::abs(top))) return;
  refuse(node, stress, "surface_y",
         fmt::format("{:.6g} lies below the top of the outline at {:.6g}", level, top),
         "give at least that, or surface = \"outline\"", reading);
}

void check_surface(const Value* node, const InitialStress& stress, Reading& reading) {
  if (stress.surface == SurfaceKind::outline) {
    if (given(node, "surface_y")) {
      refuse(node, stress, "surface_y", "has no effect with surface = \"outline\"",
             "give only one of them", reading);
    }
    if (!reading.model.domain) {
      refuse(node, stress, "surface", "there is no outline", "give surface_y", reading);
    }
  } else if (!stress.surface_y) {
    add_fault(reading, node->place, stress.where.key + ".surface_y", "is missing",
              "give the level of the ground's surface, or surface = \"outline\"");
  } else {
    check_level(node, stress, reading);
  }
}

void complete_convergence(const Value* node, const Convergence& c, Reading& reading) {
  if (!given(node, "between") || c.between.empty()) return;
  const std::string key = c.where.key + ".between";
  if (c.between.size() == 2) return;
  add_fault(reading, find(node, "between")->place, key,
            fmt::format("has {} points, not two", c.between.size()),
            "give the two points, such as [[-5.0, 0.5], [5.0, 0.5]]");
}

}  // namespace

void complete_initial_stress(const Value& root, Reading& reading) {
  for (std::size_t i = 0; i < reading.model.convergences.size(); ++i) {
    const Value* node = element(root, "convergence", i);
    if (is_table(node)) complete_convergence(node, reading.model.convergences[i], reading);
  }
  if (!reading.model.initial_stress) return;
  InitialStress& stress = *reading.model.initial_stress;
  const Value* node = find(&root, "initial_stress");
  if (!is_table(node)) return;
  if (!one_of(node, stress.where.key, "stress", "k0",
              "the stress at a level, such as stress = [-24e6, -24e6, 0.0], or k0", reading)) {
    return;
  }
  if (given(node, "stress")) {
    refuse_others(node, stress, {"surface_y"}, "stress", reading);
    if (stress.surface == SurfaceKind::outline) {
      refuse_others(node, stress, {"surface"}, "stress", reading);
    }
    if (!stress.at_y) stress.at_y = 0.0;
    if (!stress.gradient) stress.gradient = Triple{0.0, 0.0, 0.0};
    return;
  }
  refuse_others(node, stress, {"at_y", "gradient"}, "k0", reading);
  if (!(reading.model.gravity.y < 0.0)) {
    refuse(node, stress, "k0", "needs the weight of the rock, and gravity does not point down",
           "give gravity = [0.0, -9.81], or stress in place of k0", reading);
  }
  if (!stress.k0_out) stress.k0_out = stress.k0;
  check_surface(node, stress, reading);
}

}  // namespace edda
