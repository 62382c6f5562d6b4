// Factors of safety against limit equilibrium: fos_study [NAME [FOLDER]]. A line of a table per
// slope; with a folder its models are written there in place of being tried. Exit 1 if one is out
// by more than a hundredth.
#include <omp.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "study/fos.hpp"
#include "verification/exact_slopes.hpp"
#include "verification/scene.hpp"

int main(int argc, char** argv) {
  using namespace edda;
  const std::string only = argc > 1 ? argv[1] : "";
  omp_set_num_threads(1);
  std::printf(
      "| slope | blocks | exact | found | off by | trials | steps | CPU s | mechanism |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  int bad = 0;
  for (const ExactSlope& slope : exact_slopes()) {
    if (slope.name.find(only) == std::string::npos) continue;
    const std::string toml = slope.model + "[fos]\n" +
                             (slope.exclude.empty() ? "" : "exclude = [" + slope.exclude + "]\n");
    if (argc > 2) {
      std::string file = slope.name;
      for (char& c : file) c = c == ' ' ? '-' : c;
      std::ofstream(std::string(argv[2]) + "/" + file + ".toml")
          << "# exact: " << slope.factor << "\n"
          << toml;
      continue;
    }
    const Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/scene.toml", {});
    if (!model.ok()) {
      std::printf("| %s | %s |\n", slope.name.c_str(), to_string(model.faults().front()).c_str());
      ++bad;
      continue;
    }
    const std::clock_t began = std::clock();
    const Result<FosResult> found = find_factor(model.value(), {});
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    if (!found.ok()) {
      std::printf("| %s | %s |\n", slope.name.c_str(), to_string(found.faults().front()).c_str());
      ++bad;
      continue;
    }
    const FosResult& r = found.value();
    std::uint64_t steps = 0;
    for (const Trial& trial : r.trials) steps += trial.steps;
    const double off = r.factor ? *r.factor / slope.factor - 1.0 : INFINITY;
    bad += std::abs(off) <= 0.01 ? 0 : 1;
    std::printf("| %s | %zu | %.4f | %.4f | %+.2f %% | %zu | %llu | %.1f | %s |\n",
                slope.name.c_str(), r.blocks, slope.factor, r.factor.value_or(NAN), 100.0 * off,
                r.trials.size(), static_cast<unsigned long long>(steps), seconds,
                r.mechanism ? r.mechanism->text.c_str() : r.message.c_str());
    std::fflush(stdout);
  }
  return bad > 0 ? 1 : 0;
}
