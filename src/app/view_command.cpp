// edda view
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "app/common.hpp"
#include "app/plot_source.hpp"
#include "base/text.hpp"
#include "model/read_model.hpp"
#include "view/page.hpp"
#include "view/server.hpp"

namespace edda {
namespace {

struct ViewArguments {
  std::string folder, output;
  double most = 200.0;  // MB
  bool serve = false;
  int port = 8080;
};

/// Data of the model; a page works without them where the model file no longer exists.
ViewNames names_of(const std::string& folder) {
  ViewNames names;
  const Result<Model> read = read_model(folder + "/model.toml", {}, ReadFor::no_run);
  if (!read.ok()) return names;
  const Model& model = read.value();
  names.title = model.title;
  names.least_stress = least_stress_of(model);
  names.judges_rock = std::any_of(model.materials.begin(), model.materials.end(),
                                  [](const Material& m) { return m.strength.has_value(); });
  for (const Material& m : model.materials) names.materials.push_back(m.name);
  for (const Monitor& m : model.monitors) names.monitors.push_back({m.name, {m.point}});
  for (const Convergence& c : model.convergences)
    names.convergences.push_back({c.name, {c.between[0], c.between[1]}});
  return names;
}

int write(ViewRun& run, const ViewArguments& args) {
  const std::string path = args.output.empty() ? name_of(args.folder) + ".html" : args.output;
  const Result<PageReport> report =
      write_page(run, path, static_cast<std::size_t>(args.most * 1e6));
  if (!report.ok()) {
    print(report.faults());
    return exit_code::failed;
  }
  const PageReport& r = report.value();
  fmt::print("wrote {}: {}, {:.1f} MB\n", path, counted(r.frames, "frame"),
             1e-6 * static_cast<double>(r.bytes));
  if (r.frames < r.of) {
    fmt::print(
        "  {} of the run's {} frames were left out, evenly, to stay below {:g} MB: --max-size\n",
        r.of - r.frames, r.of, args.most);
  }
  if (static_cast<double>(r.bytes) > args.most * 1e6)
    fmt::print("  that is more than {:g} MB: the first and the last frame alone take it\n",
               args.most);
  if (r.precision == ViewPrecision::whole16) {
    fmt::print(
        "  displacements are stored to 1/65534, of corners to 1/10000, velocities, rotations and "
        "stresses\n"
        "  to 1/4094 of the largest in their frame; the last frame to 7 digits\n");
  }
  return exit_code::done;
}

int serve(const std::function<Result<ViewRun>()>& open, const ViewArguments& args) {
  const auto ready = [](const std::string& address) {
    fmt::print("open {} in a browser; Ctrl-C ends it\n", address);
    std::fflush(stdout);
  };
  if (const Trouble trouble = serve_page(open, args.port, ready, stop_on_signals())) {
    print({*trouble});
    return exit_code::bad_input;
  }
  return exit_code::done;
}

int view(const ViewArguments& args) {
  if (!args.output.empty() && ending_of(args.output) != ".html") {
    fmt::print(stderr, "{}: does not end in .html: name the page so\n", args.output);
    return exit_code::bad_input;
  }
  const auto open = [&] { return ViewRun::open(args.folder, names_of(args.folder)); };
  Result<ViewRun> run = open();
  // A run that has begun will have a first frame: the page waits for it.
  const bool has_begun = std::filesystem::exists(args.folder + "/model.toml");
  if (!run.ok() && !(args.serve && has_begun)) {
    std::vector<Fault> faults = run.faults();
    if (args.serve)
      faults.front().remedy = "give a folder that edda run has written, or start the run first";
    print(faults);
    return exit_code::bad_input;
  }
  return args.serve ? serve(open, args) : write(run.value(), args);
}

}  // namespace

void add_view(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("view", "Make a page that replays a run in the browser");
  command->footer(
      "Examples:\n"
      "  edda view slope                    slope.html: one file, opens from disk, needs no "
      "network\n"
      "  edda view slope --serve            while the run goes on: the page follows it\n\n"
      "The page plays the frames (output.every), colours blocks and contacts by any field, shows\n"
      "values and histories of what is clicked, and saves pictures. Keys: press ? on the page.");
  auto args = std::make_shared<ViewArguments>();
  command->add_option("DIR", args->folder, "A folder of results")->required()->type_name("DIR");
  command->add_option("-o,--output", args->output, "The page (default: the folder's name + .html)")
      ->type_name("FILE.html");
  command
      ->add_option("--max-size", args->most,
                   "Leave frames out, evenly, where the page would be larger (default 200)")
      ->type_name("MB")
      ->check(CLI::Range(1.0, 1e5));
  command->add_flag("--serve", args->serve, "Serve the page to this machine instead of writing it");
  command->add_option("--port", args->port, "Of --serve (default 8080; 0: any that is free)")
      ->type_name("N")
      ->check(CLI::Range(0, 65535));
  command->callback([args, &code] { code = view(*args); });
}

}  // namespace edda
