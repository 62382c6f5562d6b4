// DXF drawings: pairs of lines, a group code and its value. Counts in the file are not believed,
// and blocks are not followed, so that no drawing can ask for more than it holds.
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/arc.hpp"
#include "base/text.hpp"
#include "lines/drawing.hpp"
#include "lines/file_words.hpp"

namespace edda {
namespace {

/// Straight pieces of a full turn that arcs are drawn with.
constexpr int arc_segments = 48;

struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the code
};

std::optional<int> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Pairs of lines, one at a time.
class Groups {
 public:
  Groups(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

  /// The next pair; nothing at the end of the file, or where a fault has been found.
  std::optional<Group> next() {
    while (!fault_ && !rest_.empty()) {
      Group group;
      group.line = line_ + 1;
      const std::string_view code = trimmed(take());
      const auto number = whole_number(code);
      if (!number) {
        fail(group.line, '"' + for_message(code) + "\" is not a group code");
        return std::nullopt;
      }
      if (rest_.empty() && code_is_last_) return std::nullopt;
      group.code = *number;
      group.value = trimmed(take());
      constexpr int comment = 999;
      if (group.code != comment) return group;
    }
    return std::nullopt;
  }

  void fail(int line, std::string problem) {
    if (!fault_) {
      fault_ = Fault{{"", path_, line, 1},
                     std::move(problem),
                     "save it again as an ASCII DXF drawing, or export the lines as .csv"};
    }
  }
  const std::optional<Fault>& fault() const { return fault_; }
  int line() const { return line_; }

 private:
  std::string_view take() {
    ++line_;
    code_is_last_ = rest_.empty();
    return next_line(rest_);
  }

  std::string_view rest_;
  std::string path_;
  int line_ = 0;
  bool code_is_last_ = false;
  std::optional<Fault> fault_;
};

/// An entity: its name and its groups up to the next one.
struct Entity {
  std::string_view name;
  int line = 0;
  std::vector<Group> groups;

  const Group* find(int code) const {
    for (const Group& g : groups) {
      if (g.code == code) return &g;
    }
    return nullptr;
  }
};

struct Corner {
  Vec2 point;
  double bulge = 0.0;  ///< of the side that begins here
};

std::vector<Vec2> points_of(const std::vector<Corner>& corners, bool closed) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.push_back(corners[i].point);
    const bool last = i + 1 == corners.size();
    if (last && !closed) break;
    const Vec2 to = corners[last ? 0 : i + 1].point;
    const auto arc = bulge_corners(corners[i].point, to, corners[i].bulge, arc_segments);
    points.insert(points.end(), arc.begin(), arc.end());
  }
  if (closed && corners.size() > 1) points.push_back(corners[0].point);
  return points;
}

/// Takes the lines among the entities, one entity at a time; false where a fault was found.
class Lines {
 public:
  explicit Lines(Groups& file) : file_(file) {}

  bool add(const Entity& e) {
    if (e.name == "VERTEX") return vertex(e);
    if (e.name == "SEQEND") return end_polyline();
    if (open_) return fail(e.line, "a POLYLINE is not ended by SEQEND");
    skipping_ = false;
    if (e.name != "LINE" && e.name != "LWPOLYLINE" && e.name != "POLYLINE") return count(e.name);
    const std::string name(e.name);
    if (const Group* paper = e.find(67); paper != nullptr && whole_number(paper->value) == 1) {
      return skip(e, name + " on paper");
    }
    if (e.name == "LINE") return line(e);
    const auto side = side_of_plane(e);
    if (!side) return false;
    if (*side == 0) return skip(e, name + " across the plane");
    return e.name == "POLYLINE" ? polyline(e, *side) : light_polyline(e, *side);
  }

  Drawing finish() {
    if (open_) fail(file_.line(), "a POLYLINE is not ended by SEQEND");
    return std::move(drawing_);
  }

 private:
  bool fail(int line, std::string problem) {
    file_.fail(line, std::move(problem));
    return false;
  }
  bool count(std::string_view name) {
    ++drawing_.skipped[for_message(name)];
    return true;
  }
  /// Leaves an entity out, with the vertices that follow it.
  bool skip(const Entity& e, const std::string& what) {
    skipping_ = e.name == "POLYLINE";
    return count(what);
  }

  static std::string layer_of(const Entity& e) {
    const Group* layer = e.find(8);
    return layer == nullptr || layer->value.empty() ? "0" : std::string(layer->value);
  }

  void take(std::vector<Vec2> points, std::string layer, int line) {
    if (points.size() < 2) {
      count("POLYLINE of one point");
    } else {
      drawing_.lines.push_back({std::move(points), std::move(layer), line});
    }
  }

  std::optional<double> real(const Group& g) {
    const auto value = place_number(g.value);
    if (!value) fail(g.line + 1, '"' + for_message(g.value) + "\" is not a length");
    return value;
  }
  /// A coordinate that must be there.
  std::optional<double> real(const Entity& e, int code) {
    const Group* g = e.find(code);
    if (g != nullptr) return real(*g);
    fail(e.line, std::string(e.name) + " lacks group " + std::to_string(code));
    return std::nullopt;
  }
  /// A flag; 0 where it is left out.
  std::optional<int> flags(const Entity& e) {
    const Group* g = e.find(70);
    if (g == nullptr) return 0;
    const auto value = whole_number(g->value);
    if (!value) fail(g->line + 1, '"' + for_message(g->value) + "\" is not a whole number");
    return value;
  }

  /// Of a polyline, whose points are in the plane across its extrusion: +1 drawn from above, -1
  /// from below (x is mirrored), 0 aslant.
  std::optional<int> side_of_plane(const Entity& e) {
    std::array<double, 3> up{0.0, 0.0, 1.0};
    for (int k = 0; k < 3; ++k) {
      const Group* g = e.find(210 + 10 * k);
      if (g == nullptr) continue;
      const auto value = real(*g);
      if (!value) return std::nullopt;
      up[static_cast<std::size_t>(k)] = *value;
    }
    constexpr double aslant = 1e-6;
    if (std::abs(up[0]) > aslant || std::abs(up[1]) > aslant || up[2] == 0.0) return 0;
    return up[2] > 0.0 ? 1 : -1;
  }

  bool line(const Entity& e) {
    const auto x1 = real(e, 10), y1 = real(e, 20), x2 = real(e, 11), y2 = real(e, 21);
    if (!x1 || !y1 || !x2 || !y2) return false;
    take({{*x1, *y1}, {*x2, *y2}}, layer_of(e), e.line);
    return true;
  }

  /// Corners are groups 10, 20 and 42 in turn; the count in group 90 says nothing new.
  bool light_polyline(const Entity& e, int side) {
    const auto flag = flags(e);
    if (!flag) return false;
    std::vector<Corner> corners;
    bool has_y = true;
    for (const Group& g : e.groups) {
      if (g.code != 10 && g.code != 20 && g.code != 42) continue;
      const auto value = real(g);
      if (!value) return false;
      if (g.code == 10) {
        if (!has_y) break;
        corners.push_back({{side * *value, 0.0}, 0.0});
        has_y = false;
      } else if (corners.empty()) {
        return fail(g.line, "a corner of an LWPOLYLINE does not begin with group 10");
      } else if (g.code == 20) {
        corners.back().point.y = *value;
        has_y = true;
      } else {
        corners.back().bulge = side * *value;
      }
    }
    if (!has_y) return fail(e.line, "a corner of an LWPOLYLINE lacks group 20");
    take(points_of(corners, (*flag & 1) != 0), layer_of(e), e.line);
    return true;
  }

  bool polyline(const Entity& e, int side) {
    const auto flag = flags(e);
    if (!flag) return false;
    constexpr int mesh = 16 | 64;
    if ((*flag & mesh) != 0) return skip(e, "POLYLINE as a mesh");
    open_ = Open{layer_of(e), e.line, side, (*flag & 1) != 0, {}};
    return true;
  }

  bool vertex(const Entity& e) {
    if (skipping_) return true;
    if (!open_) return count(e.name);
    const auto flag = flags(e);
    if (!flag) return false;
    constexpr int frame_of_spline = 16;
    if ((*flag & frame_of_spline) != 0) return true;
    const auto x = real(e, 10), y = real(e, 20);
    if (!x || !y) return false;
    const Group* bulge = e.find(42);
    const auto b = bulge == nullptr ? std::optional(0.0) : real(*bulge);
    if (!b) return false;
    open_->corners.push_back({{open_->side * *x, *y}, open_->side * *b});
    return true;
  }

  bool end_polyline() {
    if (open_) take(points_of(open_->corners, open_->closed), open_->layer, open_->line);
    open_.reset();
    skipping_ = false;
    return true;
  }

  /// A POLYLINE whose vertices are still to come.
  struct Open {
    std::string layer;
    int line = 0, side = 1;
    bool closed = false;
    std::vector<Corner> corners;
  };

  Groups& file_;
  Drawing drawing_;
  std::optional<Open> open_;
  bool skipping_ = false;  ///< within a POLYLINE that is left out
};

/// Reads the entities of the section that has just begun, up to its end.
void read_entities(Groups& file, Lines& lines) {
  Entity e;
  while (const auto group = file.next()) {
    if (group->code != 0) {
      e.groups.push_back(*group);
      continue;
    }
    if (!e.name.empty() && !lines.add(e)) return;
    e = {group->value, group->line, {}};
    if (group->value == "ENDSEC") return;
    if (group->value == "EOF" || group->value == "SECTION") {
      return file.fail(group->line, "the section of entities is not ended by ENDSEC");
    }
  }
  file.fail(file.line(), "breaks off within its entities");
}

/// Of the header variable $INSUNITS; nothing of the units that [[import]] does not know.
std::optional<LengthUnit> drawing_unit(std::optional<int> number) {
  switch (number.value_or(0)) {
    case 1:
      return LengthUnit::in;
    case 2:
      return LengthUnit::ft;
    case 4:
      return LengthUnit::mm;
    case 5:
      return LengthUnit::cm;
    case 6:
      return LengthUnit::m;
    case 7:
      return LengthUnit::km;
    default:
      return std::nullopt;
  }
}

}  // namespace

Result<Drawing> parse_dxf(std::string_view text, const std::string& path) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Groups file(text, path);
  if (text.starts_with("AutoCAD Binary DXF")) file.fail(1, "is a binary drawing");
  Lines lines(file);
  bool section = false, entities = false, says_units = false;
  std::optional<LengthUnit> units;
  for (auto group = file.next(); group && !file.fault(); group = file.next()) {
    const bool names_it = section && group->code == 2;
    section = group->code == 0 && group->value == "SECTION";
    if (says_units && group->code == 70) units = drawing_unit(whole_number(group->value));
    says_units = group->code == 9 && group->value == "$INSUNITS";
    if (!names_it || group->value != "ENTITIES") continue;
    entities = true;
    read_entities(file, lines);
  }
  Drawing drawing = lines.finish();
  drawing.units = units;
  if (!file.fault() && !entities) file.fail(0, "has no section of entities");
  if (file.fault()) return *file.fault();
  return drawing;
}

}  // namespace edda
