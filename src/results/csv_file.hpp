// Long tables, written as they grow.
#pragma once

#include <cstddef>
#include <string>

#include "results/csv.hpp"
#include "results/files.hpp"

namespace edda {

/// Writes the present content of `csv`, its header, and then what add_row(i) appends to it for each
/// i of [0, rows). Only a piece of the table is ever in memory.
template <class AddRow>
Trouble write_rows(const std::string& path, Csv& csv, std::size_t rows, AddRow add_row) {
  constexpr std::size_t piece = 1 << 16;  // bytes
  WholeFile file(path);
  const auto pass_on = [&] {
    file.add(csv.text());
    csv.clear();
  };
  for (std::size_t i = 0; i < rows; ++i) {
    add_row(i);
    if (csv.text().size() >= piece) pass_on();
  }
  pass_on();
  return file.complete();
}

}  // namespace edda
