#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "app/common.hpp"

namespace edda {

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {}

void ProgressBar::show(const Progress& p) {
  if (terminal_) return draw_bar(p);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (wall < next_line_) return;
  next_line_ = wall < 60.0 ? wall + 10.0 : wall + 60.0;
  fmt::print(stderr,
             "{:.0f} %, t = {:.4g} s, {} steps, {:.3g} steps/s, {} left, kinetic {:.3g} J, overlap "
             "{:.2g} m\n",
             100.0 * p.fraction, p.time, p.steps, p.rate, duration_text(p.seconds_left), p.kinetic,
             p.largest_overlap);
}

void ProgressBar::draw_bar(const Progress& p) {
  constexpr int width = 24;
  const int full = std::clamp(static_cast<int>(p.fraction * width), 0, width);
  std::string bar(static_cast<std::size_t>(full), '#');
  bar.resize(width, '.');
  fmt::print(stderr,
             "\r\x1b[K[{}] {:3.0f} %  t {:.4g} s  {:.3g} steps/s  {} left  kinetic {:.2g} J  "
             "overlap {:.1g} m",
             bar, 100.0 * p.fraction, p.time, p.rate, duration_text(p.seconds_left), p.kinetic,
             p.largest_overlap);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::finish() {
  if (drawn_) std::fputc('\n', stderr);
  drawn_ = false;
}

}  // namespace edda
