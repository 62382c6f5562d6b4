// The contents of the section of entities of a drawing, or of one of its blocks.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "imports/drawing.hpp"
#include "imports/dxf_values.hpp"
#include "imports/plane_map.hpp"

namespace edda {

/// A block inserted once, or in columns and rows.
struct DxfInsert {
  std::string block, layer;
  PlaneMap map;  ///< of the first one, before the shift of the block's base point to its origin
  int columns = 1, rows = 1;
  Vec2 column_step, row_step;
  int line = 0;            ///< of the file
  std::string dictionary;  ///< handle of the dictionary of what else belongs to it
};

struct DxfContent {
  std::vector<DrawnLine> lines;  ///< in the block's own coordinates
  std::vector<DxfInsert> inserts;
  std::map<std::string, int> skipped;  ///< what was left out: how many of each kind
  int faulty = 0;                      ///< entities left out for a fault in them
  std::optional<Fault> fault;          ///< the first of these faults
};

/// Reads entities one at a time and keeps the lines that they draw. One with a fault is left out
/// and counted.
class DxfCollector {
 public:
  /// `digits`: counts those of the coordinates.
  DxfCollector(std::string path, Digits& digits) : path_(std::move(path)), digits_(digits) {}

  void add(const DxfEntity& entity);
  DxfContent finish();

 private:
  struct Kind;
  /// A POLYLINE whose vertices are still to come.
  struct Open {
    std::string layer;
    int line = 0, side = 1;
    bool closed = false;
    std::vector<BulgedCorner> corners;
    std::optional<Fault> fault = {};
  };

  bool line(DxfValues& v, int side);
  bool light_polyline(DxfValues& v, int side);
  bool polyline(DxfValues& v, int side);
  void vertex(const DxfEntity& entity);
  void end_polyline();
  void leave_open();
  bool circle(DxfValues& v, int side);
  bool arc(DxfValues& v, int side);
  bool ellipse(DxfValues& v, int side);
  bool spline(DxfValues& v, int side);
  bool insert(DxfValues& v, int side);

  bool take(DxfValues& v, std::vector<Vec2> points);
  bool count(const std::string& kind);
  void leave_out(const std::string& name, const Fault& fault);

  std::string path_;
  Digits& digits_;
  DxfContent content_;
  std::optional<Open> open_;
  bool skipping_ = false;  ///< within a POLYLINE that is left out
};

}  // namespace edda
