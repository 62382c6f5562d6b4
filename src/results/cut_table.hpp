// The block system alone, as a table.
#pragma once

#include <string>

#include "cutting/polygon_set.hpp"
#include "model/model.hpp"
#include "results/files.hpp"

namespace edda {

/// The table ResultFile::cut: a row per vertex, with the joint of the edge that starts there (empty
/// where none is named, so that contact.joint applies). Model coordinates, m.
Trouble write_cut_csv(const std::string& path, const PolygonSet& polygons, const Model& model);

}  // namespace edda
