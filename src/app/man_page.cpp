#include "app/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace edda {
namespace {

/// Text as it is: nothing in it is a request to troff.
std::string plain(std::string_view text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    line_begins = c == '\n';
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string bold(std::string_view text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == '\n') text.remove_prefix(1);
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  return text;
}

/// A text whose indented lines and lines after "Example:" keep their form, and whose others are
/// filled.
std::string mixed(std::string_view text) {
  std::string out;
  text = trimmed(text);
  bool set_as_is = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const bool indented = line.starts_with("  ");
    if (indented != set_as_is) out += indented ? ".EX\n" : ".EE\n";
    set_as_is = indented;
    out += line.empty() ? ".PP\n" : plain(line) + "\n";
  }
  if (set_as_is) out += ".EE\n";
  return out;
}

std::string option_entry(const OptionText& o) {
  std::string names;
  for (const std::string& name : o.names) names += (names.empty() ? "" : ", ") + bold(name);
  const std::string value = o.value.empty() ? "" : " " + italic(o.value);
  return ".TP\n" + names + value + "\n" + plain(o.text) + ".\n";
}

std::string positional_name(const OptionText& o) {
  return o.required ? italic(o.names.front()) : "[" + italic(o.names.front()) + "]";
}

std::string synopsis(const ProgramText& p) {
  std::string text = ".SH SYNOPSIS\n";
  bool first = true;
  for (const CommandText& c : p.commands) {
    text += first ? "" : ".br\n";
    first = false;
    text += bold(p.name + " " + c.name);
    if (c.positional) text += " " + positional_name(*c.positional);
    if (!c.options.empty()) text += " [" + italic("options") + "]";
    text += "\n";
  }
  return text;
}

std::string command_section(const ProgramText& p, const CommandText& c) {
  std::string text = fmt::format(".SS {} {}\n{}.\n", p.name, c.name, plain(c.text));
  if (c.positional) {
    text +=
        ".TP\n" + italic(c.positional->names.front()) + "\n" + plain(c.positional->text) + ".\n";
  }
  for (const OptionText& o : c.options) text += option_entry(o);
  if (!c.footer.empty()) text += ".PP\n" + mixed(c.footer);
  return text;
}

constexpr std::string_view exit_status =
    ".TP\n"
    "0\n"
    "Done. A slope that collapses is a result; the status in summary.json states it.\n"
    ".TP\n"
    "1\n"
    "The run failed: it diverged, or the disk was full. What had been computed is kept.\n"
    ".TP\n"
    "2\n"
    "Bad usage or a bad model. Nothing was written. Each fault is one line on stderr:\n"
    "FILE:LINE:COLUMN: key: what is wrong: what to do.\n"
    ".TP\n"
    "130\n"
    "Interrupted. What had been computed is kept, and \\fBedda run \\-\\-resume\\fR continues from "
    "there.\n";

constexpr std::string_view environment =
    ".TP\n"
    "\\fBOMP_NUM_THREADS\\fR\n"
    "Threads to use where \\fB\\-\\-threads\\fR is not given. Results do not depend on it.\n";

constexpr std::string_view files =
    ".TP\n"
    "\\fIMODEL\\fR.toml\n"
    "A model; \\fBedda keys\\fR explains every key, \\fBedda example\\fR writes one to start "
    "from.\n"
    ".TP\n"
    "\\fIDIR\\fR/summary.json\n"
    "How a run ended; written last.\n"
    ".TP\n"
    "\\fIDIR\\fR/history.csv, \\fIDIR\\fR/stages.csv, \\fIDIR\\fR/bolts.csv, "
    "\\fIDIR\\fR/linings.csv, "
    "\\fIDIR\\fR/reactions.csv\n"
    "What is recorded over time.\n"
    ".TP\n"
    "\\fIDIR\\fR/blocks.pvd, \\fIDIR\\fR/contacts.pvd, \\fIDIR\\fR/frames\n"
    "Every block and contact at each frame, for \\fBedda plot\\fR and ParaView.\n"
    ".TP\n"
    "\\fIDIR\\fR/checkpoint.h5\n"
    "Where \\fB\\-\\-resume\\fR continues from.\n";

/// The description of the program, up to its first empty line.
std::string first_paragraph(const std::string& text) {
  return text.substr(0, text.find("\n\n"));
}

std::string rest(const std::string& text) {
  const std::size_t at = text.find("\n\n");
  return at == std::string::npos ? std::string{} : text.substr(at + 2);
}

}  // namespace

std::string man_page(const ProgramText& p, const std::string& of, const std::string& date) {
  std::string title = p.name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text =
      fmt::format(".TH {} 1 \"{}\" \"{} {}\" \"User Commands\"\n", title, date, p.name, of);
  text += fmt::format(
      ".SH NAME\n{} \\- explicit discontinuous deformation analysis of jointed "
      "rock\n",
      p.name);
  text += synopsis(p);
  text += ".SH DESCRIPTION\n" + plain(first_paragraph(p.text)) + "\n";
  for (const OptionText& o : p.options) text += option_entry(o);
  text += ".SH COMMANDS\n";
  for (const CommandText& c : p.commands) text += command_section(p, c);
  text += fmt::format(".SH EXIT STATUS\n{}.SH ENVIRONMENT\n{}.SH FILES\n{}", exit_status,
                      environment, files);
  return text + ".SH EXAMPLES\n" + mixed(rest(p.text));
}

}  // namespace edda
