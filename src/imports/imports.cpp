#include "imports/imports.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <variant>

#include "base/place.hpp"
#include "base/text.hpp"
#include "imports/drawing.hpp"
#include "imports/import_units.hpp"
#include "model/files/file_text.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

Result<Drawing> read_drawing(const Import& import) {
  const std::variant<std::string, Fault> text = file_text(import.file);
  if (const Fault* fault = std::get_if<Fault>(&text)) return *fault;
  const auto& content = std::get<std::string>(text);
  const std::string ending = ending_of(import.file);
  if (ending == ".csv") return parse_traces(content, import.file);
  if (ending == ".geo") return parse_geo(content, import.file);
  // Whoever names a layer wants it, also where it is hidden.
  std::vector<std::string> shown = import.fixed;
  for (const auto& [name, joint] : import.layers) shown.push_back(name);
  for (const auto& [name, material] : import.materials) shown.push_back(name);
  return parse_dxf(content, import.file, shown);
}

/// Joint of a layer, and whether its lines are read at all.
class Layers {
 public:
  Layers(const Model& model, const Import& import) : import_(import) {
    for (std::size_t i = 0; i < model.given_joints().size(); ++i) {
      joints_[model.joints[i].name] = static_cast<Index>(i);
    }
    for (const auto& [name, joint] : import.layers) named_[name] = joint;
  }

  bool reads(const std::string& layer) const {
    return named_.empty() || named_.contains(layer) || layer.empty();
  }

  Index joint_of(const std::string& layer) const {
    if (const auto found = named_.find(layer); found != named_.end()) return found->second;
    if (const auto found = joints_.find(layer); found != joints_.end()) return found->second;
    return import_.joint;
  }

  /// For a table, whose joints are written out: an unknown name is a mistake.
  std::string unknown_joint(const std::string& name) const {
    if (name.empty() || named_.contains(name) || joints_.contains(name)) return {};
    std::vector<std::string_view> known;
    for (const auto& [joint, i] : joints_) known.push_back(joint);
    return known.empty() ? std::string("no joint is defined") : suggestion(name, known);
  }

 private:
  const Import& import_;
  std::map<std::string, Index> joints_, named_;
};

std::string listed(const std::map<std::string, int>& counts) {
  std::string text;
  constexpr std::size_t most = 12;
  std::size_t shown = 0;
  for (const auto& [name, count] : counts) {
    if (++shown > most) return text + ", and more";
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + clipped(name);
  }
  return text;
}

std::string note_of(const Import& import, std::size_t lines, const Drawing& drawing,
                    const std::map<std::string, int>& taken) {
  std::string text = std::filesystem::path(import.file).filename().string() + ": " +
                     std::to_string(lines) +
                     (import.as == ImportAs::blocks ? (lines == 1 ? " block" : " blocks")
                                                    : (lines == 1 ? " line" : " lines"));
  std::map<std::string, int> named = taken;
  named.erase("");
  if (!named.empty()) text += " (" + listed(named) + ')';
  if (!drawing.fixed.empty()) text += ", " + std::to_string(drawing.fixed.size()) + " fixed";
  if (!drawing.skipped.empty()) text += "; left out: " + listed(drawing.skipped);
  return text;
}

std::optional<Fault> missing_layer(const Import& import, const Drawing& drawing) {
  std::set<std::string> there;
  for (const DrawnLine& line : drawing.lines) there.insert(line.layer);
  const auto missing = [&](const std::string& key,
                           const std::string& name) -> std::optional<Fault> {
    if (there.contains(name)) return std::nullopt;
    const std::vector<std::string_view> known(there.begin(), there.end());
    return Fault{member_of(import.where, key), "no line of the file is on this layer",
                 known.empty() ? "it has no lines" : "its layers are " + quoted_list(known)};
  };
  for (const auto& [name, joint] : import.layers) {
    if (auto fault = missing("layers." + name, name)) return fault;
  }
  for (const auto& [name, material] : import.materials) {
    if (auto fault = missing("materials." + name, name)) return fault;
  }
  for (const std::string& name : import.fixed) {
    if (auto fault = missing("fixed", name)) {
      fault->problem = '"' + clipped(name) + "\": " + fault->problem;
      return fault;
    }
  }
  return std::nullopt;
}

Index material_of(const Import& import, const std::string& layer) {
  for (const auto& [name, material] : import.materials) {
    if (name == layer) return material;
  }
  return import.material;
}

/// Adds the lines of one file, or the blocks that its closed ones are.
class Taker {
 public:
  Taker(const Model& model, Index number, Drawing& drawing, Imports& imports)
      : import_(model.imports[static_cast<std::size_t>(number)]),
        layers_(model, import_),
        number_(number),
        drawing_(drawing),
        imports_(imports),
        table_(ending_of(import_.file) == ".csv") {}

  std::optional<Fault> take() {
    if (auto fault = missing_layer(import_, drawing_); fault && !table_) return fault;
    for (DrawnLine& line : drawing_.lines) {
      if (auto fault = take(line)) return fault;
    }
    for (const auto& [a, b] : drawing_.fixed) {
      imports_.fixed_lines.emplace_back(placed(a), placed(b));
      imports_.fixed_import.push_back(number_);
    }
    imports_.drawn_in.push_back(drawing_.units);
    imports_.last_digit.push_back(import_.scale * metres(import_.units) * drawing_.digits.unit());
    imports_.notes.push_back(note_of(import_, count_, drawing_, taken_));
    if (!drawing_.skipped.empty()) imports_.left_out.push_back(imports_.notes.back());
    warn_of_faults();
    if (count_ > 0) return std::nullopt;
    return Fault{member_of(import_.where, "file"), imports_.notes.back(),
                 import_.as == ImportAs::blocks
                     ? "give a drawing in which each block is a closed polyline, or as = \"lines\""
                     : "give a file with lines; of a drawing, lines, polylines, arcs, ellipses and "
                       "splines are read, also of inserted blocks"};
  }

 private:
  Vec2 placed(Vec2 p) const { return import_.shift + import_.scale * metres(import_.units) * p; }

  void warn_of_faults() {
    if (!drawing_.fault) return;
    const Fault& first = *drawing_.fault;
    imports_.warnings.push_back(
        import_.where.key + ": " + counted(static_cast<std::size_t>(drawing_.faulty), "part") +
        " of the drawing " + (drawing_.faulty == 1 ? "has a fault and is" : "have faults and are") +
        " left out; " + std::filesystem::path(import_.file).filename().string() + ", line " +
        std::to_string(first.where.line) + ": " + first.problem + ": " + first.remedy);
  }

  std::optional<Fault> take(const DrawnLine& line) {
    if (table_) {
      if (const std::string hint = layers_.unknown_joint(line.layer); !hint.empty()) {
        return Fault{{"", import_.file, line.line, 1},
                     "no joint is called \"" + clipped(line.layer) + '"',
                     hint};
      }
    } else if (!layers_.reads(line.layer)) {
      ++drawing_.skipped["on layer \"" + line.layer + '"'];
      return std::nullopt;
    }
    const bool is_point = std::all_of(line.points.begin(), line.points.end(),
                                      [&](Vec2 p) { return p == line.points[0]; });
    if (is_point) {
      ++drawing_.skipped["of no length"];
      return std::nullopt;
    }
    std::vector<Vec2> points;
    for (const Vec2 p : line.points) {
      points.push_back(placed(p));
      constexpr double largest = 1e12;  // m, as for lengths in the model
      if (std::abs(points.back().x) > largest || std::abs(points.back().y) > largest) {
        return Fault{{"", import_.file, line.line, 1},
                     "lies beyond 1e12 m",
                     "check units, scale and shift of the import"};
      }
    }
    if (add(line.layer, std::move(points))) {
      ++count_;
      ++taken_[line.layer];
    }
    return std::nullopt;
  }

  bool add(const std::string& layer, std::vector<Vec2> points) {
    const Index joint = layers_.joint_of(layer);
    if (import_.as == ImportAs::lines) {
      imports_.lines.push_back({std::move(points), joint, number_});
      return true;
    }
    Ring ring = closed_ring(points);
    if (ring.size() < 3) {
      ++drawing_.skipped["not closed"];
      return false;
    }
    const bool fixed =
        std::find(import_.fixed.begin(), import_.fixed.end(), layer) != import_.fixed.end();
    imports_.blocks.push_back(
        {std::move(ring), joint, material_of(import_, layer), fixed, number_});
    return true;
  }

  const Import& import_;
  const Layers layers_;
  const Index number_;
  Drawing& drawing_;
  Imports& imports_;
  const bool table_;
  std::size_t count_ = 0;
  std::map<std::string, int> taken_;  ///< how many of each layer
};

}  // namespace

Ring closed_ring(const std::vector<Vec2>& points) {
  Ring ring;
  if (points.size() < 4 || points.front() != points.back()) return ring;
  for (const Vec2 p : points) {
    if (ring.empty() || !(p == ring.back())) ring.push_back(p);
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() >= 3 && signed_area(ring) == 0.0) ring.clear();
  return ring;
}

Result<Imports> read_imports(const Model& model) {
  Imports imports;
  Faults faults;
  for (std::size_t i = 0; i < model.imports.size(); ++i) {
    const Import& import = model.imports[i];
    Result<Drawing> drawing = read_drawing(import);
    if (!drawing.ok()) {
      Fault fault = drawing.faults().front();
      if (fault.where.line == 0) {  // the fault is in the file's name, not in the file
        fault.problem = import.file + ' ' + fault.problem;
        fault.where = member_of(import.where, "file");
      }
      faults.push_back(std::move(fault));
    } else if (auto fault = Taker(model, static_cast<Index>(i), drawing.value(), imports).take()) {
      faults.push_back(std::move(*fault));
    }
  }
  if (!faults.empty()) return faults;
  return imports;
}

Result<Domain> frame_of(const Model& model, const Imports& imports) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec2 low{infinite, infinite}, high{-infinite, -infinite};
  for (const ImportedLine& line : imports.lines) {
    for (const Vec2 p : line.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const Import& first = model.imports.front();
  if (!(high.x > low.x && high.y > low.y)) {
    return Fault{member_of(first.where, "file"), "the lines enclose nothing",
                 "give lines that bound blocks, or a [domain] for them to cut"};
  }
  Domain frame;
  frame.outline = {low, {high.x, low.y}, high, {low.x, high.y}};
  frame.material = first.material;
  frame.where = first.where;
  return frame;
}

}  // namespace edda
