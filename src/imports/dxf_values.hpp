// The values of the groups of an entity, as numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/digits.hpp"
#include "imports/dxf_curves.hpp"
#include "imports/dxf_groups.hpp"

namespace edda {

/// Reads one entity. A value that is missing or no number is 0 and a fault, which sound() reports
/// afterwards.
class DxfValues {
 public:
  /// `digits`: counts those of its coordinates.
  DxfValues(const DxfEntity& entity, DxfFault& fault, Digits* digits = nullptr)
      : entity_(entity), fault_(fault), digits_(digits) {}

  double length(int code, std::optional<double> otherwise = std::nullopt);
  double number(int code, std::optional<double> otherwise = std::nullopt);
  int whole(int code, std::optional<int> otherwise = std::nullopt);
  Vec2 point(int code);
  std::string text(int code);
  std::vector<double> numbers(int code);  ///< of all groups of this code

  /// Points as groups 10 and 20 in turn, with bulges after them where they have a code.
  std::vector<BulgedCorner> corners(std::optional<int> bulge_code);

  /// The side from which it is drawn, by its extrusion if it has one: +1 from above, -1 from below
  /// (x is mirrored in coordinates of the object), 0 inclined to the plane. Programs write 0, 0, 0
  /// where there is nothing to say.
  int side();

  std::string layer() const;
  std::string dictionary() const;  ///< handle of its extension dictionary; empty without one
  std::string name() const { return std::string(entity_.name); }
  int line() const { return entity_.line; }
  bool sound() const { return !fault_.found(); }
  bool fail(std::string problem) { return fault_.add(entity_.line, std::move(problem)); }

 private:
  double value(int code, const char* kind, std::optional<double> otherwise);
  double value(const DxfGroup& group, const char* kind);
  void missing(int code) { fail(name() + " lacks group " + std::to_string(code)); }

  void count_digits(double coordinate) {
    if (digits_ != nullptr) digits_->add(coordinate);
  }

  const DxfEntity& entity_;
  DxfFault& fault_;
  Digits* digits_;
};

}  // namespace edda
