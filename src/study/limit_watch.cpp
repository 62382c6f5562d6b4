#include "study/limit_watch.hpp"

#include <fmt/format.h>

#include <utility>

namespace edda {

LimitWatch::LimitWatch(const std::atomic<bool>* stop, std::function<void(const std::string&)> say)
    : say_(std::move(say)) {
  programs_.stop = stop;
  if (say_) programs_.after_round = [this] { after_round(); };
}

void LimitWatch::begin(const std::string& what) {
  const std::lock_guard lock(mutex_);
  what_ = what;
}

void LimitWatch::after_round() {
  constexpr long every = 1500;  // ms
  const std::chrono::duration<double, std::milli> since = std::chrono::steady_clock::now() - began_;
  const long now = static_cast<long>(since.count());
  long last = said_.load();
  if (now - last < every || !said_.compare_exchange_strong(last, now)) return;
  const std::lock_guard lock(mutex_);
  say_(fmt::format("limit of rigid blocks: {}, after {:.0f} s", what_, 1e-3 * since.count()));
}

}  // namespace edda
