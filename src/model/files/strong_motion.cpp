#include "model/files/strong_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/text.hpp"
#include "model/files/csv_rows.hpp"

namespace edda {
namespace {

constexpr double gal = 0.01;  // m/s2

std::string small(std::string_view text) {
  std::string copy(text);
  for (char& c : copy) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return copy;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The first number in a text, such as the 100 of "100Hz".
std::optional<double> number_in(std::string_view text) {
  const std::size_t begin = text.find_first_of("0123456789.+-");
  if (begin == std::string_view::npos) return std::nullopt;
  text.remove_prefix(begin);
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  double value = 0.0;
  for (std::size_t n = end; n > 0; --n) {
    if (parse_number(text.substr(0, n), value)) return value;
  }
  return std::nullopt;
}

/// The text after `name`, wherever that stands in the line; nothing where it does not.
std::optional<std::string> after(std::string_view line, std::string_view name) {
  const std::string low = small(line);
  const std::size_t at = low.find(name);
  if (at == std::string::npos) return std::nullopt;
  return low.substr(at + name.size());
}

class MotionReader {
 public:
  MotionReader(std::string_view text, int component, const std::string& path,
               const std::string& key)
      : lines_(lines_of(text)), component_(component), path_(path), key_(key) {}

  std::optional<Result<StrongMotion>> read() {
    if (lines_.empty()) return std::nullopt;
    const std::string first = small(lines_[0]);
    if (first.starts_with("origin time")) return k_net();
    if (cosmos_data(0, 1)) return cosmos();
    if (first.find("corrected accelerogram") != std::string::npos) return geonet();
    for (std::size_t i = 0; i < std::min<std::size_t>(lines_.size(), 80); ++i) {
      if (small(lines_[i]).starts_with("sampling_interval_s:")) return esm();
    }
    return std::nullopt;
  }

 private:
  /// 17 lines of head, then counts in lines of eight. The counts have an offset, which is taken off
  /// unless the largest acceleration that the head states is that with it.
  Result<StrongMotion> k_net() const {
    StrongMotion record;
    double scale = 0.0, largest = 0.0;
    std::size_t i = 0;
    for (; i < lines_.size(); ++i) {
      if (const auto rate = after(lines_[i], "sampling freq(hz)")) {
        record.step = 1.0 / number_in(*rate).value_or(0.0);
      }
      if (const auto factor = after(lines_[i], "scale factor")) {
        const auto top = number_in(*factor), bottom = number_in(after(*factor, "/").value_or(""));
        if (top && bottom) scale = *top / *bottom;
      }
      if (const auto most = after(lines_[i], "max. acc. (gal)"))
        largest = number_in(*most).value_or(0.0);
      if (small(lines_[i]).starts_with("memo")) break;
    }
    if (i == lines_.size()) return fault(0, "has no line Memo. at the end of its K-NET head");
    if (auto bad = no_step(record.step)) return *bad;
    if (!(scale > 0.0)) return fault(0, "has no Scale Factor in its K-NET head");
    if (auto bad = values(i + 1, lines_.size(), 0, 0, record.acceleration)) return *bad;
    if (record.acceleration.empty()) return fault(0, "has no accelerations after its head");
    for (double& a : record.acceleration) a *= scale * gal;
    record.read_as = "K-NET record in gal";
    if (!has_largest(record.acceleration, largest * gal)) take_off_mean(record.acceleration);
    return record;
  }

  static bool has_largest(const std::vector<double>& a, double largest) {
    double most = 0.0;
    for (const double x : a) most = std::max(most, std::abs(x));
    constexpr double near = 0.005;
    return std::abs(most - largest) <= near * largest;
  }

  static void take_off_mean(std::vector<double>& a) {
    const double mean = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
    for (double& x : a) x -= mean;
  }

  /// Lines "NAME: value", then one acceleration in each line.
  Result<StrongMotion> esm() const {
    StrongMotion record;
    double points = 0.0;
    std::string unit;
    std::size_t i = 0;
    double number = 0.0;
    for (; i < lines_.size() && !parse_number(lines_[i], number); ++i) {
      const std::string_view line = lines_[i];
      if (const auto step = after(line, "sampling_interval_s:")) {
        record.step = number_in(*step).value_or(0.0);
      }
      if (line.starts_with("NDATA:")) points = number_in(line).value_or(0.0);
      if (line.starts_with("UNITS:")) unit = trimmed(line.substr(6));
      if (line.starts_with("DATA_TYPE:") && small(line).find("acceleration") == std::string::npos) {
        return fault(static_cast<int>(i) + 1, "is no record of accelerations: " + clean(line));
      }
    }
    if (auto bad = no_step(record.step)) return *bad;
    if (auto bad = take_unit(unit, record.unit)) return *bad;
    if (auto bad = values(i, lines_.size(), 0, 0, record.acceleration)) return *bad;
    if (auto bad = wrong_count(record, points)) return *bad;
    record.read_as = "ESM record in " + clean(unit);
    return record;
  }

  /// For each component 16 lines of text, ten of ten numbers, then the accelerations in mm/s/s, ten
  /// in a line of columns of eight; in corrected records velocities and displacements follow.
  Result<StrongMotion> geonet() const {
    constexpr std::size_t text_rows = 16, head_rows = 10, columns = 10, width = 8;
    std::size_t at = 0;
    for (int k = 1;; ++k) {
      if (at + text_rows + head_rows >= lines_.size()) return no_component(k - 1);
      std::vector<double> head;
      if (auto bad = values(at + text_rows, at + text_rows + head_rows, 0, 0, head)) return *bad;
      if (head.size() < head_rows * columns) {
        return fault(static_cast<int>(at + text_rows) + 1,
                     "does not have ten lines of ten numbers in its GeoNet head");
      }
      const bool raw = small(lines_[at]).find("uncorrected") != std::string::npos;
      const double points = head[raw ? 30 : 33];
      StrongMotion record;
      record.step = raw ? 1.0 / head[40] : head[65];
      record.unit = 1e-3;
      record.read_as = fmt::format("GeoNet record in mm/s2, component {}", component_);
      const auto rows_of = [&](double n) {
        return static_cast<std::size_t>(std::ceil(std::clamp(n, 0.0, 1e8) / columns));
      };
      const std::size_t begin = at + text_rows + head_rows, rows = rows_of(points);
      if (k == component_) {
        if (auto bad = no_step(record.step)) return *bad;
        const std::size_t end = std::min(begin + rows, lines_.size());
        if (auto bad = values(begin, end, width, 0, record.acceleration)) return *bad;
        if (auto bad = wrong_count(record, points)) return *bad;
        return record;
      }
      at = begin + rows + (raw ? 0 : rows_of(head[34]) + rows_of(head[35]));
    }
  }

  /// The line that announces the accelerations of a component: "5000 acceleration pts, approx 25
  /// secs, units=cm/sec2(4), Format=(8f10.5)", or "5000 points of accel data equally spaced at .005
  /// sec, in cm/sec2. (8f10.3)".
  std::optional<std::size_t> cosmos_data(std::size_t from, int component) const {
    for (std::size_t i = from; i < lines_.size(); ++i) {
      const std::string low = small(lines_[i]);
      const bool announces = low.find("acceleration pts") != std::string::npos ||
                             low.find("points of accel data") != std::string::npos;
      if (announces && --component == 0) return i;
    }
    return std::nullopt;
  }

  Result<StrongMotion> cosmos() const {
    const auto at = cosmos_data(0, component_);
    if (!at) {
      int there = 0;
      while (cosmos_data(0, there + 1)) ++there;
      return no_component(there);
    }
    const std::string line = small(lines_[*at]);
    StrongMotion record;
    std::string unit;
    if (const auto spaced = after(line, "spaced at")) {
      record.step = number_in(*spaced).value_or(0.0);
      unit = after(*spaced, ", in ").value_or("");
    } else {
      record.step = step_of_head(*at);
      unit = after(line, "units=").value_or("");
    }
    unit = unit.substr(0, unit.find_first_of(",("));
    while (unit.ends_with('.') || unit.ends_with(' ')) unit.pop_back();
    if (auto bad = no_step(record.step)) return *bad;
    if (auto bad = take_unit(unit, record.unit)) return *bad;
    record.read_as = fmt::format("COSMOS record in {}, component {}", clean(unit), component_);
    const double points = number_in(line).value_or(0.0);
    const std::size_t format = line.rfind('(');
    const std::string shape = format == std::string::npos ? std::string{} : line.substr(format);
    const std::size_t letter = shape.find_first_of("fe");
    const double width =
        letter == std::string::npos ? 0.0 : number_in(shape.substr(letter + 1)).value_or(0.0);
    const auto most = static_cast<std::size_t>(std::clamp(points, 1.0, 1e8));
    if (auto bad = values(*at + 1, lines_.size(), static_cast<std::size_t>(std::max(width, 0.0)),
                          most, record.acceleration)) {
      return *bad;
    }
    if (auto bad = wrong_count(record, points)) return *bad;
    return record;
  }

  /// Number 62 of the real header before a line is the step in milliseconds.
  double step_of_head(std::size_t before) const {
    for (std::size_t i = before; i-- > 0;) {
      if (small(lines_[i]).find("real-header values follow") == std::string::npos) continue;
      const std::string shape = after(lines_[i], "format").value_or("");
      const std::size_t letter = shape.find('f');
      const double width =
          letter == std::string::npos ? 0.0 : number_in(shape.substr(letter + 1)).value_or(0.0);
      constexpr std::size_t place = 62;
      std::vector<double> head;
      if (values(i + 1, before, static_cast<std::size_t>(std::max(width, 0.0)), place, head)) break;
      return head.size() < place ? 0.0 : 1e-3 * head[place - 1];
    }
    return 0.0;
  }

  /// The numbers of the lines [from, to): in columns of `width`, or between blanks where that is 0;
  /// at most `most` of them, unless that is 0.
  std::optional<Fault> values(std::size_t from, std::size_t to, std::size_t width, std::size_t most,
                              std::vector<double>& found) const {
    for (std::size_t i = from; i < to; ++i) {
      std::string_view line = lines_[i];
      while (!trimmed(line).empty()) {
        if (most != 0 && found.size() == most) return std::nullopt;
        if (width == 0) line.remove_prefix(line.find_first_not_of(" \t"));
        const std::size_t n = width == 0 ? std::min(line.find_first_of(" \t"), line.size())
                                         : std::min(width, line.size());
        const std::string_view word = trimmed(line.substr(0, n));
        line.remove_prefix(n);
        if (word.empty()) continue;
        double value = 0.0;
        if (!parse_number(word, value)) {
          return fault(static_cast<int>(i) + 1, "has \"" + clean(word) + "\" in place of a number");
        }
        found.push_back(value);
      }
    }
    return std::nullopt;
  }

  std::optional<Fault> no_step(double step) const {
    if (step > 0.0 && std::isfinite(step)) return std::nullopt;
    return fault(0, "does not state the step between its accelerations");
  }

  std::optional<Fault> take_unit(const std::string& name, double& unit) const {
    const auto known = acceleration_unit(name);
    if (!known) {
      return fault(0, name.empty() ? std::string("does not state the unit of its accelerations")
                                   : "is in \"" + clean(name) + "\", which is no known unit");
    }
    unit = *known;
    return std::nullopt;
  }

  std::optional<Fault> wrong_count(const StrongMotion& record, double points) const {
    if (static_cast<double>(record.acceleration.size()) == points && points > 0.0)
      return std::nullopt;
    return fault(0, fmt::format("holds {} accelerations where its head says {}",
                                record.acceleration.size(), points));
  }

  Fault no_component(int there) const {
    return Fault{{key_, path_, 0, 0},
                 fmt::format("has {} component{}, and number {} is asked for", there,
                             there == 1 ? "" : "s", component_),
                 "change shaking.component"};
  }

  static std::string clean(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown;
    for (const char c : trimmed(text).substr(0, longest)) {
      const auto byte = static_cast<unsigned char>(c);
      shown += byte < 0x20U || byte >= 0x7FU ? '?' : c;
    }
    return shown;
  }

  Fault fault(int line, std::string problem) const {
    return Fault{
        {key_, path_, line, line > 0 ? 1 : 0},
        std::move(problem),
        "give the whole record as its network has it, or a CSV file of time,ax,ay in m/s2"};
  }

  std::vector<std::string_view> lines_;
  int component_;
  const std::string& path_;
  const std::string& key_;
};

}  // namespace

std::optional<double> acceleration_unit(std::string_view name) {
  std::string plain;
  for (const char c : small(trimmed(name))) {
    if (c != ' ' && c != '^' && c != '*' && c != '.') plain += c;
  }
  for (const auto& [shorter, longer] :
       {std::pair("s", "secs"), std::pair("s", "sec"), std::pair("s", "second")}) {
    for (std::size_t at = plain.find(longer); at != std::string::npos; at = plain.find(longer)) {
      plain.replace(at, std::string_view(longer).size(), shorter);
    }
  }
  struct Unit {
    std::string_view name;
    double size;
  };
  constexpr double g = 9.80665;
  constexpr std::array units{Unit{"g", g},        Unit{"mg", 1e-3 * g}, Unit{"gal", gal},
                             Unit{"gals", gal},   Unit{"cm/s2", gal},   Unit{"cm/s/s", gal},
                             Unit{"m/s2", 1.0},   Unit{"m/s/s", 1.0},   Unit{"ms-2", 1.0},
                             Unit{"mm/s2", 1e-3}, Unit{"mm/s/s", 1e-3}, Unit{"cms-2", gal}};
  const auto* const known =
      std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.name == plain; });
  if (known == units.end()) return std::nullopt;
  return known->size;
}

std::optional<Result<StrongMotion>> read_strong_motion(std::string_view text, int component,
                                                       const std::string& path,
                                                       const std::string& key) {
  return MotionReader(text, component, path, key).read();
}

}  // namespace edda
