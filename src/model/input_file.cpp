#include "model/input_file.hpp"

#include <filesystem>

#include "model/time_history.hpp"

namespace edda {

std::string beside_model(const std::string& path, const std::string& model_file) {
  const std::filesystem::path found = std::filesystem::path(model_file).parent_path() / path;
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(found, error);
  return (error ? found : whole).string();
}

void blame(const Fault& fault, const std::string& path, Place place, Reading& reading) {
  if (fault.where.line > 0) {
    reading.faults.push_back(fault);
    return;
  }
  add_fault(reading, place, fault.where.key, path + " " + fault.problem, fault.remedy);
}

void read_history(const Value* node, const std::string& element, std::string& path,
                  TimeHistory& history, Reading& reading) {
  if (path.empty()) return;
  path = beside_model(path, reading.model.file);
  Result<TimeHistory> read = read_time_history(path, element + ".history");
  if (read) {
    history = std::move(read.value());
    return;
  }
  blame(read.faults().front(), path, find(node, "history")->place, reading);
}

}  // namespace edda
