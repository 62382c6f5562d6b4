// edda limit
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/analysis_command.hpp"
#include "app/mechanism_picture.hpp"
#include "base/text.hpp"
#include "results/files.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

std::string other_end_text(const LimitResult& r) {
  return fmt::format("at the other end {:.5g}", r.smallest->lower);
}

Trouble write_results(const Model& model, const LimitResult& r, const std::string& folder) {
  const auto write = [&](const std::string& name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  const auto write_mechanism = [&](const Simulation& moved, const Mechanism& mechanism,
                                   const std::string& end) {
    if (Trouble t = write("mechanism" + end + ".csv", mechanism_csv(moved, mechanism))) return t;
    if (Trouble t = write("mechanism_joints" + end + ".csv", mechanism_joints_csv(mechanism)))
      return t;
    const std::string says = (end.empty() ? r.message : other_end_text(r)) + ": " + mechanism.text;
    return draw_mechanism(model, moved, mechanism, r.size, says, folder,
                          ("mechanism" + end).c_str());
  };
  if (r.mechanism) {
    if (Trouble t = write_mechanism(*r.moved, *r.mechanism, "")) return t;
  }
  if (r.other_motion) {
    const LimitMotion& other = *r.other_motion;
    if (Trouble t = write_mechanism(other.moved, other.mechanism, "_other_end")) return t;
  }
  if (!r.forces.empty()) {
    if (Trouble t = write("limit_joints.csv", limit_joints_csv(r))) return t;
    const std::string says = "forces of the joints at the limit: " + r.message;
    return draw_thrust(model, *r.drawn, r.forces, says, folder);
  }
  return {};
}

/// Those before and after the one of the limit.
void print_mechanisms(const LimitResult& r) {
  bool before = true;
  for (const LimitMechanism& m : r.mechanisms) {
    const std::string value = m.value.status == LimitEnd::found
                                  ? fmt::format("at {:.5g}", m.value.lower)
                                  : std::string("at any value");
    const std::string what = fmt::format("{} ({}, {:.3g} m2), {}", value,
                                         counted(m.blocks.size(), "block"), m.area, m.text);
    if (m.left_out) {
      fmt::print("  left out, smaller than fos.least_area: {}\n", what);
    } else if (before) {
      before = false;  // printed as the mechanism
    } else {
      fmt::print("  then, with those blocks carried, {}\n", what);
    }
  }
}

void print_end(const LimitResult& r, const std::string& folder) {
  fmt::print("{}\n", r.message);
  if (r.mechanism) fmt::print("  mechanism: {}\n", r.mechanism->text);
  if (r.other_motion)
    fmt::print("  {}{}: {}\n", other_end_text(r), r.other_governs ? ", which is nearer" : "",
               r.other_motion->mechanism.text);
  print_mechanisms(r);
  if (r.largest.status == LimitEnd::found) {
    fmt::print("  equilibrium up to {:.9g}, none from {:.9g} on\n", r.largest.lower,
               r.largest.upper);
  }
  std::string pictures;
  const auto add = [&](bool there, const char* name) {
    if (there) pictures += (pictures.empty() ? "" : ", ") + std::string(name);
  };
  add(r.mechanism.has_value(), "mechanism.png");
  add(r.other_motion.has_value(), "mechanism_other_end.png");
  add(!r.forces.empty(), "thrust.png");
  fmt::print("  {}, {}, {} of wall time; results in {}/{}\n", counted(r.blocks, "rigid block"),
             counted(r.joints, "joint"), duration_text(r.seconds), folder,
             pictures.empty() ? "" : " (" + pictures + ")");
}

Result<AnalysisResult> limit(const Model& model, const AnalysisRun& run) {
  LimitOptions options;
  options.threads = run.threads;
  options.stop = &run.stop();
  options.say = run.say;
  Result<LimitResult> found = limit_analysis(model, options);
  if (!found.ok()) return found.faults();
  const auto r = std::make_shared<const LimitResult>(std::move(found.value()));
  AnalysisResult analysis{r->message, limit_summary(model, *r), r->warnings};
  if (r->interrupted) {
    analysis.print = [r](const std::string&) { fmt::print(stderr, "{}\n", r->message); };
    analysis.code = exit_code::interrupted;
    return analysis;
  }
  analysis.print = [r](const std::string& folder) { print_end(*r, folder); };
  analysis.write = [r, &model](const std::string& folder) {
    return write_results(model, *r, folder);
  };
  if (r->largest.status == LimitEnd::not_solved) analysis.code = exit_code::failed;
  return analysis;
}

}  // namespace

void add_limit(CLI::App& app, int& code) {
  AnalysisCommand command{
      "limit", "Find the load at which the blocks, taken as rigid, collapse",
      "Example:\n"
      "  edda limit arch.toml --set fos.vary=kh\n"
      "  edda limit slope.toml\n"
      "\n"
      "Rigid limit analysis of the model as drawn, by linear programming: the largest value of "
      "what\n"
      "[fos] varies (strength, a load, a water pressure, kh, kv, tilt or gravity) under which the\n"
      "joints can carry the loads (static theorem), which is also the smallest under which a\n"
      "mechanism moves (kinematic theorem); the same for joints that slide without dilating.\n"
      "The folder (default: the model's name without .toml and with -limit, here) then holds\n"
      "  summary.json          the limit and its bounds; written last\n"
      "  mechanism.csv, mechanism_joints.csv  which blocks and joints move;  mechanism.png, .svg\n"
      "  mechanism_other_end.* the same at the other end\n"
      "  limit_joints.csv      the force of each joint and where it acts;  thrust.png, .svg",
      "Print the line with the limit alone, no warnings"};
  command.find = limit;
  add_analysis(app, code, std::move(command));
}

}  // namespace edda
