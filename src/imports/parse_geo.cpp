// Geometry files of DDA. As numbers (Shi's own form):
//   least distance of a node from an edge
//   lines, of these boundary lines        number of each
//   material lines, bolts, fixed lines, loading points, measured points, hole points
//   x1 y1 x2 y2 type                      for each line
//   x1 y1 x2 y2 material                  for each material line
//   x1 y1 x2 y2                           for each fixed line
//   x y                                   for each point
// As tags (DDA for Windows): <Joint type="1"> x1 y1 x2 y2 </Joint> in a <Jointlist>, <Line> or
// <Point> in a <Fixedpointlist>; other lists are skipped.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "imports/drawing.hpp"
#include "imports/file_words.hpp"

namespace edda {
namespace {

constexpr const char* expected_numbers =
    "write the numbers as docs/geometry.md describes them, or export the lines as .csv";

/// The numbers of a file, one after the other.
class Numbers {
 public:
  Numbers(std::vector<Word> words, std::string path)
      : words_(std::move(words)), path_(std::move(path)) {}

  bool at_end() const { return next_ == words_.size(); }
  std::size_t left() const { return words_.size() - next_; }
  int line() const {
    if (words_.empty()) return 1;
    return words_[std::min(next_, words_.size() - 1)].line;
  }
  const std::optional<Fault>& fault() const { return fault_; }
  std::string_view word() const { return words_[next_].text; }

  double number(const char* what) {
    if (fault_) return 0.0;
    if (at_end()) return fail("ends before " + std::string(what));
    const auto value = place_number(words_[next_].text);
    if (!value) {
      return fail("has \"" + for_message(words_[next_].text) + "\" in place of " + what);
    }
    ++next_;
    return *value;
  }

  /// Reads the count of the elements that follow, each of `numbers` numbers; it must not exceed
  /// what the file can contain.
  int count(const char* what, std::size_t numbers) {
    const double n = number(what);
    if (fault_) return 0;
    --next_;
    if (n < 0.0 || n != std::floor(n)) {
      return static_cast<int>(fail("has \"" + for_message(word()) + "\" in place of " + what));
    }
    constexpr double most = 1e9;  // for elements without numbers
    if (n > most || n * static_cast<double>(numbers) > static_cast<double>(left())) {
      return static_cast<int>(
          fail(std::string(what) + " is " + for_message(word()) + ", more than the file holds"));
    }
    ++next_;
    return static_cast<int>(n);
  }

  Vec2 point(const char* what) {
    const double x = number(what);
    return {x, number(what)};
  }

  double fail(std::string problem) {
    if (!fault_) fault_ = Fault{{"", path_, line(), 1}, std::move(problem), expected_numbers};
    return 0.0;
  }

 private:
  std::vector<Word> words_;
  std::string path_;
  std::size_t next_ = 0;
  std::optional<Fault> fault_;
};

std::string whole_name(double type) {
  std::string text = std::to_string(type);
  text.erase(text.find('.'));
  return text;
}

void skip(Drawing& drawing, const char* kind, int count) {
  if (count > 0) drawing.skipped[kind] += count;
}

Result<Drawing> parse_numbers(std::string_view text, const std::string& path) {
  Numbers file(words_of(text), path);
  Drawing drawing;
  file.number("the least distance of a node from an edge");
  const int lines = file.count("the number of lines", 5);
  file.count("the number of boundary lines", 0);
  const int materials = file.count("the number of material lines", 5);
  const int bolts = file.count("the number of bolts", 0);
  const int fixed = file.count("the number of fixed lines", 4);
  std::array<int, 3> points{};
  constexpr std::array<const char*, 3> kinds{"loading points", "measured points", "hole points"};
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = file.count(kinds[k], 2);
  if (bolts > 0) file.fail("holds bolts, which are not read");
  for (int i = 0; i < lines && !file.fault(); ++i) {
    const int line = file.line();
    const Vec2 a = file.point("an end of a line"), b = file.point("an end of a line");
    for (const double x : {a.x, a.y, b.x, b.y}) drawing.digits.add(x);
    drawing.lines.push_back({{a, b}, whole_name(file.number("the type of a line")), line});
  }
  for (int i = 0; i < 5 * materials && !file.fault(); ++i) file.number("a material line");
  for (int i = 0; i < fixed && !file.fault(); ++i) {
    const Vec2 a = file.point("a fixed line");
    drawing.fixed.emplace_back(a, file.point("a fixed line"));
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int i = 0; i < points[k] && !file.fault(); ++i) file.point(kinds[k]);
    skip(drawing, kinds[k], points[k]);
  }
  skip(drawing, "material lines", materials);
  if (!file.fault() && !file.at_end()) {
    file.fail("has \"" + for_message(file.word()) + "\" after its last number");
  }
  if (file.fault()) return *file.fault();
  return drawing;
}

/// A tag and the text after it, up to the next tag.
struct Tag {
  std::string_view name;  ///< without a prefix before a colon; with / in a closing tag
  std::string_view attributes;
  std::string_view text;
  int line = 0;  ///< line at which the text begins
};

int lines_in(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// The tags of a file, without comments and declarations; empty with a fault if one does not end.
std::vector<Tag> tags_of(std::string_view text, const std::string& path,
                         std::optional<Fault>& fault) {
  std::vector<Tag> tags;
  int line = 1;
  std::size_t i = 0;
  const auto go_to = [&](std::size_t end) {
    line += lines_in(text.substr(i, end - i));
    i = end;
  };
  for (;;) {
    const std::size_t open = text.find('<', i);
    if (open == std::string_view::npos) return tags;
    go_to(open);
    const bool comment = text.substr(i).starts_with("<!--");
    const std::string_view ending = comment ? "-->" : ">";
    const std::size_t close = text.find(ending, i);
    if (close == std::string_view::npos) {
      fault = Fault{{"", path, line, 1}, "has a tag that does not end", "close it with >"};
      return {};
    }
    std::string_view inside = text.substr(i + 1, close - i - 1);
    go_to(close + ending.size());
    if (comment || inside.empty() || inside.front() == '?' || inside.front() == '!') continue;
    const bool closes = inside.front() == '/';
    const std::size_t end =
        std::min(inside.find_first_of(" \t\r\n/", closes ? 1 : 0), inside.size());
    std::string_view name = inside.substr(0, end);
    if (const std::size_t colon = name.find(':'); colon != std::string_view::npos && !closes) {
      name.remove_prefix(colon + 1);
    }
    const std::size_t next = std::min(text.find('<', i), text.size());
    tags.push_back({name, inside.substr(end), text.substr(i, next - i), line});
  }
}

std::string attribute(std::string_view attributes, std::string_view name) {
  const std::size_t at = attributes.find(name);
  if (at == std::string_view::npos) return {};
  const std::size_t open = attributes.find_first_of("\"'", at);
  if (open == std::string_view::npos) return {};
  const std::size_t close = attributes.find(attributes[open], open + 1);
  if (close == std::string_view::npos) return {};
  return std::string(trimmed(attributes.substr(open + 1, close - open - 1)));
}

Result<Drawing> parse_tags(std::string_view text, const std::string& path) {
  Drawing drawing;
  std::optional<Fault> fault;
  const std::vector<Tag> tags = tags_of(text, path, fault);
  if (fault) return *fault;
  std::string list;
  for (const Tag& tag : tags) {
    if (tag.name.ends_with("list")) {
      list = tag.name.front() == '/' ? "" : std::string(tag.name);
      continue;
    }
    const bool joint = tag.name == "Joint", line = tag.name == "Line", point = tag.name == "Point";
    if (!joint && !line && !point) continue;
    const bool fixed = !joint && list == "Fixedpointlist";
    if (!joint && !fixed) {
      skip(drawing,
           list == "Loadpointlist"       ? "loading points"
           : list == "Measuredpointlist" ? "measured points"
           : list == "Holepointlist"     ? "hole points"
                                         : "lines and points of other lists",
           1);
      continue;
    }
    Numbers numbers(words_of(tag.text, tag.line), path);
    const char* const what = joint ? "an end of a joint" : line ? "a fixed line" : "a fixed point";
    const Vec2 a = numbers.point(what);
    const Vec2 b = point ? a : numbers.point(what);
    if (!numbers.fault() && !numbers.at_end()) {
      numbers.fail("has \"" + for_message(numbers.word()) + "\" after " + what);
    }
    if (numbers.fault()) {
      Fault found = *numbers.fault();
      found.where.line = std::max(found.where.line, tag.line);
      return found;
    }
    if (joint) {
      for (const double x : {a.x, a.y, b.x, b.y}) drawing.digits.add(x);
      drawing.lines.push_back({{a, b}, attribute(tag.attributes, "type"), tag.line});
    } else {
      drawing.fixed.emplace_back(a, b);
    }
  }
  return drawing;
}

}  // namespace

Result<Drawing> parse_geo(std::string_view text, const std::string& path) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool tags = first != std::string_view::npos && text[first] == '<';
  return tags ? parse_tags(text, path) : parse_numbers(text, path);
}

}  // namespace edda
