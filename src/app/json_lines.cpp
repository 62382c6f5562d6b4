#include "app/json_lines.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>

#include "app/common.hpp"

namespace edda {

Json event(std::string_view name) {
  Json json;
  json.open_object().pair("event", name);
  return json;
}

void print_line(Json& object) {
  object.close();
  fmt::print("{}\n", object.line());
  if (std::fflush(stdout) != 0) output_was_lost(errno);
}

void print_json(const Faults& faults) {
  for (const Fault& f : faults) {
    Json json = event("fault");
    json.pair("file", f.where.file).pair("line", f.where.line).pair("column", f.where.column);
    json.pair("key", f.where.key).pair("problem", f.problem).pair("remedy", f.remedy);
    print_line(json);
  }
}

void print_json_warning(const std::string& message) {
  Json json = event("warning");
  json.pair("message", message);
  print_line(json);
}

}  // namespace edda
