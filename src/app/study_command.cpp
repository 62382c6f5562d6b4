// edda study
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/common.hpp"
#include "app/progress.hpp"
#include "app/study_pictures.hpp"
#include "base/text.hpp"
#include "model/files/file_text.hpp"
#include "model/write_model.hpp"
#include "results/files.hpp"
#include "results/json.hpp"
#include "run/wall_clock.hpp"
#include "sampling/study_results.hpp"
#include "sampling/worker_pool.hpp"

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

Trouble write_results(const StudyPlan& plan, const StudyResults& r, const SampleFolder& folder,
                      SamplerProcess& sampler) {
  if (Trouble t = write_file(folder.file("study.csv"), study_csv(plan, r))) return t;
  if (Trouble t = folder.tidy(plan)) return t;
  if (Trouble t = draw_study(plan, r, folder, sampler)) return t;
  return write_file(folder.file("summary.json"), study_summary(plan, r));
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

void print_end(const StudyPlan& plan, const StudyResults& r, const std::string& folder,
               double seconds) {
  fmt::print("{}\n", r.message);
  for (const AskedNumbers& a : r.asked) {
    if (a.values.empty()) continue;
    fmt::print(
        "  {}: mean {:.4g}, standard deviation {:.3g}, 5 % below {:.4g}, 95 % below {:.4g}\n",
        a.name, a.mean, a.sd, a.quantile_05, a.quantile_95);
    if (a.unstable > 0)
      fmt::print("    {} without any equilibrium\n", counted(a.unstable, "sample"));
    if (a.none > 0)
      fmt::print("    {} without an answer (study.csv says why)\n", counted(a.none, "sample"));
  }
  (void)plan;
  fmt::print("  {} of wall time; results in {}/ (study.csv, report.html)\n", duration_text(seconds),
             folder);
}

int study(const StudyArguments& args) {
  if (!args.worker.empty()) return work(args);
  const std::optional<Shard> shard = shard_of(args.shard);
  if (!shard)
    return fail({Fault{{"--shard", "", 0, 0},
                       fmt::format("\"{}\" is no part", args.shard),
                       "write 2/8 for the second of eight"}},
                args.json, exit_code::bad_input);
  const Result<StudyPlan> plan = read_study(args.study, args.overrides);
  if (!plan.ok()) return fail(plan.faults(), args.json, exit_code::bad_input);
  const auto model_text = file_text(plan.value().model);
  if (const Fault* fault = std::get_if<Fault>(&model_text))
    return fail({*fault}, args.json, exit_code::bad_input);
  SampleFolder folder(args.folder.empty() ? stem_of(args.study) : args.folder);
  StudyOptions options;
  options.worker = {"/proc/self/exe", "study", "--worker", folder.path()};
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
  if (!run.ok()) return fail(run.faults(), args.json, exit_code::bad_input);
  const Result<StudyResults> results = results_of(plan.value(), std::move(run.value()), sampler);
  if (!results.ok()) return fail(results.faults(), args.json, exit_code::failed);
  const StudyResults& r = results.value();
  if (r.run.end == StudyEnd::complete) {
    if (const Trouble t = write_results(plan.value(), r, folder, sampler))
      return fail({*t}, args.json, exit_code::failed);
  }
  say([&] {
    if (args.json) {
      fmt::print("{}\n", one_line(study_summary(plan.value(), r)));
    } else if (args.quiet) {
      fmt::print("{}\n", r.message);
    } else {
      print_end(plan.value(), r, folder.path(), since(start));
    }
  });
  return r.run.end == StudyEnd::interrupted ? exit_code::interrupted : exit_code::done;
}

}  // namespace

void add_study(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("study", "Run a model thousands of times with values that vary");
  command->footer(
      "Example:\n"
      "  edda study bench-study.toml\n"
      "  edda study bench-study.toml --set sampling.samples=5000     goes on to 5000 samples\n");
  auto args = std::make_shared<StudyArguments>();
  command->add_option("STUDY", args->study, "The study, a TOML file")->type_name("FILE");
  command
      ->add_option("-o,--output", args->folder, "Folder of the samples (default: the study's name)")
      ->type_name("DIR");
  command->add_option("-j,--jobs", args->jobs, "Runs side by side (default: the processors)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--shard", args->shard, "I/N: only this part of the samples, of N");
  command->add_option("--worker", args->worker)->group("");
  add_overrides(*command, args->overrides);
  command->add_flag("--quiet", args->quiet, "Print the answer alone: no progress");
  add_json(*command, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  command->callback([args, &code] { code = study(*args); });
}

}  // namespace edda
