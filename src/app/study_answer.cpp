// The end of a study; edda study show and merge.
#include "app/study_answer.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/common.hpp"
#include "app/study_pictures.hpp"
#include "base/text.hpp"
#include "model/read_model.hpp"
#include "model/write_model.hpp"
#include "results/json.hpp"
#include "sampling/study_results.hpp"

namespace edda {
namespace {

void print_end(const StudyResults& r, const std::string& folder, double seconds) {
  fmt::print("{}\n", r.message);
  for (const AskedNumbers& a : r.asked) {
    if (a.values.empty() || r.run.reliability || r.run.fitted) continue;
    fmt::print(
        "  {}: mean {:.4g}, standard deviation {:.3g}, 5 % below {:.4g}, 95 % below {:.4g}\n",
        a.name, a.mean, a.sd, a.quantile_05, a.quantile_95);
    if (a.unstable > 0)
      fmt::print("    {} without any equilibrium\n", counted(a.unstable, "sample"));
    if (a.none > 0)
      fmt::print("    {} without an answer (study.csv says why)\n", counted(a.none, "sample"));
  }
  if (r.map && r.map->samples > 0) {
    const Vec2 at = r.map->places[r.map->most()];
    const double part = r.map->part(r.map->most());
    if (part == 0.0) {
      fmt::print("  no key blocks at any place of the map\n");
    } else {
      fmt::print("  key blocks most often at ({:.4g}, {:.4g}): in {:.3g} % of the samples\n", at.x,
                 at.y, 100.0 * part);
    }
  }
  const char* what = r.run.end == StudyEnd::complete ? "results" : "samples";
  fmt::print("  {} of wall time; {} in {}/{}\n", duration_text(seconds), what, folder,
             r.run.end == StudyEnd::complete ? " (study.csv, report.html)" : "");
}

Trouble write_results(const StudyPlan& plan, const StudyResults& r, const SampleFolder& folder,
                      SamplerProcess& sampler) {
  return folder.tidy(plan, [&]() -> Trouble {
    if (Trouble t = write_file(folder.file("study.csv"), study_csv(plan, r))) return t;
    if (r.map) {
      if (Trouble t = write_file(folder.file("key_block_map.csv"), map_csv(*r.map))) return t;
    }
    if (Trouble t = write_columns_csv(folder.path(), columns_of(plan))) return t;
    if (Trouble t = draw_study(plan, r, folder, sampler)) return t;
    return write_file(folder.file("summary.json"), study_summary(plan, r));
  });
}

/// The values of a sample, its answers, and its model, with which it can be run again.
int show(const std::string& path, long long number, const std::string& output) {
  const auto bad = [](const Faults& faults) {
    print(faults);
    return exit_code::bad_input;
  };
  const Result<StudyPlan> plan = SampleFolder::plan_in(path);
  if (!plan.ok()) return bad(plan.faults());
  const SampleFolder folder(path);
  const Result<Points> points = folder.points(plan.value());
  if (!points.ok()) return bad(points.faults());
  const Rows rows = folder.rows(plan.value());
  if (number < 0) {
    fmt::print("{} of {} done\n", rows.size(), counted(points.value().size(), "sample"));
    return exit_code::done;
  }
  const auto sample = static_cast<std::size_t>(number);
  if (sample >= points.value().size()) {
    return bad({Fault{{"--run", "", 0, 0},
                      fmt::format("there is no sample {}", sample),
                      fmt::format("give 0 to {}", points.value().size() - 1)}});
  }
  const std::vector<double>& point = points.value()[sample];
  for (std::size_t q = 0; q < point.size(); ++q)
    fmt::print("{} = {:.6g} {}\n", plan.value().vary[q].name, point[q], plan.value().vary[q].unit);
  if (const auto row = rows.find(sample); row != rows.end()) {
    for (std::size_t k = 0; k < plan.value().ask.size(); ++k)
      fmt::print("{}: {}\n", plan.value().ask[k].name, row->second.cells[k]);
    if (!row->second.message.empty()) fmt::print("{}\n", row->second.message);
  }
  const Result<std::string> text = folder.model_text();
  if (!text.ok()) return bad(text.faults());
  const Result<Model> model = read_model_text(text.value(), plan.value().model,
                                              overrides_of(plan.value(), point), ReadFor::no_run);
  if (!model.ok()) return bad(model.faults());
  const std::string file =
      output.empty() ? folder.file(fmt::format("sample-{}.toml", sample)) : output;
  if (const Trouble t = write_file(file, to_toml(model.value()))) {
    print({*t});
    return exit_code::failed;
  }
  fmt::print("its model is in {}\n", file);
  return exit_code::done;
}

int merge(const std::string& into, const std::vector<std::string>& parts) {
  SampleFolder folder(into);
  if (const Trouble t = folder.merge(parts)) {
    print({*t});
    return exit_code::bad_input;
  }
  const Result<StudyPlan> plan = SampleFolder::plan_in(into);
  const Result<std::string> model = folder.model_text();
  SamplerProcess sampler;
  StudyOptions options;
  options.jobs = 0;
  options.waits = false;
  Result<StudyRun> run = lead_study(plan.value(), model.value(), folder, options, sampler);
  if (!run.ok()) {
    print(run.faults());
    return exit_code::bad_input;
  }
  return answer_study(plan.value(), std::move(run.value()), folder, sampler, {});
}

}  // namespace

int answer_study(const StudyPlan& plan, StudyRun run, const SampleFolder& folder,
                 SamplerProcess& sampler, const AnswerStyle& style) {
  const Result<StudyResults> results = results_of(plan, std::move(run), sampler);
  Faults faults = results.ok() ? Faults{} : results.faults();
  if (results.ok() && results.value().run.end == StudyEnd::complete) {
    if (Trouble t = write_results(plan, results.value(), folder, sampler)) faults.push_back(*t);
  }
  if (!faults.empty()) {
    print(faults, style.json);
    return exit_code::failed;
  }
  const StudyResults& r = results.value();
  say([&] {
    if (style.json) {
      fmt::print("{}\n", one_line(study_summary(plan, r)));
    } else if (style.quiet) {
      fmt::print("{}\n", r.message);
    } else {
      print_end(r, folder.path(), style.seconds);
    }
  });
  return r.run.end == StudyEnd::interrupted ? exit_code::interrupted : exit_code::done;
}

void add_study_show(CLI::App& study, int& code) {
  CLI::App* command = study.add_subcommand("show", "Print a sample, and write its model");
  auto folder = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  auto number = std::make_shared<long long>(-1);
  command->add_option("FOLDER", *folder, "Folder of the study")->required()->type_name("DIR");
  command->add_option("--run", *number, "Number of the sample (study.csv)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("-o,--output", *output, "The model's file (default: in the folder)")
      ->type_name("FILE");
  command->callback([=, &code] { code = show(*folder, *number, *output); });
}

void add_study_merge(CLI::App& study, int& code) {
  CLI::App* command =
      study.add_subcommand("merge", "Join the folders of parts (--shard) into a new one");
  auto into = std::make_shared<std::string>();
  auto parts = std::make_shared<std::vector<std::string>>();
  command->add_option("FOLDER", *into, "The new folder")->required()->type_name("DIR");
  command->add_option("PARTS", *parts, "Folders of the parts")->required()->type_name("DIR");
  command->callback([=, &code] { code = merge(*into, *parts); });
}

}  // namespace edda
