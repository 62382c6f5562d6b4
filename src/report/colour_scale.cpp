#include "report/colour_scale.hpp"

#include <algorithm>
#include <cmath>

#include "report/scene.hpp"
#include "report/shapes.hpp"

namespace edda {
namespace {

constexpr std::size_t most_kinds = 12;

template <class Visit>
void each_value(std::span<const Snapshot> shots, Visit visit) {
  for (const Snapshot& shot : shots) {
    const ShownField& field = shot.field;
    const std::vector<double> areas = field.of_contacts ? field.lengths : cell_areas(shot.blocks);
    for (std::size_t c = 0; c < field.values.size(); ++c) {
      if (!field.of_contacts && is_fixed(shot.blocks, c)) continue;
      if (std::isfinite(field.values[c])) visit(field.values[c], areas.empty() ? 1.0 : areas[c]);
    }
  }
}

}  // namespace

ColourScale::ColourScale(std::span<const Snapshot> shots,
                         std::optional<std::pair<double, double>> range, bool whole)
    : kind_(shots.front().field.kind), of_contacts_(shots.front().field.of_contacts) {
  take_values(shots, whole || (of_contacts_ && !shots.front().field.along_faces));
  if (kind_ != ScaleKind::numbers) return;
  if (range) {
    take_range(range->first, range->second);
  } else {
    judge_values();
  }
}

void ColourScale::take_values(std::span<const Snapshot> shots, bool whole) {
  Ends inner;
  bool any = false;
  for (std::size_t k = 0; k < shots.size(); ++k) {
    std::vector<Weighed> values;
    each_value(shots.subspan(k, 1), [&](double v, double weight) {
      values.push_back({v, weight});
      if (kind_ == ScaleKind::kinds && v >= 0.0) kinds_.push_back(static_cast<std::size_t>(v));
    });
    if (values.empty()) continue;
    // For each drawing separately, so that small values in one do not hide those of another.
    const auto widen = [&](Ends& ends, Ends by) {
      ends = any ? Ends{std::min(ends.low, by.low), std::max(ends.high, by.high)} : by;
    };
    const auto [least, most] =
        std::minmax_element(values.begin(), values.end(),
                            [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
    widen(all_, {least->value, most->value});
    widen(inner, inner_ends(values));
    any = true;
  }
  const Ends drawn = whole ? all_ : drawn_ends(all_, inner);
  take_range(drawn.low, drawn.high);
  std::sort(kinds_.begin(), kinds_.end());
  kinds_.erase(std::unique(kinds_.begin(), kinds_.end()), kinds_.end());
}

void ColourScale::take_range(double low, double high) {
  values_below_ = all_.low < low;
  values_above_ = all_.high > high;
  low_ = low;
  high_ = high;
  two_sided_ = low < 0.0 && high > 0.0;
}

void ColourScale::judge_values() {
  // Values that differ by rounding give no range: the bar then runs from zero to the one value.
  const double size = std::max(std::abs(low_), std::abs(high_));
  if (high_ - low_ <= one_value * size) {
    if (low_ > 0.0) low_ = 0.0;
    if (high_ < 0.0) high_ = 0.0;
  }
  two_sided_ = low_ < -1e-3 * size && high_ > 1e-3 * size;
}

Colour ColourScale::of(double value) const {
  if (kind_ == ScaleKind::plain || !std::isfinite(value)) return ink::block;
  if (kind_ == ScaleKind::kinds) {
    const auto kind = static_cast<std::size_t>(std::max(value, 0.0));
    return of_contacts_ ? state_colour(kind) : kind_colour(kind);
  }
  if (!(high_ > low_)) return sequential(0.0);
  const double v = std::clamp(value, low_, high_);
  if (!two_sided_) return sequential((v - low_) / (high_ - low_));
  return diverging(0.5 + 0.5 * v / std::max(-low_, high_));
}

bool ColourScale::has_legend() const {
  if (kind_ == ScaleKind::kinds) return !kinds_.empty() && kinds_.size() <= most_kinds;
  return kind_ == ScaleKind::numbers;
}

}  // namespace edda
