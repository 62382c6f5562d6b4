// SHA-256 (FIPS 180-4), to identify the input of a result.
#pragma once

#include <string>
#include <string_view>

namespace edda {

/// The hash of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace edda
