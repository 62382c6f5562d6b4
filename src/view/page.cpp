#include "view/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "results/deflate.hpp"
#include "view/bytes.hpp"

namespace edda {
namespace {

/// `count` of n elements, evenly, including the first and the last.
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

/// Bytes of frames in a page: the larger of the middle and the last one.
struct FrameSizes {
  std::size_t single = 0, whole = 0;
  std::size_t last = 0;  ///< singly
};
Result<FrameSizes> frame_sizes(const ViewRun& run, const std::vector<SeriesEntry>& series) {
  FrameSizes sizes;
  for (const std::size_t k : {series.size() / 2, series.size() - 1}) {
    for (const ViewPrecision precision : {ViewPrecision::single, ViewPrecision::whole16}) {
      const Result<std::string> bytes = run.probe(series[k], precision);
      if (!bytes.ok()) return bytes.faults();
      std::size_t& size = precision == ViewPrecision::single ? sizes.single : sizes.whole;
      const std::size_t this_one = text_size(bytes.value());
      size = std::max(size, this_one);
      if (precision == ViewPrecision::single) sizes.last = this_one;
    }
  }
  return sizes;
}

/// The contents planned for a page.
struct Plan {
  std::size_t frames = 0;
  ViewPrecision precision = ViewPrecision::single;
};

/// Planned from the estimated size of frames, after the page itself, the mesh and the tables.
Result<Plan> plan_of(const ViewRun& run, const std::vector<SeriesEntry>& series,
                     std::size_t most_bytes) {
  const Result<FrameSizes> read = frame_sizes(run, series);
  if (!read.ok()) return read.faults();
  const FrameSizes& sizes = read.value();
  std::size_t taken = page_template().head.size() + page_template().tail.size() +
                      run.header().size() + text_size(mesh_bytes(run.mesh())) + sizes.last;
  for (const char* table : view_tables) taken += text_size(run.table(table, most_table_rows));
  const std::size_t room = most_bytes > taken ? most_bytes - taken : 0, all = series.size();
  if (all * sizes.single <= std::min(small_page, room)) return Plan{all, ViewPrecision::single};
  const std::size_t fitting = room / std::max<std::size_t>(sizes.whole, 1) + 1;
  return Plan{std::min(all, std::max<std::size_t>(fitting, 2)), ViewPrecision::whole16};
}

/// Writes the page into `file`; `frames` are the bytes that its frames take.
Result<PageReport> fill(WholeFile& file, ViewRun& run, const std::vector<SeriesEntry>& series,
                        const Plan& plan, std::size_t& frames) {
  PageReport report;
  report.of = series.size();
  report.precision = plan.precision;
  const auto add = [&](std::string_view text) {
    report.bytes += text.size();
    file.add(text);
  };
  add(page_template().head);
  add(chunk("mesh", mesh_bytes(run.mesh())));
  for (const std::size_t k : evenly(series.size(), plan.frames)) {
    const bool is_last = k + 1 == series.size();
    const std::size_t datums = run.datums().size();
    const Result<std::string> frame =
        run.take(series[k], is_last ? ViewPrecision::single : plan.precision);
    if (!frame.ok()) return frame.faults();
    if (run.datums().size() > datums)
      add(chunk(fmt::format("datum-{}", datums), datum_bytes(run.mesh(), run.datums().back())));
    const std::string packed = chunk(fmt::format("frame-{}", report.frames++), frame.value());
    if (!is_last) frames += packed.size();
    add(packed);
  }
  for (const char* table : view_tables) {
    if (const std::string text = run.table(table, most_table_rows); !text.empty())
      add(chunk(table, text));
  }
  add(header_script(run));
  add(page_template().tail);
  return report;
}

/// The contents that fit, once the size of `plan` is known.
Plan with_less(Plan plan, const PageReport& report, std::size_t frames, std::size_t most_bytes) {
  if (plan.precision == ViewPrecision::single) return {plan.frames, ViewPrecision::whole16};
  const std::size_t rest = report.bytes - frames;
  const std::size_t room = most_bytes > rest ? most_bytes - rest : 0;
  const double part = static_cast<double>(room) / static_cast<double>(frames);
  const auto fitting = static_cast<std::size_t>(part * static_cast<double>(plan.frames - 1)) + 1;
  return {std::max<std::size_t>(std::min(fitting, plan.frames - 1), 2), plan.precision};
}

}  // namespace

std::string chunk(std::string_view name, std::string_view bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"edda-{}\">{}</script>\n", name,
                     base64(deflated(bytes)));
}

std::string header_script(const ViewRun& run) {
  // "<" only stands in strings; as an escape it cannot end the script.
  std::string safe;
  for (const char c : run.header()) {
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
  const Result<Plan> planned = plan_of(run, series.value(), most_bytes);
  if (!planned.ok()) return planned.faults();
  for (Plan plan = planned.value();;) {
    ViewRun filled = run;
    WholeFile file(path);
    std::size_t frames = 0;
    Result<PageReport> report = fill(file, filled, series.value(), plan, frames);
    if (!report.ok()) return report.faults();
    // Frames between those examined may have been larger.
    if (report.value().bytes > most_bytes && plan.frames > 2) {
      plan = with_less(plan, report.value(), frames, most_bytes);
      continue;
    }
    run = std::move(filled);
    if (Trouble trouble = file.complete()) return *trouble;
    return report;
  }
}

}  // namespace edda
