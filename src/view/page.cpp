#include "view/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/bytes.hpp"

namespace edda {
namespace {

/// `count` of n things, evenly, the first and the last among them.
std::vector<std::size_t> evenly(std::size_t n, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (n <= count) {
    for (std::size_t k = 0; k < n; ++k) chosen.push_back(k);
    return chosen;
  }
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(k * (n - 1) / (count - 1));
  return chosen;
}

std::size_t text_size(std::string_view bytes) {
  return 4 * deflated(bytes).size() / 3;
}

/// Bytes of one frame in a page: the larger of those of the middle and the last frame.
struct FrameSizes {
  std::size_t single = 0, whole = 0;
};
Result<FrameSizes> frame_sizes(const ViewRun& run, const std::vector<SeriesEntry>& series) {
  FrameSizes sizes;
  for (const std::size_t k : {series.size() / 2, series.size() - 1}) {
    for (const ViewPrecision precision : {ViewPrecision::single, ViewPrecision::whole16}) {
      const Result<std::string> bytes = run.probe(series[k], precision);
      if (!bytes.ok()) return bytes.faults();
      std::size_t& size = precision == ViewPrecision::single ? sizes.single : sizes.whole;
      size = std::max(size, text_size(bytes.value()));
    }
  }
  return sizes;
}

}  // namespace

std::string chunk(std::string_view name, std::string_view bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"edda-{}\">{}</script>\n", name,
                     base64(deflated(bytes)));
}

std::string header_script(const ViewRun& run, bool served) {
  // "<" only stands in strings; as an escape it cannot end the script.
  std::string safe;
  for (const char c : run.header(served)) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return "<script type=\"application/json\" id=\"edda-run\">" + safe + "</script>\n";
}

Result<PageReport> write_page(ViewRun& run, const std::string& path, std::size_t most_bytes) {
  const Result<std::vector<SeriesEntry>> series = run.series();
  if (!series.ok()) return series.faults();
  const std::size_t all = series.value().size();
  const Result<FrameSizes> sizes = frame_sizes(run, series.value());
  if (!sizes.ok()) return sizes.faults();
  PageReport report;
  report.of = all;
  report.precision =
      all * sizes.value().single <= small_page ? ViewPrecision::single : ViewPrecision::whole16;
  const std::size_t each =
      report.precision == ViewPrecision::single ? sizes.value().single : sizes.value().whole;
  const std::size_t fitting = std::max<std::size_t>(most_bytes / std::max<std::size_t>(each, 1), 2);

  WholeFile file(path);
  const auto add = [&](std::string_view text) {
    report.bytes += text.size();
    file.add(text);
  };
  add(page_template().head);
  add(chunk("mesh", mesh_bytes(run.mesh())));
  for (const std::size_t k : evenly(all, fitting)) {
    const ViewPrecision precision = k + 1 == all ? ViewPrecision::single : report.precision;
    const std::size_t datums = run.datums().size();
    const Result<std::string> frame = run.take(series.value()[k], precision);
    if (!frame.ok()) return frame.faults();
    if (run.datums().size() > datums)
      add(chunk(fmt::format("datum-{}", datums), datum_bytes(run.datums().back())));
    add(chunk(fmt::format("frame-{}", report.frames++), frame.value()));
  }
  for (const char* table : view_tables) {
    if (const std::string text = run.table(table, most_table_rows); !text.empty())
      add(chunk(table, text));
  }
  add(header_script(run, false));
  add(page_template().tail);
  if (Trouble trouble = file.complete()) return *trouble;
  return report;
}

}  // namespace edda
