// What the names in a stage stand for, and what acts before any stage names it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace edda {

/// Rows of the lists of a model.
struct NamedRows {
  std::vector<Index> loads, waters, boundaries, shakings;
  bool empty() const {
    return loads.empty() && waters.empty() && boundaries.empty() && shakings.empty();
  }
};

/// All that have one of these names.
NamedRows rows_called(const Model& model, const std::vector<std::string>& names);

/// Rows among Model::bolts and, behind them, the bolts of the patterns in their order.
std::vector<Index> bolts_called(const Model& model, const std::vector<std::string>& names);

/// Whether what has this name acts from the start of the run: unless a stage behind the first
/// activates it before any deactivates it. Without a name it does.
bool acts_at_first(const Model& model, const std::string& name);

/// Whether bolts of this name are there from the start of the run: unless a stage installs them.
bool installed_at_first(const Model& model, const std::string& name);

/// Row of the stage that has this name or number.
std::optional<std::size_t> stage_called(const Model& model, const std::string& name);

}  // namespace edda
