// edda cut
#include <fmt/format.h>

#include <memory>

#include "app/common.hpp"
#include "base/text.hpp"
#include "blocks/build_blocks.hpp"
#include "cutting/build_polygons.hpp"
#include "cutting/linings.hpp"
#include "observe/sliver_report.hpp"
#include "observe/start_picture.hpp"
#include "report/plot.hpp"
#include "results/cut_table.hpp"
#include "results/frames.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

struct CutArguments {
  std::string model, output;
  std::vector<std::string> overrides;
};

std::string number_of(int n, const char* one) {
  return counted(static_cast<std::size_t>(n), one);
}

/// The linings are the last of the polygons, after those of `rock`.
void print_report(const Model& model, const PolygonSet& polygons, std::size_t rock) {
  const CutReport& r = polygons.report;
  std::size_t fixed = 0;
  double area = 0.0;
  for (std::size_t i = 0; i < rock; ++i) {
    fixed += polygons.blocks[i].fixed;
    area += moments(polygons.blocks[i].rings).area;
  }
  fmt::print("blocks           {} ({} fixed), {:.6g} m2\n", rock, fixed, area);
  if (!model.linings.empty()) fmt::print("linings          {}\n", polygons.blocks.size() - rock);
  if (!polygons.removed.empty()) {
    fmt::print("inside openings  {}, not part of the model\n",
               counted(polygons.removed.size(), "block"));
  }
  if (r.area_in > 0.0) {
    fmt::print("cut area         {:.9g} m2 of {:.9g} m2 (difference {:.1e} of it)\n", r.area_out,
               r.area_in, (r.area_out - r.area_in) / r.area_in);
  }
  fmt::print("trimmed          {} of joints inside a block, {} with one block on both sides\n",
             number_of(r.dangling, "end"), number_of(r.bridging, "piece"));
  fmt::print("merged           {} thinner than twice domain.snap\n", number_of(r.merged, "sliver"));
  const Quality& q = model.quality;
  fmt::print("quality          {} joined to a neighbour, {:.4g} m2 in all; {} {}\n",
             number_of(r.quality_merged, "sliver"), r.quality_area, r.slivers,
             r.slivers == 1 ? "stays" : "stay");
  for (const std::string& line : sliver_lines(r)) fmt::print("sliver           {}\n", line);
  if (r.short_edges > 0) {
    fmt::print("short edges      {} below {:.4g} m\n", r.short_edges, q.min_edge);
  }
  if (r.sharp_corners > 0) {
    fmt::print("sharp corners    {} below {:.4g} degrees\n", r.sharp_corners, q.min_angle);
  }
  for (const std::string& note : r.notes) fmt::print("lines            {}\n", note);
  if (r.snap_rounded != 0)
    fmt::print("noding           the lines had to be rounded to domain.snap\n");
  fmt::print("smallest area    {:.4g} m2 at {}\n", r.smallest_area,
             place_label(r.smallest_area_at));
  fmt::print("smallest edge    {:.4g} m at {}\n", r.smallest_edge, place_label(r.smallest_edge_at));
  fmt::print("smallest angle   {:.4g} degrees at {}\n", r.smallest_angle,
             place_label(r.smallest_angle_at));
  for (const auto* warnings : {&model.warnings, &r.warnings}) {
    for (const std::string& w : *warnings) fmt::print("warning          {}\n", w);
  }
}

Trouble write_cut(const Model& model, const PolygonSet& polygons, std::size_t rock,
                  const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".csv") return write_cut_csv(path, polygons, model);
  const BlockSet blocks = build_blocks(model, polygons);
  Grid grid = block_grid(block_cells(blocks), start_picture(model, blocks));
  if (ending == ".vtu") return write_vtu(path, grid);
  const std::string field = model.materials.size() > 1 ? "material" : "none";
  Snapshot shot{std::move(grid)};
  shot.field = shown_field(field, shot.blocks, nullptr).value();
  return plot({&shot, 1}, options_of(model, rock), path);
}

int cut(const CutArguments& args) {
  const std::string ending = ending_of(args.output);
  if (!args.output.empty() && !is_picture(ending) && ending != ".vtu" && ending != ".csv") {
    fmt::print(stderr, "{}: ends in none of .png .svg .pdf .vtu .csv: name the file so\n",
               args.output);
    return exit_code::bad_input;
  }
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, false, ReadFor::no_run);
  if (!model) return exit_code::bad_input;
  Result<PolygonSet> polygons = build_polygons(*model);
  if (!polygons.ok()) {
    print(polygons.faults());
    return exit_code::bad_input;
  }
  const std::size_t rock = polygons.value().blocks.size();
  if (const Faults faults = add_linings(*model, polygons.value()); !faults.empty()) {
    print(faults);
    return exit_code::bad_input;
  }
  print_report(*model, polygons.value(), rock);
  if (args.output.empty()) return exit_code::done;
  if (const Trouble trouble = write_cut(*model, polygons.value(), rock, args.output)) {
    print({*trouble});
    return exit_code::failed;
  }
  fmt::print("wrote {}\n", args.output);
  return exit_code::done;
}

}  // namespace

PlotOptions options_of(const Model& model, std::size_t blocks) {
  PlotOptions options;
  options.title = model.title.empty() ? stem_of(model.file) : model.title;
  options.subtitle = counted(blocks, "block") + " as cut";
  for (const Material& m : model.materials) options.materials.push_back(m.name);
  for (const Monitor& m : model.monitors) options.monitors.push_back({m.name, m.point});
  for (const Convergence& c : model.convergences) {
    options.lines.push_back({c.name, {c.between[0], c.between[1]}});
  }
  options.bolts = bolt_lines(model);
  return options;
}

void add_cut(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "cut", "Cut the model into blocks, report their quality, and draw or list them");
  command->footer(
      "Examples:\n"
      "  edda cut cavern.toml                  the report alone\n"
      "  edda cut cavern.toml -o cavern.png    a picture (.svg or .pdf for one that scales)\n"
      "  edda cut cavern.toml -o cavern.csv    every corner: block,material,ring,x,y,joint");
  auto args = std::make_shared<CutArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", args->output,
                   "What to write: a .png, .svg or .pdf picture, .vtu for ParaView, or .csv")
      ->type_name("FILE");
  add_overrides(*command, args->overrides);
  add_threads(*command);
  command->callback([args, &code] { code = cut(*args); });
}

}  // namespace edda
