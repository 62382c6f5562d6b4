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

  const DxfGroup* find(int code) const;  ///< the first one; null without any
};

/// The first fault in a drawing, or in a block of it.
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

/// Pairs of lines, one at a time.
class DxfGroups {
 public:
  DxfGroups(std::string_view text, DxfFault& fault) : rest_(text), fault_(fault) {}

  /// The next pair; nothing at the end of the file, or where a fault has been found.
  std::optional<DxfGroup> next();
  int line() const { return line_; }  ///< number of the last line read
  DxfFault& fault() { return fault_; }

 private:
  std::string_view take();

  std::string_view rest_;
  int line_ = 0;
  bool code_is_last_ = false;
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

/// Reads a text that is an integer as a whole.
std::optional<int> whole_number(std::string_view text);

}  // namespace edda
