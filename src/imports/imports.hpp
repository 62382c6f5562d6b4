// [[import]]: lines from drawings, tables and other programs' models.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/polygon.hpp"
#include "base/vec2.hpp"
#include "model/model.hpp"

namespace edda {

/// A polyline in model coordinates.
struct ImportedLine {
  std::vector<Vec2> points;  ///< m
  Index joint = none;        ///< none: domain.joint applies
  Index import = 0;          ///< in Model::imports
};

/// A closed polyline that is a block, in model coordinates.
struct ImportedBlock {
  Ring ring;  ///< m, either orientation
  Index joint = none, material = none;
  bool fixed = false;
  Index import = 0;  ///< in Model::imports
};

struct Imports {
  std::vector<ImportedBlock> blocks;                ///< of imports as blocks, in order
  std::vector<ImportedLine> lines;                  ///< in the order of the files
  std::vector<std::pair<Vec2, Vec2>> fixed_lines;   ///< blocks on them are fixed; points are lines
                                                    ///< without length; m, model coordinates
  std::vector<Index> fixed_import;                  ///< import of each
  std::vector<std::optional<LengthUnit>> drawn_in;  ///< per import the unit given in the file
  std::vector<double> last_digit;  ///< per import one unit of the last digit of its coordinates, m
  std::vector<std::string> notes;  ///< per import what was read and what was left out
  std::vector<std::string> left_out;  ///< those of imports of which anything was left out
  std::vector<std::string> warnings;  ///< parts of drawings that are left out for a fault
};

/// Reads the files of model.imports. Faults, one per file: it cannot be read, does not have its
/// format, names joints or layers that do not exist, or contains no lines, or no closed ones where
/// these are blocks.
Result<Imports> read_imports(const Model& model);

/// The corners of a closed polyline; fewer than three: it is not closed, or has no area.
Ring closed_ring(const std::vector<Vec2>& points);

/// The bounding box of all lines as a domain, where a model has imports and no domain; the area
/// between the box and the outermost lines is not rock. Fault: the lines have no extent in both
/// directions.
Result<Domain> frame_of(const Model& model, const Imports& imports);

}  // namespace edda
