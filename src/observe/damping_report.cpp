#include "observe/damping_report.hpp"

#include <fmt/format.h>

#include <numbers>

#include "observe/wave_sources.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

/// The most that is taken off on any of the paths.
void add_loss(const Simulation& sim, const WaveOrigin& origin, StrainDampingAt& at) {
  for (const WaveRay& ray : origin.rays) {
    const WavePath path = wave_path(sim, ray.from, ray.along, ray.motion);
    if (path.layers.empty()) continue;
    const WaveSignal signal =
        signal_on(origin.curve, sim.scene->model.solver.duration, path.travel_time());
    const double lost = lost_to_damping(path, origin.source, signal);
    if (lost > at.lost) {
      at.lost = lost;
      at.length = path.length();
    }
  }
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
  for (const WaveOrigin& origin : wave_origins(sim)) {
    const double frequency = origin.curve.frequency;
    found.push_back({origin.of, frequency, std::numbers::pi * viscosity * frequency, most});
    if (viscosity > 0.0) add_loss(sim, origin, found.back());
  }
  return found;
}

std::vector<std::string> strain_damping_report(const Simulation& sim) {
  std::vector<std::string> lines;
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    lines.push_back(
        fmt::format("{:.2g} of critical at {:.3g} Hz, the frequency of {} (in {}, the "
                    "one that it damps most){}",
                    at.fraction, at.frequency, at.of, block_label(sim.scene->blocks, at.block),
                    at.length > 0.0 ? fmt::format("; it takes {:.2g} % of the motion on {:.3g} m",
                                                  100.0 * at.lost, at.length)
                                    : std::string()));
  }
  return lines;
}

void add_strain_damping(Json& json, const Simulation& sim) {
  json.key("strain_damping").open_list();
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    json.open_object().pair("of", at.of).pair("frequency", at.frequency);
    json.pair("fraction", at.fraction).pair("block", std::size_t{at.block});
    json.pair("lost", at.lost).pair("length", at.length).close();
  }
  json.close();
}

}  // namespace edda
