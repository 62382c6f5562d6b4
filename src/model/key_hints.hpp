// What to say of a key that its table does not know.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace edda {

/// Where it belongs, what it is called here, or which of the keys that the table knows it may be a
/// slip of.
std::string unknown_key_hint(std::string_view name, std::span<const std::string_view> known);

}  // namespace edda
