// A value that is read by many and changed by few.
#pragma once

#include <memory>
#include <utility>

namespace edda {

/// Copies share the value, and read it only. Whoever must change it says so by edit(), which leaves
/// the other copies as they are. Copies may be read in several threads; one may be edited beside
/// others only while some copy that outlives the edit shares its value.
template <class T>
class CopyOnWrite {
 public:
  CopyOnWrite() : value_(std::make_shared<T>()) {}
  explicit CopyOnWrite(T value) : value_(std::make_shared<T>(std::move(value))) {}

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }

  /// The value to write to: a copy where it is shared. References taken before may then belong to
  /// the shared one.
  T& edit() {
    if (value_.use_count() != 1) value_ = std::make_shared<T>(*value_);
    return *value_;
  }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace edda
