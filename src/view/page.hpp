// The replay page: one file that needs nothing but a browser.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "results/files.hpp"
#include "view/view_run.hpp"

namespace edda {

/// The page without a run, page/built/replay.html: the parts before and after the data.
struct PageTemplate {
  std::string_view head, tail;
};
PageTemplate page_template();

/// The contents of a written page.
struct PageReport {
  std::size_t frames = 0;  ///< in the page
  std::size_t of = 0;      ///< in the folder
  std::size_t bytes = 0;   ///< of the page
  ViewPrecision precision = ViewPrecision::single;
};

/// Writes the run's page to `path`. Frames are left out evenly, never the first nor the last, where
/// it would be larger than `most_bytes`; with those two alone it may still be larger. Numbers are
/// stored singly where all frames then take less than small_page bytes and have room, else as whole
/// numbers; those of the last frame always singly.
Result<PageReport> write_page(ViewRun& run, const std::string& path, std::size_t most_bytes);
inline constexpr std::size_t small_page = std::size_t{12} << 20;

/// A chunk of the page: `name` and its bytes, deflated.
std::string chunk(std::string_view name, std::string_view bytes);

/// The header as a script of the page.
std::string header_script(const ViewRun& run);

/// Number of rows of a history in a page.
inline constexpr std::size_t most_table_rows = 20000;

}  // namespace edda
