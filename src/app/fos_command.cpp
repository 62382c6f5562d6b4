// edda fos
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "app/analysis_command.hpp"
#include "app/mechanism_picture.hpp"
#include "base/text.hpp"
#include "results/files.hpp"
#include "study/fos.hpp"

namespace edda {
namespace {

Trouble write_results(const Model& model, const FosResult& r, const std::string& folder) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("fos.csv", fos_csv(r.trials))) return t;
  if (r.mechanism) {
    if (Trouble t = write("mechanism.csv", mechanism_csv(*r.failed, *r.mechanism))) return t;
    if (Trouble t = write("mechanism_joints.csv", mechanism_joints_csv(*r.mechanism))) return t;
    const std::string says =
        fmt::format("mechanism at factor {:.4g}: {}", *r.fails, r.mechanism->text);
    return draw_mechanism(model, *r.failed, *r.mechanism, r.size, says, folder);
  }
  return {};
}

void print_end(const FosResult& r, const std::string& folder) {
  fmt::print("{}\n", r.message);
  if (!r.proof.empty()) fmt::print("  {}\n", r.proof);
  if (r.mechanism) fmt::print("  mechanism at {:.6g}: {}\n", *r.fails, r.mechanism->text);
  const std::string lost = r.mechanism ? lost_cohesion_text(*r.mechanism) : std::string();
  if (!lost.empty()) fmt::print("  {}\n", lost);
  if (r.rigid) fmt::print("  {}\n", r.rigid->text);
  fmt::print(
      "  a trial counts as failed when {}\n",
      r.criterion.displacement
          ? fmt::format("a corner has moved by more than {:.3g} m", *r.criterion.displacement)
          : fmt::format("rigid blocks have no equilibrium in their present places, or blocks have "
                        "moved by more than {:.2g} of their size as seen from those beside them "
                        "({:.2g} where rigid blocks as drawn have none), or rock that yields by "
                        "three times what it strains until it does",
                        r.criterion.allowed, moved_little));
  fmt::print("  {}, {} of wall time; results in {}/ (fos.csv, mechanism.png)\n",
             counted(r.trials.size(), "trial"), duration_text(r.seconds), folder);
}

int code_of(FosStatus status) {
  return status == FosStatus::interrupted ? exit_code::interrupted : exit_code::done;
}

Result<AnalysisResult> fos(const Model& model, const AnalysisRun& run) {
  FosOptions options;
  options.threads = run.threads;
  options.stop = &run.stop();
  options.say = options.progress = run.say;
  Result<FosResult> found = find_factor(model, options);
  if (!found.ok()) return found.faults();
  const auto r = std::make_shared<const FosResult>(std::move(found.value()));
  AnalysisResult analysis{r->message, fos_summary(model, *r, run.threads), r->warnings};
  analysis.print = [r](const std::string& folder) { print_end(*r, folder); };
  analysis.write = [r, &model](const std::string& folder) {
    return write_results(model, *r, folder);
  };
  analysis.code = code_of(r->status);
  return analysis;
}

}  // namespace

void add_fos(CLI::App& app, int& code) {
  AnalysisCommand command{
      "fos", "Find a model's factor of safety",
      "Example:\n"
      "  edda fos slope.toml\n"
      "  edda fos dam.toml --set fos.vary=water:reservoir\n"
      "\n"
      "Brings the model to equilibrium, then tries factors: the strength of the joints divided by\n"
      "it (cohesion, tangent of the friction angle, tensile strength), or a load, a water "
      "pressure\n"
      "or a ground motion multiplied by it, until the bracket between a factor that holds and one\n"
      "that fails is no wider than the part fos.tolerance of its lower factor.\n"
      "The folder (default: the model's name without .toml and with -fos, here) then holds\n"
      "  summary.json          the factor, its bracket, the criterion, the mechanism; written "
      "last\n"
      "  fos.csv               every trial: factor, outcome, largest displacement, its block, "
      "velocity\n"
      "  mechanism.csv         which blocks move at the lowest factor that fails, and how\n"
      "  mechanism_joints.csv  along which joints;  mechanism.png, mechanism.svg: a picture\n"
      "Ctrl-C ends it early with the bracket so far (exit code 130).",
      "Print the line with the factor alone: no progress, no warnings"};
  command.find = fos;
  add_analysis(app, code, std::move(command));
}

}  // namespace edda
