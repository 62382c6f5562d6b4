#include "app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "app/common.hpp"
#include "base/text.hpp"
#include "run/wall_clock.hpp"

namespace edda {
namespace {

constexpr std::size_t gap = 2;  // columns between two parts

/// Columns of the terminal on stderr.
std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// Characters of a text in UTF-8.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string percent(const Progress& p) {
  return fmt::format("{:.0f} %", 100.0 * std::clamp(p.fraction, 0.0, 1.0));
}

std::string stage_text(const Progress& p) {
  const std::string at = p.ramp_at.empty() ? "" : ", " + p.ramp_at;
  return p.stage_name.empty() && at.empty()
             ? std::string{}
             : fmt::format("stage {} of {}{}{}", p.stage + 1, p.stages,
                           p.stage_name.empty() ? "" : " (" + p.stage_name + ")", at);
}

/// Its parts in the order of their importance.
std::vector<std::string> parts_of(const Progress& p) {
  return {percent(p),
          duration_text(p.seconds_left) + (p.at_most ? " left at most" : " left"),
          stage_text(p),
          fmt::format("t {:.4g} s", p.time),
          fmt::format("{:.3g} steps/s", p.rate),
          fmt::format("velocity {:.2g} m/s", p.largest_velocity),
          fmt::format("penetration {:.2g} m", p.largest_overlap)};
}

std::string bar_of(double fraction, std::size_t width) {
  const double filled = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(width, '.');
  return '[' + bar + ']';
}

}  // namespace

std::string progress_line(const Progress& p, std::size_t columns) {
  std::string text;
  std::size_t used = 0;
  for (const std::string& part : parts_of(p)) {
    const std::size_t more = length_of(part) + (used > 0 ? gap : 0);
    if (part.empty()) continue;
    if (used + more > columns) break;
    text += (used > 0 ? std::string(gap, ' ') : "") + part;
    used += more;
  }
  constexpr std::size_t narrowest = 8, widest = 24, ends = 2;
  if (used + gap + ends + narrowest > columns) return text;
  const std::size_t width = std::min(widest, columns - used - gap - ends);
  return bar_of(p.fraction, width) + std::string(gap, ' ') + text;
}

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {}

/// Elsewhere than on a terminal lines are rare.
bool ProgressBar::is_due() {
  if (terminal_) return true;
  const double wall = since(start_);
  if (wall < next_line_) return false;
  next_line_ = wall < 60.0 ? wall + 10.0 : wall + 60.0;
  return true;
}

void ProgressBar::show(const Progress& p) {
  if (!is_due()) return;
  // The last column stays empty: some terminals go to the next line once it is full.
  if (terminal_) return draw(progress_line(p, terminal_columns() - 1));
  const std::string stage = stage_text(p);
  fmt::print(stderr,
             "{}, {}t = {:.4g} s, {} steps, {:.3g} steps/s, {} left, velocity {:.2g} m/s, "
             "penetration {:.2g} m\n",
             percent(p), stage.empty() ? "" : stage + ", ", p.time, p.steps, p.rate,
             duration_text(p.seconds_left), p.largest_velocity, p.largest_overlap);
}

void ProgressBar::show_samples(const Progress& p, std::size_t done, std::size_t of) {
  if (!is_due()) return;
  const std::string number =
      of > 0 ? fmt::format("{} of {}", done, counted(of, "sample")) : counted(done, "sample");
  const std::string left = of > 0 && p.seconds_left >= 0.0
                               ? fmt::format("  {} left", duration_text(p.seconds_left))
                               : std::string();
  const std::string text = fmt::format("{}{}  {:.3g} samples/s", number, left, p.rate);
  if (!terminal_) {
    fmt::print(stderr, "{}\n", text);
  } else {
    draw(of > 0 ? bar_of(p.fraction, 24) + "  " + text : text);
  }
}

void ProgressBar::draw(const std::string& line) {
  fmt::print(stderr, "\r\x1b[K{}", line);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::finish() {
  if (drawn_) std::fputc('\n', stderr);
  drawn_ = false;
}

}  // namespace edda
