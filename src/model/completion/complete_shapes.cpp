// Outlines from a few parameters: [slope], shapes of openings.
#include <fmt/format.h>

#include "base/polygon.hpp"
#include "model/completion/complete_tools.hpp"
#include "model/completion/shapes.hpp"

namespace edda {
namespace {

/// Whether the parameters are consistent; one fault if they are not.
bool slope_fits(const Value* node, const Slope& slope, Reading& reading) {
  for (const char* key : {"toe", "height", "face_angle", "base_y", "extent"}) {
    if (!given(node, key)) return false;  // as was said already
  }
  if (slope.height <= 0.0 || slope.face_angle <= 0.0) return false;
  const auto fault = [&](const char* key, std::string problem, std::string remedy) {
    add_fault(reading, place_of(node, key), std::string("slope.") + key, std::move(problem),
              std::move(remedy));
    return false;
  };
  const double crest = slope.toe.x + run_of(slope);
  if (!(slope.extent.x < slope.extent.y)) {
    return fault("extent", "does not run from left to right", "give [left, right]");
  }
  if (slope.toe.x < slope.extent.x) {
    return fault("toe",
                 fmt::format("lies left of the model, which begins at x = {}", slope.extent.x),
                 "move it, or extend the model");
  }
  if (crest >= slope.extent.y) {
    return fault("extent",
                 fmt::format("ends at {}, but the crest of the slope is at x = {:.6g}",
                             slope.extent.y, crest),
                 "extend the model beyond the crest");
  }
  if (!(slope.base_y < slope.toe.y)) {
    return fault("base_y", fmt::format("is not below the toe at y = {}", slope.toe.y),
                 "give a lower level");
  }
  if (slope.benches == 1 && slope.bench_width > 0.0) {
    return fault("bench_width", "there is a single face", "give benches = 2 or more");
  }
  return true;
}

void complete_outline(const Value& root, Reading& reading) {
  Model& model = reading.model;
  const Value* node = find(&root, "domain");
  if (model.domain) model.domain->outline = model.domain->given_outline;
  if (!model.slope) {
    if (model.domain && is_table(node) && !given(node, "outline")) {
      add_fault(reading, node->place, "domain.outline", "is missing",
                "give a list of points such as [[0, 0], [2, 0], [2, 1]], or a [slope]");
    }
    return;
  }
  if (given(node, "outline")) {
    add_fault(reading, find(&root, "slope")->place, "slope", "domain.outline is given too",
              "give only one of them");
    return;
  }
  if (!model.domain) {
    model.domain.emplace();
    model.domain->where = model.slope->where;
    model.domain->where.key = "domain";
  }
  if (slope_fits(find(&root, "slope"), *model.slope, reading)) {
    model.domain->outline = ring_of(*model.slope);
  }
}

void complete_opening(const Value* node, Opening& opening, Reading& reading) {
  opening.polygon = opening.given_polygon;
  const std::string& path = opening.where.key;
  if (!one_of(node, path, "polygon", "shape",
              "corners such as polygon = [[0, 0], [2, 0], [2, 1]], or a shape", reading) ||
      !opening.shape || opening.shape->width <= 0.0) {
    return;
  }
  const Value* shape = find(node, "shape");
  if (given(shape, "height") && !opening.shape->height) return;  // as was said already
  const auto [problem, remedy] = shape_fault(*opening.shape);
  if (!problem.empty()) {
    add_fault(reading, place_of(shape, "height"), path + ".shape.height", problem, remedy);
    return;
  }
  Ring ring = ring_of(*opening.shape);
  // Far from the origin neighbouring corners of small shapes round to the same point.
  if (self_crossing(ring)) {
    add_fault(reading, shape->place, path + ".shape",
              "is too small for its corners to be told apart so far from the origin",
              "give fewer segments, or move the model towards the origin");
    return;
  }
  opening.polygon = std::move(ring);
}

}  // namespace

bool one_of(const Value* table, const std::string& path, std::string_view first,
            std::string_view second, const std::string& example, Reading& reading) {
  if (given(table, first) && given(table, second)) {
    add_fault(reading, find(table, second)->place, path + '.' + std::string(second),
              std::string(first) + " is given too", "give only one of them");
    return false;
  }
  if (given(table, first) || given(table, second)) return true;
  add_fault(reading, table->place, path, fmt::format("has neither {} nor {}", first, second),
            "add " + example);
  return false;
}

void complete_shapes(const Value& root, Reading& reading) {
  complete_outline(root, reading);
  auto& openings = reading.model.openings;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const Value* node = element(root, "opening", i);
    if (is_table(node)) complete_opening(node, openings[i], reading);
  }
}

}  // namespace edda
