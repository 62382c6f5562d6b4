#include "observe/sliver_report.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "forces/mass_scaling.hpp"
#include "step/labels.hpp"

namespace edda {

std::vector<std::string> sliver_lines(const CutReport& report) {
  std::vector<std::string> lines;
  for (const MergedSliver& s : report.merges) {
    lines.push_back(fmt::format("merged: {:.4g} m2 at {}; {} lost a face of {:.4g} m", s.area,
                                place_label(s.at), s.joint, s.face));
  }
  for (const KeptSliver& s : report.kept) {
    lines.push_back(fmt::format("stays: {:.4g} m2 at {}", s.area, place_label(s.at)));
  }
  return lines;
}

void add_slivers(Json& json, const CutReport& report) {
  const auto place = [&json](Vec2 at) {
    json.key("at").open_list().value(at.x).value(at.y).close();
  };
  json.key("merged_slivers").open_list();
  for (const MergedSliver& s : report.merges) {
    json.open_object();
    place(s.at);
    json.pair("area", s.area).pair("joint", s.joint).pair("face", s.face).close();
  }
  json.close().key("kept_slivers").open_list();
  for (const KeptSliver& s : report.kept) {
    json.open_object();
    place(s.at);
    json.pair("area", s.area).close();
  }
  json.close();
}

void warn_of_kept_slivers(const Simulation& sim, std::vector<std::string>& warnings) {
  const std::size_t kept = sim.scene->polygons.report.kept.size();
  if (kept == 0) return;
  const bool slower =
      !sim.motion.masses.raised.empty() && sim.scene->model.solver.mass_scaling == 0.0;
  warnings.push_back(fmt::format(
      "{} of the cut {}, because merging with a neighbour would close a through-going joint{}",
      counted(kept, "sliver"), kept == 1 ? "stays" : "stay",
      slower ? fmt::format("; so that {} not limit the time step {} inertia is raised, by {:.3g} "
                           "kg in all (weights stay)",
                           kept == 1 ? "it does" : "they do", kept == 1 ? "its" : "their",
                           added_mass(sim.scene->blocks, sim.motion.masses.raised))
             : std::string{}));
}

}  // namespace edda
