#include "model/files/read_values.hpp"

#include <algorithm>
#include <cmath>

#include "model/completion/polygon_check.hpp"
#include "model/table/key_hints.hpp"

namespace edda {

void type_fault(const Spot& spot) {
  add_fault(spot.reading, spot.value.place, spot.path, "is " + shown(spot.value),
            "expects " + expected(spot.key));
}

void unknown_name(const Spot& spot, const std::string& name, std::string_view what,
                  std::span<const std::string_view> known, const std::string& none_known) {
  add_fault(spot.reading, spot.value.place, spot.path,
            fmt::format("no {} is called \"{}\"", what, clipped(name)),
            known.empty() ? none_known : suggestion(name, known));
}

std::optional<long long> read_integer(const Spot& spot) {
  const long long* integer = as<long long>(spot.value);
  const double* number = as<double>(spot.value);
  long long value = 0;
  if (integer != nullptr) {
    value = *integer;
  } else if (number != nullptr && std::abs(*number) < 1e15 && *number == std::floor(*number)) {
    value = static_cast<long long>(*number);
  } else {
    type_fault(spot);
    return std::nullopt;
  }
  if (!spot.key.rule.range.holds(static_cast<double>(value))) {
    add_fault(spot.reading, spot.value.place, spot.path, fmt::format("{} is out of range", value),
              "expects " + expected_range(spot.key.rule));
    return std::nullopt;
  }
  return value;
}

std::optional<std::array<double, 3>> read_numbers(const Value& value, const Key& key,
                                                  const std::string& path, std::size_t count,
                                                  Reading& reading) {
  const List* list = as<List>(value);
  if (list == nullptr || list->size() != count) {
    add_fault(reading, value.place, path,
              list == nullptr ? "is " + shown(value)
                              : fmt::format("has {} numbers, not {}", list->size(),
                                            count == 2 ? "two" : "three"),
              key.rule.kind == Kind::point || key.rule.kind == Kind::triple ||
                      key.rule.kind == Kind::varied
                  ? "expects " + expected(key)
                  : "expects a point such as [1.0, 2.5]");
    return std::nullopt;
  }
  std::array<double, 3> numbers{};
  bool sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = read_number((*list)[i], key, fmt::format("{}[{}]", path, i), reading);
    sound = sound && number.has_value();
    numbers[i] = number.value_or(0.0);
  }
  if (!sound) return std::nullopt;
  return numbers;
}

std::optional<Vec2> read_point(const Value& value, const Key& key, const std::string& path,
                               Reading& reading) {
  const auto pair = read_numbers(value, key, path, 2, reading);
  if (!pair) return std::nullopt;
  return Vec2{(*pair)[0], (*pair)[1]};
}

std::vector<double> read_number_list(const Value& value, const Key& key, const std::string& path,
                                     Reading& reading) {
  const List* list = as<List>(value);
  if (list == nullptr || list->empty()) {
    type_fault({key, value, path, reading});
    return {};
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto number = read_number((*list)[i], key, fmt::format("{}[{}]", path, i), reading);
    if (number) numbers.push_back(*number);
  }
  if (numbers.size() != list->size()) return {};
  return numbers;
}

std::vector<Vec2> read_points(const Spot& spot) {
  const List* list = as<List>(spot.value);
  if (list == nullptr) {
    type_fault(spot);
    return {};
  }
  std::vector<Vec2> points;
  points.reserve(list->size());
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto point =
        read_point((*list)[i], spot.key, fmt::format("{}[{}]", spot.path, i), spot.reading);
    if (point) points.push_back(*point);
  }
  if (points.size() != list->size()) return {};
  const std::size_t before = spot.reading.faults.size();
  check_points(points, spot.key.rule.kind, spot.value, spot.path, spot.reading);
  if (spot.reading.faults.size() != before) return {};
  return points;
}

std::vector<std::string> read_words(const Spot& spot) {
  const List* list = as<List>(spot.value);
  const bool names = spot.key.rule.kind == Kind::names;  // whose meaning complete.cpp checks
  if (list == nullptr || (list->empty() && !names)) {
    type_fault(spot);
    return {};
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value& item = (*list)[i];
    const std::string path = fmt::format("{}[{}]", spot.path, i);
    const std::string* word = as<std::string>(item);
    const auto& known = spot.key.rule.words;
    if (word == nullptr) {
      add_fault(spot.reading, item.place, path, "is " + shown(item),
                names ? "expects a name in quotes" : "expects one of " + quoted_list(known));
    } else if (!names && std::find(known.begin(), known.end(), *word) == known.end()) {
      add_fault(spot.reading, item.place, path, shown(item) + " is not known",
                suggestion(*word, known));
    } else if (std::find(words.begin(), words.end(), *word) != words.end()) {
      add_fault(spot.reading, item.place, path, shown(item) + " is given twice", "name each once");
    } else {
      words.push_back(*word);
    }
  }
  return words;
}

}  // namespace edda
