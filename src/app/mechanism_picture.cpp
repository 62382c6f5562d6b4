#include "app/mechanism_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/common.hpp"
#include "observe/observe.hpp"
#include "report/plot.hpp"
#include "report/shapes.hpp"
#include "results/frames.hpp"

namespace edda {
namespace {

/// 1, 2 or 5 times a power of ten, not above x; at least 1.
double round_scale(double x) {
  if (!(x > 1.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

/// Of the zones where there are any, which move apart as blocks do: root of the mean area, m.
double zone_size(const Grid& blocks) {
  const std::vector<double> areas = cell_areas(blocks);
  return std::sqrt(std::accumulate(areas.begin(), areas.end(), 0.0) /
                   static_cast<double>(areas.size()));
}

}  // namespace

Trouble draw_in_both_forms(const Snapshot& shot, const PlotOptions& options,
                           const std::string& folder, const char* name) {
  for (const char* ending : {".png", ".svg"}) {
    if (Trouble trouble = plot({&shot, 1}, options, folder + "/" + name + ending)) return trouble;
  }
  return {};
}

Trouble draw_mechanism(const Model& model, const Simulation& moved, const Mechanism& mechanism,
                       double size, const std::string& subtitle, const std::string& folder,
                       const char* name) {
  Instant instant;
  observe(moved, instant);
  Snapshot shot{block_grid(block_cells(moved.scene->blocks), picture_of(moved, instant))};
  const Result<ShownField> field = shown_field("displacement", shot.blocks, nullptr);
  if (!field.ok()) return field.faults().front();
  shot.field = field.value();
  double largest = 0.0;
  for (const MovingBlock& b : mechanism.blocks) largest = std::max(largest, b.largest);
  PlotOptions options = options_of(model, moved.scene->blocks.size());
  options.subtitle = subtitle;
  constexpr double shown = 0.5;  // of a block's or a zone's size
  if (moved.scene->blocks.meshes.any()) size = std::min(size, zone_size(shot.blocks));
  options.scale = round_scale(shown * size / largest);
  options.vectors = "displacement";
  options.whole_range = true;  // a small moving part is what the picture is to show
  for (const MovingJoint& j : mechanism.joints) {
    for (const Stretch& s : j.stretches)
      options.joints.push_back(
          {s.from + options.scale * s.from_moved, s.to + options.scale * s.to_moved});
  }
  return draw_in_both_forms(shot, options, folder, name);
}

Trouble draw_thrust(const Model& model, const Simulation& drawn,
                    const std::vector<ContactRecord>& forces, const std::string& subtitle,
                    const std::string& folder) {
  Instant instant;
  observe(drawn, instant);
  Picture picture = picture_of(drawn, instant);
  picture.contacts = forces;
  Snapshot shot{block_grid(block_cells(drawn.scene->blocks), picture)};
  shot.contacts = grid_of(contact_source(picture));
  // Limit analysis knows no pressures, of which a picture draws diagrams.
  std::erase_if(shot.contacts->cell_fields,
                [](const Field& field) { return field.name == "closed_length"; });
  const Result<ShownField> field = shown_field("material", shot.blocks, nullptr);
  if (!field.ok()) return field.faults().front();
  shot.field = field.value();
  PlotOptions options = options_of(model, drawn.scene->blocks.size());
  options.subtitle = subtitle;
  options.forces = true;
  return draw_in_both_forms(shot, options, folder, "thrust");
}

}  // namespace edda
