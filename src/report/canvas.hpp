// A drawing that is written as a PNG, SVG or PDF file. Lengths are points (1/72 inch), y down.
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>

#include "base/vec2.hpp"
#include "report/colours.hpp"
#include "results/files.hpp"

namespace edda {

enum class Align { left, centre, right };

/// How a line of text is set.
struct TextStyle {
  double size = 8.0;  ///< pt
  Align align = Align::left;
  bool bold = false;
  bool halo = false;     ///< white around it, where it lies on a drawing
  bool upwards = false;  ///< rotated by a quarter turn, reading upwards
};

inline constexpr double rule = 0.5;  ///< width of frames, ticks and grids, pt

class Canvas {
 public:
  /// White, `width` x `height` pt. The extension of `path` gives the format: .svg, .pdf, else PNG
  /// with `pixels_per_point`.
  Canvas(std::string path, double width, double height, double pixels_per_point);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  cairo_t* cr() { return cr_; }
  void colour(Colour c, double alpha = 1.0);
  /// Baseline at `at`. Stays text in SVG and PDF.
  void text(const std::string& text, Vec2 at, const TextStyle& style);
  double text_width(const std::string& text, double size, bool bold = false);
  void line(Vec2 a, Vec2 b, double width);
  /// A shaft and a head of the same colour; nothing where it is too short to see.
  void arrow(Vec2 from, Vec2 to, double width);
  /// Until the next cairo_restore().
  void clip(Vec2 low, Vec2 high);

  /// Writes the file.
  Trouble finish();

 private:
  enum class Format { png, svg, pdf };
  static cairo_status_t take(void* self, const unsigned char* data, unsigned int size);
  cairo_surface_t* surface_for(double width, double height, double pixels_per_point);
  cairo_status_t end();  ///< the first error
  void svg_text(const std::string& text, Vec2 at, const TextStyle& style);
  std::string path_, bytes_;
  std::string svg_texts_;  ///< kept as texts, since cairo would make outlines of them
  Format format_;
  Colour colour_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* cr_ = nullptr;
};

/// As text of SVG and HTML.
std::string xml_escaped(const std::string& text);

/// A number as it is printed: with a minus sign, not a hyphen.
std::string typeset(std::string_view number);

}  // namespace edda
