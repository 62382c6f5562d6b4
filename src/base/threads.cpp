#include "base/threads.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>

namespace edda {
namespace {

constexpr double trial_seconds = 0.02;
constexpr std::size_t trial_steps = 2;
// Trials of slower numbers then take 2 % of the time. At first a choice is kept for less time,
// since early steps differ from later ones.
constexpr double most_patience = 50.0;

std::atomic<bool> said{false};
thread_local int kept_to = 0;  // 0: to none

}  // namespace

void report_threads(int threads) {
  omp_set_num_threads(threads);
  said = true;
}

SameThreads::SameThreads() : threads_(omp_get_max_threads()) {}

SameThreads::~SameThreads() {
  omp_set_num_threads(threads_);
}

bool threads_are_given() {
  return said || std::getenv("OMP_NUM_THREADS") != nullptr;
}

void keep_to_threads(int threads) {
  omp_set_num_threads(threads);
  kept_to = threads;
}

int most_threads() {
  return kept_to > 0 ? kept_to : omp_get_num_procs();
}

ThreadChoice::ThreadChoice(int most) {
  for (int n = most; n >= 1; n /= 2) candidates_.push_back(n);
  cost_.resize(candidates_.size());
}

void ThreadChoice::begin(std::size_t candidate) {
  at_ = candidate;
  steps_ = 0;
  spent_ = 0.0;
}

void ThreadChoice::stepped(double seconds) {
  if (candidates_.size() == 1) return;
  spent_ += seconds;
  ++steps_;
  if (!trying_) {
    if (spent_ < stay_) return;
    trying_ = true;
    return begin(0);
  }
  if (steps_ == 1) first_ = seconds;
  if (steps_ < trial_steps || spent_ < trial_seconds) return;
  cost_[at_] = (spent_ - first_) / static_cast<double>(steps_ - 1);
  tried_ += spent_;
  if (at_ + 1 < candidates_.size()) return begin(at_ + 1);
  trying_ = false;
  stay_ = patience_ * tried_;
  patience_ = std::min(2.0 * patience_, most_patience);
  tried_ = 0.0;
  begin(static_cast<std::size_t>(std::min_element(cost_.begin(), cost_.end()) - cost_.begin()));
}

}  // namespace edda
