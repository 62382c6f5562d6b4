// From the tree of values to the structs of the model, driven by the table of keys alone.
#pragma once

#include <optional>
#include <string>

#include "model/files/value.hpp"
#include "model/table/keys.hpp"

namespace edda {

// Magnitudes that numbers may have, so that their products and quotients neither overflow nor
// underflow.
inline constexpr double largest_number = 1e150, largest_length = 1e12;
inline constexpr double smallest_positive = 1e-150;  ///< of a key that must be above 0

/// State of reading: the model and the faults so far. A file of another kind has other sections,
/// and leaves the model empty.
struct Reading {
  std::string file;
  Model model;
  Faults faults;
  std::span<const Section> sections = edda::sections();
};

Where where_of(const Reading& reading, Place place, std::string key);
void add_fault(Reading& reading, Place place, std::string key, std::string problem,
               std::string remedy);

/// The name of an element of a list in keys: its own, else its number.
std::string label(const Value& element, std::size_t number);

/// Fills every object of every section. Objects and elements of the file keep the same numbers,
/// also where an element is faulty. A field whose key is missing keeps its initial value of
/// model.hpp.
/// `into`: the model, or the root of the objects of Reading::sections.
void read_sections(const Value& root, void* into, Reading& reading);

/// A number in the key's unit, or nothing and a fault at `path`.
std::optional<double> read_number(const Value& value, const Key& key, const std::string& path,
                                  Reading& reading);

}  // namespace edda
