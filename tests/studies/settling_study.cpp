// Ways to rest compared: settling_study [NAME...], of all models or those named. A row per model:
// steps and CPU seconds (one thread) by adaptive damping, by local damping (0.8), by kinetic
// damping (all velocities to zero where the kinetic energy has passed a peak) and by the implicit
// method without velocities; and how far displacements and stresses are from those of the first,
// root of the mean square over the largest displacement and over that of the stresses. Exit 1 if
// adaptive damping finds no rest.
#include <omp.h>

#include <atomic>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>

#include "observe/observe.hpp"
#include "run/run_model.hpp"
#include "step/changes.hpp"
#include "verification/cut_slope.hpp"

namespace edda {
namespace {

constexpr const char* until_rest = "\n[[stage]]\nuntil = 'equilibrium'\n";

std::string example(const std::string& name) {
  std::ifstream file(EDDA_SOURCE_DIR "/examples/" + name + ".toml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Without the tables of this name, each up to the next table of another one.
std::string without(const std::string& text, const std::string& table) {
  std::istringstream lines(text);
  std::string line, kept;
  bool leaves_out = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("[")) leaves_out = line.starts_with(table);
    if (!leaves_out) kept += line + "\n";
  }
  return kept;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) {
    std::fprintf(stderr, "settling_study: no \"%s\" in the example\n", what.c_str());
    std::exit(2);
  }
  return text.replace(at, what.size(), by);
}

/// An example that has no stages, brought to rest in place of run for a time.
std::string at_rest(const std::string& name) {
  return without(without(example(name), "[solver]"), "[output]") + until_rest;
}

std::string brick_wall(int columns, int rows) {
  return "[materials.brick]\ndensity = 1900.0\nyoung = 1e9\npoisson = 0.2\n[joints.dry]\n"
         "friction_angle = 35.0\n[[block]]\nfixed = true\npolygon = " +
         rectangle(-1.0, -0.5, 0.5 * columns + 1.0, 0.0) +
         "\n[[brick_wall]]\ncolumns = " + std::to_string(columns) +
         "\nrows = " + std::to_string(rows) + "\nbrick = [0.5, 0.25]\n" + until_rest;
}

struct Case {
  std::string name, toml;
};

std::vector<Case> cases() {
  CutSlope slope = cut_slope(4);
  slope.more = until_rest;
  const std::string tunnel = example("tunnel"), dam = example("dam");
  return {
      {"cavern",
       replaced(replaced(at_rest("cavern"), "friction_angle = 5.0", "friction_angle = 45.0"),
                "stiffness = \"19 TPa\"", "")},
      {"slope", replaced(at_rest("slope"), "friction_angle = 20.0", "friction_angle = 38.0")},
      {"tunnel", tunnel},
      {"dam", replaced(replaced(replaced(replaced(replaced(dam, "history = \"dam-level.csv\"", ""),
                                                  "duration = 10.0", "until = \"equilibrium\""),
                                         "damping = { local = 0.5 }", ""),
                                "history_every = 0.1", ""),
                       "every = 1.0", "")},
      {"roof-wedge", example("roof-wedge")},
      {"toppling", replaced(at_rest("toppling"), "friction_angle = 40.0", "friction_angle = 50.0")},
      {"arch", at_rest("arch")},
      {"quake-cavern", example("quake-cavern")},
      {"bolted-slope", without(at_rest("bolted-slope"), "[[shaking]]")},
      {"statistical slope", replaced(replaced(without(slope_model(slope), "[solver]"),
                                              "friction_angle = 30.0", "friction_angle = 45.0"),
                                     "friction_angle = 35.0", "friction_angle = 45.0")},
      {"wall 20 x 20", brick_wall(20, 20)},
      {"wall 50 x 40", brick_wall(50, 40)},
      {"wall 100 x 100", brick_wall(100, 100)},
  };
}

enum class Way { adaptive, local, kinetic, implicit };

struct Answer {
  bool rests = false;
  std::string message;
  std::size_t blocks = 0;
  std::uint64_t steps = 0;
  double seconds = 0.0;
  std::vector<Vec2> moved;     ///< [nb] m, of the centroids
  std::vector<Tensor> stress;  ///< [nb] Pa
};

double kinetic_energy_of(const Simulation& sim) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (is_free(sim.scene->blocks, sim.motion.state, i)) {
      sum += kinetic_energy(sim.motion.masses, sim.scene->blocks, sim.motion.state.velocity, i);
    }
  }
  return sum;
}

/// Ends a run that has taken `most` CPU seconds.
Answer answer_of(const Case& c, Way way, double most) {
  Answer answer;
  std::string toml = c.toml;
  if (way == Way::implicit) toml += "\n[solver]\nmethod = 'dda'\ndynamic = false\n";
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/examples/" + c.name + ".toml", {});
  if (!model.ok()) {
    answer.message = to_string(model.faults().front());
    return answer;
  }
  Model& m = model.value();
  for (Stage& stage : m.stages) {
    if (way == Way::local || way == Way::kinetic) stage.damping.adaptive = 0.0;
    if (way == Way::local) stage.damping.local = 0.8;
  }
  // What comes behind the last equilibrium is no way to rest.
  std::size_t last = m.stages.size() - 1;
  while (m.stages[last].until != StageEnd::equilibrium) --last;
  m.output.settling = false;
  m.output.every = m.output.history_every = 1e3;
  Result<PreparedRun> run = prepare_run(std::move(m));
  if (!run.ok()) {
    answer.message = to_string(run.faults().front());
    return answer;
  }
  Simulation& sim = run.value().sim;
  answer.blocks = sim.scene->blocks.size();
  RunOptions options;
  options.last_stage = last;
  double before = 0.0;
  const BodyVectors none = zero_vectors(sim.scene->blocks);
  const std::clock_t start = std::clock();
  std::atomic<bool> stop = false;
  options.stop = &stop;
  options.after_step = [&] {
    if (static_cast<double>(std::clock() - start) > most * CLOCKS_PER_SEC) stop = true;
    if (way != Way::kinetic) return false;
    const double now = kinetic_energy_of(sim);
    if (now < before) change_velocities(sim, none);
    before = now < before ? 0.0 : now;
    return false;
  };
  const Result<Outcome> outcome = run_model(run.value(), options);
  answer.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (!outcome.ok()) return answer;
  answer.rests = outcome.value().status == Status::equilibrium;
  answer.message = outcome.value().message;
  answer.steps = outcome.value().steps;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    answer.moved.push_back(displacement_of(sim.motion.state, i, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}));
    const BlockStress s = block_stress(sim, sim.motion.state, i);
    answer.stress.push_back({s.xx, s.yy, s.xy});
  }
  return answer;
}

/// Root of the mean square of the differences: of displacements over the largest, of stresses over
/// theirs.
struct Apart {
  double moved = 0.0, stress = 0.0;
};

Apart apart(const Answer& a, const Answer& b) {
  double most = 0.0, moved = 0.0, stress = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.moved.size(); ++i) {
    keep_largest(most, norm(a.moved[i]));
    const Vec2 d = b.moved[i] - a.moved[i];
    moved += dot(d, d);
    const Tensor s = a.stress[i], t = b.stress[i];
    const auto square = [](double xx, double yy, double xy) {
      return xx * xx + yy * yy + 2.0 * xy * xy;
    };
    size += square(s.xx, s.yy, s.xy);
    stress += square(t.xx - s.xx, t.yy - s.yy, t.xy - s.xy);
  }
  return {std::sqrt(moved / static_cast<double>(a.moved.size())) / most, std::sqrt(stress / size)};
}

bool wanted(int argc, char** argv, const std::string& name) {
  for (int q = 1; q < argc; ++q) {
    if (name == argv[q]) return true;
  }
  return argc == 1;
}

}  // namespace
}  // namespace edda

int main(int argc, char** argv) {
  using namespace edda;
  omp_set_num_threads(1);
  bool all_rest = true;
  std::printf(
      "Steps and CPU seconds to rest; in brackets how far displacements and stresses are "
      "from the first, %%.\n\n");
  std::printf(
      "| model | blocks | adaptive | local 0.8 | kinetic | implicit, static |\n"
      "|---|---|---|---|---|---|\n");
  for (const Case& c : cases()) {
    if (!wanted(argc, argv, c.name)) continue;
    const Answer first = answer_of(c, Way::adaptive, 1e9);
    all_rest = all_rest && first.rests;
    std::printf("| %s | %zu | %llu, %.2f s%s |", c.name.c_str(), first.blocks,
                static_cast<unsigned long long>(first.steps), first.seconds,
                first.rests ? "" : ", no rest");
    std::fflush(stdout);
    if (!first.rests) std::fprintf(stderr, "%s: %s\n", c.name.c_str(), first.message.c_str());
    for (const Way way : {Way::local, Way::kinetic, Way::implicit}) {
      const Answer answer = answer_of(c, way, 10.0 + 3.0 * first.seconds);
      if (!answer.rests) {
        std::printf(" no rest in %llu, %.2f s |", static_cast<unsigned long long>(answer.steps),
                    answer.seconds);
        std::fprintf(stderr, "%s: %s\n", c.name.c_str(), answer.message.c_str());
      } else {
        const Apart off = apart(first, answer);
        std::printf(" %llu, %.2f s (%.2g, %.2g) |", static_cast<unsigned long long>(answer.steps),
                    answer.seconds, 100.0 * off.moved, 100.0 * off.stress);
      }
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  return all_rest ? 0 : 1;
}
