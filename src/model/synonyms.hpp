// What other programs of the field call things, and what they are called here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/keys.hpp"

namespace edda {

/// One word of another program.
struct Synonym {
  std::string_view word;
  /// What stands for it: dotted keys ("solver.duration", "joints.kn"), tables ("boundary") or keys
  /// outside any table, apart by blanks; empty where there is nothing of the kind.
  std::string_view keys;
  std::string_view note;  ///< what else there is to say; may be empty
};

/// All that are known, in no order.
std::span<const Synonym> synonyms();

/// Those of `keys`, the keys of one table, that the word stands for.
std::vector<const Key*> keys_called(std::string_view word, std::span<const Key> keys);

/// "here that is kn of [joints.NAME]", or empty where the word is not known. Where some of the
/// `keys` of a table are meant, these alone. Case, "-" and blanks do not matter.
std::string synonym_hint(std::string_view word, std::span<const Key> keys = {});

/// As a message names a table or a key: "[[boundary]]", "kn of [joints.NAME]", "gravity".
std::string named_in_file(std::string_view dotted_key);

}  // namespace edda
