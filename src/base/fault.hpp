// A fault in the input: a value with place, key and remedy, never an exception or an exit.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace edda {

/// Where in a model file something was written. `key` is the dotted path ("block.slider.polygon").
struct Where {
  std::string key;
  std::string file;  ///< "--set" for a value given on the command line (line = its number, from 1)
  int line = 0;      ///< from 1; 0 where unknown
  int column = 0;    ///< from 1
};

/// One thing wrong with the input. Printed as `FILE:LINE:COLUMN: key: problem: remedy`.
struct Fault {
  Where where;
  std::string problem;  ///< what is wrong, no full stop
  std::string remedy;   ///< what to do, no full stop
};

using Faults = std::vector<Fault>;

/// `FILE:LINE:COLUMN: key: problem: remedy`, without the parts that are empty.
std::string to_string(const Fault& fault);

/// A T, or the faults that prevent it. No exceptions; test with ok() before value().
template <class T>
class Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Faults faults) : content_(std::move(faults)) {}
  Result(Fault fault) : content_(Faults{std::move(fault)}) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const T& value() const { return std::get<0>(content_); }
  T& value() { return std::get<0>(content_); }
  const Faults& faults() const { return std::get<1>(content_); }

 private:
  std::variant<T, Faults> content_;
};

}  // namespace edda
