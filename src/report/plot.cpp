#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/text.hpp"
#include "report/canvas.hpp"
#include "report/faces.hpp"
#include "report/legend.hpp"
#include "report/scene.hpp"

namespace edda {
namespace {

/// The quantities that the layers draw as lines, with one scale for all drawings.
struct Scales {
  ArrowScale vectors, forces, pressures, stresses, bolts, linings;
};

Scales scales_of(const std::vector<PlotScene>& scenes, const PlotOptions& options) {
  Scales scales;
  if (!options.vectors.empty()) scales.vectors = vector_scale(scenes, options);
  if (options.forces) {
    scales.forces = force_scale(scenes);
    scales.pressures = pressure_scale(scenes, options);
  }
  if (options.principal) scales.stresses = stress_scale(scenes, options.least_stress);
  if (options.bolt_forces) scales.bolts = bolt_scale(scenes);
  if (!options.lining.empty()) scales.linings = lining_scale(scenes);
  return scales;
}

bool any_yielded(std::span<const Snapshot> shots) {
  return std::any_of(shots.begin(), shots.end(), [](const Snapshot& shot) {
    return shot.bolts && std::any_of(shot.bolts->begin(), shot.bolts->end(), [](const auto& bolt) {
             return bolt.yielded || bolt.ruptured;
           });
  });
}

/// The same scale with a reference short enough for the legend.
ArrowScale for_legend(ArrowScale scale, double longest) {
  if (scale.per_unit > 0.0)
    scale.reference = std::min(scale.reference, round_below(longest / scale.per_unit));
  return scale;
}

using Sign = LegendKey::Sign;

/// The kinds of lines, where the frames give them.
void add_pressures(std::vector<LegendKey>& keys, std::span<const Snapshot> shots,
                   const ArrowScale& scale) {
  bool any = false, any_tension = false;
  for (const Snapshot& shot : shots) {
    if (!shot.contacts) continue;
    for (const DrawnFace& face : drawn_faces(*shot.contacts)) {
      any = true;
      any_tension = any_tension || (!face.open && std::min(face.pressure_a, face.pressure_b) < 0.0);
    }
  }
  if (any) keys.push_back({Sign::pressure, "pressure on joints", "Pa", scale, any_tension});
}

std::vector<LegendKey> keys_of(std::span<const Snapshot> shots, const PlotOptions& options,
                               const Scales& scales) {
  const double longest = 4.5 * options.paper.font;
  std::vector<LegendKey> keys;
  if (!options.vectors.empty()) {
    keys.push_back({Sign::vector, options.vectors, options.vectors == "velocity" ? "m/s" : "m",
                    for_legend(scales.vectors, longest)});
  }
  if (options.forces) {
    keys.push_back({Sign::force, "contact force", "N", for_legend(scales.forces, longest)});
    add_pressures(keys, shots, for_legend(scales.pressures, longest));
  }
  if (options.principal) {
    // Each arm of a cross goes either way from the centre.
    ArrowScale whole = scales.stresses;
    whole.per_unit *= 2.0;
    keys.push_back({Sign::stress, "principal stress", "Pa", for_legend(whole, longest)});
  }
  if (!options.joints.empty()) keys.push_back({Sign::joint, "joints", "", {}});
  if (options.cracks) keys.push_back({Sign::cracks, "broken joints", "", {}, true});
  if (options.bolt_forces) {
    keys.push_back({Sign::bolt_load, "force of bolts", "N", scales.bolts, any_yielded(shots)});
  } else if (any_yielded(shots)) {
    keys.push_back({Sign::bolt, "bolts", "", {}, true});
  }
  if (!options.lining.empty()) {
    const char* unit = options.lining == "moment"        ? "N m"
                       : options.lining == "utilisation" ? ""
                                                         : "N";
    keys.push_back(
        {Sign::diagram, options.lining + " of linings", unit, for_legend(scales.linings, longest)});
  }
  return keys;
}

/// Whether a block has moved by more than the model was large at the start: it falls without end.
std::vector<std::uint8_t> gone_blocks(const PlotScene& s) {
  const std::vector<Vec2> first = drawn_points(s.grid(), 0.0), now = drawn_points(s.grid(), 1.0);
  const Box box = box_around(first);
  const double size = std::max(box.width(), box.height());
  std::vector<std::uint8_t> gone;
  for (const BlockShape& shape : s.shapes) {
    const auto p = static_cast<std::size_t>(s.grid().corners[s.grid().begin(shape.first_cell)]);
    gone.push_back(norm(now[p] - first[p]) > size ? 1 : 0);
  }
  return gone;
}

/// The visible range: the window, or everything in any of the drawings, without the fewer than half
/// of the blocks that have gone far away.
struct World {
  Box box;
  std::size_t gone = 0;  ///< blocks that have left it
};

World world_of(const std::vector<PlotScene>& scenes, const PlotOptions& options) {
  if (options.window) return {*options.window, 0};
  World world;
  std::vector<Vec2> points;
  for (const PlotScene& s : scenes) {
    const std::vector<std::uint8_t> gone = gone_blocks(s);
    const auto count = static_cast<std::size_t>(std::count(gone.begin(), gone.end(), 1));
    if (count == 0 || 2 * count >= gone.size()) {
      points.insert(points.end(), s.points.begin(), s.points.end());
      continue;
    }
    world.gone = std::max(world.gone, count);
    for (std::size_t i = 0; i < gone.size(); ++i) {
      if (gone[i] != 0) continue;
      for (const auto& edge : s.shapes[i].outline)
        points.push_back(s.points[static_cast<std::size_t>(edge.first)]);
    }
  }
  world.box = box_around(points);
  return world;
}

struct Titles {
  std::vector<std::string> title, subtitle;  ///< lines
  bool headings = false;                     ///< one above each drawing
  double height(double font) const {
    return font * (1.0 + 1.5 * static_cast<double>(title.size()) +
                   1.3 * static_cast<double>(subtitle.size()) + (headings ? 1.6 : 0.0));
  }
};

Titles titles_of(std::span<const Snapshot> shots, const PlotOptions& options, std::size_t gone) {
  const double room = options.paper.width - 2.0 * options.paper.font;
  Canvas measure("", 1.0, 1.0, 1.0);
  std::string subtitle = options.subtitle;
  if (options.scale != 1.0) {
    subtitle += fmt::format("{}displacements drawn {:.4g} times", subtitle.empty() ? "" : "; ",
                            options.scale);
  }
  if (gone > 0) {
    subtitle += fmt::format("{}{} far beyond the picture", subtitle.empty() ? "" : "; ",
                            counted(gone, "block"));
  }
  Titles t;
  t.headings = shots.size() > 1;
  if (!options.title.empty()) {
    t.title = wrapped(measure, options.title, 1.2 * options.paper.font, room, true);
  }
  if (!subtitle.empty()) t.subtitle = wrapped(measure, subtitle, options.paper.font, room);
  return t;
}

void draw_titles(Canvas& canvas, const Layout& l, const Titles& titles) {
  const double f = l.font;
  double y = 0.5 * f;
  canvas.colour(ink::line);
  for (const std::string& line : titles.title) {
    y += 1.5 * f;
    canvas.text(line, {0.5 * l.width, y}, {.size = 1.2 * f, .align = Align::centre, .bold = true});
  }
  for (const std::string& line : titles.subtitle) {
    y += 1.3 * f;
    canvas.text(line, {0.5 * l.width, y}, {.size = f, .align = Align::centre});
  }
}

void draw_scene(Canvas& canvas, const PlotScene& s, const PlotOptions& options,
                const ColourScale& colours, const Scales& scales) {
  cairo_save(canvas.cr());
  canvas.clip(s.view.frame.low, s.view.frame.high);
  draw_blocks(canvas, s, colours, options.outlines);
  draw_contact_field(canvas, s, colours);
  draw_joints(canvas, s, options);
  if (options.cracks) draw_cracks(canvas, s);
  if (options.principal) draw_stresses(canvas, s, scales.stresses);
  if (!options.vectors.empty()) draw_vectors(canvas, s, options.vectors, scales.vectors);
  if (options.forces) {
    draw_pressures(canvas, s, scales.pressures);
    draw_forces(canvas, s, scales.forces);
  }
  if (!options.lining.empty()) draw_linings(canvas, s, scales.linings);
  draw_bolts(canvas, s, options, scales.bolts);
  if (options.marks) draw_marks(canvas, s, options);
  cairo_restore(canvas.cr());
}

/// Whether it has a size, as it has not where the world is next to a point.
bool is_sound(const Layout& l) {
  const View& view = l.views.front();
  return std::isfinite(l.width) && std::isfinite(l.height) && std::isfinite(view.scale) &&
         view.scale > 0.0 && view.world.low.x < view.world.high.x &&
         view.world.low.y < view.world.high.y;
}

/// One page; the size of its drawings determines the size of the page.
class Page {
 public:
  Page(std::span<const Snapshot> shots, const PlotOptions& options)
      : shots_(shots), options_(options), colours_(shots, options.range, options.whole_range) {
    for (const Snapshot& shot : shots) scenes_.push_back(make_scene(shot, options.scale));
  }

  Trouble draw(const std::string& path) {
    const double f = options_.paper.font;
    const auto [world, gone] = world_of(scenes_, options_);
    const Titles titles = titles_of(shots_, options_, gone);
    Surroundings room{scenes_.size(), axis_room(world, f) + 0.8 * f, titles.height(f)};
    // Lengths of arrows follow from the size of the drawings, the legend's height from what it
    // lists: laid out once without the lengths, then with the legend.
    make_room(legend_with({}), world, room);
    const Layout layout = lay_out(world, options_.paper, room);
    if (!is_sound(layout))
      return Fault{{{}, path, 0, 0}, "would have no size", "show another part of the model"};
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
      scenes_[k].view = layout.views[k];
      scenes_[k].font = f;
    }
    const Scales scales = scales_of(scenes_, options_);
    Canvas canvas(path, layout.width, layout.height, options_.paper.pixels_per_point);
    for (const PlotScene& s : scenes_) draw_scene(canvas, s, options_, colours_, scales);
    for (std::size_t k = 0; k < scenes_.size(); ++k) draw_surroundings(canvas, k, layout);
    draw_titles(canvas, layout, titles);
    draw_legend(canvas, legend_with(scales), layout, room);
    return canvas.finish();
  }

 private:
  Legend legend_with(const Scales& scales) const {
    const ShownField& field = shots_.front().field;
    const std::vector<std::string> states(contact_states.begin(), contact_states.end());
    return {colours_, field, field.of_contacts ? states : options_.materials,
            keys_of(shots_, options_, scales), options_.paper.font};
  }

  void make_room(const Legend& legend, const Box& world, Surroundings& room) const {
    constexpr double narrow = 40.0;  // sizes of the font
    if (legend.is_empty()) return;
    if (options_.paper.width >= narrow * options_.paper.font) {
      room.legend_width = legend.width();
      room.legend_height = legend.height();
    } else {
      room.legend_below = legend.height_below(lay_out(world, options_.paper, room).below);
    }
  }

  static void draw_legend(Canvas& canvas, const Legend& legend, const Layout& layout,
                          const Surroundings& room) {
    if (legend.is_empty()) return;
    if (room.legend_below > 0.0)
      return legend.draw_below(canvas, layout.legend.x, layout.legend.y, layout.below);
    legend.draw(canvas, layout.legend.x, layout.legend.y,
                std::max(layout.views.front().frame.high.y, layout.legend.y + room.legend_height));
  }

  void draw_surroundings(Canvas& canvas, std::size_t k, const Layout& layout) const {
    const View& view = layout.views[k];
    draw_axes(canvas, view, layout.font, k == 0);
    if (shots_.size() == 1) return;
    canvas.text(
        shots_[k].heading,
        {0.5 * (view.frame.low.x + view.frame.high.x), view.frame.low.y - 0.6 * layout.font},
        {.size = layout.font, .align = Align::centre});
  }

  std::span<const Snapshot> shots_;
  const PlotOptions& options_;
  ColourScale colours_;
  std::vector<PlotScene> scenes_;
};

}  // namespace

Trouble check_window(std::span<const Snapshot> shots, const PlotOptions& options) {
  if (!options.window) return {};
  std::vector<Vec2> points;
  for (const Snapshot& shot : shots) {
    const std::vector<Vec2> drawn = drawn_points(shot.blocks, options.scale);
    points.insert(points.end(), drawn.begin(), drawn.end());
  }
  const Box &w = *options.window, all = box_around(points);
  constexpr double most = 1e6;  // largest ratio of window to model, either way
  const double size = std::max(all.width(), all.height());
  const char* problem =
      !(std::min(w.width(), w.height()) * most >= size)   ? "is tiny beside the model"
      : !(std::max(w.width(), w.height()) <= most * size) ? "is huge beside the model"
      : w.high.x < all.low.x || w.low.x > all.high.x || w.high.y < all.low.y || w.low.y > all.high.y
          ? "lies beyond the model"
          : nullptr;
  if (problem == nullptr) return {};
  return Fault{{"--window", {}, 0, 0},
               problem,
               fmt::format("give a part of {:.4g},{:.4g},{:.4g},{:.4g}, where the blocks are",
                           all.low.x, all.low.y, all.high.x, all.high.y)};
}

Trouble plot(std::span<const Snapshot> shots, const PlotOptions& options, const std::string& path) {
  return Page(shots, options).draw(path);
}

}  // namespace edda
