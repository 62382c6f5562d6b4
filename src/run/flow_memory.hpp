// Checkpoint data of the water in joints.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// One member of the rows of a list; the list has the length of the column that is loaded first.
template <class Archive, class Row, class Value>
void list_member(Archive& a, const std::string& name, std::vector<Row>& rows, Value Row::*member) {
  std::vector<Value> values;
  for (const Row& row : rows) values.push_back(row.*member);
  a(name, values);
  if constexpr (Archive::loads) {
    if (rows.empty()) rows.resize(values.size());
    if (rows.size() != values.size()) return a.refuse(name + " does not fit");
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = values[k];
  }
}

template <class Archive>
void list_wet(Archive& a, const std::string& of, std::vector<WetEdge>& wet) {
  if constexpr (Archive::loads) wet.clear();
  list_member(a, of + ".edge", wet, &WetEdge::edge);
  list_member(a, of + ".from", wet, &WetEdge::from);
  list_member(a, of + ".to", wet, &WetEdge::to);
  list_member(a, of + ".level_from", wet, &WetEdge::level_from);
  list_member(a, of + ".level_to", wet, &WetEdge::level_to);
  list_member(a, of + ".water", wet, &WetEdge::water);
}

/// Whether the water is on edges of these blocks, and of waters that there are.
inline bool fits(const std::vector<WetEdge>& wet, const Simulation& s) {
  const auto waters = static_cast<Index>(s.scene->model.waters.size()) + 2;
  for (const WetEdge& e : wet) {
    if (e.edge >= s.scene->blocks.vertex_count() || e.water < 0 || e.water >= waters) return false;
  }
  return true;
}

template <class Archive>
void list_flow(Archive& a, Simulation& s) {
  if (!s.scene->model.flow) return;
  JointWater& water = s.attached.joint_water;
  if constexpr (Archive::loads) water.rows.clear();
  a("flow.pressure", water.pressure);
  a("flow.filled", water.filled);
  a("flow.inflow", water.inflow);
  a("flow.not_found", water.not_found);
  a("flow.not_taken", water.not_taken);
  list_member(a, "flow.rows.edge", water.rows, &FlowRow::edge);
  list_member(a, "flow.rows.facing", water.rows, &FlowRow::facing);
  list_member(a, "flow.rows.aperture", water.rows, &FlowRow::aperture);
  list_member(a, "flow.rows.discharge", water.rows, &FlowRow::discharge);
  list_member(a, "flow.rows.pressure_a", water.rows, &FlowRow::pressure_a);
  list_member(a, "flow.rows.pressure_b", water.rows, &FlowRow::pressure_b);
  if constexpr (Archive::loads) water.contents.clear();
  list_member(a, "flow.contents.edge", water.contents, &WaterContent::edge);
  list_member(a, "flow.contents.facing", water.contents, &WaterContent::facing);
  list_member(a, "flow.contents.part_from", water.contents, &WaterContent::part_from);
  list_member(a, "flow.contents.part_to", water.contents, &WaterContent::part_to);
  list_member(a, "flow.contents.from", water.contents, &WaterContent::from);
  list_member(a, "flow.contents.to", water.contents, &WaterContent::to);
  list_member(a, "flow.contents.aperture_from", water.contents, &WaterContent::aperture_from);
  list_member(a, "flow.contents.aperture_to", water.contents, &WaterContent::aperture_to);
  auto kind = static_cast<std::uint64_t>(s.attached.loads.flow);
  a("flow.kind", kind);
  s.attached.loads.flow = static_cast<JointFlow>(kind);
  list_wet(a, "flow.before", water.before);
  std::vector<WetEdge> wet = s.attached.loads.wet;
  list_wet(a, "flow.wet", wet);
  if constexpr (Archive::loads) {
    const std::size_t corners = s.scene->blocks.vertex_count();
    if (water.pressure.size() != corners || water.filled.size() != corners ||
        kind > static_cast<std::uint64_t>(JointFlow::held) ||
        water.inflow.size() != s.scene->model.waters.size() + 1 || !fits(wet, s) ||
        !fits(water.before, s))
      return a.refuse("water in joints does not fit the model");
    put_water(s.scene->blocks, std::move(wet), s.attached.loads);
  }
}

}  // namespace edda
