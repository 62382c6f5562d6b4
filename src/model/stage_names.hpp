// The elements that the names in a stage refer to, and which of them act before any stage names
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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

/// All elements with one of these names.
NamedRows rows_called(const Model& model, const std::vector<std::string>& names);

/// Rows in Model::bolts, followed by the bolts of the patterns in their order.
std::vector<Index> bolts_called(const Model& model, const std::vector<std::string>& names);

/// Rows in Model::linings.
std::vector<Index> linings_called(const Model& model, const std::vector<std::string>& names);

/// Whether the element of this name acts from the start of the run. It does unless a stage after
/// the first activates it before any deactivates it. An element without a name does.
bool acts_at_first(const Model& model, const std::string& name);

/// [stages_of()] Whether the element of this name acts.
std::vector<bool> acts_in_stages(const Model& model, const std::string& name);

/// Whether bolts or linings of this name are there from the start of the run, which holds unless a
/// stage installs them.
bool installed_at_first(const Model& model, const std::string& name);

/// Whether a stage gives the water in joints a time to flow.
bool flow_takes_time(const Model& model);

/// The first stage that installs it.
std::optional<std::size_t> installed_in(const Model& model, const std::string& name);

/// Rows in Model::fills.
std::vector<Index> fills_called(const Model& model, const std::vector<std::string>& names);
/// The stage that places the fill of this name, and that which excavates it or an opening.
std::optional<std::size_t> placed_in(const Model& model, const std::string& name);
std::optional<std::size_t> excavated_in(const Model& model, const std::string& name);

/// Owners of forces that are released: first the rows of Model::openings, then the boundaries that
/// took over, then fills that are excavated, then the weights of fills, which something else
/// carries until they are placed.
struct Owners {
  explicit Owners(const Model& model)
      : openings(static_cast<Index>(model.openings.size())),
        boundaries(static_cast<Index>(model.boundaries.size())),
        fills(static_cast<Index>(model.fills.size())) {}
  Index of_boundary(Index row) const { return openings + row; }
  Index of_fill(Index row) const { return openings + boundaries + row; }
  Index of_weight(Index row) const { return openings + boundaries + fills + row; }
  /// Those of wall forces, and all.
  Index of_walls() const { return openings + boundaries + fills; }
  Index all() const { return of_walls() + fills; }
  Index openings, boundaries, fills;
};

/// The linings that are there when this stage (0: the first) begins, by row.
std::vector<std::uint8_t> linings_before(const Model& model, std::size_t stage);

/// Row of the stage that has this name or number.
std::optional<std::size_t> stage_called(const Model& model, const std::string& name);

/// The stages of the model; a model without [[stage]] has one, until solver.duration.
std::vector<Stage> stages_of(const Model& model);

/// "time", "equilibrium" or "collapse".
std::string_view stage_end_name(StageEnd end);

/// "stage 2 (heading)".
std::string stage_label(const Model& model, std::size_t stage);

}  // namespace edda
