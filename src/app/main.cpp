// The program: reads the command line and calls one command.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

#include "app/commands.hpp"
#include "app/common.hpp"
#include "app/first_word.hpp"
#include "results/version.hpp"

namespace {

int run_command(int argc, char** argv) {
  int code = edda::exit_code::done;
  CLI::App app{
      "edda computes the motion of jointed rock over time: blocks cut by joints, contacts with "
      "friction\n"
      "(explicit discontinuous deformation analysis).\n"
      "\n"
      "A first run in five commands:\n"
      "  edda example ramp          writes ramp.toml, a model to read and to change\n"
      "  edda check ramp.toml       checks the model, and estimates the time of the run\n"
      "  edda run ramp.toml         computes it; results go to the folder ramp/\n"
      "  edda plot ramp             draws the last state into ramp.png\n"
      "  edda view ramp             ramp.html replays it in a browser\n",
      "edda"};
  app.set_version_flag("--version", "edda " + std::string(edda::version));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Each command has a --help of its own.\n"
      "Exit codes: 0 done, 1 the run failed, 2 bad usage or bad model, 130 interrupted.");
  edda::add_run(app, code);
  edda::add_check(app, code);
  edda::add_cut(app, code);
  edda::add_verify(app, code);
  edda::add_fos(app, code);
  edda::add_limit(app, code);
  edda::add_keyblocks(app, code);
  edda::add_study(app, code);
  edda::add_fit(app, code);
  edda::add_plot(app, code);
  edda::add_spectra(app, code);
  edda::add_view(app, code);
  edda::add_example(app, code);
  edda::add_keys(app, code);
  edda::add_columns(app, code);
  edda::add_completion(app, code);
  edda::add_man(app, code);
  if (const auto problem = edda::not_a_command(app, argc, argv)) {
    std::fprintf(stderr, "edda: %s\n", problem->c_str());
    return edda::exit_code::bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? edda::exit_code::done : edda::exit_code::bad_input;
  }
  return code;
}

/// The last output may have been lost, for example on a full disk. A closed pipe is not an error.
int after_output(int code) {
  if (std::fflush(stdout) != 0) edda::output_was_lost(errno);
  if (std::ferror(stdout) != 0) edda::output_was_lost(EIO);  // from an unknown cause
  const int why = edda::why_output_was_lost();
  if (why == 0 || why == EPIPE) return code;
  std::fprintf(stderr, "edda: standard output cannot be written: %s\n", std::strerror(why));
  return code == edda::exit_code::done ? edda::exit_code::failed : code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return after_output(run_command(argc, argv));
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "edda: out of memory: close other programs, or make the model smaller\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edda: %s\n", error.what());
  }
  return edda::exit_code::failed;
}
