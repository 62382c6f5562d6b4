// edda plot --nm: thrust and moment of linings within their strength, as a graph or a table.
#pragma once

#include <string>

#include "app/plot_source.hpp"

namespace edda {

/// Reads, and writes `path`: .csv is the table.
Trouble draw_nm(const PlotArguments& args, const std::string& path);

}  // namespace edda
