// The models of examples/, built in.
#pragma once

#include <span>

namespace edda {

struct Example {
  const char* name;  ///< file name without .toml
  const char* text;  ///< the whole file
};

/// In the order of their names. Written by cmake/embed_examples.cmake.
std::span<const Example> built_in_examples();

}  // namespace edda
