// Number of threads of the loops of base/parallel.hpp.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// From now on the loops that this thread calls, and the steps of every run, use `threads` threads
/// (1 or more).
void report_threads(int threads);
/// Restores at its end the number of threads that this thread's loops had at its start.
class SameThreads {
 public:
  SameThreads();
  ~SameThreads();
  SameThreads(const SameThreads&) = delete;
  SameThreads& operator=(const SameThreads&) = delete;

 private:
  int threads_;
};
/// Whether the number of threads has been set, by report_threads() or OMP_NUM_THREADS.
bool threads_are_given();
/// For a thread beside which others compute: its loops, and the steps of every run that it makes,
/// use up to `threads` threads (1 or more) from now on, also where their number is chosen.
void keep_to_threads(int threads);
/// Largest number of threads among which a run that this thread makes may choose: that of
/// keep_to_threads(); without it all cores.
int most_threads();

/// Chooses the number of threads by timing. More threads are slower where a model is small, or
/// where another program uses the cores: each loop then waits for the thread that is not running.
/// So steps are timed with all threads, with half of them, and so on down to one, and continue with
/// the fastest number; this is repeated after a while. Results do not depend on the number
/// (base/parallel.hpp).
class ThreadChoice {
 public:
  /// Up to `most`, 1 or more.
  explicit ThreadChoice(int most);
  /// Number of threads for the next step.
  int now() const { return candidates_[at_]; }
  /// Reports the time that this step has taken, s.
  void stepped(double seconds);

 private:
  void begin(std::size_t candidate);

  std::vector<int> candidates_;  ///< the most first
  std::vector<double> cost_;     ///< s a step, of each when last tried
  std::size_t at_ = 0;           ///< in use
  bool trying_ = true;           ///< one after another; else the best of them is in use
  std::size_t steps_ = 0;        ///< since the last change
  double spent_ = 0.0;           ///< s since then
  double first_ = 0.0;           ///< s: of it the first step, which may lay out memory anew
  double tried_ = 0.0,
         stay_ = 0.0;      ///< s: what this round of trials has taken, how long its choice holds
  double patience_ = 4.0;  ///< stay_ / tried_, of the next choice
};

}  // namespace edda
