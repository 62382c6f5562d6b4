// How many threads share the loops of base/parallel.hpp.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// From now on the loops that this thread calls, and the steps of every run, take `threads` (1 or
/// more).
void say_threads(int threads);
/// At its end this thread has as many threads for its loops again as it had at the start.
class SameThreads {
 public:
  SameThreads();
  ~SameThreads();
  SameThreads(const SameThreads&) = delete;
  SameThreads& operator=(const SameThreads&) = delete;

 private:
  int threads_;
};
/// Whether somebody has said how many: say_threads(), or OMP_NUM_THREADS.
bool threads_are_said();

/// Threads that wait for one another lose more than they bring where a model is small, or where
/// another program has their cores: then each loop lasts as long as the thread that is not let run.
/// So steps are timed with all threads, with half of them and with one, and go on with the
/// quickest; again after a while, as others come and go. Results do not depend on the number
/// (base/parallel.hpp).
class ThreadChoice {
 public:
  /// Up to `most`, 1 or more.
  explicit ThreadChoice(int most);
  /// For the next step.
  int now() const { return candidates_[at_]; }
  /// That step has taken so many seconds.
  void stepped(double seconds);

 private:
  void begin(std::size_t candidate);

  std::vector<int> candidates_;  ///< the most first
  std::vector<double> cost_;     ///< s a step, of each when last tried
  std::size_t at_ = 0;           ///< in use
  bool trying_ = true;           ///< one after another; else the best of them is in use
  std::size_t steps_ = 0;        ///< since the last change
  double spent_ = 0.0;           ///< s since then
  double tried_ = 0.0,
         stay_ = 0.0;      ///< s: what this round of trials has taken, how long its choice holds
  double patience_ = 4.0;  ///< stay_ / tried_, of the next choice
};

}  // namespace edda
