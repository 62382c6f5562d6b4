// edda study
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/common.hpp"
#include "app/progress.hpp"
#include "app/study_answer.hpp"
#include "model/files/file_text.hpp"
#include "run/wall_clock.hpp"
#include "sampling/lead_study.hpp"
#include "sampling/worker_pool.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

struct StudyArguments {
  std::string study, folder, shard, worker;
  std::vector<std::string> overrides;
  std::size_t jobs = std::max(1U, std::thread::hardware_concurrency());
  bool quiet = false, json = false;
};

/// "2/8": the second of eight parts.
std::optional<Shard> shard_of(const std::string& text) {
  if (text.empty()) return Shard{};
  std::size_t part = 0, parts = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, part);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != '/') return {};
  const auto second = std::from_chars(first.ptr + 1, end, parts);
  if (second.ec != std::errc{} || second.ptr != end || part < 1 || part > parts) return {};
  return Shard{part - 1, parts};
}

int fail(const Faults& faults, bool json, int code) {
  print(faults, json);
  return code;
}

/// What edda study starts, once for each processor.
int work(const StudyArguments& args) {
  SampleFolder folder(args.worker);
  const Result<StudyPlan> plan = SampleFolder::plan_in(args.worker);
  if (!plan.ok()) return fail(plan.faults(), false, exit_code::failed);
  const Result<std::string> model = folder.model_text();
  if (!model.ok()) return fail(model.faults(), false, exit_code::failed);
  const Trouble trouble =
      work_in(folder, plan.value(), model.value(), shard_of(args.shard).value_or(Shard{}));
  return trouble ? fail({*trouble}, false, exit_code::failed) : exit_code::done;
}

/// A bar with the samples done and the time left.
class StudyProgress {
 public:
  void show(std::size_t done, std::size_t of) {
    if (first_ == none_yet) first_ = done;
    Progress p;
    p.fraction = of > 0 ? static_cast<double>(done) / static_cast<double>(of) : 0.0;
    const double spent = since(start_);
    const auto made = static_cast<double>(done - first_);
    p.rate = spent > 0.0 ? made / spent : 0.0;
    p.seconds_left = made > 0.0 ? static_cast<double>(of - std::min(done, of)) / p.rate : -1.0;
    bar_.show_samples(p, done, of);
  }
  void finish() { bar_.finish(); }

 private:
  static constexpr std::size_t none_yet = static_cast<std::size_t>(-1);
  ProgressBar bar_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t first_ = none_yet;
};

/// The path of this program, for its workers.
std::string this_program() {
  std::error_code error;
  const std::string path = std::filesystem::read_symlink("/proc/self/exe", error).string();
  return error ? "/proc/self/exe" : path;
}

/// What limits of this model leave out, where the study asks for any.
void warn_of_limits(const StudyPlan& plan, const std::string& model_text) {
  const auto of_limit = [](const Ask& ask) { return ask.of == Analysis::limit; };
  if (std::none_of(plan.ask.begin(), plan.ask.end(), of_limit)) return;
  const Result<Model> model = read_model_text(model_text, plan.model, {}, ReadFor::no_run);
  if (model.ok() && model.value().initial_stress)
    say([] { print_warnings({initial_stress_left_out}); });
}

int study(const StudyArguments& args) {
  const auto bad = [&](const Faults& faults) {
    print(faults, args.json);
    return exit_code::bad_input;
  };
  const std::optional<Shard> shard = shard_of(args.shard);
  if (!shard) {
    return bad({Fault{{"--shard", "", 0, 0},
                      fmt::format("\"{}\" is no part", args.shard),
                      "write 2/8 for the second of eight"}});
  }
  const Result<StudyPlan> plan = read_study(args.study, args.overrides);
  if (!plan.ok()) return bad(plan.faults());
  if (shard->parts > 1 && needs_all(plan.value())) {
    return bad({Fault{{"--shard", "", 0, 0},
                      "this study chooses its samples as it goes",
                      "start it in the same folder on each machine, without --shard"}});
  }
  const auto model_text = file_text(plan.value().model);
  if (const Fault* fault = std::get_if<Fault>(&model_text)) return bad({*fault});
  if (!args.quiet && !args.json) warn_of_limits(plan.value(), std::get<std::string>(model_text));
  SampleFolder folder(args.folder.empty() ? stem_of(args.study) : args.folder);
  StudyOptions options;
  options.worker = {this_program(), "study", "--worker", folder.path()};
  if (!args.shard.empty()) options.worker.insert(options.worker.end(), {"--shard", args.shard});
  options.jobs = args.jobs;
  options.shard = *shard;
  options.stop = &stop_on_signals();
  StudyProgress progress;
  if (!args.quiet && !args.json)
    options.progress = [&](std::size_t done, std::size_t of) { progress.show(done, of); };
  SamplerProcess sampler;
  const auto start = std::chrono::steady_clock::now();
  Result<StudyRun> run =
      lead_study(plan.value(), std::get<std::string>(model_text), folder, options, sampler);
  progress.finish();
  if (!run.ok()) return bad(run.faults());
  return answer_study(plan.value(), std::move(run.value()), folder, sampler,
                      {args.json, args.quiet, since(start)});
}

void add_arguments(CLI::App& command, StudyArguments& args) {
  command.add_option("STUDY", args.study, "The study, a TOML file")->type_name("FILE");
  command
      .add_option("-o,--output", args.folder, "Folder of the samples (default: the study's name)")
      ->type_name("DIR");
  command
      .add_option("-j,--jobs", args.jobs,
                  "Runs side by side (default: the processors); 0: others fill the folder")
      ->check(CLI::Range(0, 1024));
  add_overrides(command, args.overrides);
  command.add_flag("--quiet", args.quiet, "Print the answer alone: no progress");
  add_json(command, args.json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
}

}  // namespace

void add_fit(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("fit", "Find values of a model from what was measured");
  command->footer(
      "Example:\n"
      "  edda fit tunnel-fit.toml\n"
      "\n"
      "Back-analysis by least squares: the study names a model, quantities between bounds\n"
      "([vary.NAME] with low and high), and measurements ([ask.NAME] with measured and error).\n"
      "The answer is the values with their standard errors, and which of them the measurements do\n"
      "not tell apart. The folder holds what that of edda study does.");
  auto args = std::make_shared<StudyArguments>();
  add_arguments(*command, *args);
  command->callback([args, &code] {
    if (args->study.empty()) throw CLI::RequiredError("STUDY");
    args->overrides.insert(args->overrides.begin(), "sampling.method=fit");
    code = study(*args);
  });
}

void add_study(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("study", "Run a model thousands of times with values that vary");
  command->footer(
      "Example:\n"
      "  edda study bench-study.toml\n"
      "  edda study bench-study.toml --set sampling.samples=5000     goes on to 5000 samples\n"
      "  edda study show bench-study --run 17                        writes the model of a sample\n"
      "\n"
      "The study names a model, what varies and how ([vary.NAME]), what is asked of each sample\n"
      "([ask.NAME]: edda run, fos or limit) and when it fails ([failure]); `edda keys --study`\n"
      "prints all keys. The folder (default: the study's name without .toml, here) holds\n"
      "  study.csv             a row a sample: its values, its answers, whether it failed\n"
      "  summary.json          probability of failure, distributions, sensitivities\n"
      "  report.html           all of it with pictures, one page\n"
      "Any number of processes on any number of machines may fill one folder: start the same\n"
      "command on each. What was killed goes on where it was; the outcome is the same bytes.");
  auto args = std::make_shared<StudyArguments>();
  add_arguments(*command, *args);
  command->add_option("--shard", args->shard, "I/N: only this part of the samples, of N");
  command->add_option("--worker", args->worker)->group("");
  add_study_show(*command, code);
  add_study_merge(*command, code);
  command->callback([args, command, &code] {
    if (!command->get_subcommands().empty()) return;
    if (args->study.empty() && args->worker.empty()) throw CLI::RequiredError("STUDY");
    code = args->worker.empty() ? study(*args) : work(*args);
  });
}

}  // namespace edda
