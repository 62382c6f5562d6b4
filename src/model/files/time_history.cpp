#include "model/files/time_history.hpp"

#include <algorithm>
#include <variant>

#include "model/files/csv_rows.hpp"
#include "model/files/file_text.hpp"

namespace edda {
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
  const RowShape shape{2,
                       "two numbers",
                       "write time,value",
                       "0.5,1.0",
                       {{"time", "t"}, {"value", "factor", "rise"}}};
  const Result<std::vector<double>> rows = parse_rows(text, shape, path, key);
  if (!rows) return rows.faults();
  TimeHistory history;
  for (std::size_t k = 0; k < rows.value().size(); k += 2) {
    history.time.push_back(rows.value()[k]);
    history.value.push_back(rows.value()[k + 1]);
  }
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
  for (const Boundary& boundary : model.boundaries) add(boundary.history);
  for (const Shaking& shaking : model.shakings) add(shaking.acceleration.file);
  return files;
}

}  // namespace edda
