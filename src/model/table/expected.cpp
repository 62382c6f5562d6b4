// The values that a key requires, in words.
#include <fmt/format.h>

#include <cmath>

#include "model/table/keys.hpp"
#include "model/table/nearest.hpp"

namespace edda {

std::string expected_range(const Rule& rule) {
  std::string text(rule.kind == Kind::integer ? "a whole number" : info(rule.dimension).noun);
  const Range& range = rule.range;
  if (std::isfinite(range.low)) {
    text += fmt::format(" {} {}", range.low_open ? "above" : "of at least", range.low);
  }
  if (std::isfinite(range.high)) {
    text += std::isfinite(range.low) ? " and " : " ";
    text += fmt::format("{} {}", range.high_open ? "below" : "at most", range.high);
  }
  return text;
}

std::string expected(const Key& key) {
  const Rule& rule = key.rule;
  const std::string example = " such as " + std::string(info(rule.dimension).example);
  switch (rule.kind) {
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return expected_range(rule);
    case Kind::number:
      return (rule.word.empty() ? "" : '"' + std::string(rule.word) + "\" or ") +
             expected_range(rule) + (rule.dimension == Dimension::plain ? "" : example);
    case Kind::text:
    case Kind::choice:
      return "a string";
    case Kind::name:
    case Kind::material:
    case Kind::joint:
      return "a name in quotes";
    case Kind::point:
      return rule.dimension == Dimension::length ? "a point such as [1.0, 2.5]"
             : rule.dimension == Dimension::load ? "two numbers such as [0.0, -1e5]"
                                                 : "two numbers such as [0.0, -9.81]";
    case Kind::triple:
      return "three numbers such as [-24e6, -24e6, 0.0]";
    case Kind::polyline:
      return "a list of points such as [[0, 0], [2, 1]]";
    case Kind::polygon:
      return "a list of points such as [[0, 0], [2, 0], [2, 1]]";
    case Kind::numbers:
      return "a list of numbers such as [1.0, 2.5]";
    case Kind::names:
      return "a list of names such as [\"one\", \"two\"]";
    case Kind::joint_map:
      return "a table such as { NAME = \"joint\" }";
    case Kind::material_map:
      return "a table such as { NAME = \"material\" }";
    case Kind::number_map:
      return "a table such as { NAME = 0.5 }, each " + expected_range(rule);
    case Kind::varied:
      return "two numbers, from and to, such as [0.0, 0.5]";
    case Kind::file:
      return "the path of a file in quotes";
    case Kind::words:
      return "a list of " + quoted_list(rule.words);
    case Kind::table:
      return "a table such as { key = value }";
    case Kind::tables:
      return "a list of tables such as [{ key = value }]";
    case Kind::source:
      return "the path of a file in quotes, or a table";
  }
  return {};
}

}  // namespace edda
