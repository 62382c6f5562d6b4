// Tables of traces: x1,y1,x2,y2[,joint].
#include <array>

#include "base/text.hpp"
#include "imports/drawing.hpp"
#include "imports/file_words.hpp"

namespace edda {
namespace {

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::string_view unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

Result<Drawing> parse_traces(std::string_view text, const std::string& path) {
  Drawing drawing;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  int line = 0;
  bool first = true;
  while (!text.empty()) {
    const std::string_view row = trimmed(next_line(text));
    ++line;
    if (row.empty() || row.front() == '#') continue;
    const std::vector<std::string_view> fields = fields_of(row);
    const auto fault = [&](std::string problem) {
      return Fault{
          {"", path, line, 1}, std::move(problem), "write x1,y1,x2,y2 or x1,y1,x2,y2,joint"};
    };
    const bool is_header = first && !place_number(fields[0]) && fields.size() >= 4;
    first = false;
    if (is_header) continue;
    if (fields.size() != 4 && fields.size() != 5) {
      return fault("has " + std::to_string(fields.size()) + " fields");
    }
    std::array<double, 4> x{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto value = place_number(fields[k]);
      if (!value) return fault('"' + for_message(fields[k]) + "\" is not a length");
      x[k] = *value;
    }
    const std::string_view joint = fields.size() == 5 ? unquoted(fields[4]) : std::string_view{};
    drawing.lines.push_back({{{x[0], x[1]}, {x[2], x[3]}}, std::string(joint), line});
  }
  return drawing;
}

}  // namespace edda
