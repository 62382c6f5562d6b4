// The block system alone, as a table.
#pragma once

#include <string>

#include "lines/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// block,material,ring,x,y,joint: a row per vertex, with the joint of the edge that starts there
/// (empty where none is named, so that contact.joint applies). Model coordinates, m.
std::string cut_csv(const PolygonSet& polygons, const Model& model);

}  // namespace edda
