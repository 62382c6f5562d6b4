// The reference of keys, made from the table of keys (keys.hpp).
#pragma once

#include <string>
#include <string_view>

namespace edda {

/// Every table and key of a model file in Markdown: its values, its default, its meaning.
std::string key_reference();

/// The same of one table ("stage", "solver"; "" for the keys outside any); empty if there is none.
std::string key_reference(std::string_view section);

}  // namespace edda
