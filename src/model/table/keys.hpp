// The table of keys. Every key of a model file is one line of keys.cpp: its name, the field it
// fills, the values it may have, its default and its meaning. Reading, range checks, hints, the
// written model.toml and the manual's reference all come from that line.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "model/model.hpp"
#include "model/table/quantity.hpp"

namespace edda {

enum class Kind {
  flag,
  integer,
  number,
  text,
  name,          ///< text that is not empty: the name of the element in lists and for --set
  choice,        ///< one of the words of an enumeration
  material,      ///< name of a material
  joint,         ///< name of a joint law
  point,         ///< two numbers
  triple,        ///< three numbers
  polyline,      ///< two points or more
  polygon,       ///< three points or more, with an area, not crossing itself
  words,         ///< a list of distinct words, each one of Rule::words
  numbers,       ///< a list of numbers
  names,         ///< a list of distinct names of other elements
  joint_map,     ///< a table of names, each with the name of a joint law
  material_map,  ///< a table of names, each with the name of a material
  number_map,    ///< a table of names, each with a number in Rule::range
  varied,        ///< two numbers, from and to, of what the key names
  file,          ///< path of a file, as written relative to the model's
  table,         ///< keys inside a key: damping = { ... }
  tables,        ///< a list of such tables: change = [{ ... }, { ... }]
  source,        ///< path of a file, or a table
};

/// Bounds of a number, inclusive unless open. Points obey them in each component.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool holds(double x) const {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
  }
};

/// The values that a key may have.
struct Rule {
  Kind kind = Kind::number;
  Dimension dimension = Dimension::plain;
  Range range = {};
  std::string_view word = {};  ///< accepted in place of a number ("auto"): no value is given
  std::span<const std::string_view> words = {};  ///< of Kind::words
};

/// What applies where a key is not given: a fault, the field's initial value in model.hpp, or what
/// `text` describes (filled in by complete.cpp).
struct Default {
  bool required = false;
  std::string_view text;
  bool zero_is_none =
      false;  ///< a number that is not written where it is 0, which is out of its range
};

/// A field of an enumeration type, as a number and the names of its values.
struct Choice {
  std::span<const std::string_view> names;
  void* field;
  int (*get)(const void* field);
  void (*set)(void* field, int value);
};

struct Key;
struct SubTable {
  std::span<const Key> keys;
  void* object;                ///< null where the table is optional and not given
  void* owner;                 ///< then: the object that contains it,
  void* (*make)(void* owner);  ///< and the function that creates it there
  std::string* file;  ///< where the path of a file may be given in place of the table; else null
};

using JointMap = std::vector<std::pair<std::string, Index>>;

/// A list of tables in a key.
struct TableList {
  std::span<const Key> keys;
  void* list;
  std::size_t (*count)(const void* list);
  void* (*at)(void* list, std::size_t i);
  void* (*add)(void* list);
  Where* (*where)(void* object);
};

/// Typed access to the field that a key fills.
using Slot = std::variant<bool*, int*, long long*, double*, std::optional<double>*,
                          std::optional<long long>*, std::optional<Restitution>*, std::string*,
                          JointMap*, NumberMap*, VariedRange*, Vec2*, std::optional<Vec2>*, Triple*,
                          std::optional<Triple>*, std::vector<Vec2>*, std::vector<double>*,
                          std::vector<std::string>*, Choice, SubTable, TableList>;

struct Key {
  std::string_view name;
  Slot (*slot)(void* object);  ///< null: no field of its own, complete.cpp reads it (unit_weight)
  Rule rule;
  Default otherwise;
  std::string_view meaning;
};

enum class Shape {
  root,   ///< keys outside any table
  table,  ///< [solver]
  named,  ///< [materials.NAME]
  list,   ///< [[block]]
};

/// A table of the model file, with access to its objects in a Model; or of another file, with
/// access to those in what it is read into (`root`).
struct Section {
  std::string_view name;
  Shape shape;
  bool optional;  ///< of Shape::table: a missing table has no required keys
  std::span<const Key> keys;
  std::string_view meaning;
  std::size_t (*count)(const void* root);
  void* (*add)(void* root);  ///< a new object of a list; the one object of a table
  void* (*at)(void* root, std::size_t i);
  Where* (*where)(void* object);          ///< null if the object does not keep it
  std::string* (*name_of)(void* object);  ///< of Shape::named, else null
};

/// All tables of a model file, in the order in which they are read and written: tables that others
/// refer to come first.
std::span<const Section> sections();
const Section* find_section(std::string_view name, std::span<const Section> among = sections());
/// A key of that name; "load:NAME" is found by "load:" and any name.
const Key* find_key(std::span<const Key> keys, std::string_view name);
std::vector<std::string_view> key_names(std::span<const Key> keys);

/// The keys of the table, or of each table, that a slot holds; else none.
std::span<const Key> inner_keys_of(const Slot& slot);

/// What a value must be: `a length above 0 such as 2.5 or "2.5 m"`.
std::string expected(const Key& key);
/// As expected(), without the example: `a length above 0`.
std::string expected_range(const Rule& rule);

}  // namespace edda
