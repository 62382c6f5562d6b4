// edda example
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "app/common.hpp"
#include "app/examples.hpp"
#include "model/read_model.hpp"

namespace edda {
namespace {

std::string title_of(const Example& example) {
  const Result<Model> model = read_model_text(example.text, std::string(example.name) + ".toml");
  return model.ok() ? model.value().title : std::string{};
}

int list() {
  fmt::print("Built-in models (edda example NAME writes NAME.toml here):\n");
  for (const Example& e : built_in_examples()) fmt::print("  {:<14} {}\n", e.name, title_of(e));
  return exit_code::done;
}

/// Never over a file: the mode "x" refuses one, whoever made it and when.
int write(const Example& example) {
  const std::string path = std::string(example.name) + ".toml";
  std::FILE* file = std::fopen(path.c_str(), "wx");
  if (file == nullptr) {
    const bool there = errno == EEXIST;
    fmt::print(
        stderr, "{}: {}: {}\n", path, there ? "is there already" : std::strerror(errno),
        there ? "move it away, or go to another folder" : "see that this folder may be written to");
    return exit_code::bad_input;
  }
  const std::size_t size = std::strlen(example.text);
  const bool written = std::fwrite(example.text, 1, size, file) == size;
  if (std::fclose(file) != 0 || !written) {
    fmt::print(stderr, "{}: could not be written whole: free some disk space\n", path);
    return exit_code::failed;
  }
  fmt::print("wrote {0}; next: edda check {0}, edda run {0}\n", path);
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
  command->add_option("NAME", *name, "Which one");
  command->callback([name, &code] { code = example(*name); });
}

}  // namespace edda
