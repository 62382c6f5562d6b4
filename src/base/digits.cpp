#include "base/digits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
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
  return std::max(static_cast<int>(last - point) - exponent, 0);
}

}  // namespace

void Digits::add(double number) {
  if (!std::isfinite(number)) return;
  ++with_[static_cast<std::size_t>(number == 0.0 ? 0 : std::min(decimals_of(number), most))];
}

double Digits::unit() const {
  long long all = with_[0], fractions = 0;
  for (std::size_t d = 1; d < with_.size(); ++d) fractions += with_[d];
  all += fractions;
  if (all == 0) return 0.0;
  constexpr long long part = 10;
  long long longer = 0;
  for (std::size_t d = with_.size() - 1; d > 0; --d) {
    longer += with_[d];
    if (longer > 0 && longer * part >= fractions) return std::pow(10.0, -static_cast<double>(d));
  }
  return 1.0;
}

}  // namespace edda
