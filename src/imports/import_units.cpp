#include "imports/import_units.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "base/rings.hpp"

namespace edda {
namespace {

struct NamedUnit {
  LengthUnit unit;
  const char* name;
};

constexpr std::array named_units{NamedUnit{LengthUnit::m, "m"},   NamedUnit{LengthUnit::mm, "mm"},
                                 NamedUnit{LengthUnit::cm, "cm"}, NamedUnit{LengthUnit::km, "km"},
                                 NamedUnit{LengthUnit::ft, "ft"}, NamedUnit{LengthUnit::in, "in"}};

std::string name_of(LengthUnit unit) {
  for (const NamedUnit& u : named_units) {
    if (u.unit == unit) return u.name;
  }
  return "m";
}

Vec2 spans(const Ring& points) {
  const Stretch x = extent_along(points, {1, 0}), y = extent_along(points, {0, 1});
  return {x.second - x.first, y.second - y.first};
}

std::string by(Vec2 size) {
  return number_text(size.x) + " x " + number_text(size.y) + " m";
}

/// The unit with which the size of the drawing would be nearest to that of the domain, larger or
/// smaller by the factor `ratio` than now.
LengthUnit fitting_unit(LengthUnit now, double ratio) {
  const auto misfit = [&](LengthUnit u) {
    return std::abs(std::log(ratio * metres(u) / metres(now)));
  };
  return std::min_element(named_units.begin(), named_units.end(),
                          [&](const NamedUnit& a, const NamedUnit& b) {
                            return misfit(a.unit) < misfit(b.unit);
                          })
      ->unit;
}

}  // namespace

double metres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::m:
      return 1.0;
    case LengthUnit::mm:
      return 1e-3;
    case LengthUnit::cm:
      return 1e-2;
    case LengthUnit::km:
      return 1e3;
    case LengthUnit::ft:
      return 0.3048;
    case LengthUnit::in:
      return 0.0254;
  }
  return 1.0;
}

std::optional<std::string> unit_doubt(const Model& model, const Imports& imports, std::size_t i) {
  const Import& import = model.imports[i];
  const auto said = imports.drawn_in[i];
  if (!import.size_given && said && *said != import.units) {
    return import.where.key + ".units: " + std::filesystem::path(import.file).filename().string() +
           " gives its unit as " + name_of(*said) + " ($INSUNITS), but it is read as drawn in \"" +
           name_of(import.units) + "\": write units = \"" + name_of(*said) + "\", or units = \"" +
           name_of(import.units) + "\" if the drawing is wrong";
  }
  if (!model.domain) return std::nullopt;
  Ring points;
  for (const ImportedLine& line : imports.lines) {
    if (line.import != static_cast<Index>(i)) continue;
    points.insert(points.end(), line.points.begin(), line.points.end());
  }
  if (points.empty()) return std::nullopt;
  const Vec2 drawing = spans(points), domain = spans(model.domain->outline);
  constexpr double far_too_large = 100.0;
  const double ratio = std::max(drawing.x, drawing.y) / std::max(domain.x, domain.y);
  if (!(ratio >= far_too_large)) return std::nullopt;
  const LengthUnit better = fitting_unit(import.units, ratio);
  return import.where.key + ": the drawing spans " + by(drawing) + ", the domain " + by(domain) +
         (better == import.units ? ": look at units and scale"
                                 : ": units = \"" + name_of(better) + "\"?");
}

}  // namespace edda
