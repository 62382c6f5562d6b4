// edda keys: the reference of a model's keys.
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/common.hpp"
#include "model/study/study_plan.hpp"
#include "model/table/key_reference.hpp"
#include "model/table/keys.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

int run(const std::string& name) {
  if (name.empty()) {
    fmt::print("{}", key_reference());
    return exit_code::done;
  }
  const std::string text = key_reference(name);
  if (!text.empty()) {
    fmt::print("{}", text);
    return exit_code::done;
  }
  std::vector<std::string_view> known;
  for (const Section& section : sections()) {
    if (section.shape != Shape::root) known.push_back(section.name);
  }
  print({Fault{{"", name, 0, 0}, "is no table of a model file", suggestion(name, known)}});
  return exit_code::bad_input;
}

}  // namespace

void add_keys(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("keys", "Print the reference of a model file's keys");
  command->footer("Example:\n  edda keys stage");
  auto name = std::make_shared<std::string>();
  command->add_option("TABLE", *name, "One table alone, such as stage or solver")
      ->type_name("TABLE");
  auto study = std::make_shared<bool>(false);
  command->add_flag("--study", *study, "The keys of a study's file (edda study)");
  command->callback([name, study, &code] {
    if (*study) {
      fmt::print("{}", study_key_reference());
      code = exit_code::done;
    } else {
      code = run(*name);
    }
  });
}

}  // namespace edda
