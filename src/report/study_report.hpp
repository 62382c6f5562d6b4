// One HTML page about a study, which needs no other file.
#pragma once

#include <string>
#include <vector>

#include "results/files.hpp"

namespace edda {

/// A table of the page: its first row is the header.
struct ReportTable {
  std::string heading, note;
  std::vector<std::vector<std::string>> rows;
};

/// A picture of the page, an SVG file.
struct ReportFigure {
  std::string heading, note, file;
};

struct ReportPage {
  std::string title, answer;  ///< the answer: one sentence
  std::vector<ReportTable> before;
  std::vector<ReportFigure> figures;
  std::vector<ReportTable> after;
  std::string plan, version;  ///< the study's file as it was run
};

/// Reads the figures and writes the page.
Trouble write_report(const ReportPage& page, const std::string& path);

}  // namespace edda
