// Faults of settings that a study does not support.
#pragma once

#include <string>
#include <utility>

#include "model/key_places.hpp"
#include "model/model.hpp"

namespace edda {

/// A fault of this key, at its place in the model or at that of its table.
inline Fault fault_at(const Model& model, const Where& table, const char* key, std::string problem,
                      std::string remedy) {
  Fault fault{table, std::move(problem), std::move(remedy)};
  if (fault.where.file.empty()) fault.where.file = model.file;
  fault.where.key = key;
  return at_their_keys(model.key_places, {fault}).front();
}

}  // namespace edda
