#include "model/time_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <variant>

#include "model/file_text.hpp"

namespace edda {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// The whole of `text` as a finite number.
bool read(std::string_view text, double& value) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && error == std::errc{} && end == text.data() + text.size() &&
         std::isfinite(value);
}

/// What a column may be called: begins with a letter, and is not one of the words for numbers.
bool is_name(std::string_view text) {
  text = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         error == std::errc::invalid_argument;
}

}  // namespace

double TimeHistory::at(double t, double otherwise) const {
  if (time.empty()) return otherwise;
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  if (after == time.begin()) return value.front();
  if (after == time.end()) return value.back();
  const auto k = static_cast<std::size_t>(after - time.begin());
  const double part = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return value[k - 1] + part * (value[k] - value[k - 1]);
}

Result<TimeHistory> parse_time_history(std::string_view text, const std::string& path,
                                       const std::string& key) {
  TimeHistory history;
  int line = 0;
  bool names_may_come = true;
  auto fault = [&](std::string problem, std::string remedy) {
    return Fault{{key, path, line, line > 0 ? 1 : 0}, std::move(problem), std::move(remedy)};
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (row.empty() || row.front() == '#') continue;
    const std::size_t comma = row.find(',');
    double time = 0.0, value = 0.0;
    const bool is_time = read(row.substr(0, comma), time);
    const bool is_value = comma != std::string_view::npos && read(row.substr(comma + 1), value);
    if (names_may_come && comma != std::string_view::npos && is_name(row.substr(0, comma)) &&
        is_name(row.substr(comma + 1))) {
      names_may_come = false;
      continue;
    }
    names_may_come = false;
    if (!is_time || !is_value)
      return fault("is not two numbers", "write time,value in each line, such as 0.5,1.0");
    if (!history.time.empty() && !(time > history.time.back())) {
      return fault(fmt::format("time {} does not come after {}", time, history.time.back()),
                   "write the rows in the order of their times, each time once");
    }
    history.time.push_back(time);
    history.value.push_back(value);
  }
  line = 0;
  if (history.time.empty()) return fault("has no rows", "write time,value in each line");
  return history;
}

Result<TimeHistory> read_time_history(const std::string& path, const std::string& key) {
  const std::variant<std::string, Fault> text = file_text(path);
  if (const Fault* fault = std::get_if<Fault>(&text)) {
    Fault named = *fault;
    named.where.key = key;
    return named;
  }
  return parse_time_history(std::get<std::string>(text), path, key);
}

std::vector<std::string> files_beside(const Model& model) {
  std::vector<std::string> files;
  auto add = [&](const std::string& file) {
    const bool known = std::find(files.begin(), files.end(), file) != files.end();
    if (!file.empty() && !known) files.push_back(file);
  };
  for (const Load& load : model.loads) add(load.history);
  for (const Water& water : model.waters) add(water.history);
  for (const Import& import : model.imports) add(import.file);
  return files;
}

}  // namespace edda
