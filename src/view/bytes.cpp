#include "view/bytes.hpp"

#include <bit>

namespace edda {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

void Bytes::f32(double value) {
  number(static_cast<float>(value));
}

void Bytes::varint(std::uint64_t value) {
  for (; value >= 128; value >>= 7) u8(static_cast<std::uint8_t>(value | 128));
  u8(static_cast<std::uint8_t>(value));
}

void Bytes::zigzag(std::int64_t value) {
  const auto twice = static_cast<std::uint64_t>(value) << 1;
  varint(value < 0 ? ~twice : twice);
}

std::string base64(std::string_view bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t left = bytes.size() - at;
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return k < left ? static_cast<unsigned char>(bytes[at + k]) : 0U;
    };
    const std::uint32_t triple = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(k <= left ? letters[triple >> (18 - 6 * k) & 63] : '=');
    }
  }
  return text;
}

}  // namespace edda
