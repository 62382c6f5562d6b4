// A cairo drawing that ends as a PNG or SVG file.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "base/vec2.hpp"
#include "report/colours.hpp"
#include "results/files.hpp"

namespace edda {

enum class Align { left, centre, right };

class Canvas {
 public:
  /// Pixels; SVG where `path` ends in .svg, else PNG. White.
  Canvas(std::string path, double width, double height);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  cairo_t* cr() { return cr_; }
  void colour(Colour c, double alpha = 1.0) { cairo_set_source_rgba(cr_, c.r, c.g, c.b, alpha); }
  /// Baseline at y; with a white halo where it lies on a drawing.
  void text(const std::string& text, Vec2 at, double size, Align align, bool bold = false,
            bool halo = false);
  double text_width(const std::string& text, double size, bool bold = false);
  void line(Vec2 a, Vec2 b, double width);
  void arrow(Vec2 from, Vec2 to, double width);

  /// Writes the file.
  Trouble finish();

 private:
  static cairo_status_t take(void* self, const unsigned char* data, unsigned int size);
  std::string path_, bytes_;
  bool svg_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* cr_ = nullptr;
};

}  // namespace edda
