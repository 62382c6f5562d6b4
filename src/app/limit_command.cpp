// edda limit
#include <fmt/format.h>
#include <omp.h>

#include <memory>

#include "app/common.hpp"
#include "app/mechanism_picture.hpp"
#include "app/study_folder.hpp"
#include "base/text.hpp"
#include "model/write_model.hpp"
#include "results/columns.hpp"
#include "results/files.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

struct LimitArguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  bool quiet = false, json = false;
};

std::string other_end_text(const LimitResult& r) {
  return fmt::format("at the other end {:.5g}", r.smallest->lower);
}

Trouble write_results(const Model& model, const LimitResult& r, const std::string& folder) {
  const auto write = [&](const std::string& name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("model.toml", to_toml(model))) return t;
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
    if (Trouble t = draw_thrust(model, *r.drawn, r.forces, says, folder)) return t;
  }
  if (Trouble t = write_columns_csv(folder)) return t;
  return write("summary.json", limit_summary(model, r));
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
  fmt::print("  {} rigid blocks, {} joints, {} of wall time; results in {}/{}\n", r.blocks,
             r.joints, duration_text(r.seconds), folder,
             pictures.empty() ? "" : " (" + pictures + ")");
}

int limit(const LimitArguments& args) {
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, args.json, ReadFor::no_run);
  if (!model) return exit_code::bad_input;
  const std::string folder = args.folder.empty() ? stem_of(args.model) + "-limit" : args.folder;
  if (const Trouble trouble = check_folder(folder, args.model)) {
    print({*trouble}, args.json);
    return exit_code::bad_input;
  }
  LimitOptions options;
  options.threads = omp_get_max_threads();
  options.stop = &stop_on_signals();
  if (!args.quiet && !args.json)
    options.say = [](const std::string& line) { say([&] { fmt::print(stderr, "{}\n", line); }); };
  const Result<LimitResult> found = limit_analysis(*model, options);
  if (!found.ok()) {
    print(found.faults(), args.json);
    return exit_code::bad_input;
  }
  const LimitResult& r = found.value();
  if (r.interrupted) {
    print_answer(args.json, args.quiet, limit_summary(*model, r), r.message,
                 [&] { fmt::print(stderr, "{}\n", r.message); });
    return exit_code::interrupted;
  }
  if (!args.quiet && !args.json) say([&] { print_warnings(r.warnings); });
  const Trouble trouble =
      fill_study_folder(folder, [&] { return write_results(*model, r, folder); });
  if (trouble) {
    print({*trouble}, args.json);
    return exit_code::failed;
  }
  print_answer(args.json, args.quiet, limit_summary(*model, r), r.message,
               [&] { print_end(r, folder); });
  return r.largest.status == LimitEnd::not_solved ? exit_code::failed : exit_code::done;
}

}  // namespace

void add_limit(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("limit", "Find the load at which the blocks, taken as rigid, collapse");
  command->footer(
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
      "  limit_joints.csv      the force of each joint and where it acts;  thrust.png, .svg");
  auto args = std::make_shared<LimitArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", args->folder, "Folder for the results (default: stem-limit)")
      ->type_name("DIR");
  add_overrides(*command, args->overrides);
  add_threads(*command);
  command->add_flag("--quiet", args->quiet, "Print the line with the limit alone, no warnings");
  add_json(*command, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  command->callback([args, &code] { code = limit(*args); });
}

}  // namespace edda
