#include "report/history_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace edda {
namespace {

constexpr std::array<std::string_view, 10> energies{
    "kinetic", "strain",   "contact",  "gravity",     "friction",
    "damping", "fracture", "external", "step_change", "transfer"};

struct Kind {
  std::string_view ending, label, unit;
};
constexpr std::array<Kind, 10> kinds{{{".ux", "displacement", "m"},
                                      {".uy", "displacement", "m"},
                                      {".vx", "velocity", "m/s"},
                                      {".vy", "velocity", "m/s"},
                                      {".ax", "acceleration", "m/s2"},
                                      {".ay", "acceleration", "m/s2"},
                                      {".sxx", "stress", "Pa"},
                                      {".syy", "stress", "Pa"},
                                      {".sxy", "stress", "Pa"},
                                      {".convergence", "convergence", "m"}}};

bool is_energy(const std::string& name) {
  return std::find(energies.begin(), energies.end(), name) != energies.end();
}

/// A panel without lines, for a column of that name.
HistoryPanel panel_for(const std::string& name) {
  if (is_energy(name)) return {"energy", "J", {}};
  if (name == "drift") return {"energy balance error", "", {}};
  if (name == "unbalanced") return {"unbalanced force ratio", "", {}};
  for (const Kind& k : kinds) {
    if (name.ends_with(k.ending)) return {std::string(k.label), std::string(k.unit), {}};
  }
  return {name, "", {}};
}

double largest(const Column& column) {
  double most = 0.0;
  for (const double v : column.values) most = std::max(most, std::abs(v));
  return most;
}

/// The energies that are visible beside the largest.
std::vector<const Column*> visible_energies(const Table& history) {
  constexpr double least = 0.005;
  double most = 0.0;
  for (const Column& c : history.columns) {
    if (is_energy(c.name)) most = std::max(most, largest(c));
  }
  std::vector<const Column*> found;
  for (const Column& c : history.columns) {
    if (is_energy(c.name) && largest(c) >= least * most) found.push_back(&c);
  }
  return found;
}

/// The columns that a given name stands for.
std::vector<const Column*> columns_of(const Table& history, const std::string& name) {
  if (name == "energy") return visible_energies(history);
  std::vector<const Column*> found;
  for (const Column& c : history.columns) {
    if (c.name == "time") continue;
    const bool of_a_point =
        c.name.starts_with(name + ".") && c.name.find('.', name.size() + 1) == std::string::npos;
    if (c.name == name || of_a_point) found.push_back(&c);
  }
  return found;
}

std::string names_of(const Table& history) {
  std::string text;
  for (const Column& c : history.columns) {
    if (c.name == "time") continue;
    text += (text.empty() ? "" : ", ") + c.name;
  }
  return text;
}

void add(std::vector<HistoryPanel>& panels, const Column* column) {
  HistoryPanel wanted = panel_for(column->name);
  auto panel = std::find_if(panels.begin(), panels.end(),
                            [&](const HistoryPanel& p) { return p.label == wanted.label; });
  if (panel == panels.end()) panel = panels.insert(panels.end(), std::move(wanted));
  if (std::find(panel->lines.begin(), panel->lines.end(), column) == panel->lines.end())
    panel->lines.push_back(column);
}

}  // namespace

Result<std::vector<HistoryPanel>> history_panels(const Table& history,
                                                 const std::vector<std::string>& names) {
  std::vector<HistoryPanel> panels;
  for (const std::string& name : names) {
    const std::vector<const Column*> columns = columns_of(history, name);
    if (columns.empty()) {
      return Fault{{"--history", {}, 0, 0},
                   "there is no history of \"" + name + "\"",
                   "name some of energy, " + names_of(history) +
                       ", or a monitor for all that is recorded of it"};
    }
    for (const Column* column : columns) add(panels, column);
  }
  return panels;
}

}  // namespace edda
