#include "cores.hpp"

#include <time.h>

#include <algorithm>

namespace edda {

double CountedCores::now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void CountedCores::shared(std::span<const double> seconds_of_tasks,
                          std::span<const std::size_t> weights) {
  const std::vector<std::size_t> equal(weights.empty() ? seconds_of_tasks.size() : 0, 1);
  const std::vector<std::size_t> first = shares(weights.empty() ? equal : weights, cores_);
  double most = 0.0;
  for (std::size_t core = 0; core < cores_; ++core) {
    double own = 0.0;
    for (std::size_t task = first[core]; task < first[core + 1]; ++task)
      own += seconds_of_tasks[task];
    most = std::max(most, own);
    on_one_ += own;
  }
  busiest_ += most;
  ++loops_;
}

}  // namespace edda
