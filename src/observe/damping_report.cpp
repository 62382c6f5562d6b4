#include "observe/damping_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/spectrum.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

double frequency_of(const Shaking& shaking) {
  if (shaking.acceleration.file.empty()) return shaking.acceleration.frequency.value_or(0.0);
  return dominant_frequency(shaking.record.time, shaking.record.acceleration);
}

/// 0 for a history that does not oscillate, for instance one that only rises.
double frequency_of(const TimeHistory& history) {
  if (history.time.empty()) return 0.0;
  std::vector<Vec2> value;
  value.reserve(history.value.size());
  for (const double factor : history.value) value.push_back({factor, 0.0});
  const double frequency = dominant_frequency(history.time, value);
  constexpr double cycles = 3.0;
  return frequency * (history.time.back() - history.time.front()) < cycles ? 0.0 : frequency;
}

}  // namespace

std::vector<StrainDampingAt> strain_damping_at(const Simulation& sim) {
  Id most = no_id;
  double viscosity = -1.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (sim.scene->blocks.fixed[i] != 0) continue;
    const double eta = sim.motion.masses.viscosity.empty() ? 0.0 : sim.motion.masses.viscosity[i];
    if (!(eta > viscosity)) continue;
    viscosity = eta;
    most = static_cast<Id>(i);
  }
  std::vector<StrainDampingAt> found;
  if (most == no_id) return found;
  const auto add = [&](std::string of, double frequency) {
    if (!(frequency > 0.0)) return;
    found.push_back({std::move(of), frequency, std::numbers::pi * viscosity * frequency, most});
  };
  const Model& m = sim.scene->model;
  for (std::size_t q = 0; q < m.shakings.size(); ++q) {
    add(row_label("shaking", m.shakings[q].name, q), frequency_of(m.shakings[q]));
  }
  for (std::size_t q = 0; q < m.loads.size(); ++q) {
    add(row_label("load", m.loads[q].name, q), frequency_of(m.loads[q].factor));
  }
  for (std::size_t q = 0; q < m.boundaries.size(); ++q) {
    add(row_label("boundary", m.boundaries[q].name, q), frequency_of(m.boundaries[q].factor));
  }
  return found;
}

std::vector<std::string> strain_damping_report(const Simulation& sim) {
  std::vector<std::string> lines;
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    lines.push_back(
        fmt::format("{:.2g} of critical at {:.3g} Hz, the frequency of {} (in {}, the "
                    "one that it damps most)",
                    at.fraction, at.frequency, at.of, block_label(sim.scene->blocks, at.block)));
  }
  return lines;
}

void add_strain_damping(Json& json, const Simulation& sim) {
  json.key("strain_damping").open_list();
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    json.open_object().pair("of", at.of).pair("frequency", at.frequency);
    json.pair("fraction", at.fraction).pair("block", std::size_t{at.block}).close();
  }
  json.close();
}

}  // namespace edda
