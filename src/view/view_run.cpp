#include "view/view_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/colours.hpp"
#include "report/shown_field.hpp"
#include "results/files.hpp"
#include "results/frames.hpp"
#include "results/json.hpp"
#include "results/version.hpp"

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
  return run;
}

Result<std::vector<SeriesEntry>> ViewRun::series() const {
  Result<std::vector<SeriesEntry>> series = read_pvd(folder_ + "/blocks.pvd");
  if (!series.ok()) return no_results(folder_, "holds no blocks.pvd");
  return series;
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

void ViewRun::widen_ranges(const Grids& grids) {
  const Grid* contacts = grids.contacts ? &*grids.contacts : nullptr;
  const Field* fixed = grids.blocks.cell_field("fixed");
  for (const std::string& name : all_fields()) {
    const Result<ShownField> field = shown_field(name, grids.blocks, contacts);
    if (!field.ok() || field.value().kind != ScaleKind::numbers) continue;
    ViewRange& range = ranges_[name];
    for (std::size_t c = 0; c < field.value().values.size(); ++c) {
      const double v = field.value().values[c];
      const bool held = !field.value().of_contacts && fixed != nullptr && fixed->values[c] != 0.0;
      if (held || !std::isfinite(v)) continue;
      range.low = range.any ? std::min(range.low, v) : v;
      range.high = range.any ? std::max(range.high, v) : v;
      range.any = true;
    }
  }
}

Result<std::string> ViewRun::take(const SeriesEntry& frame, ViewPrecision precision) {
  const Result<Opened> opened = open_frame(frame);
  if (!opened.ok()) return opened.faults();
  const auto& [grids, in] = opened.value();
  ViewDatum datum;
  if (find_datum(mesh_, grids.blocks, in, datums_.empty() ? nullptr : &datums_.back(), datum))
    datums_.push_back(std::move(datum));
  widen_ranges(grids);
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
  const std::string& text = file.value();
  const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (rows <= most_rows + 1) return text;
  const std::size_t every = (rows + most_rows - 1) / most_rows;
  std::string thinned;
  std::size_t row = 0;
  for (std::size_t at = 0; at < text.size(); ++row) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const bool kept = row == 0 || (row - 1) % every == 0 || end == text.size();
    if (kept) thinned.append(text, at, end - at);
    at = end;
  }
  return thinned;
}

std::string ViewRun::header(bool served) const {
  Json json;
  json.open_object().pair("format", 1).pair("edda", version).pair("served", served);
  json.pair("title", names_.title);
  add_strings(json, "materials", names_.materials);
  add_strings(json, "stages", names_.stages);
  add_marks(json, "monitors", names_.monitors);
  add_marks(json, "convergences", names_.convergences);
  json.key("frames").open_list();
  for (const Taken& t : taken_) json.value(t.entry.time);
  json.close().pair("datums", datums_.size());
  json.key("fields").open_list();
  for (const std::string& name : all_fields()) {
    const FieldText about = field_text(name);
    json.open_object().pair("name", name).pair("label", about.label).pair("unit", about.unit);
    json.pair("kind", about.kind == ScaleKind::kinds ? "kinds" : "numbers");
    json.pair("of", about.of_contacts ? "contacts" : "blocks");
    if (const auto r = ranges_.find(name); r != ranges_.end() && r->second.any)
      json.key("range").open_list().value(r->second.low).value(r->second.high).close();
    json.close();
  }
  json.close();
  std::string kinds;
  for (std::size_t k = 0; k < kind_colour_count; ++k) append_hex(kinds, kind_colour(k));
  json.key("colours").open_object().pair("sequential", colour_map(sequential));
  json.pair("diverging", colour_map(diverging)).pair("kinds", kinds).close();
  if (const Result<std::string> summary = read_file(folder_ + "/summary.json"); summary.ok())
    json.pair("summary", summary.value());
  return json.close().text();
}

}  // namespace edda
