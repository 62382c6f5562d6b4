#include "view/view_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "report/colours.hpp"
#include "report/drawn_range.hpp"
#include "report/faces.hpp"
#include "report/shapes.hpp"
#include "report/shown_field.hpp"
#include "results/files.hpp"
#include "results/frames.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "view/tables.hpp"

namespace edda {
namespace {

Fault no_results(const std::string& folder, const std::string& problem) {
  Fault fault;
  fault.where.file = folder;
  fault.problem = problem;
  fault.remedy = "give a folder that edda run has written";
  return fault;
}

void append_hex(std::string& text, Colour c) {
  for (const double part : {c.r, c.g, c.b})
    fmt::format_to(std::back_inserter(text), "{:02x}", std::lround(255.0 * part));
}

/// 256 colours of a map, six hexadecimal digits each.
std::string colour_map(Colour (*colour)(double)) {
  std::string text;
  for (int k = 0; k < 256; ++k) append_hex(text, colour(k / 255.0));
  return text;
}

void add_marks(Json& json, const char* key, const std::vector<ViewMark>& marks) {
  json.key(key).open_list();
  for (const ViewMark& mark : marks) {
    json.open_object().pair("name", mark.name).key("points").open_list();
    for (const Vec2 p : mark.points) json.open_list().value(p.x).value(p.y).close();
    json.close().close();
  }
  json.close();
}

/// The usual size is nearly the largest, so that a few outliers do not reduce all others to dots.
/// Reorders the sizes of the frame.
void widen(ViewSizes& sizes, std::vector<double>& of_frame) {
  if (of_frame.empty()) return;
  const auto at = of_frame.begin() + static_cast<std::ptrdiff_t>(of_frame.size() - 1) * 95 / 100;
  std::nth_element(of_frame.begin(), at, of_frame.end());
  const double largest = *std::max_element(at, of_frame.end());
  sizes.usual = std::max(sizes.usual, *at > 0.0 ? *at : largest);
  sizes.largest = std::max(sizes.largest, largest);
}

std::vector<double> force_sizes(const Grid& contacts) {
  const Field *normal = contacts.cell_field("normal_force"),
              *shear = contacts.cell_field("shear_force"), *state = contacts.cell_field("state");
  std::vector<double> sizes;
  if (normal == nullptr || shear == nullptr || state == nullptr) return sizes;
  for (std::size_t c = 0; c < contacts.cell_count(); ++c) {
    const double force = std::hypot(normal->values[c], shear->values[c]);
    if (state->values[c] != 0.0 && force > 0.0 && std::isfinite(force)) sizes.push_back(force);
  }
  return sizes;
}

/// The rule of pictures (pressure_scale()): weighted by the length that carries, without a few
/// outliers.
void widen_pressures(ViewSizes& sizes, double& tension, const Grid& contacts) {
  std::vector<Weighed> of_frame;
  double largest = 0.0;
  for (const DrawnFace& face : drawn_faces(contacts)) {
    const double size = std::max(std::abs(face.pressure_a), std::abs(face.pressure_b));
    if (face.open || !std::isfinite(size)) continue;
    of_frame.push_back({size, face.closed * norm(face.b - face.a)});
    largest = std::max(largest, size);
    sizes.largest = std::max({sizes.largest, face.pressure_a, face.pressure_b});
    tension = std::max({tension, -face.pressure_a, -face.pressure_b});
  }
  sizes.usual = std::max(sizes.usual, drawn_ends({0.0, largest}, inner_ends(of_frame)).high);
}

std::vector<double> stress_sizes(const Grid& blocks, const std::vector<std::size_t>& cells) {
  const Field *stress = blocks.cell_field("stress"), *fixed = blocks.cell_field("fixed");
  std::vector<double> sizes;
  if (stress == nullptr) return sizes;
  for (const std::size_t c : cells) {
    if (fixed != nullptr && fixed->values[c] != 0.0) continue;
    const double* const s = stress->values.data() + c * stress->components;  // xx yy zz xy
    const double size = std::abs(0.5 * (s[0] + s[1])) + std::hypot(0.5 * (s[0] - s[1]), s[3]);
    if (std::isfinite(size)) sizes.push_back(size);
  }
  return sizes;
}

void add_strings(Json& json, const char* key, const std::vector<std::string>& strings) {
  json.key(key).open_list();
  for (const std::string& s : strings) json.value(s);
  json.close();
}

}  // namespace

Result<ViewRun> ViewRun::open(std::string folder, ViewNames names) {
  ViewRun run;
  run.folder_ = std::move(folder);
  run.names_ = std::move(names);
  const Result<std::vector<SeriesEntry>> series = run.series();
  if (!series.ok()) return series.faults();
  if (series.value().empty()) return no_results(run.folder_, "holds no frames yet");
  const Result<Grid> first = read_vtu(run.folder_ + "/" + series.value().front().file);
  if (!first.ok()) return first.faults();
  run.mesh_ = view_mesh(first.value());
  run.stamp_ = run.stamp_of(series.value().front());
  for (const char* name : {"omega", "rotation", "overstress", "plastic_strain", "yields",
                           "strength_factor", "pore_pressure"}) {
    if (first.value().cell_field(name) == nullptr) run.absent_.emplace_back(name);
  }
  if (!run.names_.judges_rock && !std::count(run.absent_.begin(), run.absent_.end(), "overstress"))
    run.absent_.emplace_back("overstress");
  return run;
}

std::string ViewRun::stamp_of(const SeriesEntry& first) const {
  std::string stamp;
  for (const std::string& file : {first.file, std::string("model.toml")}) {
    std::error_code missing;
    const auto written = std::filesystem::last_write_time(folder_ + "/" + file, missing);
    stamp += fmt::format("{:x}.", missing ? 0 : written.time_since_epoch().count());
  }
  return stamp;
}

bool ViewRun::is_still_there() const {
  const Result<std::vector<SeriesEntry>> series = this->series();
  if (!series.ok() || series.value().empty()) return false;
  const std::vector<SeriesEntry>& now = series.value();
  return now.size() >= taken_.size() && stamp_of(now.front()) == stamp_ &&
         std::equal(taken_.begin(), taken_.end(), now.begin(),
                    [](const Taken& t, const SeriesEntry& e) { return t.entry.time == e.time; });
}

Result<std::vector<SeriesEntry>> ViewRun::series() const {
  Result<std::vector<SeriesEntry>> series = read_pvd(folder_ + "/blocks.pvd");
  if (series.ok()) return series;
  std::error_code unknown;
  if (std::filesystem::is_directory(folder_, unknown))
    return no_results(folder_, "holds no blocks.pvd");
  const bool there = std::filesystem::exists(folder_, unknown);
  return no_results(folder_, there ? "is no folder" : "there is no such folder");
}

Result<ViewRun::Opened> ViewRun::open_frame(const SeriesEntry& frame) const {
  Result<Grid> blocks = read_vtu(folder_ + "/" + frame.file);
  if (!blocks.ok()) return blocks.faults();
  Result<ViewBlocks> in = blocks_in(mesh_, blocks.value());
  if (!in.ok()) return no_results(folder_, in.faults().front().problem);
  Grids grids{std::move(blocks.value()), {}};
  if (Result<Grid> contacts = read_vtu(folder_ + "/" + contacts_beside(frame.file)); contacts.ok())
    grids.contacts = std::move(contacts.value());
  return Opened{std::move(grids), std::move(in.value())};
}

void ViewRun::widen_ranges(const Opened& frame) {
  const Grids& grids = frame.grids;
  std::vector<double> stresses = stress_sizes(grids.blocks, frame.in.cell), forces;
  if (grids.contacts) forces = force_sizes(*grids.contacts);
  widen(stresses_, stresses);
  widen(forces_, forces);
  if (grids.contacts) widen_pressures(pressures_, tension_, *grids.contacts);
  const Grid* contacts = grids.contacts ? &*grids.contacts : nullptr;
  if (const Field* by = contacts == nullptr ? nullptr : contacts->cell_field("broken_by"))
    cracked_ = cracked_ || std::any_of(by->values.begin(), by->values.end(),
                                       [](double mode) { return mode != 0.0; });
  const Field* fixed = grids.blocks.cell_field("fixed");
  const std::vector<double> areas = cell_areas(grids.blocks);
  for (const std::string& name : all_fields()) {
    const Result<ShownField> field = shown_field(name, grids.blocks, contacts);
    if (!field.ok() || field.value().kind != ScaleKind::numbers) continue;
    ViewRange& range = ranges_[name];
    const bool first = !range.any;
    const std::vector<double>& weights = field.value().of_contacts ? field.value().lengths : areas;
    std::vector<Weighed> values;
    Ends all;
    for (std::size_t c = 0; c < field.value().values.size(); ++c) {
      const double v = field.value().values[c];
      const bool held = !field.value().of_contacts && fixed != nullptr && fixed->values[c] != 0.0;
      if (held || !std::isfinite(v)) continue;
      range.low = range.any ? std::min(range.low, v) : v;
      range.high = range.any ? std::max(range.high, v) : v;
      range.any = true;
      all.low = values.empty() ? v : std::min(all.low, v);
      all.high = values.empty() ? v : std::max(all.high, v);
      values.push_back({v, weights.empty() ? 1.0 : weights[c]});
    }
    if (values.empty()) continue;
    const Ends inner = inner_ends(values);
    range.last = all;
    range.last_inner = inner;
    range.inner_low = first ? inner.low : std::min(range.inner_low, inner.low);
    range.inner_high = first ? inner.high : std::max(range.inner_high, inner.high);
  }
}

Result<std::string> ViewRun::take(const SeriesEntry& frame, ViewPrecision precision) {
  const Result<Opened> opened = open_frame(frame);
  if (!opened.ok()) return opened.faults();
  const auto& [grids, in] = opened.value();
  ViewDatum datum;
  if (find_datum(mesh_, grids.blocks, in, datums_.empty() ? nullptr : &datums_.back(), datum))
    datums_.push_back(std::move(datum));
  widen_ranges(opened.value());
  taken_.push_back({frame, datums_.size() - 1});
  return pack(opened.value(), precision, taken_.back().datum);
}

std::string ViewRun::pack(const Opened& frame, ViewPrecision precision, std::size_t datum) const {
  const auto& [grids, in] = frame;
  return frame_bytes(mesh_, in, grids.blocks, grids.contacts ? &*grids.contacts : nullptr,
                     precision, datum);
}

Result<std::string> ViewRun::read_and_pack(const SeriesEntry& frame, ViewPrecision precision,
                                           std::size_t datum) const {
  const Result<Opened> opened = open_frame(frame);
  if (!opened.ok()) return opened.faults();
  return pack(opened.value(), precision, datum);
}

Result<std::string> ViewRun::again(std::size_t frame, ViewPrecision precision) const {
  return read_and_pack(taken_[frame].entry, precision, taken_[frame].datum);
}

Result<std::string> ViewRun::probe(const SeriesEntry& frame, ViewPrecision precision) const {
  return read_and_pack(frame, precision, 0);
}

std::string ViewRun::table(const std::string& name, std::size_t most_rows) const {
  const Result<std::string> file = read_file(folder_ + "/" + name);
  if (!file.ok()) return {};
  if (name == "history.csv") return with_peaks(file.value(), most_rows);
  if (name != "bolts.csv" && name != "linings.csv") return std::string(complete_rows(file.value()));
  std::vector<double> times;
  for (const Taken& t : taken_) times.push_back(t.entry.time);
  return rows_at(file.value(), times);
}

/// Fields of water in joints are there in frames of a model in which it flows.
std::vector<std::string> ViewRun::absent() const {
  std::vector<std::string> names = absent_;
  for (const char* name : water_fields) {
    if (!ranges_.contains(name)) names.emplace_back(name);
  }
  return names;
}

std::string ViewRun::header(const std::string& served_as) const {
  Json json;
  json.open_object().pair("format", 1).pair("edda", version);
  json.pair("served", !served_as.empty());
  if (!served_as.empty()) json.pair("run", served_as);
  json.pair("title", names_.title);
  add_strings(json, "materials", names_.materials);
  add_strings(json, "absent", absent());
  add_marks(json, "monitors", names_.monitors);
  add_marks(json, "convergences", names_.convergences);
  json.key("frames").open_list();
  for (const Taken& t : taken_) json.value(t.entry.time);
  json.close().pair("datums", datums_.size()).pair("cracked", cracked_);
  json.key("fields").open_list();
  for (const std::string& name : all_fields()) {
    const FieldText about = field_text(name);
    json.open_object().pair("name", name).pair("label", about.label).pair("unit", about.unit);
    json.pair("kind", about.kind == ScaleKind::kinds ? "kinds" : "numbers");
    json.pair("of", about.of_contacts ? "contacts" : "blocks");
    if (const auto r = ranges_.find(name); r != ranges_.end() && r->second.any) {
      const ViewRange& range = r->second;
      const Ends all{range.low, range.high};
      const bool whole = about.of_contacts && !about.along_faces;
      const Ends drawn = whole ? all : drawn_ends(all, {range.inner_low, range.inner_high});
      const Ends last = whole ? range.last : drawn_ends(range.last, range.last_inner);
      json.key("range").open_list().value(all.low).value(all.high).close();
      json.key("drawn").open_list().value(drawn.low).value(drawn.high).close();
      json.key("last").open_list().value(last.low).value(last.high).close();
    }
    json.close();
  }
  json.close();
  json.key("usual").open_object();
  const bool any_stress = stresses_.largest >= names_.least_stress;
  json.pair("force", forces_.usual).pair("stress", any_stress ? stresses_.usual : 0.0);
  json.pair("pressure", pressures_.usual).close();
  json.key("largest").open_object();
  json.pair("force", forces_.largest).pair("stress", stresses_.largest);
  json.pair("pressure", pressures_.largest).pair("tension", tension_).close();
  std::string kinds;
  for (std::size_t k = 0; k < kind_colour_count; ++k) append_hex(kinds, kind_colour(k));
  std::string states;
  for (std::size_t k = 0; k < contact_states.size(); ++k) append_hex(states, state_colour(k));
  json.key("colours").open_object().pair("sequential", colour_map(sequential));
  json.pair("diverging", colour_map(diverging)).pair("kinds", kinds);
  json.pair("states", states).close();
  add_strings(json, "states", {contact_states.begin(), contact_states.end()});
  if (const Result<std::string> summary = read_file(folder_ + "/summary.json"); summary.ok())
    json.pair("summary", summary.value());
  return json.close().text();
}

}  // namespace edda
