#include "report/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/utf8.hpp"

namespace edda {
namespace {

constexpr double quarter_turn = 1.5707963267948966;

bool ends_in(const std::string& path, std::string_view lower, std::string_view upper) {
  return path.ends_with(lower) || path.ends_with(upper);
}

const char* anchor_name(Align align) {
  return align == Align::left ? "start" : align == Align::right ? "end" : "middle";
}

std::string hex(Colour c) {
  const auto part = [](double v) { return static_cast<int>(std::lround(255.0 * v)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(c.r), part(c.g), part(c.b));
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      default:
        xml += c;
    }
  }
  return xml;
}

Canvas::Canvas(std::string path, double width, double height, double pixels_per_point)
    : path_(std::move(path)),
      format_(ends_in(path_, ".svg", ".SVG")   ? Format::svg
              : ends_in(path_, ".pdf", ".PDF") ? Format::pdf
                                               : Format::png),
      surface_(surface_for(width, height, pixels_per_point)),
      cr_(cairo_create(surface_)) {
  cairo_set_source_rgb(cr_, 1.0, 1.0, 1.0);
  cairo_paint(cr_);
  if (format_ == Format::png) cairo_scale(cr_, pixels_per_point, pixels_per_point);
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  // The same widths of text whatever the resolution.
  cairo_font_options_t* fonts = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(fonts, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(fonts, CAIRO_HINT_STYLE_NONE);
  cairo_set_font_options(cr_, fonts);
  cairo_font_options_destroy(fonts);
}

cairo_surface_t* Canvas::surface_for(double width, double height, double pixels_per_point) {
  if (format_ == Format::svg) {
    cairo_surface_t* svg = cairo_svg_surface_create_for_stream(&Canvas::take, this, width, height);
    cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
    return svg;
  }
  if (format_ == Format::pdf) {
    return cairo_pdf_surface_create_for_stream(&Canvas::take, this, width, height);
  }
  const auto pixels = [&](double points) {
    return static_cast<int>(std::lround(points * pixels_per_point));
  };
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height));
}

Canvas::~Canvas() {
  cairo_destroy(cr_);
  cairo_surface_destroy(surface_);
}

cairo_status_t Canvas::take(void* self, const unsigned char* data, unsigned int size) {
  static_cast<Canvas*>(self)->bytes_.append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void Canvas::colour(Colour c, double alpha) {
  colour_ = c;
  cairo_set_source_rgba(cr_, c.r, c.g, c.b, alpha);
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
  cairo_select_font_face(cr_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr_, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cr_, printable(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& any_text, Vec2 at, const TextStyle& style) {
  // Cairo draws nothing more once it has met a text that is not UTF-8.
  const std::string text = printable(any_text);
  if (format_ == Format::svg) return svg_text(text, at, style);
  const double width = text_width(text, style.size, style.bold);
  const double shift = style.align == Align::left    ? 0.0
                       : style.align == Align::right ? -width
                                                     : -0.5 * width;
  cairo_save(cr_);
  cairo_translate(cr_, at.x, at.y);
  if (style.upwards) cairo_rotate(cr_, -quarter_turn);
  if (style.halo) {
    cairo_move_to(cr_, shift, 0.0);
    cairo_text_path(cr_, text.c_str());
    cairo_set_source_rgba(cr_, 1.0, 1.0, 1.0, 0.9);
    cairo_set_line_width(cr_, 0.3 * style.size);
    cairo_stroke(cr_);
    colour(colour_);
  }
  cairo_move_to(cr_, shift, 0.0);
  cairo_show_text(cr_, text.c_str());
  cairo_new_path(cr_);
  cairo_restore(cr_);
}

void Canvas::svg_text(const std::string& text, Vec2 at, const TextStyle& style) {
  const std::string place =
      style.upwards ? fmt::format("transform=\"translate({:.2f} {:.2f}) rotate(-90)\"", at.x, at.y)
                    : fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", at.x, at.y);
  const std::string halo = style.halo ? fmt::format(
                                            " stroke=\"#ffffff\" stroke-width=\"{:.2f}\" "
                                            "stroke-linejoin=\"round\" paint-order=\"stroke\"",
                                            0.3 * style.size)
                                      : "";
  svg_texts_ += fmt::format(
      "<text {} font-family=\"sans-serif\" font-size=\"{:.2f}\" font-weight=\"{}\" "
      "text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n",
      place, style.size, style.bold ? "bold" : "normal", anchor_name(style.align), hex(colour_),
      halo, xml_escaped(text));
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
  if (length < 0.3) return;
  const double head = std::min(0.5 * length, 5.0 * width);
  const Vec2 t = along / length, n = perp(t), base = to - head * t;
  line(from, base, width);
  const Vec2 left = base + 0.4 * head * n, right = base - 0.4 * head * n;
  cairo_move_to(cr_, to.x, to.y);
  cairo_line_to(cr_, left.x, left.y);
  cairo_line_to(cr_, right.x, right.y);
  cairo_close_path(cr_);
  cairo_fill(cr_);
}

void Canvas::clip(Vec2 low, Vec2 high) {
  cairo_rectangle(cr_, low.x, low.y, high.x - low.x, high.y - low.y);
  cairo_clip(cr_);
}

cairo_status_t Canvas::end() {
  if (const cairo_status_t drawing = cairo_status(cr_)) return drawing;
  cairo_surface_flush(surface_);
  if (format_ == Format::png) {
    const cairo_status_t packing = cairo_surface_write_to_png_stream(surface_, &Canvas::take, this);
    if (packing != CAIRO_STATUS_SUCCESS) return packing;
  } else {
    cairo_surface_finish(surface_);
  }
  return cairo_surface_status(surface_);
}

Trouble Canvas::finish() {
  if (const cairo_status_t status = end(); status != CAIRO_STATUS_SUCCESS) {
    Fault fault;
    fault.where.file = path_;
    fault.problem = std::string("cannot be drawn (") + cairo_status_to_string(status) + ")";
    fault.remedy = "make it smaller: --width, --dpi";
    return fault;
  }
  if (format_ == Format::svg) {
    if (const std::size_t end = bytes_.rfind("</svg>"); end != std::string::npos) {
      bytes_.insert(end, svg_texts_);
    }
  }
  return write_file(path_, bytes_);
}

std::string typeset(std::string_view number) {
  std::string text;
  for (const char c : number) {
    if (c == '-') {
      text += "\u2212";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace edda
