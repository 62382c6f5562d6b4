#include "app/along_picture.hpp"

#include <fmt/format.h>

#include <sstream>

#include "app/common.hpp"
#include "report/along_line.hpp"
#include "results/csv_file.hpp"

namespace edda {
namespace {

std::vector<std::string> names_in(const std::string& fields) {
  std::vector<std::string> names;
  std::istringstream text(fields.empty() ? "displacement" : fields);
  for (std::string name; std::getline(text, name, ',');) names.push_back(name);
  return names;
}

Fault bad_field(const std::string& problem, const std::string& remedy) {
  return {{"--field", {}, 0, 0}, problem, remedy};
}

/// The fields in a frame.
Result<std::vector<LineField>> fields_of(const std::string& text, const Grid& blocks) {
  std::vector<LineField> fields;
  for (const std::string& name : names_in(text)) {
    if (is_of_contacts(name))
      return bad_field("\"" + name + "\" is a field of contacts, which a line only crosses",
                       "give fields of blocks, as stress.yy");
    const Result<ShownField> shown = shown_field(name, blocks, nullptr);
    if (!shown.ok()) return shown.faults();
    if (shown.value().values.empty())
      return bad_field("there is nothing to draw along the line",
                       "give fields of blocks, as stress.yy");
    fields.push_back({name, shown.value()});
  }
  return fields;
}

Trouble write_table(const Table& table, const std::string& path) {
  Csv csv;
  for (const Column& column : table.columns) csv.add(column.name);
  csv.end();
  return write_rows(path, csv, table.rows(), [&](std::size_t r) {
    for (const Column& column : table.columns) csv.add(column.values[r]);
    csv.end();
  });
}

}  // namespace

Trouble draw_along(const PlotArguments& args, const std::string& path) {
  const Vec2 begin{args.along[0], args.along[1]}, end{args.along[2], args.along[3]};
  PlotArguments plain = args;
  plain.field = names_in(args.field).front();
  if (is_of_contacts(plain.field)) plain.field = "none";
  const Result<PlotSource> read = from_folder(plain);
  if (!read.ok()) return read.faults().front();
  const PlotSource& source = read.value();
  const Grid& blocks = source.shots.front().blocks;
  const Result<std::vector<LineField>> fields = fields_of(args.field, blocks);
  if (!fields.ok()) return fields.faults().front();
  const std::vector<LinePart> parts = parts_along(blocks, begin, end);
  if (parts.empty())
    return Fault{{"--along", {}, 0, 0}, "meets no block", "give x0,y0,x1,y1 through the model, m"};
  const Table table = table_along(blocks, parts, begin, end, fields.value());
  for (const std::string& note : source.notes) fmt::print(stderr, "note: {}\n", note);
  if (ending_of(path) == ".csv") return write_table(table, path);
  const Table drawn = with_gaps(table);
  HistoryPicture picture;
  picture.title =
      source.options.title + (source.options.title.empty() ? "" : ", ") + source.options.subtitle;
  picture.across = fmt::format("distance from ({:.6g}, {:.6g}) towards ({:.6g}, {:.6g}) (m)",
                               begin.x, begin.y, end.x, end.y);
  picture.time = drawn.columns.front().values;
  picture.panels = panels_along(drawn, fields.value());
  picture.span = Vec2{0.0, norm(end - begin)};
  if (!args.range.empty()) picture.range = Vec2{args.range[0], args.range[1]};
  picture.paper = paper_of(args);
  return plot_history(picture, path);
}

}  // namespace edda
