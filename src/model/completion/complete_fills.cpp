// [[fill]]: where it is.
#include <algorithm>

#include "model/completion/complete_tools.hpp"
#include "model/stage_names.hpp"

namespace edda {
void complete_fills(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  for (std::size_t i = 0; i < model.fills.size(); ++i) {
    const Fill& fill = model.fills[i];
    const Value* node = element(root, "fill", i);
    if (!is_table(node)) continue;
    const std::string& path = fill.where.key;
    one_of(node, path, "opening", "polygon", "opening = \"NAME\"", reading);
    check_opening(node, path, fill.opening, reading);
    const bool is_opening = std::any_of(model.openings.begin(), model.openings.end(),
                                        [&](const Opening& o) { return o.name == fill.name; });
    if (is_opening && !fill.name.empty()) {
      add_fault(reading, place_of(node, "name"), path + ".name", "is the name of an opening, too",
                "give each its own name: stages excavate both");
    }
    if (!fill.name.empty() && !placed_in(model, fill.name)) {
      add_fault(reading, node->place, path, "no stage places it",
                "name it in fill of the stage at whose start it comes");
    }
    if (model.solver.method == Method::dda) {
      add_fault(reading, node->place, path, "fill is not available with method = \"dda\"",
                implicit_remedy);
    } else if (model.contact.model == ContactModel::points) {
      add_fault(reading, node->place, path, "fill is not available with contact.model = \"points\"",
                "leave out contact.model = \"points\"");
    }
  }
}

}  // namespace edda
