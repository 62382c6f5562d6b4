// edda man: hidden; the build makes edda.1 of it.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <memory>

#include "app/commands.hpp"
#include "app/man_page.hpp"
#include "results/version.hpp"

namespace edda {

void add_man(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page, in troff")->group("");
  auto date = std::make_shared<std::string>();
  command->add_option("--date", *date, "Date of the page, as 2026-01-31 (default: today)");
  command->callback([date, &app, &code] {
    const std::string day =
        date->empty() ? fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))) : *date;
    fmt::print("{}", man_page(describe(app), std::string(version), day));
    code = exit_code::done;
  });
}

}  // namespace edda
