// SHA-256 (FIPS 180-4): which input a result came from.
#pragma once

#include <string>
#include <string_view>

namespace edda {

/// The hash of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace edda
