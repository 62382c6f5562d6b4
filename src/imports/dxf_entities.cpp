#include "imports/dxf_entities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/rings.hpp"
#include "imports/dxf_splines.hpp"
#include "imports/file_words.hpp"

namespace edda {
namespace {

constexpr int drawn_in_space = 8;  // a flag of a POLYLINE

/// The map from the coordinates of an object, whose x runs to the left where it is drawn from
/// below.
Vec2 seen(int side, Vec2 p) {
  return {side * p.x, p.y};
}

}  // namespace

struct DxfCollector::Kind {
  std::string_view name;
  bool (DxfCollector::*read)(DxfValues&, int side);
  bool plane = true;  ///< it lies in the plane of the drawing, according to its extrusion
};

void DxfCollector::add(const DxfEntity& entity) {
  static constexpr std::array kinds{
      Kind{"LINE", &DxfCollector::line, false},  Kind{"LWPOLYLINE", &DxfCollector::light_polyline},
      Kind{"POLYLINE", &DxfCollector::polyline}, Kind{"CIRCLE", &DxfCollector::circle},
      Kind{"ARC", &DxfCollector::arc},           Kind{"ELLIPSE", &DxfCollector::ellipse},
      Kind{"SPLINE", &DxfCollector::spline},     Kind{"INSERT", &DxfCollector::insert}};
  if (entity.name == "VERTEX") return vertex(entity);
  if (entity.name == "SEQEND") return end_polyline();
  leave_open();
  const auto* const kind = std::find_if(kinds.begin(), kinds.end(),
                                        [&](const Kind& k) { return k.name == entity.name; });
  skipping_ = entity.name == "POLYLINE";
  if (kind == kinds.end()) return void(count(for_message(entity.name)));
  if (entity.fault) return leave_out(std::string(entity.name), *entity.fault);
  DxfFault fault(path_);
  DxfValues v(entity, fault, &digits_);
  const bool on_paper = v.whole(67, 0) == 1, hidden = v.whole(60, 0) == 1;
  const bool in_space = skipping_ && (v.whole(70, 0) & drawn_in_space) != 0;
  const int side = kind->plane && !in_space ? v.side() : 1;
  if (v.sound() && on_paper) return void(count(v.name() + " on paper"));
  if (v.sound() && hidden) return void(count("hidden " + v.name()));
  if (v.sound() && side == 0) return void(count(v.name() + " across the plane"));
  if (v.sound()) (this->*kind->read)(v, side);
  if (fault.found()) leave_out(v.name(), *fault.found());
}

DxfContent DxfCollector::finish() {
  leave_open();
  return std::move(content_);
}

void DxfCollector::leave_out(const std::string& name, const Fault& fault) {
  count(name + " with a fault");
  ++content_.faulty;
  if (!content_.fault) content_.fault = fault;
}

/// A POLYLINE after which another entity follows without SEQEND.
void DxfCollector::leave_open() {
  if (!open_) return;
  DxfFault fault(path_);
  fault.add(open_->line, "a POLYLINE is not ended by SEQEND");
  open_->fault = fault.found();
  end_polyline();
}

bool DxfCollector::count(const std::string& kind) {
  ++content_.skipped[kind];
  return true;
}

bool DxfCollector::take(DxfValues& v, std::vector<Vec2> points) {
  if (!v.sound()) return false;
  if (points.size() < 2) return count("POLYLINE of one point");
  content_.lines.push_back({std::move(points), v.layer(), v.line()});
  return true;
}

bool DxfCollector::line(DxfValues& v, int /*side*/) {
  const Vec2 from = v.point(10), to = v.point(11);
  return take(v, {from, to});
}

bool DxfCollector::light_polyline(DxfValues& v, int side) {
  const bool closed = (v.whole(70, 0) & 1) != 0;
  std::vector<BulgedCorner> corners = v.corners(42);
  for (BulgedCorner& c : corners) c = {seen(side, c.point), side * c.bulge};
  return take(v, bulged_points(corners, closed));
}

bool DxfCollector::polyline(DxfValues& v, int side) {
  const int flags = v.whole(70, 0);
  constexpr int mesh = 16 | 64;
  if ((flags & mesh) != 0) return count("POLYLINE as a mesh");
  skipping_ = false;
  open_ = Open{v.layer(), v.line(), side, (flags & 1) != 0, {}, {}};
  return true;
}

void DxfCollector::vertex(const DxfEntity& entity) {
  if (skipping_) return;
  if (!open_) return void(count("VERTEX"));
  DxfFault fault(path_);
  DxfValues v(entity, fault, &digits_);
  constexpr int frame_of_spline = 16;
  if ((v.whole(70, 0) & frame_of_spline) != 0) return;
  const Vec2 point = v.point(10);
  const double bulge = v.number(42, 0.0);
  open_->corners.push_back({seen(open_->side, point), open_->side * bulge});
  if (!open_->fault) open_->fault = entity.fault ? entity.fault : fault.found();
}

void DxfCollector::end_polyline() {
  skipping_ = false;
  if (!open_) return;
  if (open_->fault) {
    leave_out("POLYLINE", *open_->fault);
    open_.reset();
    return;
  }
  std::vector<Vec2> points = bulged_points(open_->corners, open_->closed);
  if (points.size() < 2) {
    count("POLYLINE of one point");
  } else {
    content_.lines.push_back({std::move(points), std::move(open_->layer), open_->line});
  }
  open_.reset();
}

bool DxfCollector::circle(DxfValues& v, int side) {
  const Vec2 centre = v.point(10);
  const double radius = v.length(40);
  if (v.sound() && radius <= 0.0) return count("CIRCLE of no radius");
  const PlaneMap map{seen(side, centre), seen(side, {radius, 0.0}), {0.0, radius}};
  const Vec2 start{1.0, 0.0};
  return take(v, arc_points(map, start, start, 2.0 * std::numbers::pi));
}

bool DxfCollector::arc(DxfValues& v, int side) {
  const Vec2 centre = v.point(10);
  const double radius = v.length(40), from = v.number(50), to = v.number(51);
  if (v.sound() && radius <= 0.0) return count("ARC of no radius");
  const double turn = turn_between(from, to, 360.0);
  const Vec2 start = direction_of(from), end = turn < 360.0 ? direction_of(to) : start;
  const PlaneMap map{seen(side, centre), seen(side, {radius, 0.0}), {0.0, radius}};
  return take(v, arc_points(map, start, end, turn * std::numbers::pi / 180.0));
}

/// c + a cos t + b sin t with the major axis a and b = ratio n x a, n the side it is drawn from;
/// all in coordinates of the drawing.
bool DxfCollector::ellipse(DxfValues& v, int side) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  const Vec2 centre = v.point(10), major = v.point(11);
  const double ratio = v.number(40), from = v.number(41, 0.0), to = v.number(42, full_turn);
  if (v.sound() && (ratio == 0.0 || major == Vec2{})) return count("ELLIPSE of no width");
  const double turn = turn_between(from, to, full_turn);
  const PlaneMap map{centre, major, side * ratio * perp(major)};
  const Vec2 start{std::cos(from), std::sin(from)};
  const Vec2 end = turn < full_turn ? Vec2{std::cos(to), std::sin(to)} : start;
  return take(v, arc_points(map, start, end, turn));
}

bool DxfCollector::spline(DxfValues& v, int /*side*/) {
  DxfSpline spline = read_spline(v);
  if (!v.sound()) return false;
  if (!spline.left_out.empty()) return count(spline.left_out);
  return take(v, std::move(spline.points));
}

/// Columns and rows run along the rotated axes, with spacings that are not scaled. Those at the
/// same place count as one.
bool DxfCollector::insert(DxfValues& v, int side) {
  const Vec2 at = v.point(10), scale{v.number(41, 1.0), v.number(42, 1.0)};
  const Vec2 x = direction_of(v.number(50, 0.0)), y = perp(x);
  const Vec2 apart{v.length(44, 0.0), v.length(45, 0.0)};
  DxfInsert insert;
  insert.block = v.text(2);
  insert.layer = v.layer();
  insert.line = v.line();
  insert.dictionary = v.dictionary();
  insert.map = {seen(side, at), seen(side, scale.x * x), seen(side, scale.y * y)};
  insert.column_step = seen(side, apart.x * x);
  insert.row_step = seen(side, apart.y * y);
  const int columns = v.whole(70, 1), rows = v.whole(71, 1);
  if (!v.sound()) return false;
  insert.columns = apart.x == 0.0 ? 1 : std::max(columns, 1);
  insert.rows = apart.y == 0.0 ? 1 : std::max(rows, 1);
  if (scale.x == 0.0 || scale.y == 0.0) return count("INSERT of scale 0");
  content_.inserts.push_back(std::move(insert));
  return true;
}

}  // namespace edda
