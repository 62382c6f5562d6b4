#include "report/canvas.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>

namespace edda {

Canvas::Canvas(std::string path, double width, double height)
    : path_(std::move(path)),
      svg_(path_.ends_with(".svg") || path_.ends_with(".SVG")),
      surface_(svg_ ? cairo_svg_surface_create_for_stream(&Canvas::take, this, width, height)
                    : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                                 static_cast<int>(height))) {
  if (svg_) cairo_svg_surface_set_document_unit(surface_, CAIRO_SVG_UNIT_PX);
  cr_ = cairo_create(surface_);
  cairo_set_source_rgb(cr_, 1.0, 1.0, 1.0);
  cairo_paint(cr_);
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
}

Canvas::~Canvas() {
  cairo_destroy(cr_);
  cairo_surface_destroy(surface_);
}

cairo_status_t Canvas::take(void* self, const unsigned char* data, unsigned int size) {
  static_cast<Canvas*>(self)->bytes_.append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
  cairo_select_font_face(cr_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr_, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cr_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& text, Vec2 at, double size, Align align, bool bold,
                  bool halo) {
  const double width = text_width(text, size, bold);
  const double x = align == Align::left    ? at.x
                   : align == Align::right ? at.x - width
                                           : at.x - 0.5 * width;
  cairo_move_to(cr_, x, at.y);
  if (halo) {
    cairo_save(cr_);
    cairo_text_path(cr_, text.c_str());
    cairo_set_source_rgba(cr_, 1.0, 1.0, 1.0, 0.9);
    cairo_set_line_width(cr_, 0.3 * size);
    cairo_stroke(cr_);
    cairo_restore(cr_);
    cairo_move_to(cr_, x, at.y);
  }
  cairo_show_text(cr_, text.c_str());
  cairo_new_path(cr_);
}

void Canvas::line(Vec2 a, Vec2 b, double width) {
  cairo_set_line_width(cr_, width);
  cairo_move_to(cr_, a.x, a.y);
  cairo_line_to(cr_, b.x, b.y);
  cairo_stroke(cr_);
}

void Canvas::arrow(Vec2 from, Vec2 to, double width) {
  const Vec2 along = to - from;
  const double length = norm(along);
  if (length < 1.0) return;
  const double head = std::min(0.45 * length, 4.0 * width + 3.0);
  const Vec2 t = along / length, n = perp(t), base = to - head * t;
  line(from, base, width);
  const Vec2 left = base + 0.45 * head * n, right = base - 0.45 * head * n;
  cairo_move_to(cr_, to.x, to.y);
  cairo_line_to(cr_, left.x, left.y);
  cairo_line_to(cr_, right.x, right.y);
  cairo_close_path(cr_);
  cairo_fill(cr_);
}

Trouble Canvas::finish() {
  cairo_surface_flush(surface_);
  if (!svg_) {
    cairo_surface_write_to_png_stream(surface_, &Canvas::take, this);
  } else {
    cairo_surface_finish(surface_);
  }
  if (const cairo_status_t status = cairo_surface_status(surface_);
      status != CAIRO_STATUS_SUCCESS) {
    Fault fault;
    fault.where.file = path_;
    fault.problem = std::string("cannot be drawn (") + cairo_status_to_string(status) + ")";
    return fault;
  }
  return write_file(path_, bytes_);
}

}  // namespace edda
