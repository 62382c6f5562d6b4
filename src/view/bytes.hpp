// Bytes of the replay page: little-endian numbers, as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace edda {

/// Builds up a block of bytes.
class Bytes {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void u16(std::uint16_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void f32(double value);
  void f64(double value) { number(value); }
  /// Seven bits per byte, the lowest first; the eighth is set if more follow.
  void varint(std::uint64_t value);
  /// Small for small values of either sign: 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
  void zigzag(std::int64_t value);
  void append(std::string_view bytes) { bytes_.append(bytes); }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  const std::string& text() const { return bytes_; }

 private:
  template <class T>
  void number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::string bytes_;
};

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace edda
