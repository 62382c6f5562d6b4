#include "report/study_report.hpp"

#include <fmt/format.h>

#include "report/canvas.hpp"

namespace edda {
namespace {

constexpr const char* style = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:60rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:2rem 0 .3rem}
.answer{font-size:1.15rem;border-left:4px solid #598cc7;padding:.4rem .8rem;background:#f2f6fb}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.15rem .8rem;text-align:right;border-bottom:1px solid #ddd}
th:first-child,td:first-child{text-align:left}th{border-bottom:1px solid #888;font-weight:600}
.note{color:#555;margin:.2rem 0 .6rem}svg{max-width:100%;height:auto}.wide{overflow-x:auto}
pre{background:#f6f6f6;padding:.8rem;overflow-x:auto;font-size:13px}footer{color:#777;margin-top:3rem}
)";

std::string heading_of(const std::string& heading, const std::string& note) {
  std::string html = fmt::format("<h2>{}</h2>\n", xml_escaped(heading));
  if (!note.empty()) html += fmt::format("<p class=\"note\">{}</p>\n", xml_escaped(note));
  return html;
}

std::string html_of(const ReportTable& table) {
  std::string html = heading_of(table.heading, table.note) + "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const char* cell = i == 0 ? "th" : "td";
    html += "<tr>";
    for (const std::string& text : table.rows[i])
      html += fmt::format("<{0}>{1}</{0}>", cell, xml_escaped(text));
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace

Trouble write_report(const ReportPage& page, const std::string& path) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p class=\"answer\">{2}</p>\n",
      xml_escaped(page.title), style, xml_escaped(page.answer));
  for (const ReportTable& table : page.before) html += html_of(table);
  for (const ReportFigure& figure : page.figures) {
    const Result<std::string> svg = read_file(figure.file);
    if (!svg.ok()) return svg.faults().front();
    const std::string& text = svg.value();
    html += heading_of(figure.heading, figure.note) + text.substr(text.find("<svg")) + '\n';
  }
  for (const ReportTable& table : page.after) html += html_of(table);
  html +=
      fmt::format("<h2>The study</h2>\n<pre>{}</pre>\n<footer>edda {}</footer>\n</body></html>\n",
                  xml_escaped(page.plan), xml_escaped(page.version));
  return write_file(path, html);
}

}  // namespace edda
