// Pictures in SVG read back: texts, paths and their colours.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "report/colours.hpp"

namespace edda {

/// What stands between the quotes after ` name="` in an element; empty where it is not there.
inline std::string attribute(const std::string& element, const std::string& name) {
  const std::string key = " " + name + "=\"";
  const std::size_t at = element.find(key);
  if (at == std::string::npos) return {};
  const std::size_t from = at + key.size();
  return element.substr(from, element.find('"', from) - from);
}

/// All elements of a name, from "<name" to ">".
inline std::vector<std::string> elements(const std::string& svg, const std::string& name) {
  std::vector<std::string> found;
  const std::string open = "<" + name + " ";
  for (std::size_t at = svg.find(open); at != std::string::npos; at = svg.find(open, at + 1)) {
    found.push_back(svg.substr(at, svg.find('>', at) + 1 - at));
  }
  return found;
}

/// Where that text stands, in the order drawn.
inline std::vector<Vec2> all_texts(const std::string& svg, const std::string& text) {
  std::vector<Vec2> places;
  const std::string end = ">" + text + "</text>";
  for (std::size_t at = svg.find(end); at != std::string::npos; at = svg.find(end, at + 1)) {
    const std::size_t open = svg.rfind("<text ", at);
    const std::string element = svg.substr(open, at - open);
    places.push_back(
        {std::atof(attribute(element, "x").c_str()), std::atof(attribute(element, "y").c_str())});
  }
  return places;
}

inline std::optional<Vec2> text_of(const std::string& svg, const std::string& text) {
  const std::vector<Vec2> places = all_texts(svg, text);
  return places.empty() ? std::nullopt : std::optional<Vec2>(places.front());
}

/// A property of a path such as "fill" or "stroke-width": cairo 1.16 writes them in one attribute
/// style, 1.18 as attributes of their own. Empty where it has none.
inline std::string property(const std::string& path, const std::string& what) {
  if (const std::string own = attribute(path, what); !own.empty()) return own;
  const std::string style = ";" + attribute(path, "style") + ";", key = ";" + what + ":";
  const std::size_t at = style.find(key);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + key.size();
  return style.substr(begin, style.find(';', begin) - begin);
}

/// A colour of a path: `what` is "fill" or "stroke".
inline std::optional<Colour> colour_of(const std::string& path, const std::string& what) {
  Colour c;
  if (std::sscanf(property(path, what).c_str(), "rgb(%lf%%, %lf%%, %lf%%", &c.r, &c.g, &c.b) != 3)
    return {};
  return Colour{c.r / 100.0, c.g / 100.0, c.b / 100.0};
}

inline bool looks_like(Colour a, Colour b) {
  return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b) < 1e-3;
}

/// Fills of the first paths that are filled: the blocks, which are drawn first.
inline std::vector<Colour> block_fills(const std::string& svg, std::size_t count) {
  std::vector<Colour> fills;
  for (const std::string& path : elements(svg, "path")) {
    if (property(path, "fill-rule") != "evenodd") continue;
    if (const auto fill = colour_of(path, "fill"); fill && fills.size() < count)
      fills.push_back(*fill);
  }
  return fills;
}

/// The paths drawn as lines of a colour.
inline std::vector<std::string> stroked(const std::string& svg, Colour colour) {
  std::vector<std::string> found;
  for (const std::string& path : elements(svg, "path")) {
    const auto stroke = colour_of(path, "stroke");
    if (stroke && looks_like(*stroke, colour)) found.push_back(path);
  }
  return found;
}

inline std::vector<double> stroke_widths(const std::string& svg, Colour colour) {
  std::vector<double> widths;
  for (const std::string& path : stroked(svg, colour)) {
    widths.push_back(std::atof(property(path, "stroke-width").c_str()));
  }
  return widths;
}

/// The points of a path, also those that only steer a curve.
inline std::vector<Vec2> points_of(const std::string& path) {
  std::vector<double> numbers;
  const std::string d = attribute(path, "d");
  for (const char* at = d.c_str(); *at != '\0';) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      numbers.push_back(value);
      at = end;
    }
  }
  std::vector<Vec2> points;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
    points.push_back({numbers[k], numbers[k + 1]});
  }
  return points;
}

/// Of the page, pt.
inline Vec2 size_of_svg(const std::string& svg) {
  const std::string root = elements(svg, "svg").front();
  return {std::atof(attribute(root, "width").c_str()),
          std::atof(attribute(root, "height").c_str())};
}

}  // namespace edda
