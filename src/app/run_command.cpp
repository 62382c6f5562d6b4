// edda run
#include <fmt/format.h>

#include <atomic>
#include <memory>

#include "app/common.hpp"
#include "app/curve_picture.hpp"
#include "app/run_report.hpp"
#include "model/stage_names.hpp"
#include "results/files.hpp"
#include "run/run_model.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

struct RunArguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  bool quiet = false, resume = false, json = false;
  std::optional<std::string> from;  ///< name or number of a stage
};

int code_of(Status status) {
  if (status == Status::failed) return exit_code::failed;
  return status == Status::interrupted ? exit_code::interrupted : exit_code::done;
}

/// The stage of --from; nothing without the option.
Result<std::optional<std::size_t>> first_stage(const Model& model,
                                               const std::optional<std::string>& name) {
  if (!name) return std::optional<std::size_t>{};
  if (const auto stage = stage_called(model, *name)) return stage;
  return Fault{{"--from", {}, 0, 0},
               '"' + *name + "\" is no stage of the model",
               "name one of its [[stage]]s, or give its number from 1"};
}

RunOptions options_for(const RunArguments& args, const std::string& folder, RunReport& report) {
  RunOptions options;
  options.folder = folder;
  options.resume = args.resume;
  options.warn = [&](const std::string& w) { say([&] { report.warns(w); }); };
  options.progress = [&](const Progress& p) { say([&] { report.goes_on(p); }); };
  options.stage_ended = [&](const StageReport& s) { say([&] { report.stage_ended(s); }); };
  if (args.json) options.progress_every = 1.0;
  return options;
}

/// The model of the command line, if it, the stage to start from and the folder are usable.
Result<Model> usable_model(const RunArguments& args, const std::string& folder) {
  Result<Model> model = read_within_memory(args.model, args.overrides);
  if (!model.ok()) return model;
  const auto from = first_stage(model.value(), args.from);
  if (!from.ok()) return from.faults();
  // Checked before the cut, which may take minutes, and again when the run starts.
  const bool goes_on = args.resume || args.from.has_value();
  if (const Trouble trouble = check_folder(folder, goes_on ? "" : args.model)) return *trouble;
  return model;
}

int run(const RunArguments& args, RunReport* report) {
  const auto refuse = [&](const Faults& faults) {
    say([&] { report->refused(faults); });
    return exit_code::bad_input;
  };
  const std::string folder = args.folder.empty() ? stem_of(args.model) : args.folder;
  const Result<Model> model = usable_model(args, folder);
  if (!model.ok()) return refuse(model.faults());
  const std::atomic<bool>& stop_asked = stop_on_signals();
  Result<PreparedRun> prepared = prepare_run(model.value());
  if (!prepared.ok()) return refuse(prepared.faults());
  say([&] { report->starts(prepared.value(), folder); });
  RunOptions options = options_for(args, folder, *report);
  options.stop = &stop_asked;
  options.from_stage = first_stage(model.value(), args.from).value();
  options.rigid_factor = [&](const Simulation& sim) { return rigid_factor(model.value(), sim); };
  const Result<Outcome> outcome = run_model(prepared.value(), options);
  if (!outcome.ok()) return refuse(outcome.faults());
  if (has_curve(folder)) {
    for (const char* file : {"/curve.png", "/curve.svg"}) {
      if (const Trouble trouble = draw_curve(folder, folder + file, {}))
        options.warn(to_string(*trouble));
    }
  }
  const int code = code_of(outcome.value().status);
  say([&] { report->ends(outcome.value(), folder, code); });
  return code;
}

int run(const RunArguments& args) {
  const std::unique_ptr<RunReport> report =
      args.json ? report_to_machines(args.quiet) : report_to_people(args.quiet);
  std::string why;
  try {
    return run(args, report.get());
  } catch (const std::bad_alloc&) {
    why = "out of memory: close other programs, or make the model smaller";
  } catch (const std::exception& error) {
    why = error.what();
  }
  say([&] { report->breaks(why); });
  return exit_code::failed;
}

}  // namespace

void add_run(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("run", "Run a model and write its results into a folder");
  command->footer(
      "Example:\n"
      "  edda run slope.toml -o smooth --set joints.bedding.friction_angle=20\n"
      "\n"
      "The folder (default: the model's name without .toml, here) then holds\n"
      "  summary.json   how the run ended, the energy balance, checks to look at; written last\n"
      "  history.csv    monitors and energies over time\n"
      "  reactions.csv  forces of the boundaries over time, where there are any\n"
      "  bolts.csv      forces along the bolts at each frame, where there are any\n"
      "  linings.csv    thrust, moment and shear of linings at each frame, where there are any\n"
      "  blocks.csv     every block at the end;  joints.csv: every contact\n"
      "  blocks.pvd, contacts.pvd   time series: open them in ParaView\n"
      "  model.toml     the model as run, every default filled in\n"
      "  stages.csv     a row per stage, with joints_N.csv and checkpoint_N.h5 of its end\n"
      "  curve.csv      a row per increment of a ramp, drawn as curve.png and curve.svg\n"
      "  checkpoint.h5  the state to continue from, every few minutes of a long run\n"
      "Ctrl-C ends a run early and keeps everything so far (exit code 130); --resume continues\n"
      "it, with the same digits as a run that was never stopped.");
  auto args = std::make_shared<RunArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", args->folder,
                   "Folder for the results (default: the model's stem)")
      ->type_name("DIR");
  command->add_flag("--resume", args->resume,
                    "Continue from the last checkpoint in the folder; the model must be the same, "
                    "only its duration may grow");
  command
      ->add_option("--from", args->from,
                   "Continue from the end of this stage (name or number from 1) of the run in the "
                   "folder; stages after it may have changed")
      ->type_name("STAGE")
      ->excludes("--resume");
  add_threads(*command);
  add_overrides(*command, args->overrides);
  command->add_flag(
      "--quiet", args->quiet,
      "No progress, no summary at the end, no warnings except of what a run could not write");
  add_json(*command, args->json,
           "Report all events as JSON, one object per line on stdout, and nothing on stderr");
  command->callback([args, &code] { code = run(*args); });
}

}  // namespace edda
