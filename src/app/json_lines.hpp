// Machine-readable output of the commands: one JSON object per line on stdout, distinguished by
// "event".
#pragma once

#include "base/fault.hpp"
#include "results/json.hpp"

namespace edda {

/// An object begun, with its "event"; to be filled and given to print_line().
Json event(std::string_view name);

/// Ends the object and writes it, and flushes the output, so that a reader has it at once.
void print_line(Json& object);

/// {"event": "fault", "file", "line", "column", "key", "problem", "remedy"}
void print_json(const Faults& faults);

/// {"event": "warning", "message"}
void print_json_warning(const std::string& message);

}  // namespace edda
