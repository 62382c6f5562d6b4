// The contents of a checkpoint, independent of the file format: arrays of numbers, and texts, by
// name.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace edda {

using RecordValue =
    std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::uint32_t>,
                 std::vector<std::int32_t>, std::vector<std::uint16_t>, std::vector<std::uint8_t>,
                 std::string>;

/// Names are made of letters, digits, '_' and '.'.
using Record = std::map<std::string, RecordValue>;

/// A RecordValue that lies elsewhere.
using RecordView =
    std::variant<std::span<const double>, std::span<const std::uint64_t>,
                 std::span<const std::uint32_t>, std::span<const std::int32_t>,
                 std::span<const std::uint16_t>, std::span<const std::uint8_t>, std::string_view>;

/// Takes the entries of a checkpoint one after the other, each under a name of its own, so that
/// they need not all be in memory at once.
class RecordSink {
 public:
  RecordSink() = default;
  RecordSink(const RecordSink&) = delete;
  RecordSink& operator=(const RecordSink&) = delete;
  virtual ~RecordSink() = default;
  /// `value` is read before put() returns, and no longer.
  virtual void put(const std::string& name, RecordView value) = 0;
};

/// Copies the entries into a Record.
class RecordKeeper : public RecordSink {
 public:
  explicit RecordKeeper(Record& record) : record_(record) {}
  void put(const std::string& name, RecordView value) override {
    record_[name] = std::visit([](const auto& v) { return kept(v); }, value);
  }

 private:
  template <class T>
  static RecordValue kept(std::span<const T> values) {
    return std::vector<T>(values.begin(), values.end());
  }
  static RecordValue kept(std::string_view text) { return std::string(text); }

  Record& record_;
};

}  // namespace edda
