// Bytes compressed in zlib's format (RFC 1950), which browsers call "deflate" and ParaView reads.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace edda {

/// fastest: for data that is written as fast as it comes.
std::string deflated(std::string_view bytes, bool fastest = false);

/// The `size` bytes that have been deflated to these; nothing where they are damaged or are others.
std::optional<std::string> inflated(std::string_view packed, std::size_t size);

}  // namespace edda
