// The commands of the program. Each adds itself to the command line; its callback sets the exit
// code.
#pragma once

#include <CLI/CLI.hpp>

namespace edda {

namespace exit_code {
inline constexpr int done = 0, failed = 1, bad_input = 2, interrupted = 130;
}

void add_run(CLI::App& app, int& code);
void add_check(CLI::App& app, int& code);
void add_cut(CLI::App& app, int& code);
void add_verify(CLI::App& app, int& code);
void add_fos(CLI::App& app, int& code);
void add_limit(CLI::App& app, int& code);
void add_keyblocks(CLI::App& app, int& code);
void add_fit(CLI::App& app, int& code);
void add_study(CLI::App& app, int& code);
void add_plot(CLI::App& app, int& code);
void add_spectra(CLI::App& app, int& code);
void add_view(CLI::App& app, int& code);
void add_example(CLI::App& app, int& code);
void add_keys(CLI::App& app, int& code);
void add_columns(CLI::App& app, int& code);
/// To be called after all others, since they print what the others have added.
void add_completion(CLI::App& app, int& code);
void add_man(CLI::App& app, int& code);

}  // namespace edda
