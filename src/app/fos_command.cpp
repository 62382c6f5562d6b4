// edda fos
#include <fmt/format.h>
#include <omp.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "app/common.hpp"
#include "app/mechanism_picture.hpp"
#include "app/study_folder.hpp"
#include "base/text.hpp"
#include "model/write_model.hpp"
#include "results/columns.hpp"
#include "results/files.hpp"
#include "study/fos.hpp"

namespace edda {
namespace {

struct FosArguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  bool quiet = false, json = false;
};

Trouble write_results(const Model& model, const FosResult& r, const std::string& folder) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("model.toml", to_toml(model))) return t;
  if (Trouble t = write("fos.csv", fos_csv(r.trials))) return t;
  if (r.mechanism) {
    if (Trouble t = write("mechanism.csv", mechanism_csv(*r.failed, *r.mechanism))) return t;
    if (Trouble t = write("mechanism_joints.csv", mechanism_joints_csv(*r.mechanism))) return t;
    const std::string says =
        fmt::format("mechanism at factor {:.4g}: {}", *r.fails, r.mechanism->text);
    if (Trouble t = draw_mechanism(model, *r.failed, *r.mechanism, r.size, says, folder)) return t;
  }
  if (Trouble t = write_columns_csv(folder)) return t;
  return write("summary.json", fos_summary(model, r, omp_get_max_threads()));
}

void print_end(const FosResult& r, const std::string& folder) {
  fmt::print("{}\n", r.message);
  if (!r.proof.empty()) fmt::print("  {}\n", r.proof);
  if (r.mechanism) fmt::print("  mechanism at {:.6g}: {}\n", *r.fails, r.mechanism->text);
  const std::string lost = r.mechanism ? lost_cohesion_text(*r.mechanism) : std::string();
  if (!lost.empty()) fmt::print("  {}\n", lost);
  if (r.rigid) fmt::print("  {}\n", r.rigid->text);
  fmt::print(
      "  a trial counts as failed when {}\n",
      r.criterion.displacement
          ? fmt::format("a corner has moved by more than {:.3g} m", *r.criterion.displacement)
          : fmt::format("rigid blocks have no equilibrium in their present places, or blocks have "
                        "moved by more than {:.2g} of their size as seen from those beside them "
                        "({:.2g} where rigid blocks as drawn have none)",
                        r.criterion.allowed, moved_little));
  fmt::print("  {}, {} of wall time; results in {}/ (fos.csv, mechanism.png)\n",
             counted(r.trials.size(), "trial"), duration_text(r.seconds), folder);
}

int code_of(FosStatus status) {
  return status == FosStatus::interrupted ? exit_code::interrupted : exit_code::done;
}

int fos(const FosArguments& args) {
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, args.json, ReadFor::no_run);
  if (!model) return exit_code::bad_input;
  const std::string folder = args.folder.empty() ? stem_of(args.model) + "-fos" : args.folder;
  if (const Trouble trouble = check_folder(folder, args.model)) {
    print({*trouble}, args.json);
    return exit_code::bad_input;
  }
  const std::atomic<bool>& stop_asked = stop_on_signals();
  FosOptions options;
  options.threads = omp_get_max_threads();
  options.stop = &stop_asked;
  if (!args.quiet && !args.json)
    options.say = options.progress = [](const std::string& line) {
      say([&] { fmt::print(stderr, "{}\n", line); });
    };
  const Result<FosResult> found = find_factor(*model, options);
  if (!found.ok()) {
    print(found.faults(), args.json);
    return exit_code::bad_input;
  }
  const FosResult& r = found.value();
  if (!args.quiet && !args.json) say([&] { print_warnings(r.warnings); });
  const Trouble trouble =
      fill_study_folder(folder, [&] { return write_results(*model, r, folder); });
  if (trouble) {
    print({*trouble}, args.json);
    return exit_code::failed;
  }
  print_answer(args.json, args.quiet, fos_summary(*model, r, omp_get_max_threads()), r.message,
               [&] { print_end(r, folder); });
  return code_of(r.status);
}

}  // namespace

void add_fos(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("fos", "Find a model's factor of safety");
  command->footer(
      "Example:\n"
      "  edda fos slope.toml\n"
      "  edda fos dam.toml --set fos.vary=water:reservoir\n"
      "\n"
      "Brings the model to equilibrium, then tries factors: the strength of the joints divided by\n"
      "it (cohesion, tangent of the friction angle, tensile strength), or a load, a water "
      "pressure\n"
      "or a ground motion multiplied by it, until the bracket between a factor that holds and one\n"
      "that fails is no wider than the part fos.tolerance of its lower factor.\n"
      "The folder (default: the model's name without .toml and with -fos, here) then holds\n"
      "  summary.json          the factor, its bracket, the criterion, the mechanism; written "
      "last\n"
      "  fos.csv               every trial: factor, outcome, largest displacement, its block, "
      "velocity\n"
      "  mechanism.csv         which blocks move at the lowest factor that fails, and how\n"
      "  mechanism_joints.csv  along which joints;  mechanism.png, mechanism.svg: a picture\n"
      "Ctrl-C ends it early with the bracket so far (exit code 130).");
  auto args = std::make_shared<FosArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", args->folder, "Folder for the results (default: stem-fos)")
      ->type_name("DIR");
  add_threads(*command);
  add_overrides(*command, args->overrides);
  command->add_flag("--quiet", args->quiet,
                    "Print the line with the factor alone: no progress, no warnings");
  add_json(*command, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  command->callback([args, &code] { code = fos(*args); });
}

}  // namespace edda
