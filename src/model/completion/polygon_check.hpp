// Checks on the points of polygons and polylines as written.
#pragma once

#include <span>
#include <string>

#include "model/files/reader.hpp"

namespace edda {

/// Adds a fault where a polygon (Kind::polygon) has fewer than three points, repeats one, has no
/// area or touches itself, or a polyline (Kind::polyline) has fewer than two points or repeats one.
/// `written` is the list that the points were read from, `path` its dotted key.
void check_points(std::span<const Vec2> points, Kind kind, const Value& written,
                  const std::string& path, Reading& reading);

}  // namespace edda
