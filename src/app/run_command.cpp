// edda run
#include <fmt/format.h>

#include <atomic>
#include <memory>

#include "app/common.hpp"
#include "app/progress.hpp"
#include "results/files.hpp"
#include "run/run_model.hpp"

namespace edda {
namespace {

struct RunArguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  bool quiet = false, resume = false;
  std::string from;  ///< name or number of a stage
};

int code_of(Status status) {
  if (status == Status::failed) return exit_code::failed;
  return status == Status::interrupted ? exit_code::interrupted : exit_code::done;
}

void print_end(const Outcome& o, const std::string& folder) {
  fmt::print("{}: {}\n", status_name(o.status), o.message);
  fmt::print("  {:.6g} s in {} steps, {} of wall time; {} contacts closed at the end\n", o.time,
             o.steps, duration_text(o.wall.total), o.contacts);
  fmt::print("  energy drift {:.2g}; results in {}/ (summary.json says it all)\n", o.ledger.drift,
             folder);
}

int run(const RunArguments& args) {
  const std::optional<Model> model = read_or_print(args.model, args.overrides);
  if (!model) return exit_code::bad_input;
  std::optional<std::size_t> from;
  if (!args.from.empty()) {
    from = stage_called(*model, args.from);
    if (!from) {
      print({{{"--from", {}, 0, 0},
              '"' + args.from + "\" is no stage of the model",
              "name one of its [[stage]]s, or give its number from 0"}});
      return exit_code::bad_input;
    }
  }
  const std::string folder = args.folder.empty() ? stem_of(args.model) : args.folder;
  // Asked before the cut, which may take minutes, and again when the run starts.
  if (const Trouble trouble = check_folder(folder, args.model)) {
    print({*trouble});
    return exit_code::bad_input;
  }
  const std::atomic<bool>& stop_asked = stop_on_signals();
  Result<PreparedRun> prepared = prepare_run(*model);
  if (!prepared.ok()) {
    print(prepared.faults());
    return exit_code::bad_input;
  }
  PreparedRun& ready = prepared.value();
  if (!args.quiet) {
    const Simulation& sim = ready.sim;
    if (sim.explicit_method()) {
      fmt::print(stderr,
                 "{} blocks; step {:.4g} s; critical {:.4g} s ({:.4g} s if every bare corner "
                 "touched something), held by {}\n",
                 sim.blocks.size(), sim.step_limit, sim.bound.critical_step, sim.bound.likely_step,
                 ready.governed_by);
    } else {
      fmt::print(stderr, "{} blocks; step {:.4g} s, held by {}\n", sim.blocks.size(),
                 sim.step_limit, ready.governed_by);
    }
    print_warnings(ready.warnings);
  }
  ProgressBar bar;
  RunOptions options;
  options.folder = folder;
  options.stop = &stop_asked;
  options.resume = args.resume;
  options.from_stage = from;
  options.warn = [](const std::string& w) { fmt::print(stderr, "edda: {}\n", w); };
  if (!args.quiet) options.progress = [&](const Progress& p) { bar.show(p); };
  const Result<Outcome> outcome = run_model(ready, options);
  bar.finish();
  if (!outcome.ok()) {
    print(outcome.faults());
    return exit_code::bad_input;
  }
  const Outcome& o = outcome.value();
  if (o.status == Status::failed) fmt::print(stderr, "edda: {}\n", o.message);
  if (!args.quiet) print_end(o, folder);
  return code_of(o.status);
}

}  // namespace

void add_run(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("run", "Run a model and write its results into a folder");
  command->footer(
      "Example:\n  edda run slope.toml -o steep --set joints.rock.friction_angle=20\n\n"
      "The folder (default: the model's name without .toml, here) then holds\n"
      "  summary.json   how the run ended, the energy ledger, checks to look at; written last\n"
      "  history.csv    monitors and energies over time\n"
      "  reactions.csv  forces of the boundaries over time, where there are any\n"
      "  bolts.csv      forces along the bolts at each frame, where there are any\n"
      "  blocks.csv     every block at the end;  joints.csv: every contact\n"
      "  blocks.pvd, contacts.pvd   time series: open them in ParaView\n"
      "  model.toml     the model as run, every default filled in\n"
      "  stages.csv     a row per stage, with joints_N.csv and checkpoint_N.h5 of its end\n"
      "  checkpoint.h5  where to go on from, every few minutes of a long run\n"
      "Ctrl-C ends a run early and keeps everything so far (exit code 130); --resume goes on from\n"
      "there, to the same digits as if it had never stopped.");
  auto args = std::make_shared<RunArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", args->folder,
                   "Folder for the results (default: the model's stem)")
      ->type_name("DIR");
  command->add_flag(
      "--resume", args->resume,
      "Go on from the last checkpoint in the folder; the model must be the same, only "
      "its duration may grow");
  command
      ->add_option("--from", args->from,
                   "Go on from the end of this stage (name or number from 0) of the run in the "
                   "folder; stages after it may have changed")
      ->type_name("STAGE")
      ->excludes("--resume");
  add_threads(*command);
  add_overrides(*command, args->overrides);
  command->add_flag("--quiet", args->quiet, "No progress, no warnings, no closing words");
  command->callback([args, &code] { code = run(*args); });
}

}  // namespace edda
