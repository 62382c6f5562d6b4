// Speed of the whole step on one scene (scenes.hpp), for tools/bench to read.
//   bench_scene SCENE [--steps N] [--repeat N] [--threads N] [--cache DIR] [--wait]
//               [--limit ROUNDS | --cores N]
// Prints a line of JSON for the scene, one for each repetition of so many steps, and one for the
// memory. With --wait each repetition waits for a line on standard input, so that something else
// can be measured in between. --limit compares the critical step with the true one instead, and
// --cores counts how so many cores would share the steps.
#include <omp.h>
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#endif

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "contacts/face_reading.hpp"
#include "cores.hpp"
#include "memory.hpp"
#include "scenes.hpp"
#include "step/changes.hpp"
#include "step/faces_now.hpp"
#include "step/tile_step.hpp"
#include "stopwatch.hpp"
#include "true_step.hpp"
#include "wall.hpp"

namespace {

using edda::Simulation;

struct Options {
  std::string scene, cache;
  long steps = 100, repeat = 1, threads = 1, limit = 0, cores = 0;
  bool wait = false;
};

bool read_options(int argc, char** argv, Options& o) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--wait") {
      o.wait = true;
    } else if (word.rfind("--", 0) != 0 && o.scene.empty()) {
      o.scene = word;
    } else if (i + 1 == argc) {
      return false;
    } else if (word == "--cache") {
      o.cache = argv[++i];
    } else {
      long* const value = word == "--steps"     ? &o.steps
                          : word == "--repeat"  ? &o.repeat
                          : word == "--threads" ? &o.threads
                          : word == "--limit"   ? &o.limit
                          : word == "--cores"   ? &o.cores
                                                : nullptr;
      if (value == nullptr || (*value = std::strtol(argv[++i], nullptr, 10)) < 1) return false;
    }
  }
  return !o.scene.empty();
}

/// Those of meshed blocks instead of these.
std::size_t blocks_and_zones(const edda::BlockSet& b) {
  std::size_t count = b.meshes.zone.size();
  for (std::size_t i = 0; i < b.size(); ++i) count += b.is_meshed(i) ? 0 : 1;
  return count;
}

void describe(edda::BenchScene& scene, double made_in) {
  const Simulation& s = scene.sim;
  std::size_t closed = 0;
  for (std::size_t c = 0; c < s.motion.contacts.size(); ++c) {
    if (edda::is_closed_now(s, c)) ++closed;
  }
  std::printf(
      "{\"blocks\": %zu, \"candidates\": %zu, \"closed\": %zu, \"step\": %.6g, "
      "\"critical_step\": %.6g, \"row_error\": %.3g, \"made_in\": %.2f}\n",
      blocks_and_zones(s.scene->blocks), s.motion.contacts.size(), closed, s.motion.state.step,
      s.control.bound.critical_step, scene.row_error, made_in);
  std::fflush(stdout);
}

/// What callgrind counts, too.
void measure(Simulation& s, const Options& o) {
  const edda::OpenCloseCounts before = s.accounts.open_close;
  const edda::StepSeconds stages = s.accounts.seconds;
  const std::uint64_t searches = s.motion.contacts.rebuilds, redone = s.accounts.steps.redone;
  CALLGRIND_START_INSTRUMENTATION;
  const Stopwatch watch(static_cast<int>(o.threads));
  edda::take_steps(s, o.steps);
  const double seconds = watch.seconds();
  CALLGRIND_STOP_INSTRUMENTATION;
  const double sampled = s.accounts.seconds.sum() - stages.sum();
  const double scale = sampled > 0.0 ? seconds / sampled : 0.0;
  std::printf(
      "{\"steps\": %ld, \"seconds\": %.6g, \"switched\": %llu, \"passes\": %llu, "
      "\"searches\": %llu, \"redone\": %llu, \"search\": %.4g, \"forces\": %.4g, "
      "\"integrate\": %.4g}\n",
      o.steps, seconds,
      static_cast<unsigned long long>(s.accounts.open_close.switched - before.switched),
      static_cast<unsigned long long>(s.accounts.open_close.passes - before.passes),
      static_cast<unsigned long long>(s.motion.contacts.rebuilds - searches),
      static_cast<unsigned long long>(s.accounts.steps.redone - redone),
      scale * (s.accounts.seconds.search - stages.search),
      scale * (s.accounts.seconds.forces - stages.forces),
      scale * (s.accounts.seconds.integrate - stages.integrate));
  std::fflush(stdout);
}

/// Without damping, which shortens the one and is not in the other.
void compare_steps(Simulation& s, int rounds) {
  change_damping(s, {}, true);
  std::printf("{\"undamped_step\": %.6g, \"true_step\": %.6g, \"true_step_of_all\": %.6g}\n",
              s.control.bound.critical_step,
              edda::true_critical_step(s, edda::Carrying::now, rounds),
              edda::true_critical_step(s, edda::Carrying::may, rounds));
}

/// Steps made as if there were so many cores.
void count_cores(Simulation& s, const Options& o) {
  omp_set_num_threads(static_cast<int>(o.cores));
  edda::take_steps(s, 2);  // in tiles for so many
  const edda::CountedCores counted(static_cast<int>(o.cores));
  CALLGRIND_START_INSTRUMENTATION;
  const Stopwatch watch(1);
  edda::take_steps(s, o.steps);
  const double seconds = watch.seconds();
  CALLGRIND_STOP_INSTRUMENTATION;
  std::printf(
      "{\"cores\": %ld, \"steps\": %ld, \"seconds\": %.6g, \"shared\": %.6g, \"busiest\": %.6g, "
      "\"loops\": %zu}\n",
      o.cores, o.steps, seconds, counted.on_one(), counted.busiest(), counted.loops());
}

/// Whether there was a line before the end of the input.
bool wait_for_line() {
  int c = std::getchar();
  while (c != '\n' && c != EOF) c = std::getchar();
  return c == '\n';
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  const bool good = read_options(argc, argv, o);
  const std::string flaw =
      good ? edda::flaw_of_scene(o.scene)
           : "bench_scene SCENE [--steps N] [--repeat N] [--threads N] [--cache DIR] "
             "[--wait] [--limit ROUNDS | --cores N]";
  if (!flaw.empty()) {
    std::fprintf(stderr, "%s\n", flaw.c_str());
    return 2;
  }
  omp_set_num_threads(static_cast<int>(o.threads));
  const Stopwatch watch(static_cast<int>(o.threads));
  edda::BenchScene scene = edda::make_scene(o.scene, o.cache);
  describe(scene, watch.seconds());
  if (o.limit > 0) {
    compare_steps(scene.sim, static_cast<int>(o.limit));
    return 0;
  }
  edda::take_steps(scene.sim, 2);  // what grows once has grown
  if (o.cores > 0) {
    count_cores(scene.sim, o);
    return 0;
  }
  for (long i = 0; i < o.repeat; ++i) {
    if (o.wait && !wait_for_line()) return 0;
    measure(scene.sim, o);
  }
  const edda::MemoryInUse m = edda::take_apart(std::move(scene.sim));
  std::printf(
      "{\"bytes\": %zu, \"model\": %zu, \"polygons\": %zu, \"block_arrays\": %zu, \"state\": "
      "%zu, \"contacts\": %zu, \"rest\": %zu, \"peak\": %zu}\n",
      m.sum(), m.model, m.polygons, m.blocks, m.state, m.contacts, m.rest, edda::peak_memory());
  return 0;
}
