// Tasks of a study that run side by side: trials of a factor, runs of a verification.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

namespace edda {

/// Runs a few tasks at a time, each in a thread of its own. A task must write only what belongs to
/// it until wait_for_one() has returned its number. All functions are for the thread that made the
/// object.
class SideBySide {
 public:
  /// Ends early, without a result, where it is asked to stop.
  using Task = std::function<void(const std::stop_token&)>;

  /// Up to `tasks` at a time, 1 or more, but no more than `threads`. The loops within each use an
  /// equal share of the threads, which is one where there are no more threads than tasks. Where
  /// only one task may run, it does so in wait_for_one(), on the calling thread and with all
  /// threads of its loops.
  SideBySide(int threads, int tasks);
  /// Stops all tasks and waits until they have ended.
  ~SideBySide();
  SideBySide(const SideBySide&) = delete;
  SideBySide& operator=(const SideBySide&) = delete;

  /// Number of tasks that may run at a time.
  std::size_t places() const { return places_; }
  bool has_room() const { return running() < places_; }
  /// Begins a task and returns its number. Call only where there is room.
  std::size_t begin(Task task);
  /// Asks this task to stop. It keeps its place until wait_for_one() has returned its number.
  void stop(std::size_t number);
  /// Waits until a task has ended and returns its number; call only where one has begun. Throws
  /// what the task has thrown.
  std::size_t wait_for_one();

 private:
  struct Ended {
    std::size_t number;
    std::exception_ptr trouble;  ///< empty: none
  };
  /// The task that runs on the calling thread.
  struct Here {
    Task task;
    std::size_t number = 0;
    std::stop_source stop{};
  };

  std::size_t running() const { return running_.size() + (here_.task ? 1 : 0); }

  const std::size_t places_;
  const int share_;  ///< threads of the loops within a task
  std::size_t next_ = 0;
  Here here_{};
  std::mutex mutex_;
  std::condition_variable one_has_ended_;
  std::deque<Ended> ended_;
  std::map<std::size_t, std::jthread> running_;  ///< by number
};

/// As many of `wanted` tasks, 1 at least, as half of `memory` (bytes) has room for, if each has a
/// simulation of so many blocks.
int tasks_within(double memory, int wanted, std::size_t blocks);

}  // namespace edda
