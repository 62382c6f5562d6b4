#include "cores.hpp"

#include <time.h>

#include <algorithm>

namespace edda {

double CountedCores::now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Threads get equal numbers of tasks in a row, the first ones one more where they do not divide.
void CountedCores::shared(std::span<const double> seconds_of_tasks) {
  const std::size_t n = seconds_of_tasks.size(), each = n / cores_, more = n % cores_;
  double most = 0.0;
  for (std::size_t core = 0, task = 0; core < cores_ && task < n; ++core) {
    double own = 0.0;
    for (const std::size_t end = task + each + (core < more ? 1 : 0); task < end; ++task)
      own += seconds_of_tasks[task];
    most = std::max(most, own);
    on_one_ += own;
  }
  busiest_ += most;
  ++loops_;
}

}  // namespace edda
