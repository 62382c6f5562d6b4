// edda plot
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/common.hpp"
#include "blocks/build_blocks.hpp"
#include "lines/build_polygons.hpp"
#include "model/read_model.hpp"
#include "report/plot.hpp"
#include "results/frames.hpp"
#include "run/start_picture.hpp"

namespace edda {
namespace {

struct PlotArguments {
  std::string source, output, field, vectors;
  std::vector<std::string> overrides;
  std::optional<double> time, scale;
  bool forces = false;
};

/// What is drawn, from either source.
struct Source {
  Grid blocks;
  std::optional<Grid> contacts;
  PlotOptions options;
};

Fault no_results(const std::string& folder, const std::string& problem) {
  Fault fault;
  fault.where.file = folder;
  fault.problem = problem;
  fault.remedy = "give a folder that edda run has written, or a model file";
  return fault;
}

const SeriesEntry* nearest(const std::vector<SeriesEntry>& series, std::optional<double> time) {
  const SeriesEntry* best = nullptr;
  for (const SeriesEntry& e : series) {
    if (best == nullptr || !time || std::abs(e.time - *time) < std::abs(best->time - *time))
      best = &e;
  }
  return best;
}

Result<Source> from_folder(const PlotArguments& args) {
  const std::string& folder = args.source;
  const auto series = read_pvd(folder + "/blocks.pvd");
  if (!series.ok()) return no_results(folder, "holds no blocks.pvd");
  const SeriesEntry* entry = nearest(series.value(), args.time);
  if (entry == nullptr) return no_results(folder, "holds no frames yet");
  Result<Grid> blocks = read_vtu(folder + "/" + entry->file);
  if (!blocks.ok()) return blocks.faults();
  Source source{std::move(blocks.value()), {}, {}};
  // Contacts take more room than the blocks: only where they are drawn.
  if (args.forces || is_of_contacts(args.field)) {
    std::string contacts_file = entry->file;
    contacts_file.replace(contacts_file.find("blocks_"), 6, "contacts");
    if (Result<Grid> contacts = read_vtu(folder + "/" + contacts_file); contacts.ok()) {
      source.contacts = std::move(contacts.value());
    }
  }
  // The title, names and monitors; a picture does without them where the model is gone.
  if (const Result<Model> model = read_model(folder + "/model.toml"); model.ok()) {
    source.options = options_of(model.value(), 0);
  }
  source.options.subtitle = fmt::format("t = {:.6g} s", entry->time);
  return source;
}

Result<Source> from_model(const PlotArguments& args) {
  const Result<Model> model = read_model(args.source, args.overrides);
  if (!model.ok()) return model.faults();
  const Result<PolygonSet> polygons = build_polygons(model.value());
  if (!polygons.ok()) return polygons.faults();
  const BlockSet blocks = build_blocks(model.value(), polygons.value());
  return Source{block_grid(block_cells(blocks), start_picture(model.value(), blocks)),
                {},
                options_of(model.value(), blocks.size())};
}

int draw(const PlotArguments& args) {
  const bool folder = std::filesystem::is_directory(args.source);
  Result<Source> read = folder ? from_folder(args) : from_model(args);
  if (!read.ok()) {
    print(read.faults());
    return exit_code::bad_input;
  }
  Source& source = read.value();
  const Grid* contacts = source.contacts ? &*source.contacts : nullptr;
  const std::string wanted = !args.field.empty()                   ? args.field
                             : folder                              ? "displacement"
                             : source.options.materials.size() > 1 ? "material"
                                                                   : "none";
  const Result<ShownField> field = shown_field(wanted, source.blocks, contacts);
  if (!field.ok()) {
    print(field.faults());
    return exit_code::bad_input;
  }
  source.options.vectors = args.vectors;
  source.options.forces = args.forces;
  source.options.scale = args.scale.value_or(1.0);
  const std::string path = args.output.empty() ? stem_of(args.source) + ".png" : args.output;
  if (const Trouble trouble = plot(source.blocks, contacts, field.value(), source.options, path)) {
    print({*trouble});
    return exit_code::failed;
  }
  fmt::print("wrote {}\n", path);
  return exit_code::done;
}

int plot_or_refuse(const PlotArguments& args) {
  const std::string ending = ending_of(args.output);
  if (!args.output.empty() && ending != ".svg" && ending != ".png") {
    fmt::print(stderr, "{}: ends in neither .svg nor .png: name the file so\n", args.output);
    return exit_code::bad_input;
  }
  return draw(args);
}

}  // namespace

void add_plot(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("plot", "Draw the results in a folder, or a model's blocks");
  command->footer(
      "Examples:\n"
      "  edda plot slope                              the last state, coloured by displacement, as "
      "slope.png\n"
      "  edda plot slope --time 0.5 --field stress.yy -o stress.svg\n"
      "  edda plot slope --scale 200 --vectors velocity --forces\n"
      "  edda plot slope.toml                         the blocks before the run\n\n"
      "Fields: " +
      field_names() +
      ".\n"
      "Held blocks are grey and hatched; monitors are circles with their names, bolts blue lines, "
      "convergence lines dashed.");
  auto args = std::make_shared<PlotArguments>();
  command->add_option("DIR", args->source, "A folder of results, or a model file")
      ->required()
      ->type_name("DIR|MODEL");
  command
      ->add_option("-o,--output", args->output,
                   "The picture, .png or .svg (default: the source's stem + .png)")
      ->type_name("FILE");
  command
      ->add_option("--field", args->field,
                   "What to colour by (default: displacement; of a model: none)")
      ->type_name("NAME");
  command
      ->add_option("--time", args->time, "The frame nearest to this time in s (default: the last)")
      ->type_name("T");
  command->add_option("--scale", args->scale, "Draw displacements this many times as large")
      ->type_name("FACTOR");
  command
      ->add_option("--vectors", args->vectors,
                   "Arrows at the blocks' centres: displacement or velocity")
      ->check(CLI::IsMember({"displacement", "velocity"}));
  command->add_flag("--forces", args->forces, "Arrows of the contact forces");
  add_overrides(*command, args->overrides);
  command->callback([args, &code] { code = plot_or_refuse(*args); });
}

}  // namespace edda
