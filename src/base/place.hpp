// The place in the model file to which a geometry fault refers.
#pragma once

#include <string>

#include "base/fault.hpp"

namespace edda {

/// The place of `member` in the table at `table`: its key is extended unless it names the member
/// already.
inline Where member_of(Where table, const std::string& member) {
  if (table.key.empty()) {
    table.key = member;
  } else if (!table.key.ends_with("." + member)) {
    table.key += "." + member;
  }
  return table;
}

}  // namespace edda
