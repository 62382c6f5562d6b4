#include "base/fault.hpp"

namespace edda {

std::string to_string(const Fault& fault) {
  std::string text;
  if (!fault.where.file.empty()) {
    text += fault.where.file;
    if (fault.where.line > 0) {
      text += ':' + std::to_string(fault.where.line) + ':' + std::to_string(fault.where.column);
    }
    text += ": ";
  }
  if (!fault.where.key.empty()) text += fault.where.key + ": ";
  text += fault.problem;
  if (!fault.remedy.empty()) text += ": " + fault.remedy;
  return text;
}

}  // namespace edda
