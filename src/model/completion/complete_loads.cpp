#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/completion/complete_tools.hpp"
#include "model/files/input_file.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// A force at a point is in N, a traction in Pa; a number without a unit is either.
void check_unit(const Value& force, const Load& load, Reading& reading) {
  const List* pair = std::get_if<List>(&force.content);
  if (pair == nullptr) return;
  for (const Value& part : *pair) {
    const std::string* text = std::get_if<std::string>(&part.content);
    if (text == nullptr) continue;
    const bool stress = parse_quantity(*text, Dimension::stress).value.has_value();
    if (stress != load.point.has_value()) continue;
    add_fault(reading, part.place, load.where.key + ".force",
              shown(part) + (stress ? " is not a force" : " is not a stress"),
              stress ? "a load at a point is a force such as \"-100 kN\""
                     : "a load along a line is a traction such as \"-100 kPa\"");
  }
}

void complete_load(const Value* node, const Load& load, Reading& reading) {
  const std::string& key = load.where.key;
  const auto one_of = [&](std::array<const char*, 3> names, const char* example) {
    const char* first = nullptr;
    for (const char* name : names) {
      if (!given(node, name)) continue;
      if (first != nullptr) {
        add_fault(reading, find(node, name)->place, key + "." + name,
                  std::string(first) + " is given too", "give only one of them");
        return false;
      }
      first = name;
    }
    if (first == nullptr) {
      add_fault(reading, node->place, key,
                fmt::format("has none of {}, {} and {}", names[0], names[1], names[2]),
                std::string("add ") + example);
    }
    return first != nullptr;
  };
  if (!one_of({"point", "along", "within"}, "a point such as point = [0.0, 5.0]")) return;
  if (!one_of({"force", "pressure", "body_force"}, "a force such as force = [0.0, -1e5]")) return;
  const auto refuse = [&](const char* name, const char* problem, const char* remedy) {
    add_fault(reading, find(node, name)->place, key + "." + name, problem, remedy);
  };
  if (given(node, "pressure") && given(node, "point"))
    refuse("pressure", "a point has no face for a pressure to act on",
           "give force, or along in place of point");
  if (given(node, "body_force") && !given(node, "within"))
    refuse("body_force", "belongs to a polygon", "give within in place of point or along");
  if (given(node, "within") && !given(node, "body_force"))
    refuse("within", "belongs to a body force",
           "give body_force, a force per volume such as [\"5 kN/m3\", 0]");
  if (given(node, "force")) check_unit(*find(node, "force"), load, reading);
}

void check_table(const Value* node, const Water& water, Reading& reading) {
  for (std::size_t i = 1; i < water.table.size(); ++i) {
    if (water.table[i].x > water.table[i - 1].x) continue;
    add_fault(reading, child(find(node, "table"), i)->place,
              water.where.key + ".table[" + std::to_string(i) + "]",
              "does not lie to the right of the point before",
              "list the points of the table from left to right");
    return;
  }
}

void check_flooded(const Value* node, const Water& water, Reading& reading) {
  std::vector<std::string_view> known;
  for (const Opening& opening : reading.model.openings) {
    if (!opening.name.empty()) known.push_back(opening.name);
  }
  for (std::size_t i = 0; i < water.flooded.size(); ++i) {
    const std::string& name = water.flooded[i];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    add_fault(reading, find(node, "flooded")->place, water.where.key + ".flooded",
              "no opening is called \"" + clipped(name) + '"',
              !known.empty()                   ? suggestion(name, known)
              : reading.model.openings.empty() ? "there are no openings: leave it out"
                                               : "give the opening that name");
  }
}

/// Rain and injections bring water, and take none out.
void check_factors(const Value* node, const Water& water, Reading& reading) {
  const std::vector<double>& factors = water.rise.value;
  if ((!water.rain && !water.injection) || factors.empty()) return;
  const double least = *std::min_element(factors.begin(), factors.end());
  if (least < 0.0)
    add_fault(reading, find(node, "history")->place, water.where.key + ".history",
              fmt::format("{} has the factor {:g}, below 0", water.history, least),
              "give factors of 0 and more; water leaves along lines with a level");
}

}  // namespace

void complete_loads(const Value& root, Reading& reading) {
  for (std::size_t i = 0; i < reading.model.loads.size(); ++i) {
    const Value* node = child(find(&root, "load"), i);
    if (!std::holds_alternative<Table>(node->content)) continue;
    Load& load = reading.model.loads[i];
    complete_load(node, load, reading);
    read_history(node, load.where.key, load.history, load.factor, reading);
  }
  for (std::size_t i = 0; i < reading.model.waters.size(); ++i) {
    const Value* node = child(find(&root, "water"), i);
    if (!std::holds_alternative<Table>(node->content)) continue;
    Water& water = reading.model.waters[i];
    check_table(node, water, reading);
    check_flooded(node, water, reading);
    read_history(node, water.where.key, water.history, water.rise, reading);
    check_factors(node, water, reading);
  }
}

}  // namespace edda
