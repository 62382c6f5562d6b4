// One list of fields, read in two ways. A function template `list(archive, object)` names every
// field of an object once; Saver passes them to a RecordSink, Loader takes them out of a Record. So
// the fields written and the fields read can never differ.
#pragma once

#include <array>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/columns.hpp"
#include "base/vec2.hpp"
#include "checkpoint/record.hpp"

namespace edda {

namespace archive {

/// Type in which a number is stored: enumerations and bool as bytes.
template <class T, bool = std::is_enum_v<T>>
struct Kept {
  using type = T;
};
template <class T>
struct Kept<T, true> {
  using type = std::underlying_type_t<T>;
};
template <>
struct Kept<bool, false> {
  using type = std::uint8_t;
};

}  // namespace archive

class Saver {
 public:
  explicit Saver(RecordSink& sink) : sink_(sink) {}
  static constexpr bool loads = false;

  template <class T>
  void operator()(const std::string& name, const std::vector<T>& values) {
    using K = typename archive::Kept<T>::type;
    if constexpr (std::is_same_v<T, K>) {
      sink_.put(name, std::span<const K>(values));
    } else {
      std::vector<K> kept;
      kept.reserve(values.size());
      for (const T& v : values) kept.push_back(static_cast<K>(v));
      sink_.put(name, std::span<const K>(kept));
    }
  }
  void operator()(const std::string& name, const RowColumn& column) {
    column_.resize(column.size());
    for (std::size_t row = 0; row < column.size(); ++row) column_[row] = column[row];
    sink_.put(name, std::span<const double>(column_));
  }
  template <class T, std::size_t n>
  void operator()(const std::string& name, const std::array<std::vector<T>, n>& values) {
    for (std::size_t k = 0; k < n; ++k) (*this)(name + std::to_string(k), values[k]);
  }
  void operator()(const std::string& name, const std::string& text) {
    sink_.put(name, std::string_view(text));
  }
  template <class T>
  void operator()(const std::string& name, const std::optional<T>& value) {
    (*this)(name, value ? std::vector<T>{*value} : std::vector<T>{});
  }
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void operator()(const std::string& name,
                                                                         const T& value) {
    using K = typename archive::Kept<T>::type;
    const K kept = static_cast<K>(value);
    sink_.put(name, std::span<const K>(&kept, 1));
  }

 private:
  RecordSink& sink_;
  std::vector<double> column_;  ///< one after the other in the same memory
};

class Loader {
 public:
  explicit Loader(const Record& record) : record_(record) {}
  static constexpr bool loads = true;

  /// The fields that were missing or of another kind, empty if none. Such fields are not changed.
  const std::string& flaw() const { return flaw_; }
  /// For faults that a list finds itself.
  void refuse(std::string what) { note(std::move(what)); }

  template <class T>
  void operator()(const std::string& name, std::vector<T>& values) {
    using K = typename archive::Kept<T>::type;
    const std::vector<K>* kept = find<std::vector<K>>(name);
    if (kept == nullptr) return;
    values.clear();
    values.reserve(kept->size());
    for (const K v : *kept) values.push_back(static_cast<T>(v));
  }
  void operator()(const std::string& name, RowColumn& column) {
    const std::vector<double>* kept = find<std::vector<double>>(name);
    if (kept == nullptr) return;
    if (kept->size() != column.size()) return note(name + " has another size");
    column.take(*kept);
  }
  template <class T, std::size_t n>
  void operator()(const std::string& name, std::array<std::vector<T>, n>& values) {
    for (std::size_t k = 0; k < n; ++k) (*this)(name + std::to_string(k), values[k]);
  }
  void operator()(const std::string& name, std::string& text) {
    if (const std::string* kept = find<std::string>(name)) text = *kept;
  }
  template <class T>
  void operator()(const std::string& name, std::optional<T>& value) {
    std::vector<T> kept;
    (*this)(name, kept);
    value.reset();
    if (!kept.empty()) value = kept.front();
  }
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void operator()(const std::string& name,
                                                                         T& value) {
    using K = typename archive::Kept<T>::type;
    const std::vector<K>* kept = find<std::vector<K>>(name);
    if (kept == nullptr) return;
    if (kept->size() != 1) {
      note(name + " is no single number");
      return;
    }
    value = static_cast<T>(kept->front());
  }

 private:
  void note(std::string what) {
    if (flaw_.empty()) flaw_ = std::move(what);
  }
  template <class V>
  const V* find(const std::string& name) {
    const auto it = record_.find(name);
    const V* value = it == record_.end() ? nullptr : std::get_if<V>(&it->second);
    if (value == nullptr)
      note(name + (it == record_.end() ? " is missing" : " is of another kind"));
    return value;
  }

  const Record& record_;
  std::string flaw_;
};

/// Lists the parts of vectors of all blocks (blocks/body_vectors.hpp).
template <class Archive, class Vectors>
void list_vectors(Archive& a, const std::string& name, Vectors& u) {
  a(name + ".x", u.x);
  a(name + ".y", u.y);
  a(name + ".modes_x", u.modes.x);
  a(name + ".modes_y", u.modes.y);
}

/// Lists structs that are numbers alone, one after the other.
template <class Archive, class T>
void list_numbers(Archive& a, const std::string& name, std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0);
  constexpr std::size_t each = sizeof(T) / sizeof(double);
  std::vector<double> flat(each * values.size());
  if (!values.empty())
    std::memcpy(flat.data(), static_cast<const void*>(values.data()), flat.size() * sizeof(double));
  a(name, flat);
  if constexpr (Archive::loads) {
    values.resize(flat.size() / each);
    if (!values.empty())
      std::memcpy(static_cast<void*>(values.data()), flat.data(), values.size() * sizeof(T));
  }
}

template <class Archive>
void list_points(Archive& a, const std::string& name, std::vector<Vec2>& points) {
  std::vector<double> flat;
  for (const Vec2 p : points) {
    flat.push_back(p.x);
    flat.push_back(p.y);
  }
  a(name, flat);
  if constexpr (Archive::loads) {
    points.clear();
    for (std::size_t k = 0; k + 1 < flat.size(); k += 2) points.push_back({flat[k], flat[k + 1]});
  }
}

}  // namespace edda
