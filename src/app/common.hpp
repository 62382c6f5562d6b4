// Functions that several commands share.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.hpp"
#include "base/fault.hpp"
#include "model/model.hpp"
#include "model/read_model.hpp"
#include "report/plot.hpp"

namespace edda {

/// One line per fault on stderr.
void print(const Faults& faults);
/// Or as JSON on stdout.
void print(const Faults& faults, bool json);
void print_warnings(const std::vector<std::string>& warnings);

/// Reads MODEL with its overrides. A model that does not fit into memory is a fault, too.
Result<Model> read_within_memory(const std::string& path, const std::vector<std::string>& overrides,
                                 ReadFor what_for = ReadFor::run);

/// The same; prints the faults and returns nothing if there are any.
std::optional<Model> read_or_print(const std::string& path,
                                   const std::vector<std::string>& overrides, bool json = false,
                                   ReadFor what_for = ReadFor::run);

/// Adds --json.
void add_json(CLI::App& command, bool& json, const std::string& description);

/// From now on SIGINT, SIGTERM and SIGHUP set the returned flag, so that a run ends properly; a
/// second SIGINT or SIGTERM ends the program at once. SIGPIPE is ignored: see say().
const std::atomic<bool>& stop_on_signals();

/// Records that output on standard output was lost, with its errno; the second function returns the
/// first one recorded, 0: none.
void output_was_lost(int error);
int why_output_was_lost();

/// Prints during a run; a lost reader (a closed pipe or terminal) does not end the run.
template <class Words>
void say(const Words& words) {
  try {
    words();
  } catch (const std::system_error&) {
    return;
  }
}

/// Adds --set key=value.
void add_overrides(CLI::App& command, std::vector<std::string>& overrides);

/// Adds --threads N and sets them when parsed.
void add_threads(CLI::App& command);

/// File name without folder and ending.
std::string stem_of(const std::string& path);

/// Default name of what is made from a file or a folder: the file's name without its extension, or
/// the folder's full name.
std::string name_of(const std::string& path);

/// ".svg" of "a/b.svg", in lower case.
std::string ending_of(const std::string& path);

/// Whether plot() can draw a file with this extension (as ending_of() gives it).
bool is_picture(const std::string& ending);

/// Title, material names and monitors of a picture of the model.
PlotOptions options_of(const Model& model, std::size_t blocks);

/// "3 min 20 s", "1.4 s".
std::string duration_text(double seconds);

}  // namespace edda
