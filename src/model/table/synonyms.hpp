// Terms of other programs of the field, and the keys that correspond to them here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/table/keys.hpp"

namespace edda {

/// One word of another program.
struct Synonym {
  std::string_view word;
  /// What corresponds to it: dotted keys ("solver.duration", "joints.kn"), tables ("boundary") or
  /// keys outside any table, separated by blanks; empty where nothing corresponds.
  std::string_view keys;
  std::string_view note;  ///< a further remark; may be empty
};

/// All known words, in no order.
std::span<const Synonym> synonyms();

/// Those of `keys`, the keys of one table, that the word corresponds to.
std::vector<const Key*> keys_called(std::string_view word, std::span<const Key> keys);

/// "here that is kn of [joints.NAME]", or empty where the word is not known. Where some of the
/// `keys` of a table correspond, only these are named. Case, "-" and blanks do not matter.
std::string synonym_hint(std::string_view word, std::span<const Key> keys = {});

/// A table as messages name it: "[[boundary]]", "[joints.NAME]".
std::string in_file(const Section& section);

/// A table or a key as messages name it: "[[boundary]]", "kn of [joints.NAME]", "gravity".
std::string named_in_file(std::string_view dotted_key);

}  // namespace edda
