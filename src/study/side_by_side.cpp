#include "study/side_by_side.hpp"

#include <algorithm>
#include <utility>

#include "base/threads.hpp"

namespace edda {

SideBySide::SideBySide(int threads, int tasks)
    : places_(static_cast<std::size_t>(std::max(std::min(threads, tasks), 1))),
      share_(std::max(threads / static_cast<int>(places_), 1)) {}

SideBySide::~SideBySide() {
  for (auto& [number, thread] : running_) thread.request_stop();
  running_.clear();  // waits for each
}

std::size_t SideBySide::begin(Task task) {
  const std::size_t number = next_++;
  if (places_ == 1) {
    here_ = {std::move(task), number};
    return number;
  }
  const auto run = [this, number, work = std::move(task)](const std::stop_token& stop) {
    keep_to_threads(share_);
    std::exception_ptr trouble;
    try {
      work(stop);
    } catch (...) {
      trouble = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_.push_back({number, trouble});
    one_has_ended_.notify_one();
  };
  running_.emplace(number, std::jthread(run));
  return number;
}

void SideBySide::stop(std::size_t number) {
  if (here_.task && here_.number == number) here_.stop.request_stop();
  if (const auto found = running_.find(number); found != running_.end()) {
    found->second.request_stop();
  }
}

std::size_t SideBySide::wait_for_one() {
  if (here_.task) {
    const Here here = std::exchange(here_, {});
    here.task(here.stop.get_token());
    return here.number;
  }
  std::unique_lock lock(mutex_);
  one_has_ended_.wait(lock, [&] { return !ended_.empty(); });
  const Ended one = ended_.front();
  ended_.pop_front();
  lock.unlock();
  running_.erase(one.number);
  if (one.trouble) std::rethrow_exception(one.trouble);
  return one.number;
}

int tasks_within(double memory, int wanted, std::size_t blocks) {
  constexpr double bytes_per_block = 5e4, part = 0.5;  // of heaps of irregular polygons
  const double room = part * memory / (bytes_per_block * static_cast<double>(blocks));
  return room < wanted ? std::max(static_cast<int>(room), 1) : wanted;
}

}  // namespace edda
