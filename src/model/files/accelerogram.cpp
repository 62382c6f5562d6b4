#include "model/files/accelerogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "base/text.hpp"
#include "model/files/csv_rows.hpp"
#include "model/files/file_text.hpp"
#include "model/files/strong_motion.hpp"

namespace edda {
namespace {

constexpr double standard_gravity = 9.80665;  // m/s2

std::string upper(std::string_view text) {
  std::string copy(text);
  for (char& c : copy) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return copy;
}

/// Takes the next word off the front; words are separated by blanks and by the characters of
/// `also`.
std::string_view next_word(std::string_view& text, std::string_view also = {}) {
  const auto between = [&](char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' ||
           also.find(c) != std::string_view::npos;
  };
  while (!text.empty() && between(text.front())) text.remove_prefix(1);
  std::size_t n = 0;
  while (n < text.size() && !between(text[n])) ++n;
  const std::string_view word = text.substr(0, n);
  text.remove_prefix(n);
  return word;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// The two numbers of "NPTS= 4000, DT= .0050 SEC" or "4000 .0050 NPTS, DT".
struct Header {
  std::size_t points;
  double step;
};

std::optional<Header> header_of(std::string_view line) {
  constexpr double most_points = 1e8;
  std::vector<double> numbers;
  while (true) {
    const std::string_view word = next_word(line, ",=:");
    if (word.empty()) break;
    double value = 0.0;
    if (parse_number(word, value)) numbers.push_back(value);
  }
  if (numbers.size() != 2) return {};
  const double n = numbers[0];
  if (!(n >= 1.0 && n <= most_points) || n != std::floor(n) || !(numbers[1] > 0.0)) return {};
  return Header{static_cast<std::size_t>(n), numbers[1]};
}

Vec2 direction_of(Vec2 d) {
  return norm(d) > 0.0 ? unit(d) : Vec2{};
}

/// Acceleration and velocity of a record before scaling, linear and quadratic within the interval
/// between two rows.
struct Moving {
  Vec2 acceleration, velocity;
};

Moving at(const Accelerogram& r, double t) {
  const auto after = std::upper_bound(r.time.begin(), r.time.end(), t);
  if (after == r.time.begin()) return {};
  const auto k = static_cast<std::size_t>(after - r.time.begin()) - 1;
  if (after == r.time.end()) return {{}, r.velocity[k]};
  const double dt = r.time[k + 1] - r.time[k], s = (t - r.time[k]) / dt;
  const Vec2 a = r.acceleration[k], change = r.acceleration[k + 1] - a;
  return {a + s * change, r.velocity[k] + (s * dt) * (a + (0.5 * s) * change)};
}

/// What the text of a CSV file says before its first row of numbers.
struct RecordTable {
  std::string text;            ///< with commas between the columns
  std::size_t columns = 0;     ///< of the first row
  int line = 0;                ///< of the first row
  std::optional<double> unit;  ///< m/s2, of its second column
};

/// The row with commas for the semicolons, tabs or blanks between its cells.
std::string with_commas(std::string_view row) {
  const char* const between = row.find(';') != std::string_view::npos    ? "; \t"
                              : row.find('\t') != std::string_view::npos ? "\t"
                                                                         : " ";
  std::string changed;
  while (true) {
    const std::string_view cell = next_word(row, between);
    if (cell.empty()) return changed;
    changed += (changed.empty() ? "" : ",") + std::string(cell);
  }
}

/// A unit in brackets, "Acceleration (g)", or alone, "g".
std::optional<double> unit_in(std::string_view cell) {
  const std::size_t open = cell.find_first_of("([");
  if (open == std::string_view::npos) return acceleration_unit(cell);
  const std::size_t close = cell.find_first_of(")]", open);
  return acceleration_unit(cell.substr(open + 1, close - open - 1));
}

/// Names and units may stand in a comment, "# Time (s),Acceleration (g)".
RecordTable record_table(std::string_view text) {
  RecordTable table;
  int line = 0;
  while (!text.empty()) {
    const std::string_view row = trimmed(next_line(text));
    ++line;
    const std::string_view said = trimmed(row.starts_with('#') ? row.substr(1) : row);
    std::string_view cells = said;
    double number = 0.0;
    const bool numbers = !row.starts_with('#') && parse_number(next_word(cells, ",;"), number);
    const bool commas = row.find(',') != std::string_view::npos;
    const bool names = !numbers && !commas && table.columns == 0 && !row.empty();
    table.text += (names ? "#" : "") + (numbers && !commas ? with_commas(row) : std::string(row));
    table.text += '\n';
    if (numbers && table.columns == 0) {
      const std::string first = commas ? std::string(row) : with_commas(row);
      table.columns = static_cast<std::size_t>(std::count(first.begin(), first.end(), ',')) + 1;
      table.line = line;
    }
    if (numbers || table.columns != 0) continue;
    const std::size_t comma = said.find_first_of(",;\t");
    if (comma == std::string_view::npos) continue;
    const std::string_view second = said.substr(comma + 1);
    if (const auto unit = unit_in(trimmed(second.substr(0, second.find_first_of(",;\t"))))) {
      table.unit = unit;
    }
  }
  return table;
}

/// Whether a text without the name of a record of PEER begins like one.
bool has_peer_head(std::string_view text) {
  constexpr int longest_head = 10;
  for (int line = 0; line < longest_head && !text.empty(); ++line) {
    const std::string head = upper(next_line(text));
    if (head.find("NPTS") != std::string::npos && head.find("DT") != std::string::npos) return true;
  }
  return false;
}

std::string unit_text(double unit) {
  if (unit == standard_gravity) return "g";
  return unit == 1.0 ? "m/s2" : unit == 0.01 ? "cm/s2" : fmt::format("{:g} m/s2", unit);
}

Accelerogram accelerogram_of(const StrongMotion& motion, const RecordReading& reading) {
  Accelerogram record;
  record.unit_known = true;
  record.read_as = motion.read_as;
  if (reading.unit) record.read_as += ", taken as " + unit_text(*reading.unit);
  const Vec2 along = reading.unit.value_or(motion.unit) * direction_of(reading.direction);
  for (const double a : motion.acceleration) {
    record.time.push_back(motion.step * static_cast<double>(record.time.size()));
    record.acceleration.push_back(a * along);
  }
  integrate(record);
  return record;
}

Fault fault_in(const std::string& path, const std::string& key, int line, std::string problem,
               std::string remedy) {
  return {{key, path, line, line > 0 ? 1 : 0}, std::move(problem), std::move(remedy)};
}

}  // namespace

void integrate(Accelerogram& r) {
  r.velocity.assign(r.time.size(), Vec2{});
  for (std::size_t k = 1; k < r.time.size(); ++k) {
    r.velocity[k] = r.velocity[k - 1] + (0.5 * (r.time[k] - r.time[k - 1])) *
                                            (r.acceleration[k - 1] + r.acceleration[k]);
  }
}

Result<Accelerogram> parse_acceleration_rows(std::string_view text, const RecordReading& reading,
                                             const std::string& path, const std::string& key) {
  const RecordTable table = record_table(text);
  const bool one = table.columns == 2;
  const std::vector<std::vector<std::string_view>> names{
      {"time", "t"}, {"ax", "x", "acceleration", "acc", "accel", "a"}, {"ay", "y"}};
  const RowShape shape = one ? RowShape{2,
                                        "two numbers",
                                        "write time,acceleration",
                                        "0.005,-0.12",
                                        {names[0], names[1]}}
                             : RowShape{3,
                                        "three numbers",
                                        "write time,ax,ay",
                                        "0.005,-0.12,0.03",
                                        {names[0], {"ax", "x"}, names[2]}};
  const Result<std::vector<double>> rows = parse_rows(table.text, shape, path, key);
  if (!rows) {
    Fault fault = rows.faults().front();
    if (table.columns != 2 && table.columns != 3) fault.remedy += std::string("; ") + records_read;
    return fault;
  }
  const std::optional<double> unit = reading.unit ? reading.unit : table.unit;
  if (one && !unit) {
    return fault_in(path, key, table.line,
                    "has two columns, time and one component, and does not state its unit",
                    "write shaking.units = \"g\" or \"m/s2\", or the unit in the header, such as "
                    "time (s),acceleration (g)");
  }
  Accelerogram record;
  record.unit_known = unit.has_value();
  record.read_as = std::string(one ? "time and one component" : "time, ax and ay") + " in " +
                   unit_text(unit.value_or(1.0));
  const double size = unit.value_or(1.0);
  const Vec2 along = direction_of(reading.direction);
  for (std::size_t k = 0; k < rows.value().size(); k += shape.columns) {
    const double* row = rows.value().data() + k;
    record.time.push_back(row[0]);
    record.acceleration.push_back(one ? (size * row[1]) * along : size * Vec2{row[1], row[2]});
  }
  if (record.time.front() < 0.0) {
    return fault_in(path, key, 0, "begins before time 0", "let its times begin at 0");
  }
  integrate(record);
  return record;
}

Result<Accelerogram> parse_at2(std::string_view text, const RecordReading& reading,
                               const std::string& path, const std::string& key) {
  constexpr int longest_head = 10;
  double unit = reading.unit.value_or(standard_gravity);
  std::optional<Header> header;
  int line = 0;
  while (!header && !text.empty() && line < longest_head) {
    const std::string head = upper(next_line(text));
    ++line;
    const std::size_t units = head.find("UNITS OF ");
    if (units != std::string::npos && head.substr(units + 9, 1) != "G" && !reading.unit) {
      unit = acceleration_unit(head.substr(units + 9)).value_or(0.0);
      if (unit == 0.0) {
        return fault_in(path, key, line, "is not in units of g",
                        "write shaking.units, or give a CSV file of time,ax,ay in m/s2");
      }
    }
    if (head.find("NPTS") == std::string::npos) continue;
    header = header_of(head);
    if (!header) {
      return fault_in(path, key, line, "gives no NPTS and DT",
                      "write them as in NPTS= 4000, DT= .0050 SEC");
    }
  }
  if (!header) {
    return fault_in(path, key, 0, "has no line with NPTS and DT at its head", records_read);
  }
  Accelerogram record;
  record.unit_known = true;
  record.read_as = "PEER record in " + unit_text(unit);
  const Vec2 along = unit * direction_of(reading.direction);
  while (!text.empty()) {
    std::string_view row = next_line(text);
    ++line;
    while (true) {
      const std::string_view word = next_word(row);
      if (word.empty()) break;
      double value = 0.0;
      if (!parse_number(word, value)) {
        return fault_in(path, key, line, "holds something that is no number",
                        "give accelerations in g, separated by blanks");
      }
      record.time.push_back(header->step * static_cast<double>(record.time.size()));
      record.acceleration.push_back(value * along);
    }
  }
  if (record.time.size() != header->points) {
    return fault_in(path, key, 0,
                    fmt::format("holds {} accelerations where its head says NPTS = {}",
                                record.time.size(), header->points),
                    "give the whole record");
  }
  integrate(record);
  return record;
}

Result<Accelerogram> read_accelerogram(const std::string& path, const RecordReading& reading,
                                       const std::string& key) {
  const std::variant<std::string, Fault> text = file_text(path);
  if (const Fault* fault = std::get_if<Fault>(&text)) {
    Fault named = *fault;
    named.where.key = key;
    return named;
  }
  const std::string& whole = std::get<std::string>(text);
  if (upper(path).ends_with(".AT2")) return parse_at2(whole, reading, path, key);
  if (const auto found = read_strong_motion(whole, reading.component, path, key)) {
    if (!found->ok()) return found->faults();
    return accelerogram_of(found->value(), reading);
  }
  if (has_peer_head(whole)) return parse_at2(whole, reading, path, key);
  return parse_acceleration_rows(whole, reading, path, key);
}

Vec2 acceleration_at(const Shaking& s, double t) {
  if (!s.acceleration.file.empty()) return s.scale * at(s.record, t).acceleration;
  if (t < 0.0) return {};
  const double angle = 2.0 * std::numbers::pi * *s.acceleration.frequency * t;
  return (s.scale * *s.acceleration.amplitude * std::sin(angle)) *
         direction_of(s.acceleration.direction);
}

Vec2 velocity_at(const Shaking& s, double t) {
  if (!s.acceleration.file.empty()) return s.scale * at(s.record, t).velocity;
  if (t < 0.0) return {};
  const double rate = 2.0 * std::numbers::pi * *s.acceleration.frequency;
  return (s.scale * *s.acceleration.amplitude * (1.0 - std::cos(rate * t)) / rate) *
         direction_of(s.acceleration.direction);
}

}  // namespace edda
