#include <fmt/format.h>

#include <cmath>

#include "model/files/reader.hpp"

namespace edda {
namespace {

bool starts_above_zero(const Range& range) {
  return range.low_open && range.low == 0.0;
}

}  // namespace

std::optional<double> read_number(const Value& value, const Key& key, const std::string& path,
                                  Reading& reading) {
  const auto fails = [&](std::string problem, std::string remedy) {
    add_fault(reading, value.place, path, std::move(problem), std::move(remedy));
    return std::nullopt;
  };
  // A point as a whole must be a pair, its elements numbers.
  Key scalar = key;
  if (key.rule.kind != Kind::number) scalar.rule.kind = Kind::number;
  double number = 0.0;
  if (const long long* integer = std::get_if<long long>(&value.content)) {
    number = static_cast<double>(*integer);
  } else if (const double* real = std::get_if<double>(&value.content)) {
    number = *real;
  } else if (const std::string* text = std::get_if<std::string>(&value.content)) {
    const Quantity quantity = parse_quantity(*text, key.rule.dimension);
    if (!quantity.value) return fails(quantity.problem, "expects " + expected(scalar));
    number = *quantity.value;
  } else {
    return fails("is " + shown(value), "expects " + expected(scalar));
  }
  const double largest = key.rule.dimension == Dimension::length ? largest_length : largest_number;
  if (!std::isfinite(number)) return fails("is not a finite number", "expects " + expected(scalar));
  if (std::abs(number) > largest) {
    return fails(fmt::format("{} is too large", shown(value)),
                 fmt::format("give at most {:.0e} in size", largest));
  }
  if (starts_above_zero(key.rule.range) && number > 0.0 && number < smallest_positive) {
    return fails(fmt::format("{} is too small", shown(value)),
                 fmt::format("give at least {:.0e}", smallest_positive));
  }
  if (!key.rule.range.holds(number)) {
    return fails(fmt::format("{} is out of range", shown(value)),
                 "expects " + expected_range(scalar.rule));
  }
  return number;
}

}  // namespace edda
