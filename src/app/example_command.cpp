// edda example
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>

#include "app/common.hpp"
#include "app/examples.hpp"

namespace edda {
namespace {

/// Read from its text, since some examples read tables that are not present.
std::string title_of(const Example& example) {
  const std::string_view text = example.text, key = "\ntitle = \"";
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + key.size();
  return std::string(text.substr(from, text.find('"', from) - from));
}

int list() {
  fmt::print("Built-in models (edda example NAME writes NAME.toml here):\n");
  for (const Example& e : built_in_examples()) fmt::print("  {:<18} {}\n", e.name, title_of(e));
  return exit_code::done;
}

/// Never overwrites a file: the mode "x" refuses an existing one.
int write_new(const std::string& path, const char* text) {
  std::FILE* file = std::fopen(path.c_str(), "wx");
  if (file == nullptr) {
    const bool there = errno == EEXIST;
    fmt::print(
        stderr, "{}: {}: {}\n", path, there ? "is there already" : std::strerror(errno),
        there ? "move it away, or go to another folder" : "see that this folder may be written to");
    return exit_code::bad_input;
  }
  const std::size_t size = std::strlen(text);
  const bool written = std::fwrite(text, 1, size, file) == size;
  if (std::fclose(file) != 0 || !written) {
    fmt::print(stderr, "{}: could not be written whole: free some disk space\n", path);
    return exit_code::failed;
  }
  return exit_code::done;
}

bool holds(const std::string& path, const std::string& text) {
  std::ifstream file(path, std::ios::binary);
  return file && std::string(std::istreambuf_iterator<char>(file), {}) == text;
}

int write(const Example& example) {
  const std::string path = std::string(example.name) + ".toml", table = example.table_name;
  // The model alone would be unusable. Another one may have the same table.
  const bool new_table = !table.empty() && !holds(table, example.table);
  if (new_table) {
    if (const int code = write_new(table, example.table); code != exit_code::done) return code;
  }
  if (const int code = write_new(path, example.text); code != exit_code::done) {
    if (new_table) std::remove(table.c_str());
    return code;
  }
  fmt::print("wrote {0}{1}; next: edda check {0}, edda run {0}\n", path,
             table.empty() ? "" : " and " + table);
  return exit_code::done;
}

int example(const std::string& name) {
  if (name.empty()) return list();
  for (const Example& e : built_in_examples()) {
    if (name == e.name) return write(e);
  }
  fmt::print(stderr, "edda: example: there is no model \"{}\": edda example lists them\n", name);
  return exit_code::bad_input;
}

}  // namespace

void add_example(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("example", "List the built-in models, or write one to start from");
  command->footer(
      "Example:\n  edda example           lists them\n  edda example cavern    writes cavern.toml, "
      "never over a file");
  auto name = std::make_shared<std::string>();
  command->add_option("NAME", *name, "Which one")->type_name("EXAMPLE");
  command->callback([name, &code] { code = example(*name); });
}

}  // namespace edda
