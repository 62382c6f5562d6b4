// edda plot --along: values of fields along a line, as a graph or a table.
#pragma once

#include <string>

#include "app/plot_source.hpp"

namespace edda {

/// Reads, and writes `path`: .csv is the table.
Trouble draw_along(const PlotArguments& args, const std::string& path);

}  // namespace edda
