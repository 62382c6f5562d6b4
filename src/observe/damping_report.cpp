#include "observe/damping_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "forces/viscosity.hpp"
#include "model/stage_names.hpp"
#include "observe/wave_sources.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

/// The most that is taken off on any of the paths.
void add_loss(const Simulation& sim, const Masses& masses, const WaveOrigin& origin,
              StrainDampingAt& at) {
  for (const WaveRay& ray : origin.rays) {
    const WavePath path = wave_path(sim, masses, ray.from, ray.along, ray.motion);
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

/// The first stage with a duration in which this acts, or the first at all.
std::size_t stage_of(const std::vector<Stage>& stages, const std::vector<bool>& acts) {
  std::size_t first = stages.size();
  for (std::size_t q = 0; q < stages.size(); ++q) {
    if (!acts[q]) continue;
    if (!stages[q].to_equilibrium()) return q;
    first = std::min(first, q);
  }
  return first < stages.size() ? first : 0;
}

Id most_viscous(const BlockSet& blocks, const Masses& masses) {
  Id most = no_id;
  double viscosity = -1.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks.fixed[i] != 0) continue;
    const double eta = viscosity_of(masses, i);
    if (!(eta > viscosity)) continue;
    viscosity = eta;
    most = static_cast<Id>(i);
  }
  return most;
}

/// The key of the damping that a block has in a stage.
void name_damping(const Model& model, const Stage& stage, const Material& rock,
                  StrainDampingAt& at) {
  const std::optional<Rayleigh>& in_force = stage.damping.rayleigh_with(rock.rayleigh);
  at.rayleigh = in_force.has_value();
  const bool own = &in_force == &rock.rayleigh;
  at.key = !at.rayleigh                                ? rock.where.key + ".damping"
           : own                                       ? rock.where.key + ".rayleigh"
           : in_force == model.solver.damping.rayleigh ? "solver.damping.rayleigh"
                                                       : stage.where.key + ".damping.rayleigh";
}

}  // namespace

std::string StrainDampingAt::what() const {
  return rayleigh ? "stiffness-proportional part of Rayleigh damping" : "strain damping";
}

std::vector<StrainDampingAt> strain_damping_at(const Simulation& sim) {
  const Scene& scene = *sim.scene;
  const std::vector<Stage> stages = stages_of(scene.model);
  std::map<std::size_t, Masses> of_stages;
  std::vector<StrainDampingAt> found;
  for (const WaveOrigin& origin : wave_origins(sim)) {
    const std::size_t stage = stage_of(stages, acts_in_stages(scene.model, origin.name));
    const auto [m, is_new] = of_stages.try_emplace(stage, sim.motion.masses);
    const Masses& masses = m->second;
    if (is_new) fill_viscosity(m->second, scene.blocks, stages[stage].damping, scene.zones);
    const Id most = most_viscous(scene.blocks, masses);
    if (most == no_id) return found;
    const double viscosity = viscosity_of(masses, most), frequency = origin.curve.frequency;
    StrainDampingAt at{origin.of, frequency, std::numbers::pi * viscosity * frequency, most};
    const auto rock = static_cast<std::size_t>(scene.blocks.material[most]);
    name_damping(scene.model, stages[stage], scene.model.materials[rock], at);
    if (viscosity > 0.0) add_loss(sim, masses, origin, at);
    found.push_back(std::move(at));
  }
  return found;
}

std::vector<std::string> strain_damping_report(const Simulation& sim) {
  std::vector<std::string> lines;
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    lines.push_back(
        fmt::format("{}{:.2g} of critical at {:.3g} Hz, the frequency of {} (in {}, the "
                    "one that it damps most){}",
                    at.rayleigh ? at.what() + ": " : "", at.fraction, at.frequency, at.of,
                    block_label(sim.scene->blocks, at.block),
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
