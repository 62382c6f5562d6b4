#include "base/digits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>

namespace edda {
namespace {

int decimals_of(double number) {
  constexpr int digits = 14;
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number,
                                          std::chars_format::scientific, digits - 1);
  const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t e = all.find('e'), point = all.find('.');
  if (e == std::string_view::npos || point == std::string_view::npos) return 0;
  const std::size_t last = all.find_last_not_of('0', e - 1);
  int exponent = 0;
  const char* from = all.data() + e + (all[e + 1] == '+' ? 2 : 1);
  std::from_chars(from, all.data() + all.size(), exponent);
  return static_cast<int>(last - point) - exponent;
}

}  // namespace

void Digits::add(double number) {
  if (!std::isfinite(number)) return;
  if (number == 0.0) {
    ++zeros_;
  } else {
    ++with_[static_cast<std::size_t>(std::clamp(decimals_of(number), fewest, most) - fewest)];
  }
}

double Digits::unit() const {
  const auto whole = with_.begin() - fewest + 1;  // up to here
  const long long fractions = std::accumulate(whole, with_.end(), 0LL);
  const long long all = fractions > 0 ? fractions : std::accumulate(with_.begin(), whole, 0LL);
  if (all == 0) return zeros_ > 0 ? 1.0 : 0.0;
  constexpr long long part = 10;
  long long longer = 0;
  for (int d = most; d > fewest; --d) {
    longer += with_[static_cast<std::size_t>(d - fewest)];
    if (longer > 0 && longer * part >= all) return std::pow(10.0, -d);
  }
  return std::pow(10.0, -fewest);
}

}  // namespace edda
