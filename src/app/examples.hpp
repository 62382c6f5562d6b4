// The models of examples/, built in.
#pragma once

#include <span>

namespace edda {

struct Example {
  const char* name;        ///< file name without .toml
  const char* text;        ///< the whole file
  const char* table_name;  ///< of a table that it reads, beside it; empty if it reads none
  const char* table;
};

/// In the order of their names. Written by cmake/embed_examples.cmake.
std::span<const Example> built_in_examples();

}  // namespace edda
