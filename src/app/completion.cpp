#include "app/completion.hpp"

#include <fmt/format.h>

namespace edda {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : between) + w;
  return text;
}

/// Between single quotes for a shell; `quote` is how it writes one within.
std::string quoted(const std::string& text, const std::string& quote) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += quote;
    } else {
      out += c;
    }
  }
  return out + "'";
}

/// The first line, short enough for a list.
std::string brief(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string all_names(const std::vector<OptionText>& options) {
  std::string names;
  for (const OptionText& o : options) names += (names.empty() ? "" : " ") + joined(o.names, " ");
  return names;
}

// bash

std::string bash_values(const OptionText& o) {
  if (!o.choices.empty()) return fmt::format("_edda_words '{}'", joined(o.choices, " "));
  switch (o.files) {
    case Files::any:
      return "_edda_files";
    case Files::models:
      return "_edda_models";
    case Files::folders:
      return "_edda_folders";
    case Files::folders_or_models:
      return "_edda_models";  // which also offers folders
    case Files::nothing:
      break;
  }
  return ":";
}

std::string bash_command(const CommandText& c) {
  std::string text = fmt::format("    {})\n      case $previous in\n", c.name);
  for (const OptionText& o : c.options) {
    if (o.value.empty()) continue;
    text += fmt::format("        {}) {}; return ;;\n", joined(o.names, "|"), bash_values(o));
  }
  text += fmt::format(
      "      esac\n"
      "      if [[ $current == -* ]]; then\n"
      "        _edda_words '{}'\n"
      "      else\n"
      "        {}\n"
      "{}"
      "      fi ;;\n",
      all_names(c.options), c.positional ? bash_values(*c.positional) : ":",
      c.inner.empty() ? ""
                      : fmt::format("        ((COMP_CWORD == 2)) && COMPREPLY+=($(compgen -W '{}' "
                                    "-- \"$current\"))\n",
                                    joined(c.inner, " ")));
  return text;
}

constexpr const char* bash_head = R"(# bash completion of edda. Made by: edda completion bash

_edda_words() { COMPREPLY=($(compgen -W "$1" -- "$current")); }

# Names with blanks stay whole.
_edda_names() { local IFS=$'\n'; COMPREPLY=($(compgen "$@" -- "$current")); }
_edda_files() { compopt -o filenames 2>/dev/null; _edda_names -f; }
_edda_folders() { compopt -o filenames 2>/dev/null; _edda_names -d; }
_edda_models() {
  local models
  compopt -o filenames 2>/dev/null
  _edda_names -f -X '!*.toml'
  models=("${COMPREPLY[@]}")
  _edda_names -d
  COMPREPLY=("${models[@]}" "${COMPREPLY[@]}")
}

_edda() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
)";

// zsh

/// Within _arguments, colons and brackets mean something.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : brief(text)) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_values(const OptionText& o) {
  if (!o.choices.empty()) return "(" + joined(o.choices, " ") + ")";
  switch (o.files) {
    case Files::any:
      return "_files";
    case Files::folders:
      return "_files -/";
    case Files::models:
    case Files::folders_or_models:
      return "_files -g \"*.toml(-.)\" -g \"*(-/)\"";
    case Files::nothing:
      break;
  }
  return " ";
}

std::string zsh_option(const OptionText& o) {
  std::string text;
  for (const std::string& name : o.names) {
    std::string spec = "*" + name + "[" + zsh_text(o.text) + "]";
    if (!o.value.empty()) spec += ":" + zsh_text(o.value) + ":" + zsh_values(o);
    text += " \\\n        " + quoted(spec, R"('\'')");
  }
  return text;
}

std::string zsh_command(const CommandText& c) {
  std::string text = fmt::format("    {})\n      _arguments", c.name);
  for (const OptionText& o : c.options) text += zsh_option(o);
  if (c.positional) {
    const std::string values =
        c.inner.empty()
            ? zsh_values(*c.positional)
            : fmt::format("_alternative \"commands:command:({})\" \"files:file:_files\"",
                          joined(c.inner, " "));
    text += " \\\n        " +
            quoted(fmt::format("1:{}:{}", zsh_text(c.positional->value), values), R"('\'')");
  }
  return text + " ;;\n";
}

// fish

std::string fish_option(const OptionText& o, const std::string& when) {
  std::string text = "complete -c edda -n " + quoted(when, "\\'");
  for (const std::string& name : o.names) {
    const bool is_long = name.starts_with("--");
    text += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
  }
  if (!o.value.empty()) text += o.files == Files::any ? " -r -F" : " -x";
  if (!o.choices.empty()) text += " -a " + quoted(joined(o.choices, " "), "\\'");
  if (o.files == Files::folders) text += " -a '(__fish_complete_directories)'";
  return text + " -d " + quoted(brief(o.text), "\\'") + "\n";
}

std::string fish_positional(const OptionText& o, const std::string& when) {
  std::string values;
  if (!o.choices.empty()) {
    values = joined(o.choices, " ");
  } else if (o.files == Files::models || o.files == Files::folders_or_models) {
    values = "(__fish_complete_suffix .toml)";
  } else if (o.files == Files::folders) {
    values = "(__fish_complete_directories)";
  }
  if (values.empty()) return {};
  return "complete -c edda -n " + quoted(when, "\\'") + " -a " + quoted(values, "\\'") + "\n";
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
  std::string text = bash_head, names;
  for (const CommandText& c : program.commands) names += c.name + " ";
  text += fmt::format("    _edda_words '{}{}'\n    return\n  fi\n  case ${{COMP_WORDS[1]}} in\n",
                      names, all_names(program.options));
  for (const CommandText& c : program.commands) text += bash_command(c);
  return text + "  esac\n}\ncomplete -F _edda edda\n";
}

std::string zsh_completion(const ProgramText& program) {
  std::string text =
      "#compdef edda\n# zsh completion of edda. Made by: edda completion zsh\n\n"
      "_edda_commands() {\n  local -a commands=(\n";
  for (const CommandText& c : program.commands) {
    text += "    " + quoted(c.name + ":" + zsh_text(c.text), R"('\'')") + "\n";
  }
  text +=
      "  )\n  _describe command commands\n}\n\n"
      "_edda() {\n  local context state line\n  typeset -A opt_args\n"
      "  _arguments -C";
  for (const OptionText& o : program.options) text += zsh_option(o);
  text +=
      " \\\n        '1:command:_edda_commands' \\\n        '*::argument:->argument'\n"
      "  [[ $state == argument ]] || return 0\n"
      "  case $line[1] in\n";
  for (const CommandText& c : program.commands) text += zsh_command(c);
  return text +
         "  esac\n}\n\n"
         "# Loaded by name it completes at once; sourced it waits to be asked.\n"
         "if [[ ${funcstack[1]} == _edda ]]; then\n  _edda \"$@\"\nelse\n  compdef _edda "
         "edda\nfi\n";
}

std::string fish_completion(const ProgramText& program) {
  std::string text =
      "# fish completion of edda. Made by: edda completion fish\n\n"
      "complete -c edda -f\n";
  const std::string no_command = "__fish_use_subcommand";
  for (const OptionText& o : program.options) text += fish_option(o, no_command);
  for (const CommandText& c : program.commands) {
    text += fmt::format("complete -c edda -n {} -a {} -d {}\n", no_command, c.name,
                        quoted(brief(c.text), "\\'"));
  }
  for (const CommandText& c : program.commands) {
    const std::string when = "__fish_seen_subcommand_from " + c.name;
    text += "\n";
    for (const OptionText& o : c.options) text += fish_option(o, when);
    if (c.positional) text += fish_positional(*c.positional, when);
    if (!c.inner.empty())
      text += "complete -c edda -n " + quoted(when, "\\'") + " -a " +
              quoted(joined(c.inner, " "), "\\'") + "\n";
  }
  return text;
}

}  // namespace edda
