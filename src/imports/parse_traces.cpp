// Tables of traces: x1,y1,x2,y2[,joint], or columns by the names in their header.
#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "base/text.hpp"
#include "imports/drawing.hpp"
#include "imports/file_words.hpp"

namespace edda {
namespace {

constexpr const char* by_place = "write x1,y1,x2,y2 or x1,y1,x2,y2,joint";

/// The character between the fields: a semicolon or tab where the row has any, and no comma outside
/// of numbers.
char separator_of(std::string_view row) {
  for (const char c : {';', '\t'}) {
    if (row.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

/// Fields may be in quotes, with separators in them.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != separator)) continue;
    fields.push_back(trimmed(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return fields;
}

std::string_view unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

/// Letters and digits alone, small, without a unit in brackets: "START_X [m]" is startx.
std::string plain_name(std::string_view field) {
  std::string name;
  for (const char c : unquoted(field).substr(0, unquoted(field).find_first_of("([{"))) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) name += static_cast<char>(std::tolower(byte));
  }
  return name;
}

/// Columns of a table: x1, y1, x2, y2 and the joint.
constexpr std::size_t places = 5;
using Columns = std::array<std::optional<std::size_t>, places>;

/// What a name says: which end and which coordinate, or the joint. Geographers write START_X,
/// x_end, fromX, xstart, X0 and X1.
class TraceNames {
 public:
  TraceNames() = default;
  explicit TraceNames(const std::vector<std::string_view>& header) {
    bool from_zero = false;
    for (const std::string_view field : header) names_.push_back(plain_name(field));
    for (const std::string& name : names_) from_zero = from_zero || name == "x0";
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto place = place_of(names_[i], from_zero);
      if (!place) continue;
      double_ = double_ || columns_[*place].has_value();
      columns_[*place] = i;
    }
  }

  const Columns& columns() const { return columns_; }
  bool complete() const {
    return !double_ && std::all_of(columns_.begin(), columns_.begin() + 4,
                                   [](auto c) { return c.has_value(); });
  }

 private:
  static std::optional<std::size_t> place_of(const std::string& name, bool from_zero) {
    for (const char* joint : {"joint", "set", "jointset", "layer", "law"}) {
      if (name == joint) return 4;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::string c(1, axis == 0 ? 'x' : 'y');
      const std::string east = axis == 0 ? "easting" : "northing";
      for (const std::string& coordinate : {c, c + "coord", c + "coordinate", east}) {
        for (const char* end : {"start", "from", "begin", "first", "a", from_zero ? "0" : "1"}) {
          if (name == end + coordinate || name == coordinate + end) return axis;
        }
        for (const char* end : {"end", "to", "stop", "last", "b", from_zero ? "1" : "2"}) {
          if (name == end + coordinate || name == coordinate + end) return 2 + axis;
        }
      }
    }
    return std::nullopt;
  }

  std::vector<std::string> names_;
  Columns columns_{};
  bool double_ = false;
};

class TraceTable {
 public:
  explicit TraceTable(const std::string& path) : path_(path) {}

  /// Null where the row is read.
  std::optional<Fault> take(std::string_view row, int line) {
    if (!begun_ && row.starts_with("sep=") && row.size() == 5) {  // as spreadsheets write it
      separator_ = row[4];
      return std::nullopt;
    }
    if (!separator_) separator_ = separator_of(row);
    const std::vector<std::string_view> fields = fields_of(row, *separator_);
    const bool no_number = std::none_of(fields.begin(), fields.end(), [&](std::string_view f) {
      return number(unquoted(f)).has_value();
    });
    const bool first = !begun_;
    begun_ = true;
    if (first && no_number && fields.size() >= 4) return take_header(fields, line);
    if (!fits(fields.size()))
      return fault(line, "has " + counted(fields.size(), "field") + expectation());
    DrawnLine drawn{{}, {}, line};
    std::array<double, 4> x{};
    for (std::size_t k = 0; k < x.size(); ++k) {
      const std::string_view field = unquoted(fields[*columns_[k]]);
      const auto value = number(field);
      if (!value) return fault(line, '"' + for_message(field) + "\" is not a length");
      x[k] = *value;
      drawing_.digits.add(*value);
    }
    if (columns_[4] && *columns_[4] < fields.size()) drawn.layer = unquoted(fields[*columns_[4]]);
    drawn.points = {{x[0], x[1]}, {x[2], x[3]}};
    drawing_.lines.push_back(std::move(drawn));
    return std::nullopt;
  }

  Drawing finish() { return std::move(drawing_); }

 private:
  /// Where semicolons separate the fields, numbers may have a decimal comma.
  std::optional<double> number(std::string_view field) const {
    if (separator_ != ';') return place_number(field);
    std::string text(field);
    std::replace(text.begin(), text.end(), ',', '.');
    return place_number(text);
  }

  std::optional<Fault> take_header(const std::vector<std::string_view>& fields, int line) {
    const TraceNames names(fields);
    if (!names.complete()) {
      std::string all;
      for (const std::string_view f : fields) {
        all += (all.empty() ? "" : ", ") + for_message(unquoted(f));
      }
      return Fault{
          {"", path_, line, 1},
          "its header does not name the columns of both ends: " + all,
          "call them x1,y1,x2,y2 (or START_X, START_Y, END_X, END_Y, ...), in any order, and "
          "that of the joint, if there is one, joint"};
    }
    columns_ = names.columns();
    for (const std::string_view f : fields) header_.emplace_back(unquoted(f));
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const bool used =
          std::any_of(columns_.begin(), columns_.end(), [&](auto c) { return c == i; });
      if (!used) ++drawing_.skipped["column \"" + for_message(header_[i]) + '"'];
    }
    return std::nullopt;
  }

  /// Of a header's columns those at the end may be missing, but for the coordinates.
  bool fits(std::size_t fields) const {
    if (header_.empty()) return fields == 4 || fields == 5;
    const auto last = std::max_element(columns_.begin(), columns_.begin() + 4);
    return fields > **last && fields <= header_.size();
  }
  std::string expectation() const {
    return header_.empty() ? std::string{} : ", its header names " + std::to_string(header_.size());
  }
  std::optional<Fault> fault(int line, std::string problem) const {
    return Fault{{"", path_, line, 1},
                 std::move(problem),
                 header_.empty() ? by_place : "write a field for each column of the header"};
  }

  const std::string& path_;
  Drawing drawing_;
  Columns columns_{0, 1, 2, 3, 4};
  std::vector<std::string> header_;
  std::optional<char> separator_;
  bool begun_ = false;
};

}  // namespace

Result<Drawing> parse_traces(std::string_view text, const std::string& path) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  TraceTable table(path);
  int line = 0;
  while (!text.empty()) {
    const std::string_view row = trimmed(next_line(text));
    ++line;
    if (row.empty() || row.front() == '#') continue;
    if (auto fault = table.take(row, line)) return *fault;
  }
  return table.finish();
}

}  // namespace edda
