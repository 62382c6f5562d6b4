// edda completion
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/completion.hpp"

namespace edda {

void add_completion(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "completion", "Print the script that makes a shell complete edda's commands and options");
  command->footer(
      "Examples:\n"
      "  edda completion bash > ~/.local/share/bash-completion/completions/edda\n"
      "  edda completion zsh > ~/.zfunc/_edda          where ~/.zfunc is in fpath\n"
      "  edda completion fish > ~/.config/fish/completions/edda.fish\n"
      "\n"
      "An installed edda has put them where shells look for them. They complete commands, "
      "options,\n"
      "models, folders, fields, the names of examples and tables.");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "Which one")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([shell, &app, &code] {
    const ProgramText program = describe(app);
    fmt::print("{}", *shell == "bash"  ? bash_completion(program)
                     : *shell == "zsh" ? zsh_completion(program)
                                       : fish_completion(program));
    code = exit_code::done;
  });
}

}  // namespace edda
