#include "study/limit_watch.hpp"

#include <fmt/format.h>

#include <utility>

#include "run/wall_clock.hpp"

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
  if (!pace_.due()) return;
  const std::lock_guard lock(mutex_);
  say_(fmt::format("limit of rigid blocks: {}, after {:.0f} s", what_, since(began_)));
}

}  // namespace edda
