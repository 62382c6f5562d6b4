// Grids as ParaView files (.vtu: XML with the arrays appended, deflated), time series (.pvd),
// and back.
#pragma once

#include <string>
#include <vector>

#include "base/fault.hpp"
#include "results/files.hpp"
#include "results/grid.hpp"

namespace edda {

Trouble write_vtu(const std::string& path, const Grid& grid);
Trouble write_vtu(const std::string& path, const GridSource& source);

/// Reads what write_vtu() wrote; other files of the format are a fault.
Result<Grid> read_vtu(const std::string& path);

struct SeriesEntry {
  double time = 0.0;  ///< s
  std::string file;   ///< relative to the .pvd
};

/// Writes the whole series anew, so that it is valid during the run.
Trouble write_pvd(const std::string& path, const std::vector<SeriesEntry>& series);
Result<std::vector<SeriesEntry>> read_pvd(const std::string& path);

}  // namespace edda
