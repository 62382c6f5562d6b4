#include "run/sliver_report.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "forces/mass_scaling.hpp"
#include "run/labels.hpp"

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
  const std::size_t kept = sim.polygons.report.kept.size();
  if (kept == 0) return;
  const bool slower = !sim.inertia.empty() && sim.model.solver.mass_scaling == 0.0;
  warnings.push_back(fmt::format(
      "{} of the cut {}, because joining a neighbour would put rock across a joint that runs "
      "through{}",
      counted(kept, "sliver"), kept == 1 ? "stays" : "stay",
      slower ? fmt::format("; so that {} not hold the step {} heavier to move, by {:.3g} kg "
                           "together (weights stay)",
                           kept == 1 ? "it does" : "they do", kept == 1 ? "it is" : "they are",
                           added_mass(sim.blocks, sim.inertia))
             : std::string{}));
}

}  // namespace edda
