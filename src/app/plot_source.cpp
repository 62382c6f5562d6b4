#include "app/plot_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/common.hpp"
#include "blocks/build_blocks.hpp"
#include "cutting/build_polygons.hpp"
#include "cutting/linings.hpp"
#include "model/read_model.hpp"
#include "observe/start_picture.hpp"
#include "report/relative.hpp"
#include "results/frames.hpp"

namespace edda {
namespace {

constexpr double points_per_mm = 72.0 / 25.4;

Fault no_results(const std::string& folder, const std::string& problem) {
  return {{{}, folder, 0, 0}, problem, "give a folder that edda run has written, or a model file"};
}

const SeriesEntry& nearest(const std::vector<SeriesEntry>& series, double time) {
  return *std::min_element(series.begin(), series.end(),
                           [&](const SeriesEntry& a, const SeriesEntry& b) {
                             return std::abs(a.time - time) < std::abs(b.time - time);
                           });
}

/// The frames to draw, side by side.
std::vector<SeriesEntry> chosen(const std::vector<SeriesEntry>& series, const PlotArguments& args) {
  const SeriesEntry& last = args.time ? nearest(series, *args.time) : series.back();
  if (args.before) return {series.front(), last};
  if (args.compare.empty()) return {last};
  std::vector<SeriesEntry> entries;
  for (const double time : args.compare) entries.push_back(nearest(series, time));
  return entries;
}

/// Reports requested times that the run does not have.
std::vector<std::string> notes_on(const std::vector<SeriesEntry>& series,
                                  const PlotArguments& args) {
  std::vector<double> asked = args.compare;
  if (args.time) asked.push_back(*args.time);
  std::vector<std::string> notes;
  const double first = series.front().time, last = series.back().time;
  for (const double time : asked) {
    const double slack = 1e-9 * std::max(std::abs(first), std::abs(last));
    if (time >= first - slack && time <= last + slack) continue;
    notes.push_back(fmt::format(
        "{:.6g} s lies beyond the frames, which go from {:.6g} to {:.6g} s: drawn is {:.6g} s",
        time, first, last, nearest(series, time).time));
  }
  return notes;
}

/// The field where none is requested; crosses of stresses need blocks without colour.
std::string field_of(const PlotArguments& args, const std::string& otherwise) {
  if (!args.field.empty()) return args.field;
  return args.principal ? "none" : otherwise;
}

/// The bolts at the time of a frame, where they are recorded.
std::vector<BoltChain> bolts_at(const Table& table, double time) {
  std::vector<BoltChain> chains;
  const Column *t = table.column("time"), *name = table.column("bolt"), *x = table.column("x"),
               *y = table.column("y"), *force = table.column("axial_force"),
               *yielded = table.column("yielded"), *ruptured = table.column("ruptured");
  for (const Column* c : {t, name, x, y, force, yielded, ruptured}) {
    if (c == nullptr) return chains;
  }
  std::string last;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (std::abs(t->values[r] - time) > 1e-9 * std::max(1.0, std::abs(time))) continue;
    const std::string bolt = name->text(r);
    if (chains.empty() || bolt != last) chains.emplace_back();
    last = bolt;
    BoltChain& chain = chains.back();
    chain.points.push_back({x->values[r], y->values[r]});
    chain.force.push_back(force->values[r]);
    chain.yielded = chain.yielded || yielded->values[r] != 0.0;
    chain.ruptured = chain.ruptured || ruptured->values[r] != 0.0;
  }
  return chains;
}

/// The linings at the time of a frame, with the values of this column.
std::vector<LiningDiagram> linings_at(const Table& table, const std::string& column, double time) {
  std::vector<LiningDiagram> linings;
  const Column *t = table.column("time"), *name = table.column("lining"), *x = table.column("x"),
               *y = table.column("y"), *value = table.column(column);
  for (const Column* c : {t, name, x, y, value}) {
    if (c == nullptr) return linings;
  }
  std::string last;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (std::abs(t->values[r] - time) > 1e-9 * std::max(1.0, std::abs(time))) continue;
    const std::string lining = name->text(r);
    if (linings.empty() || lining != last) linings.emplace_back();
    last = lining;
    linings.back().points.push_back({x->values[r], y->values[r]});
    linings.back().value.push_back(value->values[r]);
  }
  return linings;
}

Fault no_monitor(const PlotArguments& args, const std::vector<PlotMonitor>& monitors) {
  std::string names;
  for (const PlotMonitor& m : monitors) names += (names.empty() ? "" : ", ") + m.name;
  return {{"--relative-to", {}, 0, 0},
          "there is no monitor \"" + args.relative_to + "\"",
          names.empty() ? "give the model a [[monitor]]" : "use one of " + names};
}

Result<Snapshot> snapshot_of(const PlotArguments& args, const SeriesEntry& entry,
                             const Table* bolts, const Table* linings, const PlotMonitor* from) {
  const std::string& folder = args.source;
  Result<Grid> blocks = read_vtu(folder + "/" + entry.file);
  if (!blocks.ok()) return blocks.faults();
  Snapshot shot{std::move(blocks.value())};
  shot.heading = fmt::format("t = {:.6g} s", entry.time);
  // Contacts take more memory than blocks, so they are read only where they are drawn.
  if (args.forces || args.cracks || is_of_contacts(args.field)) {
    if (Result<Grid> contacts = read_vtu(folder + "/" + contacts_beside(entry.file));
        contacts.ok()) {
      shot.contacts = std::move(contacts.value());
    }
  }
  if (bolts != nullptr) shot.bolts = bolts_at(*bolts, entry.time);
  if (linings != nullptr) shot.linings = linings_at(*linings, args.lining, entry.time);
  if (from != nullptr && !move_with(shot, from->start)) {
    return Fault{
        {"--relative-to", {}, 0, 0},
        fmt::format("the block of {} has been excavated at {:.6g} s", from->name, entry.time),
        "use another monitor, or an earlier time"};
  }
  const Result<ShownField> field = shown_field(field_of(args, "displacement"), shot.blocks,
                                               shot.contacts ? &*shot.contacts : nullptr);
  if (!field.ok()) return field.faults();
  shot.field = field.value();
  if (from != nullptr && shot.field.label.starts_with("displacement"))
    shot.field.label += " relative to " + from->name;
  return shot;
}

/// For rock without a strength the values are undefined, not small.
Trouble judged(const PlotArguments& args, const Model& model) {
  const auto has_strength = [](const Material& m) { return m.strength.has_value(); };
  const std::vector<Material>& all = model.materials;
  if (args.field != "overstress" || std::any_of(all.begin(), all.end(), has_strength)) return {};
  return Fault{{"--field", {}, 0, 0},
               "overstress is not judged: no material of the model has a strength",
               "give one, as strength = { ucs = \"90 MPa\", tension = \"6 MPa\" }, and run it"};
}

/// Common to both sources.
void add_options(const PlotArguments& args, PlotOptions& options) {
  options.vectors = args.vectors;
  options.forces = args.forces;
  options.principal = args.principal;
  options.bolt_forces = args.bolts;
  options.lining = args.lining;
  options.cracks = args.cracks;
  options.marks = !args.no_marks;
  options.whole_range = args.whole_range;
  options.scale = args.scale.value_or(1.0);
  options.paper = paper_of(args);
  if (!args.title.empty()) options.title = args.title;
  if (!args.range.empty()) options.range = {args.range[0], args.range[1]};
  if (!args.window.empty()) {
    options.window = Box{{args.window[0], args.window[1]}, {args.window[2], args.window[3]}};
  }
}

}  // namespace

std::vector<StageSpan> stages_of(const std::string& folder) {
  std::vector<StageSpan> stages;
  const Result<Table> table = read_table(folder + "/stages.csv");
  if (!table.ok()) return stages;
  const Column *name = table.value().column("name"), *start = table.value().column("start"),
               *end = table.value().column("end");
  if (name == nullptr || start == nullptr || end == nullptr) return stages;
  for (std::size_t r = 0; r < table.value().rows(); ++r) {
    stages.push_back({name->text(r), start->values[r], end->values[r]});
  }
  return stages;
}

double least_stress_of(const Model& model) {
  constexpr double least_strain = 1e-11;
  double least = 0.0;
  for (const Material& m : model.materials)
    least = least == 0.0 ? m.young : std::min(least, m.young);
  return least_strain * least;
}

Paper paper_of(const PlotArguments& args) {
  Paper paper;
  paper.font = args.font;
  if (args.dpi) paper.pixels_per_point = *args.dpi / 72.0;
  if (args.width > 0.0) paper.width = args.width * points_per_mm;
  paper.whole = args.width > 0.0 || args.width_pixels > 0;
  if (args.width_pixels > 0) paper.pixels_per_point = args.width_pixels / paper.width;
  return paper;
}

Result<PlotSource> from_folder(const PlotArguments& args) {
  const std::string& folder = args.source;
  const auto series = read_pvd(folder + "/blocks.pvd");
  if (!series.ok()) return no_results(folder, "holds no blocks.pvd");
  if (series.value().empty()) return no_results(folder, "holds no frames yet");
  const Result<Table> bolts = read_table(folder + "/bolts.csv");
  if (args.bolts && !bolts.ok()) {
    return Fault{{"--bolts", {}, 0, 0},
                 folder + " holds no bolts.csv",
                 "leave it out: the model has no bolts"};
  }
  const Result<Table> linings = read_table(folder + "/linings.csv");
  if (!args.lining.empty() && !linings.ok()) {
    return Fault{{"--lining", {}, 0, 0},
                 folder + " holds no linings.csv",
                 "leave it out: the model has no linings"};
  }
  PlotSource source;
  source.notes = notes_on(series.value(), args);
  // The title, names and monitors; a picture does without them where the model is gone.
  if (const Result<Model> model = read_model(folder + "/model.toml", {}, ReadFor::no_run);
      model.ok()) {
    if (const Trouble trouble = judged(args, model.value())) return *trouble;
    source.options = options_of(model.value(), 0);
    source.options.least_stress = least_stress_of(model.value());
  }
  const std::vector<PlotMonitor>& monitors = source.options.monitors;
  const auto from = std::find_if(monitors.begin(), monitors.end(),
                                 [&](const PlotMonitor& m) { return m.name == args.relative_to; });
  if (!args.relative_to.empty() && from == monitors.end()) return no_monitor(args, monitors);
  for (const SeriesEntry& entry : chosen(series.value(), args)) {
    Result<Snapshot> shot = snapshot_of(args, entry, bolts.ok() ? &bolts.value() : nullptr,
                                        args.lining.empty() ? nullptr : &linings.value(),
                                        args.relative_to.empty() ? nullptr : &*from);
    if (!shot.ok()) return shot.faults();
    source.shots.push_back(std::move(shot.value()));
  }
  source.options.subtitle = source.shots.size() == 1 ? source.shots.front().heading : "";
  add_options(args, source.options);
  return source;
}

Result<PlotSource> from_model(const PlotArguments& args) {
  if (args.time || !args.compare.empty() || args.before || args.bolts || !args.lining.empty() ||
      args.principal || args.forces || args.cracks || !args.relative_to.empty() ||
      is_of_contacts(args.field)) {
    return Fault{{{}, args.source, 0, 0},
                 "is a model, which has no times, stresses, contacts or loads yet",
                 "run it, and give the folder of its results"};
  }
  const Result<Model> model = read_model(args.source, args.overrides, ReadFor::no_run);
  if (!model.ok()) return model.faults();
  if (const Trouble trouble = judged(args, model.value())) return *trouble;
  Result<PolygonSet> polygons = build_polygons(model.value());
  if (!polygons.ok()) return polygons.faults();
  const std::size_t rock = polygons.value().blocks.size();
  if (Faults faults = add_linings(model.value(), polygons.value()); !faults.empty()) return faults;
  const BlockSet blocks = build_blocks(model.value(), polygons.value());
  Snapshot shot{block_grid(block_cells(blocks), start_picture(model.value(), blocks))};
  const std::string otherwise = model.value().materials.size() > 1 ? "material" : "none";
  const Result<ShownField> field = shown_field(field_of(args, otherwise), shot.blocks, nullptr);
  if (!field.ok()) return field.faults();
  shot.field = field.value();
  PlotSource source;
  source.shots.push_back(std::move(shot));
  source.options = options_of(model.value(), rock);
  add_options(args, source.options);
  return source;
}

Trouble read_histories(const PlotArguments& args, HistorySource& source) {
  Result<Table> table = read_table(args.source + "/history.csv");
  if (!table.ok() || table.value().column("time") == nullptr)
    return no_results(args.source, "holds no history.csv");
  source.table = std::move(table.value());
  if (!args.relative_to.empty() && !move_with(source.table, args.relative_to)) {
    std::vector<PlotMonitor> monitors;
    for (const Column& column : source.table.columns) {
      if (column.name.ends_with(".ux"))
        monitors.push_back({column.name.substr(0, column.name.size() - 3), {}});
    }
    return no_monitor(args, monitors);
  }
  Result<std::vector<HistoryPanel>> panels = history_panels(source.table, args.history);
  if (!panels.ok()) return panels.faults().front();
  HistoryPicture& picture = source.picture;
  picture.panels = std::move(panels.value());
  for (HistoryPanel& panel : picture.panels) {
    if (!args.relative_to.empty() && (panel.label == "displacement" || panel.label == "velocity"))
      panel.label += " relative to " + args.relative_to;
  }
  picture.time = source.table.column("time")->values;
  picture.stages = stages_of(args.source);
  if (!args.range.empty()) picture.range = Vec2{args.range[0], args.range[1]};
  if (!args.times.empty()) {
    const Vec2 span{args.times[0], args.times[1]};
    picture.span = span;
    const auto& t = picture.time;
    if (std::none_of(t.begin(), t.end(), [&](double v) { return v >= span.x && v <= span.y; })) {
      return Fault{
          {"--times", {}, 0, 0},
          fmt::format("no row of history.csv lies between {:.6g} and {:.6g} s", span.x, span.y),
          t.empty() ? std::string("it has none yet")
                    : fmt::format("its rows go from {:.6g} to {:.6g} s", t.front(), t.back())};
    }
  }
  picture.paper = paper_of(args);
  picture.title = args.title;
  if (!args.title.empty()) return {};
  if (const Result<Model> model = read_model(args.source + "/model.toml", {}, ReadFor::no_run);
      model.ok()) {
    picture.title = options_of(model.value(), 0).title;
  }
  return {};
}

}  // namespace edda
