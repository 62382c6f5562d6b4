#include "imports/dxf_values.hpp"

#include <cmath>

#include "imports/file_words.hpp"

namespace edda {
namespace {

constexpr const char* a_length = "length";
constexpr const char* a_number = "number of usual size";

}  // namespace

double DxfValues::value(const DxfGroup& group, const char* kind) {
  const auto value = place_number(group.value);
  if (!value) {
    fault_.add(group.line + 1, '"' + for_message(group.value) + "\" is not a " + kind);
  }
  return value.value_or(0.0);
}

double DxfValues::value(int code, const char* kind, std::optional<double> otherwise) {
  if (const DxfGroup* group = entity_.find(code)) return value(*group, kind);
  if (!otherwise) missing(code);
  return otherwise.value_or(0.0);
}

double DxfValues::length(int code, std::optional<double> otherwise) {
  return value(code, a_length, otherwise);
}

double DxfValues::number(int code, std::optional<double> otherwise) {
  return value(code, a_number, otherwise);
}

int DxfValues::whole(int code, std::optional<int> otherwise) {
  const DxfGroup* group = entity_.find(code);
  if (group == nullptr) {
    if (!otherwise) missing(code);
    return otherwise.value_or(0);
  }
  const auto value = whole_number(group->value);
  if (!value) {
    fault_.add(group->line + 1, '"' + for_message(group->value) + "\" is not a whole number");
  }
  return value.value_or(0);
}

Vec2 DxfValues::point(int code) {
  const Vec2 p{length(code), length(code + 10)};
  count_digits(p.x);
  count_digits(p.y);
  return p;
}

std::string DxfValues::text(int code) {
  const DxfGroup* group = entity_.find(code);
  if (group == nullptr || group->value.empty()) {
    missing(code);
    return {};
  }
  return std::string(group->value);
}

std::vector<double> DxfValues::numbers(int code) {
  std::vector<double> all;
  for (const DxfGroup& group : entity_.groups) {
    if (group.code == code) all.push_back(value(group, a_number));
  }
  return all;
}

std::vector<BulgedCorner> DxfValues::corners(std::optional<int> bulge_code) {
  std::vector<BulgedCorner> corners;
  bool has_y = true;
  for (const DxfGroup& group : entity_.groups) {
    const bool is_bulge = group.code == bulge_code;
    if (group.code != 10 && group.code != 20 && !is_bulge) continue;
    const double read = value(group, is_bulge ? a_number : a_length);
    if (!is_bulge) count_digits(read);
    if (group.code == 10) {
      if (!has_y) break;
      corners.push_back({{read, 0.0}, 0.0});
      has_y = false;
    } else if (corners.empty()) {
      fault_.add(group.line, "a point of " + name() + " does not begin with group 10");
      return {};
    } else if (is_bulge) {
      corners.back().bulge = read;
    } else {
      corners.back().point.y = read;
      has_y = true;
    }
  }
  if (!has_y) fail("a point of " + name() + " lacks group 20");
  return corners;
}

int DxfValues::side() {
  const double x = number(210, 0.0), y = number(220, 0.0), z = number(230, 1.0);
  if (x == 0.0 && y == 0.0 && z == 0.0) return 1;
  constexpr double aslant = 1e-6;
  if (std::abs(x) > aslant || std::abs(y) > aslant || z == 0.0) return 0;
  return z > 0.0 ? 1 : -1;
}

std::string DxfValues::dictionary() const {
  bool within = false;
  for (const DxfGroup& group : entity_.groups) {
    if (group.code == 102) within = group.value == "{ACAD_XDICTIONARY";
    if (within && group.code == 360) return dxf_handle(group.value);
  }
  return {};
}

std::string DxfValues::layer() const {
  const DxfGroup* layer = entity_.find(8);
  return layer == nullptr || layer->value.empty() ? "0" : std::string(layer->value);
}

}  // namespace edda
