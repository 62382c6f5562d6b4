// The reference of keys, made from the table of keys (keys.hpp).
#pragma once

#include <string>
#include <string_view>

#include "model/table/keys.hpp"

namespace edda {

/// Every table and key of a model file in Markdown: its values, its default, its meaning.
std::string key_reference();

/// The same of one table ("stage", "solver"; "" for the keys outside any); empty if there is none.
std::string key_reference(std::string_view section);

/// The same of a section of a file of any kind. `root`: an object of what it is read into, which
/// gets an element more.
std::string key_reference(const Section& section, void* root);

}  // namespace edda
