#include "model/table/quantity.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <system_error>

#include "base/text.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// A product of units: factor * 10^decimal * m^metre kg^kilogram s^second, and a factor for angles.
struct Unit {
  double factor = 1.0;
  int decimal = 0;
  int metre = 0, kilogram = 0, second = 0, turn = 0;
};

struct Symbol {
  std::string_view name;
  bool prefixes;  ///< whether k, M, G, ... may stand before it
  Unit unit;
};

constexpr double radians_per_degree = std::numbers::pi / 180.0;

// Angles are radians here; parse_quantity() undoes that exactly where degrees are wanted.
constexpr std::array symbols{
    Symbol{"m", true, {1.0, 0, 1, 0, 0, 0}},
    Symbol{"g", true, {1.0, -3, 0, 1, 0, 0}},
    Symbol{"t", true, {1.0, 3, 0, 1, 0, 0}},
    Symbol{"s", true, {1.0, 0, 0, 0, 1, 0}},
    Symbol{"min", false, {60.0, 0, 0, 0, 1, 0}},
    Symbol{"h", false, {3600.0, 0, 0, 0, 1, 0}},
    Symbol{"d", false, {86400.0, 0, 0, 0, 1, 0}},
    Symbol{"a", false, {365.25 * 86400.0, 0, 0, 0, 1, 0}},
    Symbol{"N", true, {1.0, 0, 1, 1, -2, 0}},
    Symbol{"Pa", true, {1.0, 0, -1, 1, -2, 0}},
    Symbol{"bar", true, {1.0, 5, -1, 1, -2, 0}},
    Symbol{"J", true, {1.0, 0, 2, 1, -2, 0}},
    Symbol{"Hz", true, {1.0, 0, 0, 0, -1, 0}},
    Symbol{"rad", true, {1.0, 0, 0, 0, 0, 1}},
    Symbol{"deg", false, {radians_per_degree, 0, 0, 0, 0, 1}},
    Symbol{"\u00b0", false, {radians_per_degree, 0, 0, 0, 0, 1}},
    Symbol{"%", false, {1.0, -2, 0, 0, 0, 0}},
};

struct Prefix {
  std::string_view name;
  int decimal;
};
constexpr std::array prefixes{Prefix{"n", -9},      Prefix{"u", -6}, Prefix{"\u00b5", -6},
                              Prefix{"\u03bc", -6}, Prefix{"m", -3}, Prefix{"c", -2},
                              Prefix{"d", -1},      Prefix{"k", 3},  Prefix{"M", 6},
                              Prefix{"G", 9},       Prefix{"T", 12}};

std::optional<Unit> unit_of(std::string_view word) {
  for (const Symbol& symbol : symbols) {
    if (symbol.name == word) return symbol.unit;
  }
  for (const Prefix& prefix : prefixes) {
    if (!word.starts_with(prefix.name)) continue;
    for (const Symbol& symbol : symbols) {
      if (!symbol.prefixes || symbol.name != word.substr(prefix.name.size())) continue;
      Unit unit = symbol.unit;
      unit.decimal += prefix.decimal;
      return unit;
    }
  }
  return std::nullopt;
}

void multiply(Unit& product, const Unit& unit, int power) {
  product.factor *= std::pow(unit.factor, power);
  product.decimal += power * unit.decimal;
  product.metre += power * unit.metre;
  product.kilogram += power * unit.kilogram;
  product.second += power * unit.second;
  product.turn += power * unit.turn;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_separator(char c) {
  return c == ' ' || c == '*' || c == '.' || c == '/';
}

/// Removes a power from the end of a word and returns it: "m3", "m^3", "s-1". 1 if there is none.
int take_power(std::string_view& word) {
  if (word.ends_with("\u00b2") || word.ends_with("\u00b3")) {
    const int power = word.ends_with("\u00b2") ? 2 : 3;
    word.remove_suffix(2);
    return power;
  }
  if (word.size() < 2 || !is_digit(word.back())) return 1;
  int power = word.back() - '0';
  word.remove_suffix(1);
  if (word.ends_with('-')) {
    power = -power;
    word.remove_suffix(1);
  }
  if (word.ends_with('^')) word.remove_suffix(1);
  return power;
}

/// The product of units in `text`, or nothing where a part of it is no unit.
std::optional<Unit> parse_unit(std::string_view text) {
  Unit product;
  bool divide = false;
  int parts = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (is_separator(text[i])) {
      if (text[i] == '/' && divide) return std::nullopt;
      if (text[i] == '/') divide = true;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && !is_separator(text[end])) ++end;
    std::string_view word = text.substr(i, end - i);
    i = end;
    constexpr int most_units = 8;
    if (++parts > most_units) return std::nullopt;
    if (word == "1" && parts == 1) continue;  // "1/s"
    const int power = take_power(word);
    const std::optional<Unit> unit = unit_of(word);
    if (!unit) return std::nullopt;
    multiply(product, *unit, divide ? -power : power);
    divide = false;
  }
  if (divide || parts == 0) return std::nullopt;
  return product;
}

bool fits(const Unit& unit, Dimension dimension) {
  const DimensionInfo& wanted = info(dimension);
  const bool metres = unit.metre == wanted.metre ||
                      (dimension == Dimension::stiffness && unit.metre == wanted.metre + 1) ||
                      (dimension == Dimension::load && unit.metre == wanted.metre - 2);
  return metres && unit.kilogram == wanted.kilogram && unit.second == wanted.second &&
         unit.turn == wanted.turn;
}

/// value * factor * 10^decimal, with one rounding for a plain decimal prefix.
double scaled(double value, const Unit& unit) {
  value *= unit.factor;
  const double power = std::pow(10.0, std::abs(unit.decimal));
  return unit.decimal < 0 ? value / power : value * power;
}

}  // namespace

const DimensionInfo& info(Dimension dimension) {
  // In the order of the enumeration.
  static constexpr std::array table{
      DimensionInfo{"a number", "", "0.5", 0, 0, 0, 0, false},
      DimensionInfo{"a length", "m", "2.5 or \"2.5 m\"", 1, 0, 0, 0, false},
      DimensionInfo{"an angle", "degrees", "30.0 or \"30 deg\"", 0, 0, 0, 1, true},
      DimensionInfo{"a time", "s", "0.1 or \"100 ms\"", 0, 0, 1, 0, false},
      DimensionInfo{"a density", "kg/m3", "2700.0 or \"2700 kg/m3\"", -3, 1, 0, 0, false},
      DimensionInfo{"a unit weight", "N/m3", "26e3 or \"26 kN/m3\"", -2, 1, -2, 0, false},
      DimensionInfo{"a stress", "Pa", "20e9 or \"20 GPa\"", -1, 1, -2, 0, false},
      DimensionInfo{"a stiffness", "Pa", "2e9 or \"2 GPa\"", -1, 1, -2, 0, false},
      DimensionInfo{"a stiffness per length", "Pa/m", "20e9 or \"20 GPa/m\"", -2, 1, -2, 0, false},
      DimensionInfo{"a velocity", "m/s", "0.5 or \"0.5 m/s\"", 1, 0, -1, 0, false},
      DimensionInfo{"an acceleration", "m/s2", "-9.81 or \"-9.81 m/s2\"", 1, 0, -2, 0, false},
      DimensionInfo{"a load", "N or Pa", "-1e5 or \"-100 kN\"", 1, 1, -2, 0, false},
      DimensionInfo{"a force", "N", "3e4 or \"30 kN\"", 1, 1, -2, 0, false},
      DimensionInfo{"a force per length", "N/m", "4e5 or \"400 kN/m\"", 0, 1, -2, 0, false},
      DimensionInfo{"a frequency", "Hz", "2.0 or \"2 Hz\"", 0, 0, -1, 0, false},
      DimensionInfo{"a rate", "1/s", "0.5 or \"0.5 1/s\"", 0, 0, -1, 0, false},
      DimensionInfo{"an angular velocity", "rad/s", "0.5 or \"0.5 rad/s\"", 0, 0, -1, 1, false},
      DimensionInfo{"an area", "m2", "0.01 or \"1 dm2\"", 2, 0, 0, 0, false},
      DimensionInfo{"a length per area", "1/m", "1.2 or \"1.2 1/m\"", -1, 0, 0, 0, false},
      DimensionInfo{"a stress per length", "Pa/m", "27e3 or \"27 kPa/m\"", -2, 1, -2, 0, false},
      DimensionInfo{"an energy per area", "J/m2", "40.0 or \"40 J/m2\"", 0, 1, -2, 0, false},
      DimensionInfo{"a second moment of area", "m4", "3.9e-5 or \"3900 cm4\"", 4, 0, 0, 0, false},
      DimensionInfo{"a moment", "N m", "120e3 or \"120 kN m\"", 2, 1, -2, 0, false},
      DimensionInfo{"a viscosity", "Pa s", "1e-3 or \"1 mPa s\"", -1, 1, -1, 0, false},
      DimensionInfo{"a discharge per metre", "m2/s", "1e-4 or \"1e-4 m2/s\"", 2, 0, -1, 0, false},
  };
  return table[static_cast<std::size_t>(dimension)];
}

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  const DimensionInfo& wanted = info(dimension);
  const std::string quoted = '"' + clipped(text) + '"';
  const auto fails = [&](const std::string& why) { return Quantity{std::nullopt, quoted + why}; };
  std::string_view rest = trimmed(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  const std::size_t first = rest.starts_with('-') ? 1 : 0;
  const bool number = first < rest.size() && (is_digit(rest[first]) || rest[first] == '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (!number || error == std::errc::invalid_argument) {
    return fails(" is not " + std::string(wanted.noun));
  }
  if (error != std::errc{}) return fails(" is out of range");
  rest = trimmed(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (rest.empty()) {
    return fails(dimension == Dimension::plain ? " is a string, not a number" : " has no unit");
  }
  std::optional<Unit> unit = parse_unit(rest);
  if (!unit) return fails(" has an unknown unit, " + clipped(rest));
  if (!fits(*unit, dimension)) return fails(" is not " + std::string(wanted.noun));
  // "3 deg" is 3 and "3 rad" 180/pi of it where the key is in degrees, without a rounding between.
  if (wanted.degrees) unit->factor = unit->factor == 1.0 ? 1.0 / radians_per_degree : 1.0;
  return {scaled(value, *unit), {}};
}

}  // namespace edda
