// [flow] and what belongs to it: apertures of joints, heads of waters.
#include <fmt/format.h>

#include "model/completion/complete_tools.hpp"

namespace edda {
namespace {

void check_water(const Value* node, const Water& water, Reading& reading) {
  const std::string& key = water.where.key;
  const auto refuse = [&](const char* name, const std::string& problem, const char* remedy) {
    add_fault(reading, place_of(node, name), key + "." + name, problem, remedy);
  };
  const bool injects = given(node, "injection");
  if (injects != given(node, "at")) {
    if (injects) {
      refuse("at", "is missing", "give the point of the injection, such as at = [0, -5]");
    } else {
      refuse("at", "belongs to an injection", "add injection, or leave it out");
    }
    return;
  }
  if (injects || given(node, "rain")) {
    const char* source = injects ? "injection" : "rain";
    for (const char* name : {"rain", "table", "level", "sides", "along", "flooded"}) {
      if (given(node, name) && name != std::string_view(source))
        refuse(name, fmt::format("{} is given too", source),
               "give one of them, or a second [[water]]");
    }
    if (!reading.model.flow)
      refuse(source, "belongs to water that flows through joints", "add [flow], or leave it out");
    return;
  }
  if (!reading.model.flow && !given(node, "table") && !given(node, "level")) {
    add_fault(reading, node->place, key + ".table", "is missing",
              "give its level from left to right, such as table = [[0, 5], [20, 5]]");
    return;
  }
  if (!one_of(node, key, "table", "level",
              "a level from left to right such as table = [[0, 5], [20, 5]]", reading))
    return;
  for (const char* name : {"level", "sides", "along"}) {
    if (reading.model.flow || !given(node, name)) continue;
    add_fault(reading, find(node, name)->place, key + "." + name,
              "belongs to water that flows through joints", "add [flow], or leave it out");
    return;
  }
  if (given(node, "sides") && given(node, "along")) {
    add_fault(reading, find(node, "along")->place, key + ".along", "sides is given too",
              "give only one of them, or a second [[water]]");
  }
  if (water.level && water.sides.empty() && water.along.empty()) {
    add_fault(reading, find(node, "level")->place, key + ".level",
              "is the level along a line in the rock, and there is none",
              "add sides or along, or give table in place of it");
  }
}

void check_apertures(const Value* node, const JointLaw& law, Reading& reading) {
  const std::string key = "joints." + law.name;
  const auto refuse = [&](const char* name, const char* problem, const char* remedy) {
    add_fault(reading, place_of(node, name), key + "." + name, problem, remedy);
  };
  if (!law.aperture) {
    for (const char* name : {"residual_aperture", "largest_aperture"}) {
      if (given(node, name)) refuse(name, "belongs to an aperture", "add aperture");
    }
    if (reading.model.flow && law.type != LawType::glued)
      refuse(
          "aperture", "is missing: water flows through the joints of [flow]",
          "give the hydraulic aperture as drawn, such as \"0.2 mm\", or 0 for watertight joints");
    return;
  }
  if (law.residual_aperture && *law.residual_aperture > *law.aperture)
    refuse("residual_aperture", "is larger than aperture", "give at most that");
  if (law.largest_aperture && *law.largest_aperture < *law.aperture)
    refuse("largest_aperture", "is smaller than aperture", "give at least that");
}

}  // namespace

void complete_flow(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Value* node = element(root, "water", q);
    if (is_table(node)) check_water(node, model.waters[q], reading);
  }
  for (const JointLaw& law : model.joints) {
    const Value* node = find(find(&root, "joints"), law.name);
    if (is_table(node)) check_apertures(node, law, reading);
  }
  if (!model.flow) return;
  const Value* flow = find(&root, "flow");
  if (model.waters.empty())
    add_fault(
        reading, flow->place, "flow", "there is no water",
        "add [[water]] with a table, such as the level of a lake and the sides where the rock "
        "has that level");
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    if (water.unit_weight == model.waters.front().unit_weight) continue;
    add_fault(reading, place_of(element(root, "water", q), "unit_weight"),
              water.where.key + ".unit_weight",
              fmt::format("differs from that of {}", model.waters.front().where.key),
              "give all waters of a model with [flow] the same");
    return;
  }
  if (model.solver.method == Method::dda || model.contact.model == ContactModel::points)
    add_fault(reading, flow->place, "flow", "flow through joints belongs to the explicit method",
              implicit_remedy);
}

}  // namespace edda
