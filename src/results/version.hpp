// The version, as CMake knows it.
#pragma once

#include <string_view>

namespace edda {

#ifdef EDDA_VERSION
inline constexpr std::string_view version = EDDA_VERSION;
#else
inline constexpr std::string_view version = "unknown";
#endif

}  // namespace edda
