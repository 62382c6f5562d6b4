// Values to colours, and the legend that says which.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/layout.hpp"
#include "report/shown_field.hpp"

namespace edda {

class ColourScale {
 public:
  /// `counted[c]`: whether value c takes part in the range (held blocks do not).
  ColourScale(const ShownField& field, const std::vector<bool>& counted);
  Colour of(double value) const;
  /// A bar with ticks, unit and name at the right of the drawing; entries by name for kinds.
  void draw_legend(Canvas& canvas, const Layout& layout, const ShownField& field,
                   const std::vector<std::string>& kind_names) const;
  bool has_legend() const { return kind_ != ScaleKind::plain && !many_kinds_; }

 private:
  void draw_bar(Canvas& canvas, const Layout& layout, const ShownField& field) const;
  ScaleKind kind_;
  bool two_sided_ = false, many_kinds_ = false;
  double low_ = 0.0, high_ = 0.0;
  std::vector<std::size_t> kinds_;  ///< that occur
};

}  // namespace edda
