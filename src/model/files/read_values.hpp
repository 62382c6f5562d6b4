// Single values of a model file, read and checked.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "model/files/reader.hpp"
#include "model/table/nearest.hpp"

namespace edda {

/// The value if it is of that type, else null.
template <class T>
const T* as(const Value& value) {
  return std::get_if<T>(&value.content);
}

/// One value that is being read into its field.
struct Spot {
  const Key& key;
  const Value& value;
  const std::string& path;  ///< dotted key
  Reading& reading;
};

/// Adds a fault: the value has another type than the key requires.
void type_fault(const Spot& spot);
void unknown_name(const Spot& spot, const std::string& name, std::string_view what,
                  std::span<const std::string_view> known, const std::string& none_known);

template <class Item>
std::vector<std::string_view> item_names(const std::vector<Item>& items) {
  std::vector<std::string_view> names;
  names.reserve(items.size());
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

template <class Item>
Index index_of(const std::vector<Item>& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<Index>(i);
  }
  return none;
}

template <class Item>
Index read_reference(const Spot& spot, const std::vector<Item>& items, std::string_view what,
                     std::string_view table) {
  const std::string* name = as<std::string>(spot.value);
  if (name == nullptr) {
    type_fault(spot);
    return none;
  }
  const Index i = index_of(items, *name);
  if (i == none) {
    unknown_name(spot, *name, what, item_names(items),
                 fmt::format("add [{}.{}]", table, clipped(*name)));
  }
  return i;
}

std::optional<long long> read_integer(const Spot& spot);

/// Reads `count` numbers; faults have `path`, which already contains the number of a point in its
/// list.
std::optional<std::array<double, 3>> read_numbers(const Value& value, const Key& key,
                                                  const std::string& path, std::size_t count,
                                                  Reading& reading);
std::optional<Vec2> read_point(const Value& value, const Key& key, const std::string& path,
                               Reading& reading);
/// A list of at least one number; empty where anything is wrong with it.
std::vector<double> read_number_list(const Value& value, const Key& key, const std::string& path,
                                     Reading& reading);
/// A list of points, empty where anything is wrong with it.
std::vector<Vec2> read_points(const Spot& spot);
std::vector<std::string> read_words(const Spot& spot);

}  // namespace edda
