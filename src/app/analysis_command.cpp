#include "app/analysis_command.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "model/write_model.hpp"
#include "results/columns.hpp"
#include "results/files.hpp"
#include "results/json.hpp"

namespace edda {
namespace {

struct Arguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  bool quiet = false, json = false;
};

Trouble write_files(const Model& model, const AnalysisResult& found, const std::string& folder) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("model.toml", to_toml(model))) return t;
  if (Trouble t = found.write(folder)) return t;
  if (Trouble t = write_columns_csv(folder)) return t;
  return write("summary.json", found.summary);
}

/// Makes or clears the folder, which has no frames, and fills it while it is locked.
Trouble fill(const Model& model, const AnalysisResult& found, const std::string& folder) {
  FolderLock lock;
  Trouble trouble = make_folder(folder);
  if (!trouble) trouble = lock.take(folder);
  if (!trouble) trouble = clear_folder(folder);
  std::error_code none_there;
  std::filesystem::remove(folder + "/frames", none_there);
  return trouble ? trouble : write_files(model, found, folder);
}

void print_answer(const Arguments& args, const AnalysisResult& found, const std::string& folder) {
  if (args.json) {
    fmt::print("{}\n", one_line(found.summary));
  } else if (!found.failure.empty()) {
    fmt::print(stderr, "edda: {}\n", found.failure);
  } else if (args.quiet || !found.print) {
    fmt::print("{}\n", found.message);
  } else {
    found.print(folder);
  }
}

int analyse(const AnalysisCommand& command, const Arguments& args) {
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, args.json, command.reads);
  if (!model) return exit_code::bad_input;
  const std::string folder =
      args.folder.empty() ? stem_of(args.model) + "-" + command.name : args.folder;
  const Trouble occupied = command.writes ? check_folder(folder, args.model) : Trouble{};
  if (occupied) {
    print({*occupied}, args.json);
    return exit_code::bad_input;
  }
  const bool talks = !args.quiet && !args.json;
  AnalysisRun run{omp_get_max_threads(), stop_on_signals, {}};
  if (talks)
    run.say = [](const std::string& line) { say([&] { fmt::print(stderr, "{}\n", line); }); };
  const Result<AnalysisResult> result = command.find(*model, run);
  if (!result.ok()) {
    print(result.faults(), args.json);
    return exit_code::bad_input;
  }
  const AnalysisResult& found = result.value();
  if (talks) say([&] { print_warnings(found.warnings); });
  if (const Trouble trouble = found.write ? fill(*model, found, folder) : Trouble{}) {
    print({*trouble}, args.json);
    return exit_code::failed;
  }
  say([&] { print_answer(args, found, folder); });
  return found.code;
}

}  // namespace

CLI::App& add_analysis(CLI::App& app, int& code, AnalysisCommand command) {
  CLI::App* const added = app.add_subcommand(command.name, command.what);
  added->footer(command.footer);
  auto args = std::make_shared<Arguments>();
  added->add_option("MODEL", args->model, "The model, a TOML file")->required()->type_name("FILE");
  if (command.writes) {
    added
        ->add_option("-o,--output", args->folder,
                     fmt::format("Folder for the results (default: stem-{})", command.name))
        ->type_name("DIR");
  }
  add_threads(*added);
  add_overrides(*added, args->overrides);
  added->add_flag("-q,--quiet", args->quiet, command.quiet);
  add_json(*added, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  added->callback([args, &code, command = std::move(command)] { code = analyse(command, *args); });
  return *added;
}

}  // namespace edda
