// edda limit
#include <fmt/format.h>

#include <memory>

#include "app/common.hpp"
#include "app/mechanism_picture.hpp"
#include "app/study_folder.hpp"
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

Trouble write_results(const Model& model, const LimitResult& r, const std::string& folder) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("model.toml", to_toml(model))) return t;
  if (r.mechanism) {
    if (Trouble t = write("mechanism.csv", mechanism_csv(*r.moved, *r.mechanism))) return t;
    if (Trouble t = write("mechanism_joints.csv", mechanism_joints_csv(*r.mechanism))) return t;
    const std::string says = r.message + ": " + r.mechanism->text;
    if (Trouble t = draw_mechanism(model, *r.moved, *r.mechanism, r.size, says, folder)) return t;
  }
  if (!r.forces.empty()) {
    if (Trouble t = write("limit_joints.csv", limit_joints_csv(r))) return t;
    const std::string says = "forces of the joints at the limit: " + r.message;
    if (Trouble t = draw_thrust(model, *r.drawn, r.forces, says, folder)) return t;
  }
  if (Trouble t = write_columns_csv(folder)) return t;
  return write("summary.json", limit_summary(model, r));
}

void print_end(const LimitResult& r, const std::string& folder) {
  fmt::print("{}\n", r.message);
  if (r.mechanism) fmt::print("  mechanism: {}\n", r.mechanism->text);
  if (r.largest.status == LimitEnd::found) {
    fmt::print("  equilibrium up to {:.9g}, none from {:.9g} on\n", r.largest.lower,
               r.largest.upper);
  }
  std::string pictures = r.mechanism ? "mechanism.png" : "";
  if (!r.forces.empty()) pictures += pictures.empty() ? "thrust.png" : ", thrust.png";
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
  const Result<LimitResult> found = limit_analysis(*model);
  if (!found.ok()) {
    print(found.faults(), args.json);
    return exit_code::bad_input;
  }
  const LimitResult& r = found.value();
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
      "  limit_joints.csv      the force of each joint and where it acts;  thrust.png, .svg");
  auto args = std::make_shared<LimitArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", args->folder, "Folder for the results (default: stem-limit)")
      ->type_name("DIR");
  add_overrides(*command, args->overrides);
  command->add_flag("--quiet", args->quiet, "Print the line with the limit alone, no warnings");
  add_json(*command, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  command->callback([args, &code] { code = limit(*args); });
}

}  // namespace edda
