// A Model back as a model file.
#pragma once

#include <span>
#include <string>

#include "model/table/keys.hpp"

namespace edda {

/// The model as run: TOML with every key and every default filled in, in SI units and degrees,
/// numbers the shortest that read back to the same bits. read_model_text() of it gives the same
/// model but for Model::file and the places.
std::string to_toml(const Model& model);

/// The objects of the sections, which `root` holds, as TOML. `names`: where references lead.
std::string to_toml(std::span<const Section> sections, void* root, const Model& names);

/// One value of the model as TOML; empty where the field has none. `slot`: the key's field in an
/// object of `model`.
std::string toml_value(const Key& key, const Slot& slot, const Model& model);

}  // namespace edda
