#include "model/files/input_file.hpp"

#include "model/files/file_text.hpp"

#include <filesystem>

#include "model/files/time_history.hpp"

namespace edda {

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
