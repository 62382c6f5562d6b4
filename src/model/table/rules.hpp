// Building blocks of the table of keys: the values that a key may have.
#pragma once

#include "model/table/keys.hpp"

namespace edda::rules {

using D = Dimension;

constexpr Range any{};
constexpr Range above(double low) {
  return {.low = low, .low_open = true};
}
constexpr Range from(double low) {
  return {.low = low};
}
constexpr Range from_below(double low, double high) {
  return {.low = low, .high = high, .high_open = true};
}
constexpr Range between(double low, double high) {
  return {.low = low, .high = high, .low_open = true, .high_open = true};
}
constexpr Range above_to(double low, double high) {
  return {.low = low, .high = high, .low_open = true};
}
constexpr Range from_to(double low, double high) {
  return {.low = low, .high = high};
}

constexpr Rule rule(Kind kind) {
  return {.kind = kind};
}
constexpr Rule number(D dimension, Range range = any) {
  return {.kind = Kind::number, .dimension = dimension, .range = range};
}
constexpr Rule number_or(std::string_view word, D dimension, Range range) {
  return {.kind = Kind::number, .dimension = dimension, .range = range, .word = word};
}
constexpr Rule whole(double low, double high) {
  return {.kind = Kind::integer, .range = from_to(low, high)};
}
constexpr Rule shape(Kind kind, D dimension, Range range = any) {
  return {.kind = kind, .dimension = dimension, .range = range};
}
constexpr Rule numbers_of_names(Range range) {
  return {.kind = Kind::number_map, .range = range};
}
constexpr Rule words_of(std::span<const std::string_view> words) {
  return {.kind = Kind::words, .words = words};
}
constexpr Rule varied(D dimension) {
  return {.kind = Kind::varied, .dimension = dimension};
}
constexpr Rule flag = rule(Kind::flag), text = rule(Kind::text), naming = rule(Kind::name),
               choice = rule(Kind::choice), material = rule(Kind::material),
               joint = rule(Kind::joint), table = rule(Kind::table), tables = rule(Kind::tables),
               point = shape(Kind::point, D::length), polygon = shape(Kind::polygon, D::length),
               polyline = shape(Kind::polyline, D::length), name_list = rule(Kind::names),
               number_list = rule(Kind::numbers), file = rule(Kind::file),
               source = rule(Kind::source);

constexpr Default required{true, {}};
constexpr Default initial{};  // the field's initial value in model.hpp
constexpr Default otherwise(std::string_view words) {
  return {false, words};
}
/// For a number whose field is 0 where none is given.
constexpr Default or_none(std::string_view words) {
  return {false, words, true};
}
constexpr std::string_view if_one = "may be left out where one is defined";

}  // namespace edda::rules
