// What a drawing says about its layers and about the clipping of inserted blocks.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "imports/dxf_groups.hpp"

namespace edda {

class DxfTables {
 public:
  /// `shown`: layers that are read even if they are off or frozen.
  explicit DxfTables(const std::vector<std::string>& shown);

  /// Reads a section of tables, for the layers.
  void read_layers(DxfSection& section);
  /// Reads a section of objects: a SPATIAL_FILTER in the dictionaries of an INSERT clips it
  /// (XCLIP).
  void read_objects(DxfSection& section);

  bool hidden(const std::string& layer) const;  ///< off or frozen
  bool frozen(const std::string& layer) const;
  bool clips(const std::string& dictionary) const;

 private:
  std::set<std::string> shown_, off_, frozen_;            ///< in capitals
  std::set<std::string> filters_;                         ///< handles of those that clip
  std::map<std::string, std::set<std::string>> entries_;  ///< of each dictionary
};

}  // namespace edda
