// The legend at the right of the drawings, or below them on a narrow page: colours with their
// meaning, and the length of an arrow of a round value.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/colour_scale.hpp"
#include "report/scene.hpp"

namespace edda {

/// A sample line with its meaning.
struct LegendKey {
  enum class Sign { vector, force, pressure, stress, bolt, bolt_load, joint, cracks, diagram };
  Sign sign = Sign::vector;
  std::string name;  ///< "velocity"
  std::string unit;  ///< "m/s"
  ArrowScale scale{};
  bool also_red = false;  ///< for bolts: some have yielded; for pressures: some are tensile; of
                          ///< cracks
};

class Legend {
 public:
  Legend(const ColourScale& scale, const ShownField& field, std::vector<std::string> kind_names,
         std::vector<LegendKey> keys, double font);
  bool is_empty() const;
  double width() const;
  /// Least, pt.
  double height() const;
  void draw(Canvas& canvas, double left, double top, double bottom) const;
  /// The same below drawings of this total width, pt.
  double height_below(double width) const;
  void draw_below(Canvas& canvas, double left, double top, double width) const;

 private:
  /// Positions of the keys below, relative to the first.
  struct Rows {
    std::vector<Vec2> places;
    double height = 0.0;
  };
  Rows rows_below(double width) const;
  double colours_height_below(double width) const;
  /// The heading broken into lines of this width, pt.
  std::vector<std::string> heading_below(double width) const;
  void draw_kinds_across(Canvas& canvas, double left, double top, double width) const;
  void draw_bar_across(Canvas& canvas, double left, double top, double width) const;
  void draw_kind(Canvas& canvas, std::size_t kind, Vec2 at) const;
  /// The colours within a box, upwards or to the right, and the points beyond its ends.
  void paint_bar(Canvas& canvas, const Box& bar, bool upwards) const;
  double draw_heading(Canvas& canvas, double left, double top) const;
  void draw_kinds(Canvas& canvas, double left, double top) const;
  void draw_bar(Canvas& canvas, double left, double top, double bottom) const;
  void draw_ticks(Canvas& canvas, double left, const Box& bar, double factor) const;
  double key_height(const LegendKey& key) const;
  void draw_key(Canvas& canvas, const LegendKey& key, double left, double top) const;
  double keys_height() const;
  const ColourScale& scale_;
  const ShownField& field_;
  std::vector<std::string> kind_names_;
  std::vector<LegendKey> keys_;
  double font_;
  double factor_ = 1.0;  ///< of values in the bar's unit
  std::string label_;
  std::vector<std::string> heading_;  ///< lines of it
};

/// Breaks a text into lines no wider than `width` pt.
std::vector<std::string> wrapped(Canvas& canvas, const std::string& text, double size, double width,
                                 bool bold = false);

}  // namespace edda
