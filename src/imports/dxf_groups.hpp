// DXF drawings as pairs of lines, a group code and its value, and as entities: a name with the
// groups up to the next one. Counts given in a file are not relied on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/fault.hpp"

namespace edda {

struct DxfGroup {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the code
};

struct DxfEntity {
  std::string_view name;
  int line = 0;
  std::vector<DxfGroup> groups;
  std::optional<Fault> fault = {};  ///< a line in it that is no group code

  const DxfGroup* find(int code) const;  ///< the first one; null without any
};

/// The first fault in a drawing, or in an entity of it.
class DxfFault {
 public:
  explicit DxfFault(std::string path) : path_(std::move(path)) {}

  /// Returns false, for callers that then return false, too.
  bool add(int line, std::string problem,
           std::string remedy =
               "save it again as an ASCII DXF drawing, or export the lines as "
               ".csv");
  const std::optional<Fault>& found() const { return fault_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::optional<Fault> fault_;
};

/// Pairs of lines, one at a time, up to the end that the drawing states: text may follow it. Where
/// a line is no group code, reading goes on at the next pair that begins an entity.
class DxfGroups {
 public:
  DxfGroups(std::string_view text, DxfFault& fault) : rest_(text), fault_(fault) {}

  /// The next pair; nothing at the end of the file, or where a fault has been found.
  std::optional<DxfGroup> next();
  int line() const { return line_; }  ///< number of the last line read
  /// The first line that was no group code since the last call.
  std::optional<Fault> take_damage() { return std::exchange(damage_, std::nullopt); }
  DxfFault& fault() { return fault_; }

 private:
  std::string_view take();
  bool find_next_entity();

  std::string_view rest_;
  int line_ = 0;
  bool code_is_last_ = false, any_ = false;
  std::optional<Fault> damage_;
  DxfFault& fault_;
};

/// The entities of a section whose name has just been read.
class DxfSection {
 public:
  explicit DxfSection(DxfGroups& file) : file_(file) {}

  /// The next entity; the end of a section is returned without groups. Nothing where the file ends
  /// early.
  std::optional<DxfEntity> next();
  int line() const { return file_.line(); }
  DxfFault& fault() { return file_.fault(); }

  static bool is_end(const DxfEntity& e) {
    return e.name == "ENDSEC" || e.name == "EOF" || e.name == "SECTION";
  }

 private:
  DxfGroups& file_;
  std::optional<DxfEntity> begun_;
};

/// A text in capitals: names of blocks and layers are case-insensitive.
std::string in_capitals(std::string_view text);

/// A handle, by which objects refer to each other: a hexadecimal number, without leading zeros.
std::string dxf_handle(std::string_view text);

/// Reads a text that is an integer as a whole.
std::optional<int> whole_number(std::string_view text);

}  // namespace edda
